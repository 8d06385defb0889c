#include "view.h"

#include <QMouseEvent>
#include <QOpenGLContext>
#include <QWheelEvent>
#include <cmath>

#include "colours.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr double reach = 14;  // pixels from the cursor in which an element is found
constexpr int hoverMilliseconds = 16;
constexpr double zoomPerNotch = 1.2;

}  // namespace

View::View(Document& document, int panel, std::shared_ptr<Camera> camera, QColor colour)
    : document_(document), panel_(panel), camera_(std::move(camera)), colour_(colour) {
  setMouseTracking(true);
  setFocusPolicy(Qt::ClickFocus);  // a click here takes the keyboard from the field last typed in
  setMinimumSize(160, 120);
  hover_.setSingleShot(true);
  hover_.setInterval(hoverMilliseconds);
  connect(&hover_, &QTimer::timeout, this, [this] {
    if (tool_ != nullptr) {
      tool_->hover(*this, cursor_);
    }
  });
  connect(&document, &Document::frameReady, this, [this](int ready) {
    if (ready == panel_) {
      update();
    }
  });
  connect(&document, &Document::highlightChanged, this, qOverload<>(&View::update));
  connect(&document, &Document::meshChanged, this, &View::fit);
  connect(&document, &Document::cutsChanged, this, [this] {
    if (painterReady_ && document_.frame(panel_) != nullptr) {
      makeCurrent();
      painter_.setFrame(*document_.frame(panel_), document_.cuts());
      painter_.setCuts(document_.cuts());
      doneCurrent();
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
  doneCurrent();
}

void View::setTool(Tool* tool) {
  tool_ = tool;
  setCursor(tool->cursor());
}

void View::setCamera(std::shared_ptr<Camera> camera) {
  camera_ = std::move(camera);
  update();
}

void View::fit() {
  const Mesh& mesh = *document_.mesh();
  camera_->fit(bounds(mesh), std::span(mesh.axes).first(std::size_t(mesh.space_dimension)), size());
  fitPending_ = false;
  emit cameraChanged();
  update();
}

std::optional<ElementId> View::elementAt(QPointF place) const {
  const Frame* frame = document_.frame(panel_);
  return frame == nullptr ? std::nullopt : nearestElement(*frame, projection(), place, reach);
}

std::vector<LinkId> View::linksCrossing(QLineF stroke) const {
  const Frame* frame = document_.frame(panel_);
  return frame == nullptr ? std::vector<LinkId>() : crossedLinks(*frame, document_.cuts(), projection(), stroke);
}

Point View::position(ElementId element) const {
  const Frame* frame = document_.frame(panel_);
  return frame == nullptr ? document_.mesh()->rest_position(element) : point_of(*frame->mesh, frame->view(), element);
}

QVector3D View::pointAt(QPointF place, const Point& through) const {
  return camera_->pointAt(place, QVector3D(float(through.x()), float(through.y()), float(through.z())), size());
}

QPointF View::placeOf(ElementId element) const {
  const Frame* frame = document_.frame(panel_);
  if (frame == nullptr) {
    return {};
  }
  const auto at = projection()(frame->positions.data() + std::size_t{element} * frame->mesh->space_dimension);
  return {at.x, at.y};
}

Projection View::projection() const { return {*document_.mesh(), camera_->toView(), camera_->toClip(size()), size()}; }

ObjectPainter::Scene View::scene() const {
  ObjectPainter::Scene scene;
  scene.toView = camera_->toView();
  scene.toClip = camera_->toClip(size());
  scene.size = QSizeF(size()) * devicePixelRatioF();
  scene.background = colours::background;
  scene.pixelRatio = float(devicePixelRatioF());
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
    painterReady_ = false;
    doneCurrent();
  });
  try {
    painter_.initialize();
    painterReady_ = true;
  } catch (const Error& error) {
    emit failed(QString::fromStdString(error.what()));
  }
}

void View::paintGL() {
  auto* gl = context()->functions();
  gl->glClearColor(colours::background.redF(), colours::background.greenF(), colours::background.blueF(), 1);
  gl->glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl->glDisable(GL_DEPTH_TEST);
  const Frame* frame = document_.frame(panel_);
  meter_.painted();
  if (!painterReady_ || frame == nullptr) {
    return;
  }
  painter_.setFrame(*frame, document_.cuts());
  const unsigned stepBefore = painter_.step();
  const auto in = scene();
  painter_.drawObject(in, colour_, 1 / camera_->unitsPerPixel(size()));
  drawHighlight(in);
  if (painter_.step() != stepBefore) {
    emit drawnStepChanged();
  }
}

void View::drawHighlight(const ObjectPainter::Scene& in) {
  const Highlight& highlight = document_.highlight();
  painter_.drawLinks(in, highlight.links, colours::lit);
  if (highlight.element) {
    const ElementId element = *highlight.element;
    painter_.drawElements(in, std::span(&element, 1), colours::background, 17);
    painter_.drawElements(in, std::span(&element, 1), highlight.grabbed ? colours::lit : colours::marked, 13);
  }
  if (tool_ != nullptr) {
    painter_.drawStroke(in, tool_->stroke(*this), colours::marked);
  }
}

void View::resizeEvent(QResizeEvent* event) {
  QOpenGLWidget::resizeEvent(event);
  if (fitPending_ && isVisible()) {
    fit();
  }
}

void View::mousePressEvent(QMouseEvent* event) {
  cursor_ = event->position();
  if (event->button() == Qt::LeftButton && tool_ != nullptr) {
    hover_.stop();
    tool_->press(*this, cursor_);
  }
}

void View::mouseMoveEvent(QMouseEvent* event) {
  const QPointF travel = event->position() - cursor_;
  cursor_ = event->position();
  if (event->buttons() == Qt::NoButton) {
    if (!hover_.isActive()) {
      hover_.start();
    }
  } else if ((event->buttons() & Qt::LeftButton) != 0) {
    if (tool_ != nullptr) {
      tool_->move(*this, cursor_);
    }
  } else {
    moveCamera(travel, event->buttons());
  }
}

void View::moveCamera(QPointF travel, Qt::MouseButtons buttons) {
  if ((buttons & Qt::RightButton) != 0 && camera_->spatial()) {
    camera_->orbit(travel);
  } else {
    camera_->pan(travel, size());
  }
  emit cameraChanged();
  update();
}

void View::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && tool_ != nullptr) {
    tool_->release(*this, event->position());
  }
}

void View::leaveEvent(QEvent* event) {
  QOpenGLWidget::leaveEvent(event);
  hover_.stop();
  if (!document_.highlight().grabbed && document_.highlight().links.empty()) {
    document_.setHighlight({});
  }
}

void View::wheelEvent(QWheelEvent* event) {
  camera_->zoom(std::pow(zoomPerNotch, event->angleDelta().y() / 120.0), event->position(), size());
  emit cameraChanged();
  update();
}

}  // namespace chainmail
