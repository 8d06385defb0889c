#pragma once

#include <QUndoCommand>

#include "document.h"

namespace chainmail {

/// The steps of the undo stack. Cuts, pins, resets and meshes come back exactly; of softness the values do, and
/// what they have moved since stays, as after a drag.

class CutEdit : public QUndoCommand {
 public:
  CutEdit(Document& document, std::vector<LinkId> links);
  void redo() override { document_.applyCuts(links_, true); }
  void undo() override { document_.applyCuts(links_, false); }

 private:
  Document& document_;
  std::vector<LinkId> links_;
};

/// Pins elements, or unpins them.
class PinEdit : public QUndoCommand {
 public:
  PinEdit(Document& document, std::vector<ElementId> elements, bool pinned);
  void redo() override { document_.applyPins(elements_, pinned_); }
  void undo() override { document_.applyPins(elements_, !pinned_); }

 private:
  Document& document_;
  std::vector<ElementId> elements_;  // that change, ascending
  bool pinned_;
};

/// Holds the whole softness, before and after, and shares it: the steps of a slider's gesture copy no links.
class SoftnessEdit : public QUndoCommand {
 public:
  SoftnessEdit(Document& document, std::shared_ptr<const Softness> softness, const QString& text, int gesture);
  int id() const override { return gesture_ == 0 ? -1 : gesture_; }
  bool mergeWith(const QUndoCommand* later) override;
  void redo() override { document_.applySoftness(after_); }
  void undo() override { document_.applySoftness(before_); }

 private:
  Document& document_;
  std::shared_ptr<const Softness> before_, after_;
  int gesture_;
};

/// An edit for which the solvers keep the object as it was before.
class KeepingEdit : public QUndoCommand {
 protected:
  KeepingEdit(Document& document, const QString& text);
  ~KeepingEdit() override;
  void keep();
  void swap();
  Document& document_;

 private:
  commands::StateId state_;
};

class ResetEdit : public KeepingEdit {
 public:
  explicit ResetEdit(Document& document);
  void redo() override;
  void undo() override { swap(); }
};

class MeshEdit : public KeepingEdit {
 public:
  MeshEdit(Document& document, MeshPointer mesh, const QString& name, const QString& text);
  void redo() override;
  void undo() override;

 private:
  void exchange();

  // What the document does not show at the moment.
  MeshPointer mesh_;
  QString name_;
  Cuts cuts_;
  std::vector<ElementId> pins_;
  std::map<LinkId, LinkSoftness> softness_;  // of the links that have their own
  bool done_ = false;
};

}  // namespace chainmail
