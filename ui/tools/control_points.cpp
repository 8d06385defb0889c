#include "tools/control_points.h"

#include <algorithm>
#include <array>
#include <limits>

#include "common/colours.h"
#include "drawing/colour_map.h"
#include "panels/view.h"

namespace chainmail {
namespace {

constexpr double reach = 10;                // pixels
constexpr float size = 7, markedSize = 12;  // pixels: a square's side
constexpr float rim = 1.5F;                 // of the ground about it
constexpr float lineWidth = 1.2F;

Point positionOf(const Frame& frame, std::uint32_t point) {
  const auto dimension = std::size_t(frame.mesh->space_dimension);
  std::array<double, 3> carried{};
  for (std::size_t k = 0; k < dimension; ++k) {
    carried[k] = double(frame.control_points[dimension * point + k]);
  }
  return frame.mesh->to_point(carried.data());
}

std::uint32_t countOf(const Frame& frame) {
  return std::uint32_t(frame.control_points.size() / std::size_t(frame.mesh->space_dimension));
}

std::vector<QVector3D> placesOf(const Frame& frame) {
  std::vector<QVector3D> places;
  for (std::uint32_t point = 0; point < countOf(frame); ++point) {
    const Point at = positionOf(frame, point);
    places.emplace_back(float(at.x()), float(at.y()), float(at.z()));
  }
  return places;
}

/// Two triangles about a place that look at the eye.
void addSquare(const Overlay::Canvas& canvas, const QVector3D& at, float side, std::vector<QVector3D>& corners) {
  const float half = side / 2 * float(canvas.unitsPerPixel);
  const QVector3D right = canvas.scene.toView.row(0).toVector3D().normalized() * half;
  const QVector3D up = canvas.scene.toView.row(1).toVector3D().normalized() * half;
  for (const auto& corner : {-right - up, right - up, right + up, -right - up, right + up, up - right}) {
    corners.push_back(at + corner);
  }
}

void drawSquares(const Overlay::Canvas& canvas, const std::vector<QVector3D>& places, float side, QColor colour) {
  for (const bool ground : {true, false}) {
    std::vector<QVector3D> corners;
    for (const QVector3D& at : places) {
      addSquare(canvas, at, side + (ground ? 2 * rim : 0), corners);
    }
    canvas.painter.drawInSpace(canvas.scene, corners, ObjectDrawing::Shape::triangles,
                               ground ? canvas.scene.background : colour);
  }
}

}  // namespace

const Frame* ControlPoints::frame(int panel) const {
  const Frame* frame = document_.frame(panel);
  const bool has = frame != nullptr && info(document_.algorithm(panel)).has_control_points;
  return has && !frame->control_points.empty() ? frame : nullptr;
}

std::optional<ControlPoints::Handle> ControlPoints::at(const View& view, QPointF place) const {
  std::optional<Handle> nearest;
  if (const Frame* shown = frame(view.panel())) {
    double least = reach;
    for (std::uint32_t point = 0; point < countOf(*shown); ++point) {
      const double apart = QLineF(place, view.placeOf(positionOf(*shown, point))).length();
      if (apart <= least) {
        least = apart;
        nearest = Handle{view.panel(), point};
      }
    }
  }
  return nearest;
}

Point ControlPoints::position(const Handle& handle) const {
  const Frame* shown = frame(handle.panel);
  return shown != nullptr && handle.point < countOf(*shown) ? positionOf(*shown, handle.point) : Point(Point::Zero());
}

void ControlPoints::mark(const std::optional<Handle>& handle, bool held) {
  if (handle != marked_ || held != held_) {
    marked_ = handle;
    held_ = held;
    emit changed();
  }
}

void ControlPoints::draw(const Canvas& canvas) {
  const Frame* shown = frame(canvas.panel);
  if (shown == nullptr || canvas.frame.control_points.empty()) {
    return;
  }
  const std::vector<QVector3D> places = placesOf(canvas.frame);
  drawLattice(canvas, places);
  drawSquares(canvas, places, size, colours::marked);
  if (marked_ && marked_->point < places.size()) {
    drawSquares(canvas, {places[marked_->point]}, markedSize, held_ ? colours::lit : colours::marked);
  }
}

/// Lines between neighbours along each axis, the first of which runs fastest. A frame may be of another lattice than
/// was set since: then its points stand alone.
void ControlPoints::drawLattice(const Canvas& canvas, const std::vector<QVector3D>& places) const {
  const Mesh& mesh = *canvas.frame.mesh;
  std::vector<std::size_t> counts;
  std::size_t all = 1;
  for (int k = 0; k < mesh.space_dimension; ++k) {
    counts.push_back(document_.elastic().lattice[std::size_t(mesh.axes[std::size_t(k)])]);
    all *= counts.back();
  }
  if (all != places.size()) {
    return;
  }
  std::vector<QVector3D> ends;
  std::size_t stride = 1;
  for (std::size_t k = 0; k < counts.size(); stride *= counts[k], ++k) {
    for (std::size_t i = 0; i < all; ++i) {
      if (i / stride % counts[k] + 1 < counts[k]) {
        ends.insert(ends.end(), {places[i], places[i + stride]});
      }
    }
  }
  canvas.painter.drawInSpace(canvas.scene, ends, ObjectDrawing::Shape::segments, QColor(colour_map::neutral),
                             lineWidth);
}

}  // namespace chainmail
