#include "document/edits.h"

#include "common/text.h"

namespace chainmail {

Edit::Edit(Document& document, const QString& text, std::optional<commands::StateId> state, bool kept)
    : QUndoCommand(text), document_(document), state_(state), kept_(kept) {}

Edit::~Edit() {
  if (state_) {
    document_.post(commands::DropState{*state_});
  }
}

void Edit::redo() {
  if (done_) {
    exchange(true);
    return;
  }
  done_ = true;
  if (state_ && !kept_) {
    document_.post(commands::KeepState{*state_});
  }
  carryOut();
  show(true);
}

void Edit::undo() { exchange(false); }

void Edit::exchange(bool done) {
  const commands::StateId now = document_.newState();
  document_.post(commands::KeepState{now});
  prepare(done);
  document_.post(commands::RestoreState{*state_});
  document_.post(commands::DropState{*state_});
  state_ = now;
  show(done);
}

DragEdit::DragEdit(Document& document, const QString& text, commands::StateId before)
    : Edit(document, text, before, true) {}

CutEdit::CutEdit(Document& document, std::vector<LinkId> links)
    : Edit(document, counted(QStringLiteral("cut"), links.size(), QStringLiteral("link")), document.newState()),
      links_(std::move(links)) {}

void CutEdit::carryOut() { document_.post(commands::Cut{links_}); }

PinEdit::PinEdit(Document& document, std::vector<ElementId> elements, bool pinned)
    : Edit(
          document,
          counted(pinned ? QStringLiteral("pin") : QStringLiteral("unpin"), elements.size(), QStringLiteral("element")),
          document.newState()),
      elements_(std::move(elements)),
      pinned_(pinned) {}

void PinEdit::carryOut() {
  document_.post(pinned_ ? Command(commands::Pin{elements_}) : Command(commands::Unpin{elements_}));
}

SoftnessEdit::SoftnessEdit(Document& document, std::shared_ptr<const Softness> softness, const QString& text,
                           int gesture)
    : GestureEdit(document, document.wholeSoftness(), std::move(softness), text, gesture) {}

void SoftnessEdit::carryOut() { document_.post(commands::SetSoftness{after_}); }

RelaxationEdit::RelaxationEdit(Document& document, const commands::SetRelaxation& relaxation, const QString& text,
                               int gesture)
    : GestureEdit(document, document.relaxation(), relaxation, text, gesture) {}

void RelaxationEdit::carryOut() { document_.post(after_); }
void RelaxationEdit::prepare(bool done) { document_.post(done ? after_ : before_); }

ElasticEdit::ElasticEdit(Document& document, const ElasticOptions& options, const QString& text, int gesture)
    : GestureEdit(document, document.elastic(), options, text, gesture) {}

void ElasticEdit::prepare(bool done) { document_.post(commands::SetElastic{done ? after_ : before_}); }

AlgorithmEdit::AlgorithmEdit(Document& document, int panel, Algorithm algorithm)
    : Edit(document, chainmail::text(info(algorithm).label), document.newState()),
      panel_(panel),
      before_(document.algorithm(panel)),
      after_(algorithm) {}

void AlgorithmEdit::prepare(bool done) { document_.runAlgorithm(panel_, done ? after_ : before_); }

ResetEdit::ResetEdit(Document& document) : Edit(document, QStringLiteral("reset object"), document.newState()) {}

void ResetEdit::carryOut() { document_.post(commands::Reset{}); }

TravelEdit::TravelEdit(Document& document, const QString& text, int gesture, std::function<void()> go)
    : Edit(document, text, document.stateFor(gesture, text)),
      gesture_(gesture),
      go_(std::move(go)),
      relaxation_(document.relaxation()) {}

void TravelEdit::carryOut() {
  prepare(true);
  go_();
}

void TravelEdit::prepare(bool done) {
  commands::SetRelaxation relaxation = relaxation_;
  relaxation.on = relaxation.on && !done;
  if (relaxation != document_.relaxation_) {
    document_.post(relaxation);
    document_.showRelaxation(relaxation);
  }
}

void TravelEdit::show(bool /*done*/) {
  document_.setHighlight({});
  document_.showTape();
}

MeshEdit::MeshEdit(Document& document, MeshPointer mesh, const QString& name, const QString& text,
                   std::map<LinkId, LinkSoftness> own)
    : Edit(document, text, document.newState()),
      mesh_(std::move(mesh)),
      name_(name),
      cuts_(mesh_),
      parts_(mesh_),
      softness_(std::move(own)),
      algorithms_(document.algorithms_.begin(), document.algorithms_.begin() + document.panels()) {}

void MeshEdit::carryOut() {
  document_.post(commands::ReplaceMesh{mesh_});
  if (!softness_.empty()) {
    document_.post(commands::SetSoftness(Softness{document_.softness(), softness_}));
  }
}

void MeshEdit::show(bool done) {
  document_.letGoOfElements();
  std::swap(mesh_, document_.mesh_);
  std::swap(name_, document_.name_);
  std::swap(cuts_, document_.cuts_);
  std::swap(parts_, document_.parts_);
  std::swap(pins_, document_.pins_);
  Softness softness = *document_.softness_;
  std::swap(softness_, softness.links);  // the global one is no part of the object
  document_.softness_ = std::make_shared<const Softness>(std::move(softness));
  emit document_.meshChanged();
  if (done) {
    document_.followFallback();
  } else {
    document_.runAlgorithms(algorithms_);
  }
}

}  // namespace chainmail
