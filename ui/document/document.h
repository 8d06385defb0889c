#pragma once

#include <QObject>
#include <QTimer>
#include <QUndoStack>
#include <array>
#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <optional>

#include "document/selection.h"
#include "mesh/parts.h"
#include "simulate/command_log.h"
#include "simulate/solver_thread.h"

namespace chainmail {

struct Session;

/// What all panels share beside the object: the element under the cursor or the hand, and the links
/// that a stroke would cut.
struct Highlight {
  std::optional<ElementId> element;
  bool grabbed = false;
  std::vector<LinkId> links;

  bool operator==(const Highlight&) const = default;
};

/// The object, its parameters, their undo stack, and the solvers that deform it side by side, one a panel.
///
/// Edits go through the undo stack and change the data and all solvers; the moves of the hand go
/// straight to the solvers' one log.
class Document : public QObject {
  Q_OBJECT

 public:
  static constexpr int fewestPanels = 2, mostPanels = 4;

  Document(MeshPointer mesh, const QString& name);
  ~Document() override;

  const MeshPointer& mesh() const { return mesh_; }
  const QString& name() const { return name_; }
  const Cuts& cuts() const { return cuts_; }
  /// How many parts it has that no uncut link joins.
  std::uint32_t parts() const { return parts_.count(); }
  /// The pinned elements, ascending.
  const std::vector<ElementId>& pins() const { return pins_; }
  bool isPinned(ElementId element) const;
  /// The softness of all links but those that have one of their own.
  const LinkSoftness& softness() const { return softness_->global; }
  const std::shared_ptr<const Softness>& wholeSoftness() const { return softness_; }
  const commands::SetRelaxation& relaxation() const { return relaxation_; }
  const ElasticOptions& elastic() const { return elastic_; }
  /// How many there are, fewestPanels to mostPanels.
  int panels() const { return int(solvers_.size()); }
  /// One more, in which the object is as in the first one, undo included, by an algorithm that none runs yet.
  void addPanel();
  /// One less: the last one goes.
  void removePanel();
  Algorithm algorithm(int panel) const { return algorithms_[panel]; }
  /// Whether a panel's method has no answer, because nothing holds the object.
  bool lacksPins(int panel) const;
  QUndoStack& undoStack() { return undoStack_; }
  /// Ends what the hand is at, so that it is a step of its own, and undoes it or the step before.
  void undo();
  void redo();

  /// The newest frame of a panel, or none while it does not show the object yet; it stays as it is until
  /// frameReady.
  const Frame* frame(int panel) const;
  /// Shows a frame in place of a panel's newest one, until none is given; it stays as long as it is shown, and this
  /// is called again when it has changed.
  void showInstead(int panel, const Frame* frame);
  /// From now on all solvers record their passes, or no more.
  void recordPasses(bool on);
  /// A panel's last pass, unless it is the one with this number, as SolverThread::last_pass.
  std::unique_ptr<RecordedPass> lastPass(int panel, std::uint64_t seen) const {
    return solvers_[panel]->last_pass(seen);
  }
  /// Calls `question` on the thread of a panel's solver when that has done all that was asked so far; it must not wait.
  void ask(int panel, SolverThread::Question question);
  /// The positions of a panel's elements when its solver has done all that was asked so far.
  std::future<Snapshot> placement(int panel);
  /// The file of the session that this is; empty where it is none yet.
  const QString& sessionFile() const { return sessionFile_; }
  void setSessionFile(const QString& file);
  /// Whether something was done since it was last opened or saved.
  bool isModified() const { return !undoStack_.isClean() || hand_.has_value(); }
  /// The window closes: moves that are not done after some time are given up, and the object stays as it is.
  void abandonMoves(std::chrono::milliseconds patience = {});
  /// Whether all solvers have carried out all that was asked of them.
  bool idle() const;
  /// Whether, beside, the frames show what came of it. Not so while relaxation goes on.
  bool settled() const;

  /// The hand, in mesh units. From grab to release is one step of undo, if anything was dragged.
  void grab(ElementId element);
  void drag(const Point& target);
  void release();
  /// The element in the hand.
  std::optional<ElementId> held() const { return hand_ ? hand_->element : std::nullopt; }
  /// The hand takes a control point of free-form deformation and moves it, in the panels that have it; it is released
  /// as an element is.
  void grabControlPoint(std::uint32_t point);
  void dragControlPoint(const Point& target);
  /// What the hand did last on this mesh, without the release; empty where it did nothing yet.
  std::vector<Command> lastDrag() const { return tape().last_drag(); }
  /// As if nothing had been done yet to this object, which stands as it is.
  void forgetMoves();

  /// What was done to this object since it was at rest, and how far of it the object stands.
  const Tape& tape() const { return log_->tape(); }
  /// Notes on the tape what relaxation did in idle time since the last pass; to be called before the tape is saved.
  void noteRelaxation();
  /// Brings the object, by both solvers, to where it stood after so many commands of the tape, or where their own
  /// algorithms would have it. Relaxation goes off: what it did is on the tape. One step of undo, as are several in a
  /// row.
  void goTo(std::size_t position);
  /// Other moves, of this mesh: the object goes to rest, whole, and they lie ahead. One step of undo.
  void loadMoves(const std::shared_ptr<const std::vector<Command>>& moves, const QString& text);

  /// Edits, each one step of undo. Changes of one gesture (not 0) become one step.
  void setSoftness(const LinkSoftness& global, const QString& text, int gesture = 0);
  /// Gives links a softness of their own, or, with none, back the global one.
  void setSoftnessOf(const std::vector<LinkId>& links, const std::optional<LinkSoftness>& own);
  /// All links back to the default, those with a softness of their own too.
  void resetSoftness();
  void setPinned(const std::vector<ElementId>& elements, bool pinned);
  void cut(const std::vector<LinkId>& links);
  void resetObject();
  /// `own` is the softness of links that have their own.
  void replaceMesh(const MeshPointer& mesh, const QString& name, const QString& text,
                   std::map<LinkId, LinkSoftness> own = {});
  /// All that the session holds of an object; `file` is where it is kept, if anywhere.
  void restore(const std::shared_ptr<const Session>& session, const QString& file, const QString& text);

  /// Refused where the algorithm does not work on the mesh.
  void setAlgorithm(int panel, Algorithm algorithm);
  void setRelaxation(const commands::SetRelaxation& relaxation, int gesture = 0);
  /// Both as one step.
  void setSoftnessAndRelaxation(const LinkSoftness& global, const commands::SetRelaxation& relaxation,
                                const QString& text);
  void setElastic(const ElasticOptions& options, const QString& text, int gesture = 0);

  const Highlight& highlight() const { return highlight_; }
  void setHighlight(const Highlight& highlight);
  const Selection& selection() const { return selection_; }
  /// Elements ascending; not an edit, as the object stays as it is.
  void select(std::vector<ElementId> elements);

 signals:
  void frameReady(int panel);
  /// The last panel is about to go, and its frames with it.
  void panelLeaves(int panel);
  /// There is one more, or one less.
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
  /// There is more on the tape, or the object stands elsewhere on it.
  void tapeChanged();
  void sessionFileChanged();
  /// A command was refused: one sentence.
  void refused(const QString& sentence);
  /// A panel has no answer, as lacksPins says.
  void unpinned(int panel);
  /// Something was done that was not asked for: one sentence.
  void noticed(const QString& sentence);

 private:
  friend class Edit;
  friend class CutEdit;
  friend class PinEdit;
  template <class Value>
  friend class GestureEdit;
  friend class SoftnessEdit;
  friend class RelaxationEdit;
  friend class ElasticEdit;
  friend class AlgorithmEdit;
  friend class ResetEdit;
  friend class TravelEdit;
  friend class MeshEdit;
  friend class SessionEdit;

  // The document's own side of edits; the solvers are told beside.
  void letGoOfElements();
  void showCuts(const std::vector<LinkId>& links, bool cut);
  void showPins(const std::vector<ElementId>& elements, bool pinned);
  void showSoftness(std::shared_ptr<const Softness> softness);
  void showRelaxation(const commands::SetRelaxation& relaxation);
  void showElastic(const ElasticOptions& options);
  void runAlgorithm(int panel, Algorithm algorithm);
  void runAlgorithms(const std::vector<Algorithm>& algorithms);
  void followFallback();

  void cutSweeps();
  void travel(std::size_t position);
  void goToBeginning();
  void keepOnTheWay(std::size_t position);
  void dropKeptOnTheWay();
  void showTape();

  commands::StateId newState() { return nextState_++; }
  std::optional<commands::StateId> stateFor(int gesture, const QString& text);
  void push(QUndoCommand* edit);
  void takeInHand(std::optional<ElementId> element, const QString& text);
  void endDrag();
  void pushSoftness(Softness softness, const QString& text, int gesture);
  void post(const Command& command);
  std::function<void()> announcer(int panel);
  void takeOn(std::unique_ptr<SolverThread> solver);
  Algorithm unusedAlgorithm() const;
  void receiveFrame(int panel);
  void tellRefusal(int panel, const QString& sentence);

  MeshPointer mesh_;
  QString name_, sessionFile_;
  Cuts cuts_;
  Parts parts_;
  std::vector<ElementId> pins_;
  std::shared_ptr<const Softness> softness_ = std::make_shared<Softness>();  // shared with the edits
  commands::SetRelaxation relaxation_;
  ElasticOptions elastic_;
  std::array<Algorithm, mostPanels> algorithms_{Algorithm::generalized, Algorithm::natural_queue};
  Highlight highlight_;
  Selection selection_;
  commands::StateId nextState_ = 1;
  struct Hand {
    std::optional<ElementId> element;  // none where it holds a control point
    std::uint32_t controlPoint = 0;
    QString text;                  // of the step that this becomes
    commands::StateId before = 0;  // kept while the hand holds it
    bool moved = false;
  };
  std::optional<Hand> hand_;
  std::array<QString, mostPanels> told_;  // the last refusal, since the hand took hold

  // States kept while moves are replayed, by how many commands were carried out then: going back begins at one of them.
  std::map<std::size_t, commands::StateId> onTheWay_;
  std::uint64_t timelineOnTheWay_ = 0;  // the tape's
  bool replayed_ = false;               // the solvers stand where a replay has brought them
  std::uint64_t relaxationNoted_ = 0;   // the number of passes after which relaxation was last noted

  // The solver threads announce a frame at most once until it is received.
  std::array<std::atomic<bool>, mostPanels> announced_{};
  std::vector<std::unique_ptr<SolverThread>> solvers_;
  std::array<const Frame*, mostPanels> frames_{};
  std::array<const Frame*, mostPanels> instead_{};  // of these
  bool recordsPasses_ = false;
  std::unique_ptr<CommandLog> log_;
  QTimer sampler_;
  QUndoStack undoStack_;  // last: its edits post to the log when they go
};

}  // namespace chainmail
