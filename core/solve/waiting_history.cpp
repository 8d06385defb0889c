#include "solve/waiting_history.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "solve/original.h"
#include "solve/propagate.h"

namespace chainmail {
namespace {

/// When candidates enter and leave a list, by the step that the pass is at.
struct Log {
  explicit Log(const Mesh& of) : mesh(of), candidate_of(of.neighbours.size()) {}

  /// An entry names its sponsor, which is updated once: it enters at most once a pass.
  void enter(Candidate candidate, double key) {
    candidate_of[candidate.entry] = static_cast<std::uint32_t>(candidates.size());
    candidates.push_back({mesh.neighbours[candidate.entry], candidate.sponsor, step, 0, true});
    keys.push_back(key);
  }
  void leave(Candidate candidate) { of(candidate).left = step + 1; }
  WaitingCandidate& of(Candidate candidate) { return candidates[candidate_of[candidate.entry]]; }

  const Mesh& mesh;
  std::uint32_t step = 0;
  std::vector<WaitingCandidate> candidates;
  std::vector<double> keys;
  std::vector<std::uint32_t> candidate_of;
};

/// A waiting list that writes down what happens to it.
template <class List>
class Logged : public List {
 public:
  explicit Logged(Log& log, double key = 0) : log_(&log), key_(key) {}

  void admit(Candidate candidate) {
    log_->enter(candidate, key_);
    List::admit(candidate);
  }
  void admit(Candidate candidate, double violation) {
    log_->enter(candidate, violation);
    List::admit(candidate, violation);
  }
  Candidate take() {
    const Candidate candidate = List::take();
    log_->leave(candidate);
    return candidate;
  }

 private:
  Log* log_;
  double key_;
};

/// The object as a pass finds it, as far as the loop asks for it.
template <int Dimension>
struct RecordedBody {
  explicit RecordedBody(const RecordedPass& of)
      : pass(of), mesh(of.mesh), places(of.before), is_updated(of.mesh->element_count()) {
    for (const ElementId pin : of.conditions->pins) {
      is_updated[pin] = true;
    }
    place(of.grabbed, of.grabbed_after());
  }

  void begin_pass() {}
  bool updated(ElementId element) const { return is_updated[element]; }
  void mark_updated(ElementId element) { is_updated[element] = true; }
  template <class Visit>
  void for_each_neighbour(ElementId element, Visit visit) const {
    chainmail::for_each_neighbour(*mesh, pass.conditions->cuts, element, visit);
  }
  double violation(ElementId element, ElementId sponsor, EntryId entry) const {
    const auto region =
        valid_region<float, Dimension>(*mesh, sponsor, element, pass.conditions->softness.of(mesh->entry_link[entry]));
    return candidate_violation(*mesh, element, &places[std::size_t{element} * Dimension], sponsor,
                               &places[std::size_t{sponsor} * Dimension], region);
  }
  void place(ElementId element, std::span<const float> at) {
    std::ranges::copy(at, places.begin() + static_cast<std::ptrdiff_t>(std::size_t{element} * Dimension));
  }

  const RecordedPass& pass;
  MeshPointer mesh;
  std::vector<float> places;
  std::vector<bool> is_updated;
};

/// Stands for the record of a pass: what comes of a candidate is read, not computed.
class Outcomes {
 public:
  Outcomes(const RecordedPass& pass, Log& log) : pass_(pass), log_(log) {}

  void forget() {}
  template <class Body>
  bool begin(Body& /*body*/, ElementId /*grabbed*/, std::vector<ElementId>& /*moved*/) {
    return false;
  }
  template <class Body>
  bool update(Body& body, Candidate candidate, std::vector<ElementId>& /*moved*/) {
    WaitingCandidate& taken = log_.of(candidate);
    taken.dropped = false;
    body.mark_updated(taken.element);
    const std::size_t row = log_.step;
    agrees_ = agrees_ && row < pass_.trace.size() && pass_.trace[row].element == taken.element &&
              pass_.trace[row].sponsor == taken.sponsor;
    if (!agrees_) {
      return false;  // nothing more enters: it ends soon
    }
    ++log_.step;
    body.place(taken.element, pass_.place_after(row));
    return pass_.trace[row].moved;
  }
  void end() { agrees_ = agrees_ && log_.step == pass_.trace.size(); }
  bool agree() const { return agrees_; }

 private:
  const RecordedPass& pass_;
  Log& log_;
  bool agrees_ = true;
};

template <class List, class Body>
void run(Body& body, Outcomes& outcomes, Log& log, ElementId grabbed) {
  Logged<List> list(log);
  std::vector<ElementId> none;
  propagate(body, list, outcomes, grabbed, none);
}

template <class Body>
void run_directions(Body& body, Outcomes& outcomes, Log& log, ElementId grabbed) {
  using List = Logged<BackList>;
  // The lists are worked in their order: all of the first, then all of the next.
  DirectionLists<List> lists({List(log, 0), List(log, -1), List(log, -2), List(log, -3), List(log, -4), List(log, -5)});
  std::vector<ElementId> none;
  lists.propagate(body, outcomes, grabbed, none);
}

}  // namespace

WaitingHistory::WaitingHistory(const RecordedPass& pass) {
  if (pass.algorithm == Algorithm::natural_queue) {
    follow_natural_queue(pass);
  } else if (pass.algorithm != Algorithm::exact && !elastic_method(pass.algorithm)) {
    pass.mesh->space_dimension == 1   ? follow<1>(pass)
    : pass.mesh->space_dimension == 2 ? follow<2>(pass)
                                      : follow<3>(pass);
  }
}

template <int Dimension>
void WaitingHistory::follow(const RecordedPass& pass) {
  RecordedBody<Dimension> body(pass);
  Log log(*pass.mesh);
  Outcomes outcomes(pass, log);
  if (pass.algorithm == Algorithm::generalized) {
    order_ = Order::last_in;
    run<FrontList>(body, outcomes, log, pass.grabbed);
  } else if (pass.algorithm == Algorithm::spiral) {
    run<SpiralList>(body, outcomes, log, pass.grabbed);
  } else if (pass.algorithm == Algorithm::enhanced) {
    order_ = Order::by_key;
    run<EnhancedList>(body, outcomes, log, pass.grabbed);
  } else {
    order_ = Order::by_key;
    run_directions(body, outcomes, log, pass.grabbed);
  }
  known_ = outcomes.agree();
  if (!known_) {
    return;
  }
  for (WaitingCandidate& one : log.candidates) {
    one.left = std::min(one.left, log.step);  // those dropped at the end have gone when the pass is over
  }
  candidates_ = std::move(log.candidates);
  if (order_ == Order::by_key) {
    keys_ = std::move(log.keys);
  }
}

/// Its queue is the record of its pass: each element waits once, from when its sponsor moved until its own turn.
void WaitingHistory::follow_natural_queue(const RecordedPass& pass) {
  std::vector<std::uint32_t> updated_at(pass.mesh->element_count(), no_element);
  updated_at[pass.grabbed] = 0;
  for (std::uint32_t row = 0; row < pass.trace.size(); ++row) {
    const auto [element, sponsor, moved] = pass.trace[row];
    if (sponsor == no_element || updated_at[sponsor] == no_element) {
      candidates_.clear();
      return;
    }
    candidates_.push_back({element, sponsor, updated_at[sponsor], row + 1, false});
    updated_at[element] = row + 1;
  }
  known_ = true;
}

std::vector<std::uint32_t> WaitingHistory::at(std::size_t step) const {
  std::vector<std::uint32_t> waiting;
  for (std::uint32_t i = 0; i < candidates_.size(); ++i) {
    if (candidates_[i].entered <= step && step < candidates_[i].left) {
      waiting.push_back(i);
    }
  }
  if (order_ == Order::last_in) {
    std::reverse(waiting.begin(), waiting.end());
  } else if (order_ == Order::by_key) {
    std::stable_sort(waiting.begin(), waiting.end(), [this](auto a, auto b) { return keys_[a] > keys_[b]; });
  }
  return waiting;
}

}  // namespace chainmail
