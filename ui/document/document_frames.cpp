// What the panels show: the solvers' newest frames, or others in their place.

#include "document/document.h"

namespace chainmail {

const Frame* Document::frame(int panel) const {
  if (panel >= panels()) {
    return nullptr;
  }
  const Frame* frame = instead_[panel] != nullptr ? instead_[panel] : frames_[panel];
  return frame->mesh == mesh_ ? frame : nullptr;
}

void Document::showInstead(int panel, const Frame* frame) {
  if (frame != nullptr || instead_[panel] != nullptr) {
    instead_[panel] = frame;
    emit frameReady(panel);
  }
}

void Document::recordPasses(bool on) {
  recordsPasses_ = on;
  for (const auto& solver : solvers_) {
    solver->record_passes(on);
  }
}

}  // namespace chainmail
