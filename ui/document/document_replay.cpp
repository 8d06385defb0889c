// Replay: brings the object of a document to any position in its recorded commands.

#include <algorithm>
#include <iterator>
#include <limits>

#include "document/document.h"

namespace chainmail {
namespace {

constexpr int travelGesture = std::numeric_limits<int>::max();
// Waypoints: largest number of saved states, and smallest number of commands between two of them.
constexpr std::size_t mostWaypoints = 16;
constexpr std::size_t leastApart = 32;
constexpr std::uint64_t mostSweepsNoted = 1'000'000;

template <class T>
std::vector<T> without(const std::vector<T>& all, const std::vector<T>& some) {
  std::vector<T> rest;
  std::ranges::set_difference(all, some, std::back_inserter(rest));
  return rest;
}

}  // namespace

void Document::forgetMoves() {
  log_->tape().load({});
  emit tapeChanged();
  emit lastDragChanged();
}

void Document::noteRelaxation() {
  const Frame* now = frame(0);
  if (!relaxation().on || now == nullptr || now->statistics.sweeps == 0 || now->statistics.passes == relaxationNoted_) {
    return;
  }
  relaxationNoted_ = now->statistics.passes;
  const auto sweeps = std::min<std::uint64_t>(now->statistics.sweeps, mostSweepsNoted);
  log_->tape().note(commands::Relax{static_cast<std::uint32_t>(sweeps), relaxation().step, relaxation().scheme});
  emit tapeChanged();
}

/// Stops sweeps of relaxation, which may run for hours. Call it before the object changes. Drops the waypoints, because
/// they lack the skipped sweeps.
void Document::endSweeps() {
  if (idle()) {
    return;
  }
  for (const auto& solver : solvers_) {
    solver->cut_sweeps();
  }
  dropWaypoints();
  replayed_ = false;
}

void Document::goTo(std::size_t position) {
  noteRelaxation();
  position = std::min(position, tape().length());
  if (position == tape().position()) {
    return;
  }
  endSweeps();
  Change edit = change(QStringLiteral("replay"), travelGesture);
  edit.after.relaxation.on = false;
  if (const Tape::Object then = tape().object(position); then.mesh && then.mesh != mesh()) {
    edit.after.object = objectOf(then.mesh, then.cuts, then.pins);
    edit.after.softness = then.softness;
  }
  edit.carryOut = [this, position] { travel(position); };
  edit.followsTape = true;
  apply(std::move(edit));
  emit tapeChanged();
}

void Document::loadMoves(const std::shared_ptr<const std::vector<Command>>& moves, const QString& text) {
  endSweeps();
  Change edit = change(text);
  edit.after.relaxation.on = false;
  edit.carryOut = [this, moves] {
    goToBeginning({});
    log_->tape().load(*moves);
    replayed_ = true;
  };
  edit.followsTape = true;
  apply(std::move(edit));
  emit tapeChanged();
}

/// Replays the commands from the nearest known state up to `position`. Another algorithm, or relaxation in idle time,
/// may make the result of a replay differ from that of the live moves. So the current state counts as known only after
/// a replay.
void Document::travel(std::size_t position) {
  Tape& tape = log_->tape();
  if (waypointTimeline_ != tape.timeline()) {
    dropWaypoints();
    waypointTimeline_ = tape.timeline();
  }
  std::size_t at = tape.position();
  if (!replayed_ || position < at) {
    const auto after = waypoints_.upper_bound(position);
    at = after == waypoints_.begin() ? 0 : std::prev(after)->first;
    after == waypoints_.begin() ? goToBeginning(tape.object(0).mesh)
                                : log_->replay(commands::RestoreState{std::prev(after)->second});
  }
  for (; at < position; ++at) {
    keepWaypoint(at);
    log_->replay(tape.at(at));
  }
  tape.go_to(position);
  replayed_ = true;
}

/// Resets the object: at rest, uncut, unpinned, with the default softness. Recorded commands always start from this
/// state. `first` is the mesh before it was split; null if that is the present one.
void Document::goToBeginning(const MeshPointer& first) {
  log_->replay(commands::Release{});
  if (first && first != mesh()) {
    log_->replay(commands::ReplaceMesh{first});
    log_->replay(commands::SetSoftness{});
    return;
  }
  log_->replay(commands::Uncut{cuts().links()});
  log_->replay(commands::Unpin{pins()});
  log_->replay(commands::SetSoftness{});
  log_->replay(commands::Reset{});
}

/// Saves a waypoint if the previous one is far enough away. It does so only between two drags, because a state does not
/// include the handle.
void Document::keepWaypoint(std::size_t position) {
  const std::size_t apart = std::max(leastApart, tape().length() / mostWaypoints);
  const std::size_t last = waypoints_.empty() ? 0 : std::prev(waypoints_.end())->first;
  if (position >= last + apart && std::holds_alternative<commands::Grab>(tape().at(position))) {
    waypoints_[position] = newState();
    log_->replay(commands::KeepState{waypoints_[position]});
  }
}

void Document::dropWaypoints() {
  for (const auto& [position, state] : waypoints_) {
    log_->replay(commands::DropState{state});
  }
  waypoints_.clear();
}

/// Sets cuts, pins and softness to their state at the current position in the recorded commands.
void Document::showTape() {
  const Tape::Object object = tape().object();
  const std::vector<LinkId> cut = cuts().links();
  if (cut != object.cuts) {
    showCuts(without(cut, object.cuts), false);
    showCuts(without(object.cuts, cut), true);
  }
  if (pins() != object.pins) {
    contents_.object->pins = object.pins;
    emit pinsChanged();
  }
  if (*wholeSoftness() != *object.softness) {
    contents_.softness = object.softness;
    emit softnessChanged();
  }
}

}  // namespace chainmail
