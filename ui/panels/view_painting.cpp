// What a view paints: objects, overlays, marks, annotations, focus, orientation cube; on the screen and in pictures.

#include <QImage>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QPainter>
#include <array>

#include "common/application.h"
#include "document/panel_colour.h"
#include "drawing/colour_map.h"
#include "drawing/vector_painter.h"
#include "mesh/error.h"
#include "panels/orientation_cube.h"
#include "panels/view.h"

namespace chainmail {
namespace {

constexpr double ringRadius = 24, ringWidth = 3;                     // pixels
constexpr float lectureLinks = 2;                                    // times the usual width
constexpr double arrowMargin = 34, arrowLength = 26, arrowHead = 9;  // pixels
constexpr float pinSize = 13;                                        // pixels
constexpr float cursorMarkSize = 13;                                 // pixels
constexpr float markEdge = 4;           // pixels of background around a mark, both sides together
constexpr double largestSelected = 12;  // diameter of a selected element's mark, pixels
constexpr double smallestSelected = 2;
// Diameter of the mark of a handle's element, in link lengths. In space, the marks of hidden elements are also visible.
constexpr double handleMarkShare = 0.5, spatialMarkShare = 0.2;
constexpr double largestHandleMark = 10;  // pixels

Error tooLarge(QSize picture, int most) {
  const auto what = QStringLiteral("%1 × %2 pixels are too many: the graphics card draws at most %3 on a side")
                        .arg(picture.width())
                        .arg(picture.height())
                        .arg(most);
  return {"picture", what.toStdString(), "choose a smaller scale"};
}

}  // namespace

void View::initializeGL() {
  // Docking a part of the window may give this view another context. Everything is created again then.
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] {
    makeCurrent();
    painter_.destroy();
    freeGhostPainter();
    painterReady_ = false;
    doneCurrent();
  });
  try {
    painter_.initialize();
    selectionOutdated_ = true;
    painterReady_ = true;
  } catch (...) {
    // Not while Qt paints: the sentence may show a bar, which resizes the view.
    const auto sentence = QString::fromStdString(failure_sentence("view"));
    QMetaObject::invokeMethod(
        this, [this, sentence] { emit failed(sentence); }, Qt::QueuedConnection);
  }
}

/// Requires the context to be current.
void View::freeGhostPainter() {
  painter_.freeSeeThrough();
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

/// An exception must not leave this function: QOpenGLWidget would believe that it is still painting.
void View::paintGL() {
  Application::guarded([this] {
    try {
      paint();
    } catch (...) {
      startOver();
      throw;
    }
  });
}

/// After a paint that failed in the middle, the next one must not use what it left half done.
void View::startOver() {
  painter_.startOver();
  if (ghostPainter_ != nullptr) {
    ghostPainter_->startOver();
  }
  selectionOutdated_ = true;
}

void View::paint() {
  if (fitPending_) {
    fitRest();  // there was no resize since the view became visible
  }
  const auto before = std::pair(painter_.step(), painter_.leavesLinksOut());
  meter_.painted();
  paintClock_.start();
  detail_ = chooseDetail();
  paintOn(colours::background, devicePixelRatioF(), detail_);
  if (document_.solvers().frame(panel_) != nullptr) {
    drawFocus();
    drawCube();
    drawRing();
  }
  if (detail_ == DetailBudget::Detail::quick) {
    quickShapes_ = painter_.shapes();
  } else if (painter_.takeLayerDrawn()) {
    context()->functions()->glFinish();
    budget_.tookComplete(double(paintClock_.nsecsElapsed()) * 1e-6);
  }
  if (std::pair(painter_.step(), painter_.leavesLinksOut()) != before) {
    emit drawnStepChanged();
  }
}

/// Returns the detail of the next picture. While the object or the camera moves, pictures that would take too long are
/// quick.
DetailBudget::Detail View::chooseDetail() {
  const Frame* frame = document_.solvers().frame(panel_);
  if (frame == nullptr) {
    return DetailBudget::Detail::complete;
  }
  const Mesh& mesh = *frame->mesh;
  const LastPicture now{&mesh, frame->number, frame->series, camera_->toView(), camera_->toClip(size())};
  const LastPicture before = std::exchange(lastPicture_, now);
  const bool slow = search_.showsSolid() || mesh.links.size() + mesh.triangles.size() > DetailBudget::minShapes;
  if (!slow || budget_.affordsComplete()) {
    return DetailBudget::Detail::complete;
  }
  if (now != before && before.mesh == &mesh) {
    still_.start();
  }
  return still_.isActive() ? DetailBudget::Detail::quick : DetailBudget::Detail::complete;
}

/// Takes note of how long a quick picture took until it was on the screen.
void View::measurePaint() {
  if (const std::size_t shapes = std::exchange(quickShapes_, 0); shapes > 0) {
    budget_.tookQuick(shapes, double(paintClock_.nsecsElapsed()) * 1e-6);
  }
}

/// Paints with OpenGL into the bound framebuffer.
void View::paintOn(const QColor& ground, double pixelRatio, DetailBudget::Detail detail) {
  auto* gl = context()->functions();
  const float opacity = ground.alphaF();
  gl->glClearColor(opacity * ground.redF(), opacity * ground.greenF(), opacity * ground.blueF(), opacity);
  gl->glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl->glDisable(GL_DEPTH_TEST);
  if (!painterReady_ || document_.solvers().frame(panel_) == nullptr) {
    return;
  }
  if (selectionOutdated_) {
    painter_.setSelection(document_.selection().elements());
    selectionOutdated_ = false;
  }
  draw({painter_, ghostFrame() != nullptr ? &ghostPainter() : nullptr, scene(pixelRatio, ground, detail)});
}

ObjectDrawing::Scene View::scene(double pixelRatio, const QColor& ground, DetailBudget::Detail detail) const {
  ObjectDrawing::Scene scene;
  scene.toView = camera_->toView();
  scene.toClip = camera_->toClip(size());
  scene.size = QSizeF(size()) * pixelRatio;
  scene.background = ground;
  scene.pixelRatio = float(pixelRatio);
  scene.linkScale = lecture_ ? lectureLinks : 1;
  scene.detail = detail;
  scene.maxShapes = detail == DetailBudget::Detail::quick ? budget_.maxShapes() : DetailBudget::maxAtRest;
  scene.hidesMarks = search_.showsSolid() && ghostFrame() == nullptr;
  if (camera_->spatial()) {
    const auto [near, far] = camera_->depthRange();
    scene.fog = QVector2D(float(near), float(far));
  }
  return scene;
}

/// Draws everything except the frame of the keyboard focus. The panel must have a frame.
void View::draw(const PaintTarget& on) {
  takeFrames(on);
  drawObjects(on);
  const Frame& frame = *document_.solvers().frame(panel_);
  for (Overlay* overlay : overlays_) {
    overlay->draw({*this, on.own, on.scene, frame, panel_, unitsPerPixel()});
  }
  drawMarks(on);
  drawAnnotations(on);
  if (on.scene.detail == DetailBudget::Detail::complete) {
    drawWayBack(on);
  }
}

const Frame* View::ghostFrame() const { return ghost_.of ? document_.solvers().frame(*ghost_.of) : nullptr; }

/// Passes the newest frames to the painters. A painter sends only the changes since its last frame to the graphics
/// card.
void View::takeFrames(const PaintTarget& on) {
  on.own.setFrame(*document_.solvers().frame(panel_), document_.cuts());
  if (on.ghost != nullptr) {
    on.ghost->setFrame(*ghostFrame(), document_.cuts());
  }
}

void View::drawObjects(const PaintTarget& on) {
  const double pixelsPerUnit = 1 / unitsPerPixel();
  const ObjectDrawing::Paint ownPaint = objectPaint();
  const auto drawOwn = [&] { on.own.drawObject(on.scene, ownPaint, pixelsPerUnit); };
  if (on.ghost == nullptr) {
    drawOwn();
    return;
  }
  const ObjectDrawing::Paint ghostPaint{panelColour(document_, *ghost_.of), nullptr, {}, drawOptions_};
  on.own.drawSeeThrough(on.scene, ghost_.ownOpacity(), drawOwn);
  on.ghost->drawSeeThrough(on.scene, ghost_.opacity(),
                           [&] { on.ghost->drawObject(on.scene, ghostPaint, pixelsPerUnit); });
}

/// Returns the colours and the parts of the object to draw. Links that are coloured by a value are drawn even if links
/// are hidden.
ObjectDrawing::Paint View::objectPaint() {
  auto paint = colouredPaint();
  paint.options = drawOptions_;
  paint.options.links = drawOptions_.links || (paint.values != nullptr && paint.values->ofLinks);
  return paint;
}

/// Returns the colours of the object: those of the first overlay that has colours, otherwise those of the values,
/// otherwise the colour of the panel.
ObjectDrawing::Paint View::colouredPaint() {
  for (const Overlay* overlay : overlays_) {
    if (const auto paint = overlay->paint(panel_)) {
      return *paint;
    }
  }
  const ColourValues* values = colouring_.follow(panel_);
  const bool plain = colouring_.mode() == ColourMode::plain || values != nullptr;  // else grey until values are known
  return {plain ? QColor(panelColour(document_, panel_)) : QColor(colour_map::neutral), values,
          colouring_.scale(panel_)};
}

/// Draws the selection, the highlight, the pins and the tool's stroke. Pins are drawn after the highlight, so that the
/// cursor's mark does not hide them.
void View::drawMarks(const PaintTarget& on) {
  const auto& in = on.scene;
  if (links_.marks() || selectedHere_) {
    const double pixelsPerLink = document_.mesh()->mean_link_length / unitsPerPixel();
    on.own.drawSelection(in, colours::selected,
                         float(std::clamp(0.7 * pixelsPerLink, smallestSelected, largestSelected)));
  }
  drawHighlight(on);
  on.own.drawElements(in, document_.pins(), in.background, pinSize + markEdge + 1, ObjectDrawing::Mark::diamond);
  on.own.drawElements(in, document_.pins(), colours::pinned, pinSize, ObjectDrawing::Mark::diamond);
  if (tool_ != nullptr) {
    on.own.drawStroke(in, tool_->stroke(*this), colours::marked);
    drawRibbon(on);
  }
}

/// Draws the ribbon of a stroke in another view.
void View::drawRibbon(const PaintTarget& on) {
  constexpr int faint = 70;  // of 255
  const auto ribbon = tool_->ribbon(*this);
  std::vector<QVector3D> sides, edges;
  for (std::size_t i = 0; i + 4 <= ribbon.size(); i += 2) {
    const auto& a = ribbon[i];
    const auto &b = ribbon[i + 1], &c = ribbon[i + 2], &d = ribbon[i + 3];
    sides.insert(sides.end(), {a, b, c, c, b, d});
    edges.insert(edges.end(), {a, c, b, d});
  }
  QColor colour = colours::marked;
  on.own.drawInSpace(on.scene, edges, ObjectDrawing::Shape::segments, colour, 1);
  colour.setAlpha(faint);
  on.own.drawInSpace(on.scene, sides, ObjectDrawing::Shape::triangles, colour);
}

void View::drawHighlight(const PaintTarget& on) {
  const auto& in = on.scene;
  const Marks& marks = document_.highlight().marks();
  // All panels show the handle, and the links that would be cut.
  const bool inAllPanels = links_.marks() || marks.grabbed || !marks.links.empty();
  if (!inAllPanels && links_.pointed() != panel_) {
    return;
  }
  on.own.drawLinks(in, marks.links, colours::lit);
  const QColor colour = marks.grabbed ? colours::lit : colours::marked;
  if (!marks.handle.empty()) {
    const double pixelsPerLink = document_.mesh()->mean_link_length / unitsPerPixel();
    const double share = camera_->spatial() ? spatialMarkShare : handleMarkShare;
    const auto diameter = float(std::clamp(share * pixelsPerLink, smallestSelected, largestHandleMark));
    on.own.drawElements(in, marks.handle, colour, diameter);
  }
  if (marks.element) {
    const ElementId element = *marks.element;
    on.own.drawElements(in, std::span(&element, 1), in.background, cursorMarkSize + markEdge);
    on.own.drawElements(in, std::span(&element, 1), colour, cursorMarkSize);
  }
}

void View::drawAnnotations(const PaintTarget& on) {
  std::vector<Annotation> annotations;
  for (const Overlay* overlay : overlays_) {
    const auto more = overlay->annotations(*this);
    annotations.insert(annotations.end(), more.begin(), more.end());
  }
  if (annotations.empty()) {
    return;
  }
  for (const Annotation& annotation : annotations) {
    on.own.drawStroke(on.scene, std::array{annotation.line.p1(), annotation.line.p2()}, colours::marked);
  }
  on.own.paintOver(on.scene, [&](QPainter& painter) {
    for (const Annotation& annotation : annotations) {
      drawAnnotation(painter, annotation, on.scene.background, size());
    }
  });
}

/// Returns where in the view (logical pixels) the object is that is out of view; none if a part of it is in view.
std::optional<QPointF> View::wayToObject() const {
  const ClusterBoxes& all = search_.boxes(*document_.solvers().frame(panel_));
  const Projection seen = search_.projection();
  ViewBounds bounds;
  for (std::size_t cluster = 0; cluster < all.level().clusterCount(); ++cluster) {
    bounds.unite(seen.bounds(all[cluster]));
    if (bounds.meets(QRectF(rect()))) {
      return std::nullopt;
    }
  }
  return bounds.empty() ? QRectF(rect()).center()
                        : QPointF((bounds.left + bounds.right) / 2, (bounds.top + bounds.bottom) / 2);
}

/// If the object is out of view, draws an arrow at the edge that points to it, and says how to see it.
void View::drawWayBack(const PaintTarget& on) {
  const auto object = wayToObject();
  if (!object) {
    return;
  }
  const QPointF middle = QRectF(rect()).center();
  on.own.paintOver(on.scene, [&](QPainter& painter) {
    painter.setPen(QColor(colours::marked));
    painter.drawText(rect(), Qt::AlignCenter, QStringLiteral("The object is out of view. Press F to show it."));
  });
  const QLineF way(middle, *object);
  if (way.length() < 1) {
    return;
  }
  const QPointF along = (way.p2() - way.p1()) / way.length(), side(-along.y(), along.x());
  const double room = std::min((middle.x() - arrowMargin) / std::max(std::abs(along.x()), 1e-9),
                               (middle.y() - arrowMargin) / std::max(std::abs(along.y()), 1e-9));
  const QPointF tip = middle + room * along, neck = tip - arrowHead * along;
  on.own.paintOver(on.scene, [&](QPainter& painter) {
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(QColor(colours::marked), 3));
    painter.setBrush(QColor(colours::marked));
    painter.drawLine(QLineF(tip - arrowLength * along, neck));
    painter.drawPolygon(QPolygonF({tip, neck + arrowHead * 0.7 * side, neck - arrowHead * 0.7 * side}));
  });
}

void View::drawFocus() {
  if (focusFramed_) {
    const QRectF inner = QRectF(rect()).adjusted(1, 1, -1, -1);
    const std::array corners{inner.topLeft(), inner.topRight(), inner.bottomRight(), inner.bottomLeft(),
                             inner.topLeft()};
    painter_.drawStroke(scene(devicePixelRatioF(), colours::background, detail_), corners, colours::focus);
  }
}

void View::drawCube() {
  if (camera_->spatial() && painterReady_) {
    painter_.paintOver(scene(devicePixelRatioF(), colours::background, detail_),
                       [this](QPainter& painter) { OrientationCube(*camera_, size()).draw(painter); });
  }
}

void View::drawRing() {
  if (lecture_ && underMouse() && painterReady_) {
    painter_.paintOver(scene(devicePixelRatioF(), colours::background, detail_), [this](QPainter& painter) {
      painter.setRenderHint(QPainter::Antialiasing);
      painter.setBrush(Qt::NoBrush);
      painter.setPen(QPen(QColor(colours::background), ringWidth + 2));
      painter.drawEllipse(cursor_, ringRadius, ringRadius);
      painter.setPen(QPen(QColor(colours::pinned), ringWidth));
      painter.drawEllipse(cursor_, ringRadius, ringRadius);
    });
  }
}

// Pictures: in pixels, and as vector graphics

QImage View::picture(double pixelRatio, bool transparent) {
  const QSize pixels = (QSizeF(size()) * pixelRatio).toSize();
  makeCurrent();
  GLint most = 0;
  context()->functions()->glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most);
  if (std::max(pixels.width(), pixels.height()) > most) {
    doneCurrent();
    throw tooLarge(pixels, most);
  }
  QImage image;
  {
    QOpenGLFramebufferObject canvas(pixels, QOpenGLFramebufferObject::CombinedDepthStencil);
    canvas.bind();
    context()->functions()->glViewport(0, 0, pixels.width(), pixels.height());
    paintOn(transparent ? QColor(0, 0, 0, 0) : QColor(colours::background), pixelRatio, DetailBudget::Detail::complete);
    image = canvas.toImage();
  }
  doneCurrent();
  image.setDevicePixelRatio(pixelRatio);
  return image;
}

void View::drawIn(QPainter& painter, const QColor& ground) {
  painter.fillRect(QRectF(rect()), ground);
  if (document_.solvers().frame(panel_) == nullptr) {
    return;
  }
  VectorPainter own(painter, levels_);
  own.setSelection(document_.selection().elements());
  std::optional<VectorPainter> ghost;
  if (ghostFrame() != nullptr) {
    ghost.emplace(painter, levels_);
  }
  draw({own, ghost ? &*ghost : nullptr, scene(1, ground, DetailBudget::Detail::complete)});
}

}  // namespace chainmail
