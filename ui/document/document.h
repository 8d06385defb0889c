#pragma once

#include <QObject>
#include <QUndoStack>
#include <array>
#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <span>

#include "document/change.h"
#include "document/selection.h"
#include "simulate/command_log.h"
#include "simulate/solver_thread.h"

namespace chainmail {

struct Session;

/// The parts of the object that all panels highlight: the element under the cursor or in the handle, the links that a
/// stroke would cut, and the elements of a handle of many.
struct Highlight {
  std::optional<ElementId> element;
  bool grabbed = false;
  std::vector<LinkId> links;
  std::vector<ElementId> handle = {};  // grabbed, or those that a press would grab

  bool operator==(const Highlight&) const = default;
};

/// The object, its parameters, their undo stack, and one solver per panel that deforms the object.
///
/// Every edit is a Change that is passed to apply(). It becomes one undo step, which changes the contents and all
/// solvers. Moves of the handle go directly to the log that feeds all solvers. A drag becomes an undo step when it
/// ends.
class Document : public QObject {
  Q_OBJECT

 public:
  static constexpr int minPanels = 2, maxPanels = Contents::maxPanels;

  Document(MeshPointer mesh, const QString& name);
  ~Document() override;

  const MeshPointer& mesh() const { return contents_.object->mesh; }
  /// The mesh from which splits made the present one: while it stays, the object is the same for the user.
  const MeshPointer& unsplitMesh() const { return contents_.object->unsplit; }
  const QString& name() const { return contents_.object->name; }
  const Cuts& cuts() const { return contents_.object->cuts; }
  /// Number of connected parts of the object. No uncut link joins two parts.
  std::uint32_t parts() const { return contents_.object->parts.count(); }
  /// The pinned elements, ascending.
  const std::vector<ElementId>& pins() const { return contents_.object->pins; }
  bool isPinned(ElementId element) const;
  /// The global softness. It applies to all links without a softness of their own.
  const LinkSoftness& softness() const { return contents_.softness->global; }
  const std::shared_ptr<const Softness>& wholeSoftness() const { return contents_.softness; }
  const commands::SetRelaxation& relaxation() const { return contents_.relaxation; }
  /// The scheme for a number of sweeps: that of relaxation(), or `mean` if that is the equilibrium.
  RelaxationScheme sweepScheme() const {
    return info(relaxation().scheme).sweeps ? relaxation().scheme : RelaxationScheme::mean;
  }
  const ElasticOptions& elastic() const { return contents_.elastic; }

  // Panels: each has a solver and an algorithm.

  /// Number of panels, from minPanels to maxPanels.
  int panels() const { return int(solvers_.size()); }
  /// Adds a panel. It copies the object of the first panel, including the states for undo, and runs an algorithm that
  /// no other panel runs.
  void addPanel();
  /// Removes the last panel.
  void removePanel();
  /// The algorithm of a panel. For a removed panel, its last one.
  Algorithm algorithm(int panel) const { return contents_.algorithms[std::size_t(panel)]; }
  /// True if the panel's method has no solution because no element is pinned.
  bool lacksPins(int panel) const;
  /// The frame that a panel shows, valid until the next frameReady; null while the panel has none of the current
  /// object.
  const Frame* frame(int panel) const;
  /// The statistics of a panel's newest frame, also while the panel shows another one. Valid if frame() is not null.
  const Statistics& statistics(int panel) const { return frames_[std::size_t(panel)]->statistics; }
  /// Shows `frame` instead of the panel's newest one; null shows the newest one again. The frame must stay alive until
  /// then. Call this again after each change of the frame.
  void showInstead(int panel, const Frame* frame);
  /// Turns pass recording on or off, for all solvers.
  void recordPasses(bool on);
  /// Returns a panel's last pass; null if its number is `seen`, before the first pass, and while a pass is running.
  std::unique_ptr<RecordedPass> lastPass(int panel, std::uint64_t seen) const {
    return solvers_[std::size_t(panel)]->last_pass(seen);
  }
  /// Calls `question` on the thread of a panel's solver, after all commands posted before. `question` must not block.
  void ask(int panel, SolverThread::Question question);
  /// Returns the positions of a panel's elements after all commands posted before.
  std::future<Snapshot> snapshot(int panel);
  /// True while all solvers have carried out all posted commands.
  bool idle() const;
  /// True while idle() and all frames are up to date. While relaxation runs, this is true only for short moments.
  bool settled() const;
  /// Call this when the window closes. Waits up to `patience` for posted moves, then skips the rest.
  void abandonMoves(std::chrono::milliseconds patience = {});
  /// Call this if the window stays open after all.
  void goOn();

  // The handle. Targets are in mesh units. A drag, from grab() to release(), becomes one undo step if anything moved.

  void grab(ElementId element) { grab(std::vector{element}); }
  /// Grabs elements, which move together as one rigid body. Leaves pinned elements out; if all are pinned, the solvers
  /// refuse the grab.
  void grab(std::vector<ElementId> elements);
  /// Moves a handle of one element to a position.
  void drag(const Point& target);
  /// Moves the handle by a way and a rotation about its pivot, both since it was grabbed.
  void dragBy(const Point& by, const Rotation& rotation = {});
  void release();
  /// Ends the drag and restores the object as it was before. It does not become an undo step.
  void cancelDrag();
  /// The grabbed elements, ascending; empty while nothing or a control point is grabbed.
  std::span<const ElementId> held() const { return handle_ ? handle_->elements : std::span<const ElementId>(); }
  /// Grabs a control point in the panels that run free-form deformation. release() releases it.
  void grabControlPoint(std::uint32_t point);
  void dragControlPoint(const Point& target);
  /// The commands of the last drag of this mesh, without the release; empty if there was none.
  std::vector<Command> lastDrag() const { return moveHistory().last_drag(); }

  // The recorded commands of the object.

  /// The commands carried out since the object was at rest, and the current position in them.
  const MoveHistory& moveHistory() const { return log_->history(); }
  /// Clears the move history; positions stay.
  void forgetMoves();
  /// Adds the relaxation since the last pass to the recorded commands. Call it before they are saved.
  void noteRelaxation();
  /// Brings the object in all panels to its state after the first `position` recorded commands. Each panel uses its own
  /// algorithm. Turns relaxation off, because its steps are recorded. Several calls in a row become one undo step.
  void goTo(std::size_t position);
  /// Replaces the recorded commands with moves of this mesh, and resets the object: at rest, uncut and unpinned. One
  /// undo step.
  void loadMoves(const std::shared_ptr<const std::vector<Command>>& moves, const QString& text);

  /// The session of the object, if it is a lesson; otherwise null.
  const std::shared_ptr<const Session>& lesson() const { return contents_.object->lesson; }
  /// Brings the object to its state after the first `position` moves of its lesson, from rest, with these algorithms
  /// (one per panel) and the lesson's options. Several calls in a row become one undo step.
  void goToInLesson(std::size_t position, const std::vector<Algorithm>& algorithms);
  /// True if the object is in the state to which goToInLesson() leads with these arguments.
  bool isInLesson(std::size_t position, const std::vector<Algorithm>& algorithms) const;
  /// True if the recorded commands begin with the lesson's moves.
  bool recordsLesson() const;

  // Edits. Each is one undo step.

  QUndoStack& undoStack() { return undoStack_; }
  /// Undoes the last step. If a drag is in progress, it ends and becomes that step.
  void undo();
  void redo();
  /// True if there are changes since the session was opened or saved.
  bool isModified() const { return handle_.has_value() || (!undoStack_.isClean() && !onlyLessonMoved()); }
  /// Returns a change that does nothing yet: its values are the current ones.
  Change change(const QString& text, int gesture = 0) const;
  /// Carries out a change as one undo step. All edits use this function.
  void apply(Change change);

  void setSoftness(const LinkSoftness& global, const QString& text, int gesture = 0);
  void setEnergy(EnergyKind kind);
  /// Sets the axes along which valid regions lie: those of the world, or the principal axes of the object.
  void setFrame(AxesKind kind);
  /// Sets the softness of these links. If `own` is empty, the global softness applies to them again.
  void setSoftnessOf(const std::vector<LinkId>& links, const std::optional<LinkSoftness>& own);
  /// Resets all links to the default softness, including links with a softness of their own.
  void resetSoftness();
  void setRelaxation(const commands::SetRelaxation& relaxation, int gesture = 0);
  void setSoftnessAndRelaxation(const LinkSoftness& global, const commands::SetRelaxation& relaxation,
                                const QString& text);
  void setElastic(const ElasticOptions& options, const QString& text, int gesture = 0);
  /// Sets the algorithm of a panel. Emits refused() if the algorithm does not work on the mesh.
  void setAlgorithm(int panel, Algorithm algorithm);
  void setPinned(const std::vector<ElementId>& elements, bool pinned);
  void cut(const std::vector<LinkId>& links);
  /// Splits faces of the object, and cuts links of the object before the split.
  void split(const SplitPointer& split, const std::vector<LinkId>& cut = {});
  void resetObject();
  /// Opens another object: a new document, which has no file yet. `own` contains the softness of links that have their
  /// own. Throws Error if there is too little memory to work with it; nothing has changed then.
  void replaceMesh(const MeshPointer& mesh, const QString& name, const QString& text, OwnSoftness own = {});
  /// Replaces the mesh of the same object, for example with a repaired one. Otherwise as replaceMesh().
  void reworkMesh(const MeshPointer& mesh, const QString& name, const QString& text, OwnSoftness own = {});
  /// Opens a session, unless there is too little memory as for replaceMesh(). A panel that the session does not have
  /// shows the object of the session's first panel and keeps its algorithm if possible.
  void restore(const std::shared_ptr<const Session>& session, const QString& file, const QString& text);
  /// The file of this session; empty if it has none yet.
  const QString& sessionFile() const { return sessionFile_; }
  /// Returns the mesh file that the object was opened from; empty if there is none.
  const QString& meshFile() const { return contents_.object->file; }
  void setSessionFile(const QString& file);
  /// The object was opened from this mesh file.
  void setMeshFile(const QString& file);

  // Highlight and selection. They do not change the object and are not undo steps.

  const Highlight& highlight() const { return highlight_; }
  void setHighlight(const Highlight& highlight);
  /// Names the element that the next press would grab, if any, so that all panels prepare its drag in idle time.
  void prepareDrag(std::optional<ElementId> element);
  /// Number of preparations that every panel has ended.
  int preparedDrags() const;
  /// Adds links to the highlighted ones. The time depends only on the number of added links.
  void addToHighlight(std::span<const LinkId> links);
  const Selection& selection() const { return selection_; }
  /// Selects these elements, which must be ascending.
  void select(std::vector<ElementId> elements);

 signals:
  void frameReady(int panel);
  /// All solvers have carried out all posted commands.
  void becameIdle();
  /// The last panel and its frames are about to be removed.
  void panelLeaves(int panel);
  /// A panel was added or removed.
  void panelsChanged();
  void meshChanged();
  /// These links were cut, or restored if `cut` is false.
  void cutsChanged(const std::vector<LinkId>& links, bool cut);
  void softnessChanged();
  void relaxationChanged();
  void elasticChanged();
  void algorithmChanged(int panel);
  void highlightChanged();
  void pinsChanged();
  void selectionChanged();
  void lastDragChanged();
  /// The recorded commands, or the current position in them, have changed.
  void movesChanged();
  void sessionFileChanged();
  void meshFileChanged();
  /// A command was refused; `sentence` gives the reason.
  void refused(const QString& sentence);
  /// A panel has no solution; see lacksPins().
  void unpinned(int panel);
  /// The document changed something by itself; `sentence` says what.
  void noticed(const QString& sentence);

 private:
  class Edit;  // a command of the undo stack

  // Apply changes to the solvers and the contents.
  std::shared_ptr<const SettingsBefore> ownSettings() const;
  void takeOwnSettings(Contents& after) const;
  Change meshChange(const MeshPointer& mesh, const QString& name, const QString& text, OwnSoftness own) const;
  std::optional<commands::StateId> stateFor(int gesture, const QString& text);
  void carryOut(const Change& change, const Contents& before);
  void postSettings(const Contents& from, const Contents& to, bool neutral);
  void show(Change& change, const Contents& from, const Contents& to, bool done);
  void showParts(const Change& change, bool done);
  std::shared_ptr<DocumentObject> objectOf(const MeshPointer& mesh, const std::vector<LinkId>& cuts,
                                           std::vector<ElementId> pins) const;
  void showCuts(const std::vector<LinkId>& links, bool cut);
  void showPins(const std::vector<ElementId>& elements, bool pinned);
  std::vector<int> panelsToSwitch(const Contents& from, const Contents& to) const;
  void postAlgorithm(int panel, Algorithm algorithm);
  void replaceUnfitAlgorithms();
  void placeSession(const std::shared_ptr<const Session>& session);

  // Send commands to the solvers, and receive their frames.
  void post(const Command& command);
  void receiveIdle();
  void receiveFrame(int panel);
  void reportRefusal(int panel, const QString& sentence);
  std::function<void()> frameAnnouncer(int panel);
  std::function<void()> idleAnnouncer();
  void addSolver(std::unique_ptr<SolverThread> solver);
  Algorithm unusedAlgorithm() const;

  void beginDrag(std::vector<ElementId> elements, const QString& text);
  void postDrag(const commands::Drag& drag);
  void endDrag();

  // Replay, in document_replay.cpp.
  void endSweeps();
  void travel(std::size_t position, const MeshPointer& first);
  void replaceSplit(Change& edit, const MoveHistory::Object& then, const MeshPointer& first) const;
  void goToBeginning(const MeshPointer& first);
  bool followsLesson(const std::vector<Algorithm>& algorithms) const;
  bool onlyLessonMoved() const;
  void keepWaypoint(std::size_t position);
  void dropWaypoints();
  void showMoves();

  commands::StateId newState() { return nextState_++; }

  Contents contents_;
  QString sessionFile_;
  Highlight highlight_;
  Selection selection_;
  commands::StateId nextState_ = 1;

  struct Handle {
    std::vector<ElementId> elements;  // ascending; none while a control point is grabbed
    std::uint32_t controlPoint = 0;
    QString text;                  // of the undo step
    commands::StateId before = 0;  // state before the drag, which the solvers have saved
    bool moved = false;
  };
  std::optional<Handle> handle_;
  std::array<QString, maxPanels> lastRefusal_;  // one per panel, during the current drag or edit

  // States that the solvers have saved, by position in the recorded commands. A replay backwards starts at one of them.
  std::map<std::size_t, commands::StateId> waypoints_;
  std::uint64_t waypointTimeline_ = 0;  // MoveHistory::timeline() of the waypoints
  bool replayed_ = false;               // true if the solvers have done nothing since the last replay
  std::uint64_t lessonTimeline_ = 0;    // MoveHistory::timeline() of the lesson's moves
  std::uint64_t relaxationNoted_ = 0;   // number of passes when relaxation was last noted

  // True while an announcement of a solver thread (new frame, idle) waits in the event queue. Prevents a second one.
  std::array<std::atomic<bool>, maxPanels> frameAnnounced_{};
  std::atomic<bool> idleAnnounced_ = false;
  std::vector<std::unique_ptr<SolverThread>> solvers_;
  std::array<const Frame*, maxPanels> frames_{};
  std::array<const Frame*, maxPanels> instead_{};  // null if the panel shows its own frame
  bool recordsPasses_ = false;
  std::unique_ptr<CommandLog> log_;
  QUndoStack undoStack_;  // the last member: its edits post to the log when they are deleted
};

}  // namespace chainmail
