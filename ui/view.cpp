#include "view.h"

#include <QGuiApplication>
#include <QOpenGLContext>
#include <algorithm>

#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr double reach = 14;  // pixels from the cursor in which an element is found
constexpr int hoverMilliseconds = 16;
constexpr float pinSize = 13;       // pixels
constexpr double largestRing = 12;  // pixels
constexpr double smallestMark = 2;

}  // namespace

View::View(Document& document, Colouring& colouring, PanelLinks& links, int panel, std::shared_ptr<Camera> camera,
           std::shared_ptr<MeshLevels> levels)
    : document_(document),
      colouring_(colouring),
      links_(links),
      panel_(panel),
      camera_(std::move(camera)),
      colour_(colours::ofPanel(panel)),
      levels_(std::move(levels)),
      painter_(levels_) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);  // a click here takes the keyboard from the field last typed in
  setMinimumSize(160, 120);
  hover_.setSingleShot(true);
  hover_.setInterval(hoverMilliseconds);
  connect(&hover_, &QTimer::timeout, this, [this] {
    if (tool_ != nullptr) {
      tool_->hover(*this, cursor_);
    }
  });
  listen();
}

void View::listen() {
  connect(&document_, &Document::frameReady, this, [this](int ready) {
    if (ready == panel_ || ready == ghost_.of) {
      update();
    }
  });
  connect(&document_, &Document::highlightChanged, this, qOverload<>(&View::update));
  connect(&document_, &Document::pinsChanged, this, qOverload<>(&View::update));
  connect(&document_, &Document::selectionChanged, this, [this] {
    selectionOutdated_ = true;
    selectedHere_ = links_.pointed() == panel_;
    update();
  });
  // What an edit has put out is lit up again, without a move of the mouse.
  connect(&document_.undoStack(), &QUndoStack::indexChanged, &hover_, [this] {
    if (underMouse() && QGuiApplication::mouseButtons() == Qt::NoButton) {
      hover_.start();
    }
  });
  connect(&links_, &PanelLinks::marksLinked, this, qOverload<>(&View::update));
  connect(&colouring_, &Colouring::changed, this, qOverload<>(&View::update));
  connect(&document_, &Document::cutsChanged, this, [this] {
    painter_.cutsChanged();
    if (ghostPainter_ != nullptr) {
      ghostPainter_->cutsChanged();
    }
    update();
  });
  connect(this, &QOpenGLWidget::frameSwapped, this, [this] { meter_.swapped(); });
}

View::~View() {
  if (context() != nullptr) {
    disconnect(context(), nullptr, this, nullptr);  // its end must find nothing of this view
  }
  makeCurrent();
  painter_.destroy();
  forgetGhost();
  doneCurrent();
}

void View::setTool(Tool* tool) {
  tool_ = tool;
  setCursor(tool->cursor());
}

void View::setCamera(std::shared_ptr<Camera> camera) {
  camera_ = std::move(camera);
  fitPending_ = false;
  update();
}

void View::fit() {
  const Mesh& mesh = *document_.mesh();
  camera_->fit(bounds(mesh), std::span(mesh.axes).first(std::size_t(mesh.space_dimension)), size());
  fitPending_ = false;
  announceCamera();
}

void View::fitAgain() {
  if (camera_->framed()) {
    camera_->frame(bounds(*document_.mesh()), size());
    announceCamera();
  }
}

void View::announceCamera() {
  emit cameraChanged();
  update();
}

void View::lookFrom(double yaw, double pitch) {
  camera_->lookFrom(yaw, pitch);
  announceCamera();
}

void View::setParallel(bool parallel) {
  camera_->setParallel(parallel);
  announceCamera();
}

const CellBoxes& View::boxes(const Frame& frame) const {
  boxes_.follow(levels_->at(frame.mesh, 1), frame);
  return boxes_;
}

std::optional<ElementId> View::elementAt(QPointF place) const {
  const Frame* frame = document_.frame(panel_);
  return frame == nullptr ? std::nullopt : nearestElement(*frame, boxes(*frame), projection(), place, reach);
}

std::vector<LinkId> View::linksCrossing(QLineF stroke) const {
  const Frame* frame = document_.frame(panel_);
  return frame == nullptr ? std::vector<LinkId>()
                          : crossedLinks(*frame, boxes(*frame), document_.cuts(), projection(), stroke);
}

std::vector<ElementId> View::elementsWhere(QRectF bounds, const std::function<bool(QPointF)>& inside) const {
  const Frame* frame = document_.frame(panel_);
  return frame == nullptr ? std::vector<ElementId>()
                          : chainmail::elementsWhere(*frame, boxes(*frame), projection(), bounds, inside);
}

Point View::position(ElementId element) const {
  const Frame* frame = document_.frame(panel_);
  return frame == nullptr ? document_.mesh()->rest_position(element) : point_of(*frame->mesh, frame->view(), element);
}

QVector3D View::pointAt(QPointF place, const Point& through) const {
  return camera_->pointAt(place, asVector(through), size());
}

QPointF View::placeOf(ElementId element) const {
  const Frame* frame = document_.frame(panel_);
  if (frame == nullptr) {
    return {};
  }
  const auto at = projection()(frame->positions.data() + std::size_t{element} * frame->mesh->space_dimension);
  return {at.x, at.y};
}

QPointF View::placeOf(const Point& point) const {
  const QVector3D at = (camera_->toClip(size()) * camera_->toView())
                           .map(QVector3D(float(point.x()), float(point.y()), float(point.z())));
  return {(1 + double(at.x())) / 2 * width(), (1 - double(at.y())) / 2 * height()};
}

Projection View::projection() const { return {*document_.mesh(), camera_->toView(), camera_->toClip(size()), size()}; }

ObjectDrawing::Scene View::scene(double pixelRatio) const {
  ObjectDrawing::Scene scene;
  scene.toView = camera_->toView();
  scene.toClip = camera_->toClip(size());
  scene.size = QSizeF(size()) * pixelRatio;
  scene.background = colours::background;
  scene.pixelRatio = float(pixelRatio);
  if (camera_->spatial()) {
    const auto [near, far] = camera_->depthRange();
    scene.fog = QVector2D(float(near), float(far));
  }
  return scene;
}

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
  const unsigned stepBefore = painter_.step();
  meter_.painted();
  paint(devicePixelRatioF(), colours::background);
  if (document_.frame(panel_) != nullptr) {
    drawFocus();
  }
  if (painter_.step() != stepBefore) {
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

/// How the object is painted: as an overlay wants it, or by its values, or in the panel's colour.
ObjectDrawing::Paint View::paint() {
  for (const Overlay* overlay : overlays_) {
    if (const auto paint = overlay->paint(panel_)) {
      return *paint;
    }
  }
  const ColourValues* values = colouring_.follow(panel_);
  return {colour_, values, colouring_.scale(panel_)};
}

std::optional<OverlayLegend> View::overlayLegend() const {
  for (const Overlay* overlay : overlays_) {
    if (auto legend = overlay->legend(panel_)) {
      return legend;
    }
  }
  return std::nullopt;
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

void View::resizeEvent(QResizeEvent* event) {
  QOpenGLWidget::resizeEvent(event);
  if (fitPending_ && isVisible()) {
    fit();
  }
  emit resized();
}

}  // namespace chainmail
