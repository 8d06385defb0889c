// How a document goes back and forth in what was done to its object.

#include <algorithm>
#include <iterator>
#include <limits>

#include "document/document.h"
#include "document/edits.h"

namespace chainmail {
namespace {

constexpr int travelGesture = std::numeric_limits<int>::max();
// At most so many states are kept on the way, as far apart as that makes them.
constexpr std::size_t mostOnTheWay = 16;
constexpr std::size_t leastApart = 32;

template <class T>
std::vector<T> without(const std::vector<T>& all, const std::vector<T>& some) {
  std::vector<T> rest;
  std::ranges::set_difference(all, some, std::back_inserter(rest));
  return rest;
}

}  // namespace

void Document::noteRelaxation() {
  const Frame* now = frame(0);
  if (!relaxation_.on || now == nullptr || now->statistics.sweeps == 0 || now->statistics.passes == relaxationNoted_) {
    return;
  }
  relaxationNoted_ = now->statistics.passes;
  const auto sweeps = std::min<std::uint64_t>(now->statistics.sweeps, 1'000'000);
  log_->tape().note(commands::Relax{static_cast<std::uint32_t>(sweeps), relaxation_.step, relaxation_.scheme});
  emit tapeChanged();
}

/// Sweeps of relaxation may go on for hours: nobody waits for them to bring the object elsewhere. What they would have
/// done is missing from the states that are kept on the way.
void Document::cutSweeps() {
  if (idle()) {
    return;
  }
  for (const auto& solver : solvers_) {
    solver->cut_sweeps();
  }
  dropKeptOnTheWay();
  replayed_ = false;
}

void Document::goTo(std::size_t position) {
  noteRelaxation();
  position = std::min(position, tape().length());
  if (position != tape().position()) {
    cutSweeps();
    push(new TravelEdit(*this, QStringLiteral("replay"), travelGesture, [this, position] { travel(position); }));
    emit tapeChanged();
  }
}

void Document::loadMoves(const std::shared_ptr<const std::vector<Command>>& moves, const QString& text) {
  cutSweeps();
  push(new TravelEdit(*this, text, 0, [this, moves] {
    goToBeginning();
    log_->tape().load(*moves);
    replayed_ = true;
  }));
  emit tapeChanged();
}

/// The solvers carry out what lies between the nearest state that is known and the place; what they did live may
/// differ: another algorithm, relaxation in idle time.
void Document::travel(std::size_t position) {
  Tape& tape = log_->tape();
  if (timelineOnTheWay_ != tape.timeline()) {
    dropKeptOnTheWay();
    timelineOnTheWay_ = tape.timeline();
  }
  std::size_t at = tape.position();
  if (!replayed_ || position < at) {
    const auto after = onTheWay_.upper_bound(position);
    at = after == onTheWay_.begin() ? 0 : std::prev(after)->first;
    after == onTheWay_.begin() ? goToBeginning() : log_->replay(commands::RestoreState{std::prev(after)->second});
  }
  for (; at < position; ++at) {
    keepOnTheWay(at);
    log_->replay(tape.at(at));
  }
  tape.go_to(position);
  replayed_ = true;
}

/// To rest, whole, unpinned, with the default softness: where every tape begins.
void Document::goToBeginning() {
  log_->replay(commands::Release{});
  log_->replay(commands::Uncut{cuts_.links()});
  log_->replay(commands::Unpin{pins_});
  log_->replay(commands::SetSoftness{});
  log_->replay(commands::Reset{});
}

/// Between two drags alone: a state does not know what the hand holds.
void Document::keepOnTheWay(std::size_t position) {
  const std::size_t apart = std::max(leastApart, tape().length() / mostOnTheWay);
  const std::size_t last = onTheWay_.empty() ? 0 : std::prev(onTheWay_.end())->first;
  if (position >= last + apart && std::holds_alternative<commands::Grab>(tape().at(position))) {
    onTheWay_[position] = newState();
    log_->replay(commands::KeepState{onTheWay_[position]});
  }
}

void Document::dropKeptOnTheWay() {
  for (const auto& [position, state] : onTheWay_) {
    log_->replay(commands::DropState{state});
  }
  onTheWay_.clear();
}

/// Brings the document's own side to what the tape says of the object.
void Document::showTape() {
  const Tape::Object object = tape().object();
  const std::vector<LinkId> cuts = cuts_.links();
  if (cuts != object.cuts) {
    showCuts(without(cuts, object.cuts), false);
    showCuts(without(object.cuts, cuts), true);
  }
  if (pins_ != object.pins) {
    pins_ = object.pins;
    emit pinsChanged();
  }
  if (*softness_ != *object.softness) {
    showSoftness(object.softness);
  }
}

}  // namespace chainmail
