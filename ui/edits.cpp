#include "edits.h"

namespace chainmail {

CutEdit::CutEdit(Document& document, std::vector<LinkId> links) : document_(document), links_(std::move(links)) {
  setText(links_.size() == 1 ? QStringLiteral("cut 1 link") : QStringLiteral("cut %L1 links").arg(links_.size()));
}

SoftnessEdit::SoftnessEdit(Document& document, const LinkSoftness& softness, const QString& text, int gesture)
    : QUndoCommand(text), document_(document), before_(document.softness()), after_(softness), gesture_(gesture) {}

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
  document_.setHighlight({});
  emit document_.meshChanged();
}

}  // namespace chainmail
