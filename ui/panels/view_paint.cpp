// What a view draws: the object, what overlays add, and marks.

#include <QOpenGLContext>
#include <algorithm>

#include "mesh/error.h"
#include "panels/view.h"

namespace chainmail {
namespace {

constexpr float pinSize = 13;       // pixels
constexpr double largestRing = 12;  // pixels
constexpr double smallestMark = 2;

}  // namespace

void View::initializeGL() {
  // Docking the window's parts anew may give this view another context: everything is made again.
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] {
    makeCurrent();
    painter_.destroy();
    forgetGhost();
    painterReady_ = false;
    doneCurrent();
  });
  try {
    painter_.initialize();
    selectionOutdated_ = true;
    painterReady_ = true;
  } catch (const Error& error) {
    emit failed(QString::fromStdString(error.what()));
  }
}

void View::paintGL() {
  if (fitPending_) {
    fit();  // no resize came once it could be seen
  }
  const auto before = std::pair(painter_.step(), painter_.leavesLinksOut());
  meter_.painted();
  paint(devicePixelRatioF(), colours::background);
  if (document_.frame(panel_) != nullptr) {
    drawFocus();
  }
  if (std::pair(painter_.step(), painter_.leavesLinksOut()) != before) {
    emit drawnStepChanged();
  }
}

/// On what the context is bound to.
void View::paint(double pixelRatio, const QColor& ground) {
  auto* gl = context()->functions();
  const float opacity = ground.alphaF();
  gl->glClearColor(opacity * ground.redF(), opacity * ground.greenF(), opacity * ground.blueF(), opacity);
  gl->glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl->glDisable(GL_DEPTH_TEST);
  const Frame* frame = document_.frame(panel_);
  if (!painterReady_ || frame == nullptr) {
    return;
  }
  if (selectionOutdated_) {
    painter_.setSelection(document_.selection().elements);
    selectionOutdated_ = false;
  }
  Easel easel{painter_, [this]() -> ObjectDrawing& { return ghostPainter(); }, scene(pixelRatio)};
  easel.scene.background = ground;
  draw(easel, *frame);
}

void View::draw(const Easel& on, const Frame& frame) {
  drawObjects(on, frame);
  on.own.setFrame(frame, document_.cuts());
  for (Overlay* overlay : overlays_) {
    overlay->draw({on.own, on.scene, frame, panel_, camera_->unitsPerPixel(size())});
  }
  drawMarks(on);
}

/// Where links are coloured by a value they are what is to be seen.
ObjectDrawing::Paint View::paint() {
  auto paint = colouredPaint();
  paint.look = look_;
  paint.look.links = look_.links || (paint.values != nullptr && paint.values->ofLinks);
  return paint;
}

/// What colours the object: an overlay, its values, or its panel.
ObjectDrawing::Paint View::colouredPaint() {
  for (const Overlay* overlay : overlays_) {
    if (const auto paint = overlay->paint(panel_)) {
      return *paint;
    }
  }
  const ColourValues* values = colouring_.follow(panel_);
  return {colour_, values, colouring_.scale(panel_)};
}

double View::pixelsPerLink() const { return document_.mesh()->mean_link_length / camera_->unitsPerPixel(size()); }

/// The selection, what the cursor is at, and the pins, which a cursor must not hide.
void View::drawMarks(const Easel& on) {
  ObjectDrawing& own = on.own;
  const auto& in = on.scene;
  const double room = pixelsPerLink() * 0.7;
  if (links_.marks() || selectedHere_) {
    own.drawSelection(in, colours::selected, float(std::clamp(room, smallestMark, largestRing)));
  }
  drawHighlight(on);
  own.drawElements(in, document_.pins(), in.background, pinSize + 5, ObjectDrawing::Mark::diamond);
  own.drawElements(in, document_.pins(), colours::pinned, pinSize, ObjectDrawing::Mark::diamond);
  if (tool_ != nullptr) {
    own.drawStroke(in, tool_->stroke(*this), colours::marked);
  }
  drawAnnotations(on);
}

void View::drawHighlight(const Easel& on) {
  ObjectDrawing& own = on.own;
  const auto& in = on.scene;
  const Highlight& highlight = document_.highlight();
  // What the hand holds, or would cut, it does in all panels.
  const bool mirrored = links_.marks() || highlight.grabbed || !highlight.links.empty();
  if (!mirrored && links_.pointed() != panel_) {
    return;
  }
  own.drawLinks(in, highlight.links, colours::lit);
  if (highlight.element) {
    const ElementId element = *highlight.element;
    own.drawElements(in, std::span(&element, 1), in.background, 17);
    own.drawElements(in, std::span(&element, 1), highlight.grabbed ? colours::lit : colours::marked, 13);
  }
}

}  // namespace chainmail
