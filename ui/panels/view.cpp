#include "panels/view.h"

#include <QFocusEvent>
#include <QImage>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QPainter>
#include <QVector4D>
#include <QWheelEvent>
#include <array>
#include <chrono>
#include <cmath>

#include "common/application.h"
#include "common/text.h"
#include "document/panel_colour.h"
#include "drawing/colour_map.h"
#include "drawing/vector_painter.h"
#include "mesh/error.h"
#include "mesh/failure.h"
#include "mesh/surface.h"
#include "panels/orientation_cube.h"

namespace chainmail {
namespace {

constexpr int hoverMilliseconds = 16;
constexpr std::chrono::milliseconds boxMilliseconds(4);
constexpr int stillMilliseconds = 50;
constexpr double ringRadius = 24, ringWidth = 3;  // pixels
constexpr float lectureLinks = 2;                 // times the usual width
constexpr double zoomPerNotch = 1.2;
constexpr std::size_t maxOutlinePoints = 200'000;  // of larger objects, some elements or boxes are the outline
constexpr double arrowMargin = 34, arrowLength = 26, arrowHead = 9;  // pixels
constexpr float pinSize = 13;                                        // pixels
constexpr float cursorMarkSize = 13;                                 // pixels
constexpr float markEdge = 4;           // pixels of background around a mark, both sides together
constexpr double largestSelected = 12;  // diameter of a selected element's mark, pixels
constexpr double smallestSelected = 2;
// Diameter of the mark of a handle's element, in link lengths. In space, the marks of hidden elements are also visible.
constexpr double handleMarkShare = 0.5, spatialMarkShare = 0.2;
constexpr double largestHandleMark = 10;  // pixels

/// Returns the bounds of an object at rest in the space of its frames.
std::array<Point, 2> boxIn(const FrameSpace& space, const Mesh& mesh) {
  return {space.into(bounds(mesh)[0]), space.into(bounds(mesh)[1])};
}

/// Returns points of an object at rest that tell where it is: its corners, or many of its elements.
std::vector<QVector3D> restOutline(const Mesh& mesh) {
  const FrameSpace space(mesh);
  if (mesh.lattice) {
    const auto corners = cornersOf(boxIn(space, mesh));
    return {corners.begin(), corners.end()};
  }
  std::vector<QVector3D> points;
  const std::size_t step = mesh.element_count() / maxOutlinePoints + 1;
  for (std::size_t element = 0; element < mesh.element_count(); element += step) {
    points.push_back(asVector(space.into(mesh.rest_position(ElementId(element)))));
  }
  return points;
}

Error tooLarge(QSize picture, int most) {
  const auto what = QStringLiteral("%1 × %2 pixels are too many: the graphics card draws at most %3 on a side")
                        .arg(picture.width())
                        .arg(picture.height())
                        .arg(most);
  return {"picture", what.toStdString(), "choose a smaller scale"};
}

}  // namespace

View::View(Document& document, Colouring& colouring, PanelLinks& links, int panel, std::shared_ptr<Camera> camera,
           std::shared_ptr<MeshLevels> levels)
    : document_(document),
      colouring_(colouring),
      links_(links),
      panel_(panel),
      camera_(std::move(camera)),
      levels_(std::move(levels)),
      search_(*this, document_, panel, camera_, levels_, drawOptions_),
      painter_(levels_),
      still_(this),
      hover_(this) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);  // a click takes the keyboard focus from an input field
  setMinimumSize(160, 90);
  still_.setSingleShot(true);
  still_.setInterval(stillMilliseconds);
  connect(&still_, &QTimer::timeout, this, qOverload<>(&View::update));
  hover_.setSingleShot(true);
  connect(&hover_, &QTimer::timeout, this, &View::searchUnderCursor);
  listen();
}

void View::listen() {
  connect(&document_.solvers(), &PanelSolvers::frameReady, this, [this](int ready) {
    if (ready == panel_ || ready == ghost_.of) {
      update();  // the paint passes the newest frame to the painters
    }
  });
  connect(&document_.highlight(), &Highlight::changed, this, qOverload<>(&View::update));
  connect(&document_, &Document::pinsChanged, this, qOverload<>(&View::update));
  connect(&document_, &Document::algorithmChanged, this, qOverload<>(&View::update));  // changes colours of panels
  connect(&document_, &Document::algorithmChanged, this, &View::nameIt);
  nameIt();
  connect(&document_.selection(), &Selection::changed, this, [this] {
    selectionOutdated_ = true;
    selectedHere_ = links_.pointed() == panel_;
    update();
  });
  connect(&document_, &Document::cutsChanged, this, [this] {
    painter_.cutsChanged();
    if (ghostPainter_ != nullptr) {
      ghostPainter_->cutsChanged();
    }
    update();
  });
  connect(&document_.undoStack(), &QUndoStack::indexChanged, this, &View::updateHover, Qt::QueuedConnection);
  connect(&links_, &PanelLinks::marksLinked, this, qOverload<>(&View::update));
  connect(&colouring_, &Colouring::changed, this, qOverload<>(&View::update));
  connect(this, &QOpenGLWidget::frameSwapped, this, [this] {
    meter_.swapped();
    measurePaint();
  });
}

/// Names the view for screen readers.
void View::nameIt() {
  setAccessibleName(
      QStringLiteral("Object of panel %1, %2").arg(panelName(panel_), text(info(document_.algorithm(panel_)).label)));
}

/// Highlights the element under the cursor again after an edit has cleared the highlight.
void View::updateHover() {
  if (underMouse() && tool_ != nullptr && !tool_->busy()) {
    hoverSoon();
  }
}

View::~View() {
  if (context() == nullptr) {
    return;  // it was never shown
  }
  disconnect(context(), nullptr, this, nullptr);  // aboutToBeDestroyed must not reach a destroyed view
  makeCurrent();
  painter_.destroy();
  freeGhostPainter();
  doneCurrent();
}

// Tools and overlays

void View::setTool(Tool* tool) {
  tool_ = tool;
  setCursor(tool->cursor());
}

QStringList View::notes() const {
  QStringList notes;
  for (const Overlay* overlay : overlays_) {
    if (const QString note = overlay->note(panel_); !note.isEmpty()) {
      notes << note;
    }
  }
  return notes;
}

bool View::isInMidPass() const {
  return std::ranges::any_of(overlays_, [this](const Overlay* overlay) { return overlay->isInMidPass(panel_); });
}

std::optional<OverlayLegend> View::overlayLegend() const {
  for (const Overlay* overlay : overlays_) {
    if (auto legend = overlay->legend(panel_)) {
      return legend;
    }
  }
  return std::nullopt;
}

void View::setDrawOptions(const DrawOptions& options) {
  drawOptions_ = options;
  update();
}

void View::setGhost(const Ghost& ghost) {
  if (ghost == ghost_) {
    return;
  }
  ghost_ = ghost;
  if (!ghost_.of) {
    makeCurrent();
    freeGhostPainter();
    doneCurrent();
  }
  emit ghostChanged();
  update();
}

void View::setLecture(bool on) {
  lecture_ = on;
  update();
}

// Camera

void View::setCamera(std::shared_ptr<Camera> camera) {
  camera_ = std::move(camera);
  fitPending_ = false;
  update();
}

void View::fitRest() {
  const Mesh& mesh = *document_.mesh();
  camera_->fit(boxIn(space(), mesh), std::span(mesh.axes).first(std::size_t(mesh.space_dimension)), size());
  fitPending_ = false;
  frame(outline(true));
}

std::vector<QVector3D> View::outline(bool atRest) const {
  const Mesh& mesh = *document_.mesh();
  const Frame* frame = document_.solvers().frame(panel_);
  if (atRest || frame == nullptr) {
    return restOutline(mesh);
  }
  std::vector<QVector3D> points;
  const QMatrix4x4 inSpace = meshToWorld(mesh);
  const auto add = [&](const float* coordinates) {
    QVector3D at;
    std::copy_n(coordinates, mesh.space_dimension, &at[0]);
    points.push_back(inSpace.map(at));
  };
  if (mesh.element_count() <= maxOutlinePoints) {
    for (ElementId element = 0; element < mesh.element_count(); ++element) {
      add(frame->positions.data() + std::size_t{element} * mesh.space_dimension);
    }
    return points;
  }
  const ClusterBoxes& all = search_.boxes(*frame);
  for (std::size_t cluster = 0; cluster < all.level().clusterCount(); ++cluster) {
    for (unsigned corner = 0; corner < 8; ++corner) {
      const ClusterBoxes::Box& box = all[cluster];
      const auto side = [&](unsigned k) { return (corner >> k & 1U) != 0 ? box.highest[k] : box.lowest[k]; };
      add(std::array{side(0), side(1), side(2)}.data());
    }
  }
  return points;
}

/// A single place has no size that the camera could fit, so it gets some room around it (mesh units).
void View::frame(std::span<const QVector3D> points) {
  const QVector3D half(0.5F, 0.5F, 0.5F);
  if (!points.empty() && std::ranges::all_of(points, [&](const QVector3D& point) { return point == points.front(); })) {
    camera_->frame(std::array{points.front() - half, points.front() + half}, size());
  } else {
    camera_->frame(points, size());
  }
  announceCamera();
}

void View::resizeEvent(QResizeEvent* event) {
  QOpenGLWidget::resizeEvent(event);
  if (fitPending_ && isVisible()) {
    fitRest();
  }
  emit resized();
}

void View::announceCamera() {
  emit cameraChanged();
  update();
}

void View::lookFrom(double yaw, double pitch) {
  camera_->lookFrom(yaw, pitch);
  announceCamera();
  emit sideChosen();
}

void View::lookFromAxis(int axis, bool positive) {
  camera_->lookFromAxis(axis, positive);
  announceCamera();
  emit sideChosen();
}

void View::centreOn(ElementId element) {
  camera_->centreOn(asVector(space().into(position(element))));
  announceCamera();
}

void View::setParallel(bool parallel) {
  camera_->setParallel(parallel);
  announceCamera();
}

void View::orbit(QPointF pixels) {
  camera_->orbit(pixels);
  announceCamera();
}

void View::pan(QPointF pixels) {
  camera_->pan(pixels, size());
  announceCamera();
}

void View::zoom(double factor) { zoom(factor, QRectF(rect()).center()); }

void View::zoom(double factor, QPointF about) {
  camera_->zoom(factor, about, size());
  announceCamera();
}

// Search, see view_search.h, and positions of elements in the view

/// Shows what is under the cursor. After a large move the boxes are computed first, a part at a time, so that the
/// window stays responsive.
void View::searchUnderCursor() {
  if (const Frame* frame = document_.solvers().frame(panel_);
      frame != nullptr && !search_.prepare(*frame, boxMilliseconds)) {
    hover_.start(0);
  } else if (tool_ != nullptr) {
    tool_->hover(*this, cursor_);
  }
}

Point View::position(ElementId element) const {
  const Frame* frame = document_.solvers().frame(panel_);
  return frame == nullptr ? document_.mesh()->rest_position(element) : point_of(*frame->mesh, frame->view(), element);
}

FrameSpace View::space() const { return FrameSpace(*document_.mesh()); }

double View::unitsPerPixel() const { return camera_->unitsPerPixel(size()) * space().unit(); }

Point View::pointAt(QPointF position, const Point& through) const {
  const FrameSpace space = this->space();
  const QVector3D at = camera_->pointAt(position, asVector(space.into(through)), size());
  return space.out_of({at.x(), at.y(), at.z()});
}

QPointF View::viewPosition(ElementId element) const {
  const Frame* frame = document_.solvers().frame(panel_);
  if (frame == nullptr) {
    return {};
  }
  const auto at = search_.projection()(frame->positions.data() + std::size_t{element} * frame->mesh->space_dimension);
  return {at.x, at.y};
}

QPointF View::viewPosition(const Point& point) const {
  const QVector3D at = (camera_->toClip(size()) * camera_->toView()).map(asVector(space().into(point)));
  return {(1 + double(at.x())) / 2 * width(), (1 - double(at.y())) / 2 * height()};
}

// Mouse: the left button belongs to the tool, the others move the camera

void View::mousePressEvent(QMouseEvent* event) {
  links_.point(panel_);
  cursor_ = event->position();
  if (const auto face = OrientationCube(*camera_, size()).faceAt(cursor_);
      face && event->button() == Qt::LeftButton && event->buttons() == Qt::LeftButton) {
    cubePressed_ = true;
    lookFromAxis(face->axis, face->positive);
    return;
  }
  if (event->button() == Qt::LeftButton && tool_ != nullptr) {
    hover_.stop();
    tool_->press(*this, cursor_, event->modifiers());
  }
}

void View::mouseMoveEvent(QMouseEvent* event) {
  links_.point(panel_);
  const QPointF travel = event->position() - cursor_;
  cursor_ = event->position();
  if (lecture_) {
    update();
  }
  if (event->buttons() == Qt::NoButton) {
    if (!hover_.isActive()) {
      hover_.start(hoverMilliseconds);
    }
  } else if ((event->buttons() & Qt::LeftButton) != 0) {
    if (tool_ != nullptr && !cubePressed_) {
      tool_->move(*this, cursor_, event->modifiers());
    }
  } else {
    moveCamera(travel, event->buttons());
  }
}

void View::moveCamera(QPointF travel, Qt::MouseButtons buttons) {
  if ((buttons & Qt::RightButton) != 0 && camera_->spatial()) {
    orbit(travel);
  } else {
    pan(travel);
  }
}

/// The second press of a double click moves the element under the cursor to the centre of the view. It does not grab an
/// element.
void View::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || (tool_ != nullptr && tool_->clicks())) {
    mousePressEvent(event);
    return;
  }
  cursor_ = event->position();
  if (const auto element = search_.elementAt(cursor_)) {
    centreOn(*element);
  }
}

void View::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && std::exchange(cubePressed_, false)) {
    return;
  }
  cursor_ = event->position();
  if (event->button() == Qt::LeftButton && tool_ != nullptr) {
    tool_->release(*this, event->position());
  }
}

void View::leaveEvent(QEvent* event) {
  QOpenGLWidget::leaveEvent(event);
  hover_.stop();
  if (lecture_) {
    update();
  }
  if (tool_ != nullptr) {
    tool_->leave(*this);
  }
  if (!document_.highlight().marks().grabbed && document_.highlight().marks().links.empty()) {
    document_.highlight().set({});
  }
}

void View::wheelEvent(QWheelEvent* event) {
  const double notches = event->angleDelta().y() / 120.0;
  if (tool_ == nullptr || !tool_->wheel(*this, event->position(), notches)) {
    zoom(std::pow(zoomPerNotch, notches), event->position());
  }
}

// Keyboard: a frame shows the focus, except after a click

void View::focusInEvent(QFocusEvent* event) {
  QOpenGLWidget::focusInEvent(event);
  focusFramed_ = event->reason() == Qt::TabFocusReason || event->reason() == Qt::BacktabFocusReason ||
                 event->reason() == Qt::ShortcutFocusReason;
  update();
}

void View::focusOutEvent(QFocusEvent* event) {
  QOpenGLWidget::focusOutEvent(event);
  focusFramed_ = false;
  update();
}

// Painting: objects, overlays, marks, annotations, focus, orientation cube

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
  }
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

bool View::showsAll() const {
  const QMatrix4x4 toClip = camera_->toClip(size()) * camera_->toView();
  return std::ranges::all_of(outline(false), [&](const QVector3D& point) {
    const QVector4D at = toClip.map(QVector4D(point, 1));
    return std::abs(at.x()) <= at.w() && std::abs(at.y()) <= at.w();
  });
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
