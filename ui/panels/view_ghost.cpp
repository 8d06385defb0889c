// A view's own object, and another panel's laid over it as a ghost.

#include "common/colours.h"
#include "panels/view.h"

namespace chainmail {

void View::setGhost(const Ghost& ghost) {
  if (ghost == ghost_) {
    return;
  }
  ghost_ = ghost;
  if (!ghost_.of) {
    makeCurrent();
    forgetGhost();
    doneCurrent();
  }
  emit ghostChanged();
  update();
}

/// Frees what the ghost holds of the graphics card; needs the context current.
void View::forgetGhost() {
  if (ghostPainter_ != nullptr) {
    ghostPainter_->destroy();
    ghostPainter_.reset();
  }
}

ObjectPainter& View::ghostPainter() {
  if (ghostPainter_ == nullptr) {
    ghostPainter_ = std::make_unique<ObjectPainter>(levels_);
    ghostPainter_->initialize();
  }
  return *ghostPainter_;
}

void View::drawObjects(const Easel& on, const Frame& frame) {
  const double pixelsPerUnit = 1 / camera_->unitsPerPixel(size());
  const ObjectDrawing::Paint ownPaint = paint();
  const auto drawOwn = [&] {
    on.own.setFrame(frame, document_.cuts());
    on.own.drawObject(on.scene, ownPaint, pixelsPerUnit);
  };
  const Frame* other = ghost_.of ? document_.frame(*ghost_.of) : nullptr;
  if (other == nullptr) {
    drawOwn();
    return;
  }
  ObjectDrawing& ghost = on.ghost();
  const ObjectDrawing::Paint otherPaint{colours::ofPanel(*ghost_.of), nullptr, {}, look_};
  ghost.drawSeeThrough(on.scene, ghost_.ownOpacity(), drawOwn);
  ghost.drawSeeThrough(on.scene, ghost_.opacity(), [&] {
    ghost.setFrame(*other, document_.cuts());
    ghost.drawObject(on.scene, otherPaint, pixelsPerUnit);
  });
}

}  // namespace chainmail
