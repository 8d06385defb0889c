// A view's own object, and another panel's laid over it as a ghost.

#include "colours.h"
#include "view.h"

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
  seeThrough_.destroy();
}

void View::drawObjects(const ObjectPainter::Scene& in) {
  const double pixelsPerUnit = 1 / camera_->unitsPerPixel(size());
  const ObjectPainter::Paint ownPaint = paint();
  const auto drawOwn = [&] { painter_.drawObject(in, ownPaint, pixelsPerUnit); };
  const Frame* other = ghost_.of ? document_.frame(*ghost_.of) : nullptr;
  if (other == nullptr) {
    drawOwn();
    return;
  }
  if (ghostPainter_ == nullptr) {
    ghostPainter_ = std::make_unique<ObjectPainter>(levels_);
    ghostPainter_->initialize();
  }
  ghostPainter_->setFrame(*other, document_.cuts());
  const ObjectPainter::Paint otherPaint{colours::ofPanel(*ghost_.of), nullptr, {}};
  const QSize pixels = in.size.toSize();
  seeThrough_.draw(pixels, ghost_.ownOpacity(), drawOwn);
  seeThrough_.draw(pixels, ghost_.opacity(), [&] { ghostPainter_->drawObject(in, otherPaint, pixelsPerUnit); });
}

}  // namespace chainmail
