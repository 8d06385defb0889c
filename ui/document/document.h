#pragma once

#include <QObject>
#include <QString>
#include <QUndoStack>
#include <functional>
#include <memory>
#include <optional>

#include "document/change_executor.h"
#include "document/drag_session.h"
#include "document/move_player.h"
#include "document/panel_solvers.h"
#include "document/selection.h"

namespace chainmail {

struct Session;

/// The file of a document.
class DocumentFiles : public QObject {
  Q_OBJECT

 public:
  /// The file of this session; empty if it has none yet.
  const QString& session() const { return session_; }
  void setSession(const QString& file);
  /// Exchanges the file of the session with `file`, which an undo step keeps.
  void exchangeSession(QString& file);

 signals:
  void sessionChanged();

 private:
  QString session_;
};

/// The object, its parameters, their undo stack, and one solver per panel that deforms the object.
///
/// Every edit (edits.h) is a Change that is passed to apply(). It becomes one undo step, which changes the contents and
/// all solvers. Moves of the handle go directly to the log that feeds all solvers. Both are
/// carried out by one ChangeExecutor.
class Document : public QObject {
  Q_OBJECT

 public:
  static constexpr int minPanels = Contents::minPanels, maxPanels = Contents::maxPanels;

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
  /// The global softness. It applies to all links without a softness of their own.
  const LinkSoftness& softness() const { return contents_.softness->global; }
  const std::shared_ptr<const Softness>& wholeSoftness() const { return contents_.softness; }
  ObjectState object() const { return {mesh(), cuts().links(), pins(), wholeSoftness()}; }
  const commands::SetRelaxation& relaxation() const { return contents_.relaxation; }
  const ElasticOptions& elastic() const { return contents_.elastic; }
  /// The lesson of the object; without a session if the object is none.
  const OpenLesson& lesson() const { return contents_.lesson; }

  // Its parts.

  PanelSolvers& solvers() { return solvers_; }
  const PanelSolvers& solvers() const { return solvers_; }
  DragSession& handle() { return handle_; }
  const DragSession& handle() const { return handle_; }
  MovePlayer& moves() { return moves_; }
  const MovePlayer& moves() const { return moves_; }
  Highlight& highlight() { return highlight_; }
  const Highlight& highlight() const { return highlight_; }
  DocumentFiles& files() { return files_; }
  const DocumentFiles& files() const { return files_; }
  Selection& selection() { return selection_; }
  const Selection& selection() const { return selection_; }

  // Panels: each has a solver and an algorithm.

  /// Number of panels, from minPanels to maxPanels.
  int panels() const { return solvers_.count(); }
  /// Adds a panel. It copies the object of the first panel, including the states for undo, and runs an algorithm that
  /// no other panel runs.
  void addPanel();
  /// Removes the last panel.
  void removePanel();
  /// The algorithm of a panel. For a removed panel, its last one.
  Algorithm algorithm(int panel) const { return contents_.algorithms[std::size_t(panel)]; }

  /// Sets what keeps unsaved work before another object replaces it; it returns false if the work must stay.
  void setKeeper(std::function<bool()> keeper) { keeper_ = std::move(keeper); }
  /// Ends a drag, and keeps unsaved work. Returns false if the object must stay.
  bool keepsWork();

  // Undo steps: see also edits.h.

  QUndoStack& undoStack() { return undoStack_; }
  /// Undoes the last step. If a drag is in progress, it ends and becomes that step.
  void undo();
  void redo();
  /// True if there are changes since the session was opened or saved.
  bool isModified() const { return handle_.isActive() || (!undoStack_.isClean() && !moves_.onlyLessonMoved()); }
  /// Returns a change that does nothing yet: its values are the current ones.
  Change change(const QString& text, int gesture = 0);
  /// Begins relaxation anew in all panels, where it has stopped before it has settled.
  void continueRelaxation();
  /// Carries out a change as one undo step. All edits use this function.
  void apply(Change change);

 signals:
  /// The last panel and its frames are about to be removed.
  void panelLeaves(int panel);
  /// A panel was added or removed.
  void panelsChanged();
  void meshChanged();
  /// Another lesson, other captions or another step of them belong to the object.
  void lessonChanged();
  /// These links were cut, or restored if `cut` is false.
  void cutsChanged(const std::vector<LinkId>& links, bool cut);
  void softnessChanged();
  void relaxationChanged();
  void elasticChanged();
  void algorithmChanged(int panel);
  void pinsChanged();
  /// A command was refused; `sentence` gives the reason.
  void refused(const QString& sentence);
  /// A panel has no solution; see lacksPins() in element_facts.h.
  void unpinned(int panel);
  /// The document changed something by itself; `sentence` says what.
  void noticed(const QString& sentence);

 private:
  std::optional<commands::StateId> stateFor(int gesture, const QString& text);
  void addSolver(Algorithm algorithm);
  Algorithm unusedAlgorithm() const;

  Contents contents_;
  std::function<bool()> keeper_;
  DocumentFiles files_;
  Highlight highlight_;
  Selection selection_;
  PanelSolvers solvers_;
  ChangeExecutor executor_;
  DragSession handle_;
  MovePlayer moves_;
  QUndoStack undoStack_;  // the last member: its edits post to the log when they are deleted
};

}  // namespace chainmail
