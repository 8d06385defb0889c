#pragma once

#include <QObject>
#include <map>
#include <memory>
#include <vector>

#include "document/change.h"
#include "simulate/move_history.h"

namespace chainmail {

class ChangeExecutor;
class Document;

/// Records the commands of a document, and brings the object to any position in them.
class MovePlayer : public QObject {
  Q_OBJECT

 public:
  MovePlayer(Document& document, ChangeExecutor& executor);
  ~MovePlayer() override;

  /// The commands carried out since the object was at rest, and the current position in them.
  const MoveHistory& history() const;
  /// The commands of the last drag of this mesh, without the release; empty if there was none.
  std::vector<Command> lastDrag() const { return history().last_drag(); }
  /// Replaces the recorded commands with those that lead to the present object at rest; positions stay.
  void forget();
  /// Adds what relaxation has done since the last command to the recorded ones. Call it before they are saved.
  void noteRelaxation();
  /// Brings the object in all panels to its state after the first `position` recorded commands. Each panel uses its own
  /// algorithm. Turns relaxation off, because its steps are recorded. Several calls in a row become one undo step.
  void goTo(std::size_t position);
  /// Replaces the recorded commands with moves of this mesh, and resets the object: at rest, uncut and unpinned. One
  /// undo step.
  void load(const std::shared_ptr<const std::vector<Command>>& moves, const QString& text);

  /// For a film, the document shows other solvers than those of the work, which stays as it is. It ends when the user
  /// changes something.
  void beginFilm();
  void showInFilm(std::size_t position);
  void endFilm();
  bool isFilming() const { return work_ != nullptr; }

  /// Brings the object to its state after the first `position` moves of its lesson, from rest, with these algorithms
  /// (one per panel) and the lesson's options, on the way to the end of a step. Several calls in a row become one undo
  /// step, which also restores the step.
  void goToInLesson(std::size_t position, const std::vector<Algorithm>& algorithms, std::size_t step);
  /// Notes the step that the object is at the end of. It is no undo step, because a step may move nothing.
  void noteLessonStep(std::size_t step);
  /// True if the object is in the state to which goToInLesson() leads with these arguments.
  bool isInLesson(std::size_t position, const std::vector<Algorithm>& algorithms) const;
  /// True if the recorded commands begin with the lesson's moves.
  bool recordsLesson() const;
  /// True if the last saved state differs from the present one only by moves of the lesson, which its file contains.
  bool onlyLessonMoved() const;

  // For the document.

  /// Replaces the recorded commands with those of a session, whose object the solvers have.
  void open(const Session& session);
  /// A command was posted to the log of the solvers, which calls this.
  void noteSent(const Command& command);
  /// Drops the waypoints. Call this when the solvers do something other than a replay: its result may differ.
  void noteDeparture();
  /// Stops sweeps of relaxation, which may run for hours. Drops the waypoints, because they lack the skipped sweeps.
  /// Call it before the object changes.
  void endSweeps();

 signals:
  /// The recorded commands, or the current position in them, have changed.
  void changed();
  void lastDragChanged();
  void filmEnded();

 private:
  struct Work;

  Change travelTo(std::size_t position);
  void travel(std::size_t position, const MeshPointer& first);
  void replaceSplit(Change& edit, ObjectState then, const MeshPointer& first) const;
  void goToBeginning(const MeshPointer& first);
  void noteRecorded(const Session* lesson);
  bool followsLesson(const std::vector<Algorithm>& algorithms) const;
  void keepWaypoint(std::size_t position);
  void dropWaypoints();

  Document& document_;
  ChangeExecutor& executor_;
  /// What the solvers have replayed.
  struct Replayed {
    // States that the solvers have saved, by position in the recorded commands. A replay backwards starts at one of
    // them.
    std::map<std::size_t, commands::StateId> waypoints;
    std::uint64_t waypointTimeline = 0;  // MoveHistory::timeline() of the waypoints
    bool isCurrent = false;              // true if the solvers have done nothing since the last replay
    /// Relaxation was repeated: what it keeps is not saved, so there are no waypoints after it.
    bool hasRelaxed = false;
  };
  Replayed replayed_;
  std::uint64_t lessonTimeline_ = 0;         // MoveHistory::timeline() of the lesson's moves
  const Session* lessonRecorded_ = nullptr;  // the lesson of this timeline, only to compare it
  std::unique_ptr<Work> work_;               // while a film shows other states
};

}  // namespace chainmail
