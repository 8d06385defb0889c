// The camera of a view, and positions of elements in it.

#include <QVector4D>
#include <array>
#include <cmath>

#include "mesh/surface.h"
#include "panels/view.h"

namespace chainmail {
namespace {

constexpr std::size_t maxOutlinePoints = 200'000;  // of larger objects, some elements or boxes are the outline

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

}  // namespace

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

bool View::showsAll() const {
  const QMatrix4x4 toClip = camera_->toClip(size()) * camera_->toView();
  return std::ranges::all_of(outline(false), [&](const QVector3D& point) {
    const QVector4D at = toClip.map(QVector4D(point, 1));
    return std::abs(at.x()) <= at.w() && std::abs(at.y()) <= at.w();
  });
}

// Positions in the view

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

}  // namespace chainmail
