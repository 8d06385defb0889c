#include "document/move_player.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "common/application.h"
#include "document/document.h"
#include "files/session/session.h"

namespace chainmail {
namespace {

constexpr int travelGesture = std::numeric_limits<int>::max();
constexpr int lessonGesture = travelGesture - 1;
// Waypoints: largest number of saved states, and smallest number of commands between two of them.
constexpr std::size_t maxWaypoints = 16;
constexpr std::size_t minApart = 32;

/// True if the object of a session is as recorded moves expect it at their beginning.
bool startsFromRest(const Session& session) {
  return session.moves_done == 0 && session.cuts.empty() && session.pins.empty() && *session.softness == Softness() &&
         !session.relaxation.on &&
         std::ranges::all_of(session.panels, [](const auto& panel) { return panel.positions.is_at_rest(); });
}

/// Returns the commands that lead from the beginning of recorded moves to an object at rest.
std::vector<Command> commandsFor(const ObjectState& object) {
  std::vector<Command> commands{commands::SetSoftness{object.softness}};
  if (!object.cuts.empty()) {
    commands.push_back(commands::Cut{object.cuts});
  }
  if (!object.pins.empty()) {
    commands.push_back(commands::Pin{object.pins});
  }
  return commands;
}

}  // namespace

/// The work while a film is made.
struct MovePlayer::Work {
  Contents contents;
  Replayed replayed;
};

MovePlayer::MovePlayer(Document& document, ChangeExecutor& executor) : document_(document), executor_(executor) {}
MovePlayer::~MovePlayer() = default;

const MoveHistory& MovePlayer::history() const { return std::as_const(document_).solvers().log().history(); }

/// A session without moves gets recorded commands that start with the object at rest.
void MovePlayer::open(const Session& session) {
  const std::vector<Command> object = commandsFor(session);
  const bool hasMoves = !session.moves.empty();
  CommandLog& log = document_.solvers().log();
  log.flush();  // to the history that is replaced below
  log.history().load(hasMoves ? session.moves : object);
  log.history().go_to(hasMoves ? session.moves_done : object.size());
  noteRecorded(&session);
  replayed_.isCurrent = hasMoves && startsFromRest(session);
}

void MovePlayer::noteSent(const Command& command) {
  replayed_.isCurrent = replayed_.isCurrent && is_one_of<commands::KeepState, commands::DropState>(command);
  Application::guarded([this] { emit changed(); });
}

void MovePlayer::noteDeparture() {
  dropWaypoints();
  replayed_.isCurrent = false;
}

void MovePlayer::forget() {
  const auto object = commandsFor(document_.object());
  MoveHistory& history = document_.solvers().log().history();
  history.load(object);
  history.go_to(object.size());
  emit changed();
  emit lastDragChanged();
}

void MovePlayer::noteRelaxation() {
  PanelSolvers& solvers = document_.solvers();
  solvers.log().ask_all(std::vector<SolverThread::Question>(std::size_t(solvers.count()), [](const Simulation&) {}));
  emit changed();
}

void MovePlayer::endSweeps() {
  if (!document_.solvers().idle()) {
    document_.solvers().cutSweeps();
    noteDeparture();
  }
}

void MovePlayer::goTo(std::size_t position) {
  endFilm();
  const bool toEnd = position >= history().length();
  noteRelaxation();
  position = toEnd ? history().length() : std::min(position, history().length());
  if (position == history().position()) {
    return;
  }
  endSweeps();
  document_.apply(travelTo(position));
  emit changed();
}

/// Returns a change that leads to a position. It turns relaxation off.
Change MovePlayer::travelTo(std::size_t position) {
  Change edit;
  edit.text = QStringLiteral("replay");
  edit.gesture = travelGesture;
  edit.after = executor_.contents();
  edit.after.relaxation.on = false;
  const MeshPointer first = history().first_mesh();
  if (first) {
    replaceSplit(edit, history().object(position), first);
  }
  edit.carryOut = [this, position, first] { travel(position, first); };
  edit.followsMoves = true;
  return edit;
}

void MovePlayer::beginFilm() {
  noteRelaxation();
  document_.solvers().setAside();
  work_ = std::make_unique<Work>(Work{executor_.contents(), std::exchange(replayed_, {})});
}

void MovePlayer::showInFilm(std::size_t position) {
  Change edit = travelTo(position);
  const Contents before = executor_.contents();
  executor_.carryOut(edit, before);
  executor_.show(edit, before, edit.after, true);
}

void MovePlayer::endFilm() {
  if (const auto work = std::exchange(work_, {})) {
    document_.solvers().takeBack();
    replayed_ = work->replayed;
    Change back;
    back.followsMoves = true;
    const Contents shown = executor_.contents();
    Application::guarded([&] { executor_.show(back, shown, work->contents, true); });
    emit filmEnded();
    emit changed();
  }
}

/// Lets a change lead to the mesh that the object has then, before or after splits. `first` is the mesh with which the
/// recorded commands begin; null if that is the present one.
void MovePlayer::replaceSplit(Change& edit, ObjectState then, const MeshPointer& first) const {
  then.mesh = then.mesh ? then.mesh : first;
  if (then.mesh && then.mesh != document_.mesh()) {
    edit.after.goTo(then);
  }
}

void MovePlayer::load(const std::shared_ptr<const std::vector<Command>>& moves, const QString& text) {
  endSweeps();
  Change edit = document_.change(text);
  edit.after.relaxation.on = false;
  const MeshPointer first = document_.unsplitMesh();
  replaceSplit(edit, {}, first);
  edit.carryOut = [this, moves, first] {
    document_.solvers().log().end_replay();
    goToBeginning(first);
    document_.solvers().log().history().load(*moves);
    replayed_.isCurrent = true;
  };
  edit.followsMoves = true;
  document_.apply(std::move(edit));
  emit changed();
}

bool MovePlayer::recordsLesson() const {
  return document_.lesson().session && document_.lesson().session.get() == lessonRecorded_ &&
         history().timeline() == lessonTimeline_ && history().length() >= document_.lesson().session->moves.size();
}

/// True if the solvers have done nothing but replay the lesson's moves with these algorithms.
bool MovePlayer::followsLesson(const std::vector<Algorithm>& algorithms) const {
  return recordsLesson() && replayed_.isCurrent && !document_.handle().isActive() && !document_.relaxation().on &&
         document_.elastic() == document_.lesson().session->elastic &&
         std::ranges::equal(algorithms, executor_.contents().running());
}

bool MovePlayer::isInLesson(std::size_t position, const std::vector<Algorithm>& algorithms) const {
  return followsLesson(algorithms) && history().position() == position;
}

bool MovePlayer::onlyLessonMoved() const {
  const int clean = document_.undoStack().cleanIndex();
  return clean >= 0 && clean == document_.undoStack().index() - 1 &&
         document_.undoStack().command(clean)->id() == lessonGesture;
}

void MovePlayer::noteRecorded(const Session* lesson) {
  lessonRecorded_ = lesson;
  lessonTimeline_ = history().timeline();
}

void MovePlayer::noteLessonStep(std::size_t step) { executor_.noteLessonStep(step); }

void MovePlayer::goToInLesson(std::size_t position, const std::vector<Algorithm>& algorithms, std::size_t step) {
  if (!document_.lesson().session || isInLesson(position, algorithms)) {
    return;
  }
  endSweeps();
  const bool goesOn = followsLesson(algorithms);
  Change edit = document_.change(QStringLiteral("lesson"), lessonGesture);
  edit.after.relaxation.on = false;
  edit.after.lesson.step = step;
  edit.after.elastic = document_.lesson().session->elastic;
  std::ranges::copy(algorithms, edit.after.algorithms.begin());
  const MeshPointer first = first_mesh(*document_.lesson().session);
  if (first_mesh(document_.lesson().session->moves) || first != document_.mesh()) {
    MoveHistory moves;
    moves.load(document_.lesson().session->moves);
    replaceSplit(edit, moves.object(std::min(position, moves.length())), first);
  }
  edit.carryOut = [this, position, goesOn, first, session = document_.lesson().session] {
    if (!goesOn) {
      noteDeparture();
    }
    if (!recordsLesson()) {
      document_.solvers().log().flush();
      document_.solvers().log().history().load(session->moves);
      noteRecorded(session.get());
    }
    travel(std::min(position, history().length()), first);
  };
  edit.followsMoves = true;
  document_.apply(std::move(edit));
  emit changed();
}

/// Replays the commands from the nearest known state up to `position`. Another algorithm, or relaxation in idle time,
/// may make the result of a replay differ from that of the live moves. So the current state counts as known only after
/// a replay. `first` is the mesh with which the commands begin; null if that is the present one.
void MovePlayer::travel(std::size_t position, const MeshPointer& first) {
  MoveHistory& history = document_.solvers().log().history();
  if (replayed_.waypointTimeline != history.timeline()) {
    dropWaypoints();
    replayed_.waypointTimeline = history.timeline();
  }
  std::size_t at = history.position();
  if (!replayed_.isCurrent || position < at) {
    const auto after = replayed_.waypoints.upper_bound(position);
    at = after == replayed_.waypoints.begin() ? 0 : std::prev(after)->first;
    document_.solvers().log().end_replay();
    after == replayed_.waypoints.begin()
        ? goToBeginning(first)
        : document_.solvers().log().replay(commands::RestoreState{std::prev(after)->second});
  }
  for (; at < position; ++at) {
    keepWaypoint(at);
    document_.solvers().log().replay(history.at(at));
  }
  history.go_to(position);
  replayed_.isCurrent = true;
}

/// Resets the object: at rest, uncut, unpinned, with the default softness. Recorded commands always start from this
/// state. `first` is the mesh before it was split; null if that is the present one.
void MovePlayer::goToBeginning(const MeshPointer& first) {
  document_.solvers().log().replay(commands::Release{});
  if (first && first != document_.mesh()) {
    document_.solvers().log().replay(commands::ReplaceMesh{first});
    document_.solvers().log().replay(commands::SetSoftness{});
    return;
  }
  document_.solvers().log().replay(commands::Uncut{document_.cuts().links()});
  document_.solvers().log().replay(commands::Unpin{document_.pins()});
  document_.solvers().log().replay(commands::SetSoftness{});
  document_.solvers().log().replay(commands::Reset{});
}

/// Saves a waypoint if the previous one is far enough away. It does so only between two drags, because a state does not
/// include the handle.
void MovePlayer::keepWaypoint(std::size_t position) {
  const std::size_t apart = std::max(minApart, history().length() / maxWaypoints);
  replayed_.hasRelaxed = replayed_.hasRelaxed || std::holds_alternative<commands::Relaxed>(history().at(position));
  const std::size_t last = replayed_.waypoints.empty() ? 0 : std::prev(replayed_.waypoints.end())->first;
  if (!replayed_.hasRelaxed && position >= last + apart &&
      std::holds_alternative<commands::Grab>(history().at(position))) {
    replayed_.waypoints[position] = executor_.newState();
    document_.solvers().log().replay(commands::KeepState{replayed_.waypoints[position]});
  }
}

void MovePlayer::dropWaypoints() {
  for (const auto& [position, state] : replayed_.waypoints) {
    document_.solvers().log().replay(commands::DropState{state});
  }
  replayed_.waypoints.clear();
  replayed_.hasRelaxed = false;
}

}  // namespace chainmail
