// Replay: brings the object of a document to any position in its recorded commands.

#include <algorithm>
#include <iterator>
#include <limits>

#include "document/document.h"
#include "files/session/session.h"

namespace chainmail {
namespace {

constexpr int travelGesture = std::numeric_limits<int>::max();
constexpr int lessonGesture = travelGesture - 1;
// Waypoints: largest number of saved states, and smallest number of commands between two of them.
constexpr std::size_t maxWaypoints = 16;
constexpr std::size_t leastApart = 32;
constexpr std::uint64_t maxSweepsNoted = 1'000'000;

template <class T>
std::vector<T> without(const std::vector<T>& all, const std::vector<T>& some) {
  std::vector<T> rest;
  std::ranges::set_difference(all, some, std::back_inserter(rest));
  return rest;
}

}  // namespace

void Document::forgetMoves() {
  log_->history().load({});
  emit movesChanged();
  emit lastDragChanged();
}

void Document::noteRelaxation() {
  const Frame* now = frame(0);
  if (!relaxation().on || now == nullptr || now->statistics.sweeps == 0 || now->statistics.passes == relaxationNoted_) {
    return;
  }
  relaxationNoted_ = now->statistics.passes;
  const auto sweeps = std::min<std::uint64_t>(now->statistics.sweeps, maxSweepsNoted);
  log_->history().note(commands::Relax{static_cast<std::uint32_t>(sweeps), relaxation().step, relaxation().scheme});
  emit movesChanged();
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
  position = std::min(position, moveHistory().length());
  if (position == moveHistory().position()) {
    return;
  }
  endSweeps();
  Change edit = change(QStringLiteral("replay"), travelGesture);
  edit.after.relaxation.on = false;
  const MeshPointer first = moveHistory().first_mesh();
  if (first) {
    replaceSplit(edit, moveHistory().object(position), first);
  }
  edit.carryOut = [this, position, first] { travel(position, first); };
  edit.followsTape = true;
  apply(std::move(edit));
  emit movesChanged();
}

/// Lets a change lead to the mesh that the object has then, before or after splits. `first` is the mesh with which the
/// recorded commands begin; null if that is the present one.
void Document::replaceSplit(Change& edit, const MoveHistory::Object& then, const MeshPointer& first) const {
  if (const MeshPointer& other = then.mesh ? then.mesh : first; other && other != mesh()) {
    edit.after.object = objectOf(other, then.cuts, then.pins);
    edit.after.softness = then.softness;
  }
}

void Document::loadMoves(const std::shared_ptr<const std::vector<Command>>& moves, const QString& text) {
  endSweeps();
  Change edit = change(text);
  edit.after.relaxation.on = false;
  const MeshPointer first = unsplitMesh();
  replaceSplit(edit, {}, first);
  edit.carryOut = [this, moves, first] {
    goToBeginning(first);
    log_->history().load(*moves);
    replayed_ = true;
  };
  edit.followsTape = true;
  apply(std::move(edit));
  emit movesChanged();
}

bool Document::recordsLesson() const {
  return lesson() && moveHistory().timeline() == lessonTimeline_ && moveHistory().length() >= lesson()->moves.size();
}

/// True if the solvers have done nothing but replay the lesson's moves with these algorithms.
bool Document::followsLesson(const std::vector<Algorithm>& algorithms) const {
  return recordsLesson() && replayed_ && !handle_ && !relaxation().on && elastic() == lesson()->elastic &&
         std::ranges::equal(algorithms, std::span(contents_.algorithms).first(std::size_t(panels())));
}

bool Document::isInLesson(std::size_t position, const std::vector<Algorithm>& algorithms) const {
  return followsLesson(algorithms) && moveHistory().position() == position;
}

/// True if the last saved state differs from the present one only by moves of the lesson, which its file contains.
bool Document::onlyLessonMoved() const {
  const int clean = undoStack_.cleanIndex();
  return clean >= 0 && clean == undoStack_.index() - 1 && undoStack_.command(clean)->id() == lessonGesture;
}

void Document::goToInLesson(std::size_t position, const std::vector<Algorithm>& algorithms) {
  if (!lesson() || isInLesson(position, algorithms)) {
    return;
  }
  endSweeps();
  const bool goesOn = followsLesson(algorithms);
  Change edit = change(QStringLiteral("lesson"), lessonGesture);
  edit.after.relaxation.on = false;
  edit.after.elastic = lesson()->elastic;
  std::ranges::copy(algorithms, edit.after.algorithms.begin());
  const MeshPointer first = first_mesh(*lesson());
  if (first_mesh(lesson()->moves) || first != mesh()) {
    MoveHistory moves;
    moves.load(lesson()->moves);
    replaceSplit(edit, moves.object(std::min(position, moves.length())), first);
  }
  edit.carryOut = [this, position, goesOn, first, session = lesson()] {
    if (!goesOn) {
      dropWaypoints();
      replayed_ = false;
    }
    if (!recordsLesson()) {
      log_->flush();
      log_->history().load(session->moves);
      lessonTimeline_ = moveHistory().timeline();
    }
    travel(std::min(position, moveHistory().length()), first);
  };
  edit.followsTape = true;
  apply(std::move(edit));
  emit movesChanged();
}

/// Replays the commands from the nearest known state up to `position`. Another algorithm, or relaxation in idle time,
/// may make the result of a replay differ from that of the live moves. So the current state counts as known only after
/// a replay. `first` is the mesh with which the commands begin; null if that is the present one.
void Document::travel(std::size_t position, const MeshPointer& first) {
  MoveHistory& history = log_->history();
  if (waypointTimeline_ != history.timeline()) {
    dropWaypoints();
    waypointTimeline_ = history.timeline();
  }
  std::size_t at = history.position();
  if (!replayed_ || position < at) {
    const auto after = waypoints_.upper_bound(position);
    at = after == waypoints_.begin() ? 0 : std::prev(after)->first;
    after == waypoints_.begin() ? goToBeginning(first) : log_->replay(commands::RestoreState{std::prev(after)->second});
  }
  for (; at < position; ++at) {
    keepWaypoint(at);
    log_->replay(history.at(at));
  }
  history.go_to(position);
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
  const std::size_t apart = std::max(leastApart, moveHistory().length() / maxWaypoints);
  const std::size_t last = waypoints_.empty() ? 0 : std::prev(waypoints_.end())->first;
  if (position >= last + apart && std::holds_alternative<commands::Grab>(moveHistory().at(position))) {
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
void Document::showMoves() {
  const MoveHistory::Object object = moveHistory().object();
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
