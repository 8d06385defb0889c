#include "document/lesson_player.h"

#include <QScopedValueRollback>
#include <algorithm>
#include <utility>

#include "files/session/session.h"

namespace chainmail {
namespace {

/// A recorded drag, or the part of it that belongs to a range of moves.
struct LessonDrag {
  std::vector<ElementId> elements;  // of the handle
  bool relative = false;            // true: `ways` are displacements since the beginning of the range
  std::array<Point, 2> ways{};      // the lowest and highest coordinates of where the moves lead (mesh units)
};

using Box = std::array<Point, 2>;

void include(Box& box, const Point& point) { box = {box[0].cwiseMin(point), box[1].cwiseMax(point)}; }

Point positionIn(const Frame& frame, ElementId element) { return point_of(*frame.mesh, frame.view(), element); }

/// Returns the drag that is under way before a move: its handle, and where it has led so far.
LessonDrag underWay(std::span<const Command> moves, std::size_t from, Point& reached) {
  LessonDrag drag;
  for (std::size_t i = 0; i < from; ++i) {
    if (const auto* grab = std::get_if<commands::Grab>(&moves[i])) {
      drag.elements = grab->elements;
      reached = Point::Zero();
    } else if (const auto* one = std::get_if<commands::Drag>(&moves[i])) {
      reached = one->target;
    }
  }
  return drag;
}

constexpr int moveMilliseconds = 16;        // between two moves
constexpr int candidateMilliseconds = 160;  // between two candidates of a pass
constexpr int maxTicksForPasses = 200;      // a panel may have refused the move, so that it has no pass

/// Returns the drags among the moves from `from` up to `to`, also the rest of a drag that began before.
std::vector<LessonDrag> dragsAmong(std::span<const Command> moves, std::size_t from, std::size_t to) {
  Point before = Point::Zero();
  LessonDrag now = underWay(moves, from, before);
  std::vector<LessonDrag> drags;
  bool begun = false;
  for (const Command& move : moves.subspan(from, to - from)) {
    if (const auto* grab = std::get_if<commands::Grab>(&move)) {
      now.elements = grab->elements;
      before = Point::Zero();
      begun = false;
    } else if (const auto* drag = std::get_if<commands::Drag>(&move)) {
      const Point way = drag->relative ? Point(drag->target - before) : drag->target;
      if (!std::exchange(begun, true)) {
        drags.push_back({now.elements, drag->relative, {way, way}});
      }
      include(drags.back().ways, way);
    }
  }
  return drags;
}

/// Returns the corners of a box that contains the handles of the drags everywhere on their ways. `now` shows the object
/// at the beginning of the range.
std::vector<Point> cornersOf(std::span<const LessonDrag> drags, const Frame& now) {
  std::vector<Point> corners;
  for (const LessonDrag& drag : drags) {
    Box box{Point::Zero(), Point::Zero()};
    for (const ElementId element : drag.elements) {
      const Point at = drag.relative ? positionIn(now, element) : Point(Point::Zero());
      element == drag.elements.front() ? void(box = {at, at}) : include(box, at);
    }
    box = {box[0] + drag.ways[0], box[1] + drag.ways[1]};
    for (unsigned corner = 0; corner < 8; ++corner) {
      const auto side = [&](unsigned k) { return box[corner >> k & 1U][k]; };
      corners.push_back({side(0), side(1), side(2)});
    }
  }
  return corners;
}

}  // namespace

LessonPlayer::LessonPlayer(Document& document, Propagation& propagation)
    : document_(document), propagation_(propagation) {
  clock_.setTimerType(Qt::PreciseTimer);
  connect(&clock_, &QTimer::timeout, this, &LessonPlayer::tick);
  connect(&document, &Document::lessonChanged, this, &LessonPlayer::adopt);
}

const Lesson& LessonPlayer::lesson() const {
  static const Lesson none{{}, {LessonStep()}};
  return session_ ? *captions_ : none;
}

const std::string& LessonPlayer::name(std::string LessonStep::*which) const {
  const auto& steps = lesson().steps;
  std::size_t from = step_;
  while (from > 0 && (steps[from].*which).empty()) {
    --from;
  }
  return steps[from].*which;
}

/// Takes over the lesson of a new object, its captions after an edit, and the step to which an undo returned.
void LessonPlayer::adopt() {
  if (travels_) {
    return;  // the player itself leads to another step
  }
  clock_.stop();
  const OpenLesson& lesson = document_.lesson();
  const bool sameCaptions = isOpen() && lesson.session == session_ && lesson.captions == captions_;
  session_ = lesson.session == closed_ ? nullptr : lesson.session;
  captions_ = lesson.captions;
  step_ = session_ ? lesson.step : 0;
  position_ = document_.moves().history().position();
  dragged_.clear();
  sameCaptions ? emit stepChanged() : emit openChanged();
}

void LessonPlayer::start() {
  const auto atRest = [](const auto& panel) { return panel.positions.is_at_rest(); };
  if (isOpen() && session_->moves_done == 0 && std::ranges::all_of(session_->panels, atRest)) {
    show(0, true);
  }
}

void LessonPlayer::goToEnd() {
  if (isOpen()) {
    show(lesson().steps.size() - 1, false);
  }
}

void LessonPlayer::close() {
  clock_.stop();
  closed_ = std::exchange(session_, nullptr);
  propagation_.setShowsNewest(true);
  emit openChanged();
}

void LessonPlayer::next() {
  if (plays()) {
    animated_ = false;
    tick();
  } else if (isOpen() && !isLast()) {
    show(step_ + 1, true);
  }
}

void LessonPlayer::back() {
  if (isOpen() && step_ > 0) {
    show(step_ - 1, false);
  }
}

/// Shows a step: plays it from the end of the step before, or goes to its end.
void LessonPlayer::show(std::size_t step, bool animated) {
  clock_.stop();
  const auto& steps = lesson().steps;
  const std::size_t before = step > 0 ? steps[step - 1].until : 0;
  step_ = step;
  animated_ = animated;
  begun_ = false;
  position_ = animated ? before : steps[step].until;
  candidate_ = 0;
  waited_ = 0;
  noteDragged();
  setPanels(algorithms(step).size());
  emit stepChanged();
  const bool samePass = steps[step].candidate && animated && steps[step].until == before;
  if (samePass && !propagation_.showsNewest() && document_.moves().isInLesson(position_, algorithms(step))) {
    candidate_ = steps[step - 1].candidate.value_or(0);
  } else {
    propagation_.setShowsNewest(true);
    goTo(position_, steps[step].candidate && position_ == steps[step].until);
  }
  clock_.start(moveMilliseconds);
  emit playsChanged();
}

/// Goes to a position in the moves. `withPass`: the solvers carry out the last move before it again, and so record its
/// pass.
void LessonPlayer::goTo(std::size_t position, bool withPass) {
  for (std::size_t last = position; withPass && last > 0; --last) {
    if (std::holds_alternative<commands::Drag>(session_->moves[last - 1])) {
      travel(last - 1);
      break;
    }
  }
  travel(position);
}

void LessonPlayer::travel(std::size_t position) {
  const QScopedValueRollback guard(travels_, true);
  document_.moves().goToInLesson(position, algorithms(step_), step_);
}

/// Returns the position at which the moves of the present step begin. A step without moves has those of the step
/// before.
std::size_t LessonPlayer::beginning() const {
  const auto& steps = lesson().steps;
  std::size_t from = step_;
  while (from > 0 && steps[from - 1].until == steps[step_].until) {
    --from;
  }
  return from > 0 ? steps[from - 1].until : 0;
}

void LessonPlayer::noteDragged() {
  dragged_.clear();
  for (const LessonDrag& drag : dragsAmong(session_->moves, beginning(), position_)) {
    dragged_.insert(dragged_.end(), drag.elements.begin(), drag.elements.end());
  }
  std::ranges::sort(dragged_);
  dragged_.erase(std::unique(dragged_.begin(), dragged_.end()), dragged_.end());
}

std::span<const ElementId> LessonPlayer::dragged() const {
  const bool isShown = isOpen() && !dragged_.empty() && document_.moves().isInLesson(position_, algorithms(step_));
  return isShown ? std::span<const ElementId>(dragged_) : std::span<const ElementId>();
}

std::vector<Point> LessonPlayer::reach() const {
  const Frame* frame = document_.solvers().frame(0);
  return isOpen() && frame != nullptr
             ? cornersOf(dragsAmong(session_->moves, position_, lesson().steps[step_].until), *frame)
             : std::vector<Point>();
}

void LessonPlayer::setPanels(std::size_t count) {
  while (document_.panels() < int(count)) {
    document_.addPanel();
  }
  while (document_.panels() > int(count)) {
    document_.removePanel();
  }
}

/// Returns the algorithms of a step: its own, or those of a step before, or of the session.
std::vector<Algorithm> LessonPlayer::algorithms(std::size_t step) const {
  const auto& steps = lesson().steps;
  for (std::size_t i = step + 1; i-- > 0;) {
    if (!steps[i].algorithms.empty()) {
      return steps[i].algorithms;
    }
  }
  std::vector<Algorithm> result;
  for (std::size_t i = 0; i < std::min(session_->panels.size(), lesson_panels_most); ++i) {
    result.push_back(session_->panels[i].algorithm);
  }
  result.resize(std::max(result.size(), lesson_panels_least), result.back());
  return result;
}

void LessonPlayer::tick() {
  const LessonStep& step = lesson().steps[step_];
  const bool userTookOver = !document_.moves().isInLesson(position_, algorithms(step_));
  const bool begins = animated_ && !begun_;
  if (!userTookOver && (begins || position_ == step.until) && !document_.solvers().settled()) {
    return;
  }
  if (!userTookOver && begins) {
    begun_ = true;
    emit movesBegin();
  }
  if (!userTookOver && position_ < step.until) {
    playMoves();
  } else if (!userTookOver && step.candidate && propagation_.isOpen()) {
    playCandidates();
  } else {
    end(!userTookOver);
  }
}

void LessonPlayer::playMoves() {
  if (animated_ && !document_.solvers().idle()) {
    return;
  }
  position_ = animated_ ? nextMove() : lesson().steps[step_].until;
  travel(position_);
  noteDragged();
}

/// Returns the position after the next move of the handle, at most the end of the step.
std::size_t LessonPlayer::nextMove() const {
  const std::size_t until = lesson().steps[step_].until;
  std::size_t position = position_;
  while (position < until && !std::holds_alternative<commands::Drag>(session_->moves[position])) {
    ++position;
  }
  return std::min(position + 1, until);
}

/// Shows the last pass, candidate by candidate, as soon as it has been recorded.
void LessonPlayer::playCandidates() {
  if (!document_.solvers().idle()) {
    return;
  }
  if (!passesAreComplete() && ++waited_ < maxTicksForPasses) {
    return;
  }
  const std::size_t wanted = std::min<std::size_t>(*lesson().steps[step_].candidate, propagation_.stepCount());
  candidate_ = animated_ && candidate_ < wanted ? candidate_ + 1 : wanted;
  propagation_.setStep(0, candidate_);
  clock_.setInterval(candidateMilliseconds);
  if (candidate_ == wanted) {
    end(true);
  }
}

/// True if the last pass of each panel that has steps was taken over.
bool LessonPlayer::passesAreComplete() const {
  for (int panel = 0; panel < document_.panels(); ++panel) {
    const PassPlayer* player = propagation_.player(panel);
    if (info(document_.algorithm(panel)).has_steps() &&
        (player == nullptr || document_.solvers().lastPass(panel, player->pass().number) != nullptr)) {
      return false;
    }
  }
  return true;
}

/// Ends the play of a step. `complete`: the object is as at the end of the step.
void LessonPlayer::end(bool complete) {
  clock_.stop();
  if (complete) {
    document_.moves().noteLessonStep(step_);
    emit movesEnd(animated_);
  }
  emit playsChanged();
}

}  // namespace chainmail
