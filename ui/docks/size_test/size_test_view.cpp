#include "docks/size_test/size_test_view.h"

#include <QOpenGLContext>
#include <QOpenGLFunctions>

#include "common/application.h"
#include "mesh/failure.h"

namespace chainmail {
namespace {

constexpr double roomForHandle = 0.3;  // on each side, in widths of the object
constexpr float handleSize = 13;       // pixels

}  // namespace

SizeTestView::SizeTestView(std::shared_ptr<MeshLevels> levels, colours::Colour colour)
    : colour_(colour), painter_(std::move(levels)) {
  setMinimumSize(160, 120);
  connect(this, &QOpenGLWidget::frameSwapped, this, [this] { meter_.swapped(); });
}

SizeTestView::~SizeTestView() {
  if (context() != nullptr) {
    disconnect(context(), nullptr, this, nullptr);  // so that the context does not call a deleted view
  }
  if (ready_) {  // false if the view was never shown
    makeCurrent();
    painter_.destroy();
    doneCurrent();
  }
}

void SizeTestView::show(const Frame& frame, std::optional<ElementId> handle) {
  frame_ = &frame;
  handle_ = handle;
  if (frame.mesh != fitted_) {
    uncut_ = Cuts(frame.mesh);
    fit();
  }
  update();
}

void SizeTestView::fit() {
  fitted_ = frame_->mesh;
  auto box = bounds(*fitted_);
  const Point room = roomForHandle * (box[1] - box[0]);
  box[0] -= room;
  box[1] += room;
  camera_.fit(box, std::span(fitted_->axes).first(std::size_t(fitted_->space_dimension)), size());
}

void SizeTestView::resizeEvent(QResizeEvent* event) {
  QOpenGLWidget::resizeEvent(event);
  if (frame_ != nullptr) {
    fit();
  }
}

void SizeTestView::initializeGL() {
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] {
    makeCurrent();
    painter_.destroy();
    ready_ = false;
    doneCurrent();
  });
  try {
    painter_.initialize();
    ready_ = true;
  } catch (...) {
    emit failed(QString::fromStdString(failure_sentence("view")));
  }
}

ObjectPainter::Scene SizeTestView::scene() const {
  ObjectPainter::Scene scene;
  scene.toView = camera_.toView();
  scene.toClip = camera_.toClip(size());
  scene.size = QSizeF(size()) * devicePixelRatioF();
  scene.background = colours::background;
  scene.pixelRatio = float(devicePixelRatioF());
  return scene;
}

/// An exception must not leave this function: QOpenGLWidget would believe that it is still painting.
void SizeTestView::paintGL() {
  Application::guarded([this] {
    try {
      paint();
    } catch (...) {
      painter_.startOver();
      throw;
    }
  });
}

void SizeTestView::paint() {
  auto* gl = context()->functions();
  const QColor ground = colours::background;
  gl->glClearColor(ground.redF(), ground.greenF(), ground.blueF(), 1);
  gl->glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl->glDisable(GL_DEPTH_TEST);
  meter_.painted();
  if (!ready_ || frame_ == nullptr) {
    return;
  }
  painter_.setFrame(*frame_, uncut_);
  const auto in = scene();
  painter_.drawObject(in, {colour_, nullptr, {}}, 1 / camera_.unitsPerPixel(size()));
  if (handle_) {
    painter_.drawElements(in, std::span(&*handle_, 1), colours::background, handleSize + 4);
    painter_.drawElements(in, std::span(&*handle_, 1), colours::lit, handleSize);
  }
}

}  // namespace chainmail
