#include "edits.h"

#include "text.h"

namespace chainmail {

CutEdit::CutEdit(Document& document, std::vector<LinkId> links) : document_(document), links_(std::move(links)) {
  setText(counted(QStringLiteral("cut"), links_.size(), QStringLiteral("link")));
}

PinEdit::PinEdit(Document& document, std::vector<ElementId> elements, bool pinned)
    : document_(document), elements_(std::move(elements)), pinned_(pinned) {
  setText(
      counted(pinned ? QStringLiteral("pin") : QStringLiteral("unpin"), elements_.size(), QStringLiteral("element")));
}

SoftnessEdit::SoftnessEdit(Document& document, std::shared_ptr<const Softness> softness, const QString& text,
                           int gesture)
    : QUndoCommand(text),
      document_(document),
      before_(document.softness_),
      after_(std::move(softness)),
      gesture_(gesture) {}

bool SoftnessEdit::mergeWith(const QUndoCommand* later) {
  const auto* other = dynamic_cast<const SoftnessEdit*>(later);
  if (other == nullptr || other->text() != text()) {
    return false;
  }
  after_ = other->after_;
  return true;
}

KeepingEdit::KeepingEdit(Document& document, const QString& text)
    : QUndoCommand(text), document_(document), state_(document.nextState_++) {}

KeepingEdit::~KeepingEdit() { document_.post(commands::DropState{state_}); }

void KeepingEdit::keep() { document_.post(commands::KeepState{state_}); }
void KeepingEdit::swap() { document_.post(commands::SwapState{state_}); }

ResetEdit::ResetEdit(Document& document) : KeepingEdit(document, QStringLiteral("reset object")) {}

void ResetEdit::redo() {
  keep();
  document_.post(commands::Reset{});
}

MeshEdit::MeshEdit(Document& document, MeshPointer mesh, const QString& name, const QString& text)
    : KeepingEdit(document, text), mesh_(std::move(mesh)), name_(name), cuts_(mesh_) {}

void MeshEdit::redo() {
  if (done_) {
    swap();
  } else {
    keep();
    document_.post(commands::ReplaceMesh{mesh_});
    done_ = true;
  }
  exchange();
}

void MeshEdit::undo() {
  swap();
  exchange();
}

void MeshEdit::exchange() {
  std::swap(mesh_, document_.mesh_);
  std::swap(name_, document_.name_);
  std::swap(cuts_, document_.cuts_);
  std::swap(pins_, document_.pins_);
  Softness softness = *document_.softness_;
  std::swap(softness_, softness.links);  // the global one is no part of the object
  document_.softness_ = std::make_shared<const Softness>(std::move(softness));
  document_.setHighlight({});
  document_.select({});
  emit document_.meshChanged();
  document_.followFallback();
}

}  // namespace chainmail
