#pragma once

#include <QUndoCommand>
#include <functional>

#include "document/document.h"

namespace chainmail {

/// A step of the undo stack. The solvers keep the whole object as it was before, and exchange it with what is there:
/// undo and redo give every position back to the bit, whatever the hand and relaxation have moved since.
class Edit : public QUndoCommand {
 public:
  ~Edit() override;
  void redo() final;
  void undo() final;

 protected:
  /// `state` is kept already, or is to be kept when the step is first done; none where the step is merged into the one
  /// before.
  Edit(Document& document, const QString& text, std::optional<commands::StateId> state, bool kept = false);

  /// Posts what the step does the first time.
  virtual void carryOut() {}
  /// Posts what the solvers do not keep with the object, before they take it back.
  virtual void prepare(bool /*done*/) {}
  /// Brings the document's own side to what it is with the step done, or undone.
  virtual void show(bool /*done*/) {}

  Document& document_;

 private:
  void exchange(bool done);

  std::optional<commands::StateId> state_;
  bool kept_;
  bool done_ = false;  // once
};

/// What the hand did from taking an element to letting go.
class DragEdit : public Edit {
 public:
  DragEdit(Document& document, const QString& text, commands::StateId before);
};

class CutEdit : public Edit {
 public:
  CutEdit(Document& document, std::vector<LinkId> links);

 private:
  void carryOut() override;
  void show(bool done) override { document_.showCuts(links_, done); }

  std::vector<LinkId> links_;
};

/// Pins elements, or unpins them.
class PinEdit : public Edit {
 public:
  PinEdit(Document& document, std::vector<ElementId> elements, bool pinned);

 private:
  void carryOut() override;
  void show(bool done) override { document_.showPins(elements_, pinned_ == done); }

  std::vector<ElementId> elements_;  // that change, ascending
  bool pinned_;
};

/// A step that changes with the gesture that makes it: steps of one gesture (not 0) become one.
template <class Value>
class GestureEdit : public Edit {
 public:
  int id() const override { return gesture_ == 0 ? -1 : gesture_; }
  bool mergeWith(const QUndoCommand* later) override {
    const auto* other = dynamic_cast<const GestureEdit*>(later);
    if (other == nullptr || other->text() != text()) {
      return false;
    }
    after_ = other->after_;
    return true;
  }

 protected:
  GestureEdit(Document& document, Value before, Value after, const QString& text, int gesture)
      : Edit(document, text, document.stateFor(gesture, text)),
        before_(std::move(before)),
        after_(std::move(after)),
        gesture_(gesture) {}

  Value before_, after_;

 private:
  int gesture_;
};

/// Holds the whole softness and shares it: the steps of a slider's gesture copy no links.
class SoftnessEdit : public GestureEdit<std::shared_ptr<const Softness>> {
 public:
  SoftnessEdit(Document& document, std::shared_ptr<const Softness> softness, const QString& text, int gesture);

 private:
  void carryOut() override;
  void show(bool done) override { document_.showSoftness(done ? after_ : before_); }
};

class RelaxationEdit : public GestureEdit<commands::SetRelaxation> {
 public:
  RelaxationEdit(Document& document, const commands::SetRelaxation& relaxation, const QString& text, int gesture);

 private:
  void carryOut() override;
  void prepare(bool done) override;
  void show(bool done) override { document_.showRelaxation(done ? after_ : before_); }
};

/// Another material, or another lattice of control points.
class ElasticEdit : public GestureEdit<ElasticOptions> {
 public:
  ElasticEdit(Document& document, const ElasticOptions& options, const QString& text, int gesture);

 private:
  void carryOut() override { prepare(true); }
  void prepare(bool done) override;
  void show(bool done) override { document_.showElastic(done ? after_ : before_); }
};

/// Another algorithm in one panel.
class AlgorithmEdit : public Edit {
 public:
  AlgorithmEdit(Document& document, int panel, Algorithm algorithm);

 private:
  void carryOut() override { prepare(true); }
  void prepare(bool done) override;
  void show(bool /*done*/) override { emit document_.algorithmChanged(panel_); }

  int panel_;
  Algorithm before_, after_;
};

class ResetEdit : public Edit {
 public:
  explicit ResetEdit(Document& document);

 private:
  void carryOut() override;
};

/// Another place on the tape, or another tape; several in a row are one step.
class TravelEdit : public Edit {
 public:
  TravelEdit(Document& document, const QString& text, int gesture, std::function<void()> go);
  int id() const override { return gesture_ == 0 ? -1 : gesture_; }
  bool mergeWith(const QUndoCommand* later) override { return later->text() == text(); }

 private:
  void carryOut() override;
  void prepare(bool done) override;
  void show(bool done) override;

  int gesture_;
  std::function<void()> go_;
  commands::SetRelaxation relaxation_;  // before
};

class MeshEdit : public Edit {
 public:
  MeshEdit(Document& document, MeshPointer mesh, const QString& name, const QString& text,
           std::map<LinkId, LinkSoftness> own);

 private:
  void carryOut() override;
  void show(bool done) override;

  // What the document does not show at the moment.
  MeshPointer mesh_;
  QString name_;
  Cuts cuts_;
  Parts parts_;
  std::vector<ElementId> pins_;
  std::map<LinkId, LinkSoftness> softness_;  // of the links that have their own
  std::vector<Algorithm> algorithms_;        // that ran before
};

}  // namespace chainmail
