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

/// What all panels highlight: the element under the cursor or in the handle, and the links that a stroke would cut.
struct Highlight {
  std::optional<ElementId> element;
  bool grabbed = false;
  std::vector<LinkId> links;

  bool operator==(const Highlight&) const = default;
};

/// The object, its parameters, their undo stack, and the solvers that deform the object side by side, one per panel.
///
/// Every edit is a Change that goes through apply(): one step of undo, which changes the contents and all solvers.
/// Moves of the handle go straight to the log that feeds all solvers; a drag becomes a step of undo when it ends.
class Document : public QObject {
  Q_OBJECT

 public:
  static constexpr int fewestPanels = 2, mostPanels = Contents::mostPanels;

  Document(MeshPointer mesh, const QString& name);
  ~Document() override;

  const MeshPointer& mesh() const { return contents_.object->mesh; }
  const QString& name() const { return contents_.object->name; }
  const Cuts& cuts() const { return contents_.object->cuts; }
  /// Number of parts of the object that no uncut link joins.
  std::uint32_t parts() const { return contents_.object->parts.count(); }
  /// The pinned elements, ascending.
  const std::vector<ElementId>& pins() const { return contents_.object->pins; }
  bool isPinned(ElementId element) const;
  /// The global softness: of all links without a softness of their own.
  const LinkSoftness& softness() const { return contents_.softness->global; }
  const std::shared_ptr<const Softness>& wholeSoftness() const { return contents_.softness; }
  const commands::SetRelaxation& relaxation() const { return contents_.relaxation; }
  const ElasticOptions& elastic() const { return contents_.elastic; }

  // Panels: a solver and an algorithm each.

  /// Number of panels, from fewestPanels to mostPanels.
  int panels() const { return int(solvers_.size()); }
  /// Adds a panel. Its object, undo included, is that of the first panel; its algorithm is one that no panel runs yet.
  void addPanel();
  /// Removes the last panel.
  void removePanel();
  /// The algorithm of a panel; of a removed panel, the last one.
  Algorithm algorithm(int panel) const { return contents_.algorithms[std::size_t(panel)]; }
  /// True where the panel's method has no answer because nothing pins the object.
  bool lacksPins(int panel) const;
  /// The newest frame of a panel, valid until frameReady; null while the panel does not show the object yet.
  const Frame* frame(int panel) const;
  /// Shows a frame in place of the panel's newest one, until called with null. The frame must stay alive meanwhile;
  /// call this again after a change of the frame.
  void showInstead(int panel, const Frame* frame);
  /// Turns pass recording on or off, for all solvers.
  void recordPasses(bool on);
  /// A panel's last pass, unless its number is `seen`; see SolverThread::last_pass.
  std::unique_ptr<RecordedPass> lastPass(int panel, std::uint64_t seen) const {
    return solvers_[std::size_t(panel)]->last_pass(seen);
  }
  /// Calls `question` on the thread of a panel's solver, after everything posted before. It must not wait.
  void ask(int panel, SolverThread::Question question);
  /// The positions of a panel's elements, after everything posted before.
  std::future<Snapshot> snapshot(int panel);
  /// True when all solvers have carried out everything posted.
  bool idle() const;
  /// True when idle and all frames are up to date; never for long while relaxation runs.
  bool settled() const;
  /// The window closes: waits up to `patience` for posted moves, then skips the rest.
  void abandonMoves(std::chrono::milliseconds patience = {});

  // The handle; targets are in mesh units. From grab to release is one step of undo, if anything moved.

  void grab(ElementId element);
  void drag(const Point& target);
  void release();
  /// The element in the handle.
  std::optional<ElementId> held() const { return handle_ ? handle_->element : std::nullopt; }
  /// Grabs a control point of free-form deformation, in the panels that have it; release() releases it.
  void grabControlPoint(std::uint32_t point);
  void dragControlPoint(const Point& target);
  /// The commands of the last drag of this mesh, without the release; empty if there was none.
  std::vector<Command> lastDrag() const { return tape().last_drag(); }

  // The tape.

  /// The commands that were carried out since the object was at rest, and the current position among them.
  const Tape& tape() const { return log_->tape(); }
  /// Clears the move history; positions stay.
  void forgetMoves();
  /// Records the relaxation since the last pass; call it before the tape is saved.
  void noteRelaxation();
  /// Brings the object in all panels to its state after `position` commands of the tape, each panel by its own
  /// algorithm. Turns relaxation off: its result is on the tape. Several calls in a row are one step of undo.
  void goTo(std::size_t position);
  /// Replaces the tape with moves of this mesh, and brings the object to rest, uncut and unpinned. One step of undo.
  void loadMoves(const std::shared_ptr<const std::vector<Command>>& moves, const QString& text);

  // Edits, one step of undo each.

  QUndoStack& undoStack() { return undoStack_; }
  /// Ends the drag, which becomes a step of its own, and undoes the last step.
  void undo();
  void redo();
  /// True if there are changes since the session was opened or saved.
  bool isModified() const { return !undoStack_.isClean() || handle_.has_value(); }
  /// A change that does nothing yet: its values are the current ones.
  Change change(const QString& text, int gesture = 0) const;
  /// Carries out a change as one step of undo. All edits go through here.
  void apply(Change change);

  void setSoftness(const LinkSoftness& global, const QString& text, int gesture = 0);
  /// Gives links a softness of their own, or none: then the global one applies to them again.
  void setSoftnessOf(const std::vector<LinkId>& links, const std::optional<LinkSoftness>& own);
  /// Resets all links to the default softness, including links with a softness of their own.
  void resetSoftness();
  void setRelaxation(const commands::SetRelaxation& relaxation, int gesture = 0);
  void setSoftnessAndRelaxation(const LinkSoftness& global, const commands::SetRelaxation& relaxation,
                                const QString& text);
  void setElastic(const ElasticOptions& options, const QString& text, int gesture = 0);
  /// Emits refused if the algorithm does not work on the mesh.
  void setAlgorithm(int panel, Algorithm algorithm);
  void setPinned(const std::vector<ElementId>& elements, bool pinned);
  void cut(const std::vector<LinkId>& links);
  void resetObject();
  /// `own` is the softness of links that have their own.
  void replaceMesh(const MeshPointer& mesh, const QString& name, const QString& text,
                   std::map<LinkId, LinkSoftness> own = {});
  /// Opens a session. Panels that the session does not have show the object of its first panel, by their own algorithm.
  void restore(const std::shared_ptr<const Session>& session, const QString& file, const QString& text);
  /// The file of this session; empty if it has none yet.
  const QString& sessionFile() const { return sessionFile_; }
  void setSessionFile(const QString& file);

  // What the panels highlight and select. No edits: the object stays the same.

  const Highlight& highlight() const { return highlight_; }
  void setHighlight(const Highlight& highlight);
  /// Adds links to the highlighted ones, at a cost of these links only.
  void addToHighlight(std::span<const LinkId> links);
  const Selection& selection() const { return selection_; }
  /// Elements must be ascending.
  void select(std::vector<ElementId> elements);

 signals:
  void frameReady(int panel);
  /// All solvers have carried out everything posted.
  void becameIdle();
  /// The last panel and its frames are about to be removed.
  void panelLeaves(int panel);
  /// A panel was added or removed.
  void panelsChanged();
  void meshChanged();
  /// These links were cut, or uncut.
  void cutsChanged(const std::vector<LinkId>& links, bool cut);
  void softnessChanged();
  void relaxationChanged();
  void elasticChanged();
  void algorithmChanged(int panel);
  void highlightChanged();
  void pinsChanged();
  void selectionChanged();
  void lastDragChanged();
  /// The tape is longer, or the object has another position on it.
  void tapeChanged();
  void sessionFileChanged();
  /// A command was refused; one sentence says why.
  void refused(const QString& sentence);
  /// A panel has no answer; see lacksPins.
  void unpinned(int panel);
  /// The document changed something by itself; one sentence says what.
  void noticed(const QString& sentence);

 private:
  class Edit;  // of the undo stack

  // How a change reaches the solvers and the contents.
  std::optional<commands::StateId> stateFor(int gesture, const QString& text);
  void carryOut(const Change& change, const Contents& before);
  void postSettings(const Contents& from, const Contents& to, bool neutral);
  void show(Change& change, const Contents& from, const Contents& to, bool done);
  void showParts(const Change& change, bool done);
  void showCuts(const std::vector<LinkId>& links, bool cut);
  void showPins(const std::vector<ElementId>& elements, bool pinned);
  std::vector<int> panelsToSwitch(const Contents& from, const Contents& to) const;
  void postAlgorithm(int panel, Algorithm algorithm);
  void replaceUnfitAlgorithms();
  void placeSession(const std::shared_ptr<const Session>& session);

  // How commands reach the solvers, and frames come back.
  void post(const Command& command);
  void receiveIdle();
  void receiveFrame(int panel);
  void reportRefusal(int panel, const QString& sentence);
  std::function<void()> frameAnnouncer(int panel);
  std::function<void()> idleAnnouncer();
  void addSolver(std::unique_ptr<SolverThread> solver);
  Algorithm unusedAlgorithm() const;

  void beginDrag(std::optional<ElementId> element, const QString& text);
  void endDrag();

  // Replay, in document_replay.cpp.
  void endSweeps();
  void travel(std::size_t position);
  void goToBeginning();
  void keepWaypoint(std::size_t position);
  void dropWaypoints();
  void showTape();

  commands::StateId newState() { return nextState_++; }

  Contents contents_;
  QString sessionFile_;
  Highlight highlight_;
  Selection selection_;
  commands::StateId nextState_ = 1;

  struct Handle {
    std::optional<ElementId> element;  // none while it holds a control point
    std::uint32_t controlPoint = 0;
    QString text;                  // of the undo step
    commands::StateId before = 0;  // the solvers keep this state during the drag
    bool moved = false;
  };
  std::optional<Handle> handle_;
  std::array<QString, mostPanels> lastRefusal_;  // during the present drag or edit

  // States that the solvers keep along the tape, by position: a replay backwards starts at one of them.
  std::map<std::size_t, commands::StateId> waypoints_;
  std::uint64_t waypointTimeline_ = 0;  // Tape::timeline() of the waypoints
  bool replayed_ = false;               // the last thing that the solvers did is a replay
  std::uint64_t relaxationNoted_ = 0;   // number of passes when relaxation was last noted

  // The solver threads announce a frame, or that they are idle, at most once until it is received.
  std::array<std::atomic<bool>, mostPanels> frameAnnounced_{};
  std::atomic<bool> idleAnnounced_ = false;
  std::vector<std::unique_ptr<SolverThread>> solvers_;
  std::array<const Frame*, mostPanels> frames_{};
  std::array<const Frame*, mostPanels> instead_{};  // null where the panel shows its own frame
  bool recordsPasses_ = false;
  std::unique_ptr<CommandLog> log_;
  QUndoStack undoStack_;  // last: its edits post to the log when they are deleted
};

}  // namespace chainmail
