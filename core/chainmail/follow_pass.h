#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "chainmail/propagate.h"
#include "chainmail/recorded_pass.h"

// How the waiting list of a recorded pass is found: the pass runs again in the loop that every pass runs in, with a
// list that logs what enters and leaves, and with outcomes that are read from the trace instead of computed.

namespace chainmail {

/// Records when candidates enter and leave a list, by the step of the pass.
struct WaitingLog {
  explicit WaitingLog(const Mesh& of) : mesh(of), candidate_of(of.neighbours.size()) {}

  /// A candidate's entry names its sponsor, which is updated once: each entry enters at most once per pass.
  void enter(Candidate candidate, double key) {
    candidate_of[candidate.entry] = static_cast<std::uint32_t>(candidates.size());
    candidates.push_back({mesh.neighbours[candidate.entry], candidate.sponsor, step, 0, true});
    keys.push_back(key);
  }
  void leave(Candidate candidate) { of(candidate).left = step + 1; }
  WaitingCandidate& of(Candidate candidate) { return candidates[candidate_of[candidate.entry]]; }
  /// Returns the history of the candidates, which the log loses.
  WaitingHistory history(TakingOrder order) {
    for (WaitingCandidate& one : candidates) {
      one.left = std::min(one.left, step);  // candidates that are dropped at the end leave with the last step
    }
    return {order, std::move(candidates), order == TakingOrder::by_key ? std::move(keys) : std::vector<double>()};
  }
  const Mesh& mesh;
  std::uint32_t step = 0;
  std::vector<WaitingCandidate> candidates;
  std::vector<double> keys;
  std::vector<std::uint32_t> candidate_of;
};

/// A waiting list that logs what enters and leaves.
template <WaitingList List>
class LoggedList : public List {
 public:
  explicit LoggedList(WaitingLog& log) : log_(&log) {}
  void admit(Candidate candidate, double violation) {
    log_->enter(candidate, List::key(candidate, violation));
    List::admit(candidate, violation);
  }
  Candidate take() {
    const Candidate candidate = List::take();
    log_->leave(candidate);
    return candidate;
  }

 private:
  WaitingLog* log_;
};

/// The object at the beginning of a recorded pass, as far as the loop needs it.
struct RecordedBody {
  explicit RecordedBody(const RecordedPass& of)
      : pass(of), mesh(of.mesh), positions(of.before), is_updated(of.mesh->element_count()) {
    for (const ElementId pin : of.conditions->pins) {
      is_updated[pin] = true;
    }
    for (std::size_t i = 0; i < of.handle.size(); ++i) {
      set_position(of.handle[i], of.handle_after(i));
    }
  }
  void begin_pass() {}
  bool updated(ElementId element) const { return is_updated[element]; }
  void mark_updated(ElementId element) { is_updated[element] = true; }
  template <class Visit>
  void for_each_neighbour(ElementId element, Visit visit) const {
    chainmail::for_each_neighbour(*mesh, pass.conditions->cuts, element, visit);
  }
  double violation(ElementId element, ElementId sponsor, EntryId entry) const {
    switch (mesh->space_dimension) {
      case 1:
        return violation_in<1>(element, sponsor, entry);
      case 2:
        return violation_in<2>(element, sponsor, entry);
      default:
        return violation_in<3>(element, sponsor, entry);
    }
  }
  template <int Dimension>
  double violation_in(ElementId element, ElementId sponsor, EntryId entry) const {
    const Softness& softness = *pass.conditions->softness;
    const auto region =
        valid_region<float, Dimension>(*mesh, softness.axes, sponsor, element, softness.of(mesh->entry_link[entry]));
    if (softness.axes.is_turned()) {
      const auto own = in_axes<Dimension>(element), about = in_axes<Dimension>(sponsor);
      return candidate_violation(*mesh, element, own.data(), sponsor, about.data(), region);
    }
    return candidate_violation(*mesh, element, &positions[std::size_t{element} * Dimension], sponsor,
                               &positions[std::size_t{sponsor} * Dimension], region);
  }
  /// Returns the position of an element along the axes that the pass computed in.
  template <int Dimension>
  std::array<float, Dimension> in_axes(ElementId element) const {
    std::array<double, Dimension> own;
    std::copy_n(positions.begin() + std::ptrdiff_t(std::size_t{element} * Dimension), Dimension, own.begin());
    turn_into_axes(*mesh, pass.conditions->softness->axes, own.data());
    std::array<float, Dimension> result;
    std::copy(own.begin(), own.end(), result.begin());
    return result;
  }
  void set_position(ElementId element, std::span<const float> position) {
    std::copy(position.begin(), position.end(),
              positions.begin() + static_cast<std::ptrdiff_t>(element * position.size()));
  }
  const RecordedPass& pass;
  MeshPointer mesh;
  std::vector<float> positions;
  std::vector<bool> is_updated;
};

/// Used in place of PassRecord. The outcome of a candidate is read from the trace.
class RecordedOutcomes {
 public:
  RecordedOutcomes(const RecordedPass& pass, WaitingLog& log) : pass_(pass), log_(log) {}
  bool begin(RecordedBody& /*body*/, std::span<const ElementId> /*handle*/, std::vector<ElementId>& /*moved*/,
             Replay /*uses*/) {
    return false;
  }

  bool update(RecordedBody& body, Candidate candidate, std::vector<ElementId>& /*moved*/) {
    WaitingCandidate& taken = log_.of(candidate);
    taken.dropped = false;
    body.mark_updated(taken.element);
    const std::size_t row = log_.step;
    agrees_ = agrees_ && row < pass_.trace.size() && pass_.trace[row].element == taken.element &&
              pass_.trace[row].sponsor == taken.sponsor;
    if (!agrees_) {
      return false;  // nothing more enters, so the loop ends soon
    }
    ++log_.step;
    body.set_position(taken.element, pass_.position_after(row));
    return pass_.trace[row].moved;
  }
  void end() { agrees_ = agrees_ && log_.step == pass_.trace.size(); }
  bool agree() const { return agrees_; }

 private:
  const RecordedPass& pass_;
  WaitingLog& log_;
  bool agrees_ = true;
};

/// The history of a pass by one waiting list.
template <WaitingList List>
WaitingHistory follow_list(const RecordedPass& pass) {
  RecordedBody body(pass);
  WaitingLog log(*pass.mesh);
  RecordedOutcomes outcomes(pass, log);
  LoggedList<List> list(log);
  std::vector<ElementId> none;
  propagate(body, list, outcomes, pass.handle, none);
  return outcomes.agree() ? log.history(List::order) : WaitingHistory();
}

/// The history of a pass by Natural Queue ChainMail.
WaitingHistory follow_natural_queue(const RecordedPass& pass);

}  // namespace chainmail
