#pragma once

#include <QObject>
#include <QTimer>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "document/propagation.h"
#include "files/session/lesson.h"
#include "simulate/command.h"
#include "simulate/frame.h"

namespace chainmail {

/// Leads through the lesson of a document, step by step. A step forward plays its recorded moves; a step back restores
/// the state at the end of the step before, to the bit. Both start from the lesson's own state, whatever the user did.
/// An undo also returns to the step that fits the object.
class LessonPlayer : public QObject {
  Q_OBJECT

 public:
  LessonPlayer(Document& document, Propagation& propagation);

  /// True while the object is a lesson that the user has not closed.
  bool isOpen() const { return session_ != nullptr; }
  const Lesson& lesson() const;
  /// Index of the present step.
  std::size_t step() const { return step_; }
  bool isLast() const { return step_ + 1 == lesson().steps.size(); }
  /// True while the moves of the present step are played.
  bool plays() const { return clock_.isActive(); }
  /// Returns a name of the window that applies to the present step: its own, or that of a step before.
  const std::string& name(std::string LessonStep::*which) const;

  /// Corners of a box through which the moves of the present step drag their handles (mesh units).
  std::vector<Point> reach() const;
  /// The handles that the moves of the present step have dragged so far. A step without moves keeps those of the step
  /// before. Empty if the user has changed the object since.
  std::span<const ElementId> dragged() const;

  /// Plays the first step. A session that was saved in the middle of a lesson stays as it is, at its step.
  void start();
  /// Plays the next step, or goes to the end of the present one if it is being played.
  void next();
  /// Goes to the end of the step before.
  void back();
  /// Goes to the end of the last step.
  void goToEnd();
  void close();

 signals:
  /// A lesson was opened or closed.
  void openChanged();
  /// The present step is about to be shown: its moves follow.
  void stepChanged();
  /// The object is as at the end of the step before: the first move follows.
  void movesBegin();
  /// The object is as at the end of the present step, whose moves were played one by one or carried out at once.
  void movesEnd(bool oneByOne);
  /// The moves of the present step began or ended.
  void playsChanged();

 private:
  void adopt();
  void show(std::size_t step, bool animated);
  void tick();
  void playMoves();
  void playCandidates();
  bool passesAreComplete() const;
  void end(bool complete);
  void goTo(std::size_t position, bool withPass);
  void setPanels(std::size_t count);
  std::vector<Algorithm> algorithms(std::size_t step) const;
  std::size_t nextMove() const;
  void travel(std::size_t position);
  std::size_t beginning() const;
  void noteDragged();

  Document& document_;
  Propagation& propagation_;
  std::shared_ptr<const Session> session_;  // of the lesson; null while none is open
  std::shared_ptr<const Lesson> captions_;  // of the session
  std::shared_ptr<const Session> closed_;   // the lesson that the user closed
  std::size_t step_ = 0;
  std::size_t position_ = 0;        // in the recorded moves, while playing
  std::size_t candidate_ = 0;       // shown last
  bool animated_ = true;            // false: goes to the end of the step at once
  bool begun_ = false;              // movesBegin() was emitted
  bool travels_ = false;            // the player itself moves the object
  int waited_ = 0;                  // ticks of the clock, for passes
  std::vector<ElementId> dragged_;  // see dragged()
  QTimer clock_;
};

}  // namespace chainmail
