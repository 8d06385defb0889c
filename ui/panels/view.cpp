#include "panels/view.h"

#include <QOpenGLContext>
#include <algorithm>

#include "drawing/front_links.h"
#include "mesh/error.h"
#include "mesh/surface.h"

namespace chainmail {
namespace {

constexpr double reach = 14;  // pixels from the cursor in which an element is found
constexpr int hoverMilliseconds = 16;

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
      painter_(levels_),
      hover_(this) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);  // a click here takes the keyboard from the field last typed in
  setMinimumSize(160, 90);
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
  const auto lightUp = [this] {
    if (underMouse() && tool_ != nullptr && !tool_->busy()) {
      tool_->hover(*this, cursor_);
    }
  };
  connect(&document_.undoStack(), &QUndoStack::indexChanged, this, lightUp, Qt::QueuedConnection);
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

const CellBoxes& View::boxes(const Frame& frame) const {
  boxes_.follow(levels_->at(frame.mesh, 1), frame);
  return boxes_;
}

std::function<bool(ElementId)> View::shown() const {
  if (!look_.section) {
    return {};
  }
  return [mesh = document_.mesh(), plane = *look_.section](ElementId element) {
    return !(plane.before(mesh->rest_position(element)) > 0);
  };
}

std::optional<ElementId> View::elementAt(QPointF place) const {
  const Frame* frame = document_.frame(panel_);
  return frame == nullptr ? std::nullopt : nearestElement(*frame, boxes(*frame), projection(), place, reach, shown());
}

std::vector<LinkId> View::linksCrossing(QLineF stroke) const {
  const Frame* frame = document_.frame(panel_);
  if (frame == nullptr) {
    return {};
  }
  auto crossed = crossedLinks(*frame, boxes(*frame), document_.cuts(), projection(), stroke);
  if (const auto isShown = shown()) {
    std::erase_if(crossed, [&](LinkId link) {
      const auto& [a, b] = frame->mesh->links[link];
      return !isShown(a) && !isShown(b);
    });
  }
  return crossed;
}

std::vector<LinkId> View::frontLinksCrossing(QLineF stroke) const {
  const std::vector<LinkId> crossed = linksCrossing(stroke);
  const Frame* frame = document_.frame(panel_);
  if (crossed.empty() || !camera_->spatial()) {
    return crossed;
  }
  const Surface& surface = levels_->surface(frame->mesh, document_.cuts());
  if (frame->mesh->triangles.empty() && surface.table().empty()) {
    return nearestLinks(*frame, boxes(*frame), projection(), stroke, crossed);
  }
  auto faces =
      wholeFaces(*frame, boxes(*frame), document_.cuts(), projection(), QRectF(stroke.p1(), stroke.p2()).normalized());
  appendFaces(surface, faces);
  if (const auto isShown = shown()) {
    std::erase_if(faces, [&](const Face& face) { return std::ranges::none_of(face, isShown); });
  }
  return unhiddenLinks(*frame, projection(), stroke, crossed, faces);
}

std::vector<ElementId> View::elementsWhere(QRectF bounds, const std::function<bool(QPointF)>& inside) const {
  const Frame* frame = document_.frame(panel_);
  return frame == nullptr ? std::vector<ElementId>()
                          : chainmail::elementsWhere(*frame, boxes(*frame), projection(), bounds, inside, shown());
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

void View::resizeEvent(QResizeEvent* event) {
  QOpenGLWidget::resizeEvent(event);
  if (fitPending_ && isVisible()) {
    fit();
  }
  emit resized();
}

}  // namespace chainmail
