#include "tools/control_points.h"

#include <algorithm>
#include <limits>

#include "common/colours.h"
#include "drawing/colour_map.h"
#include "panels/view.h"

namespace chainmail {
namespace {

constexpr double pointReach = 10;                     // pixels
constexpr float pointSize = 7, markedPointSize = 12;  // pixels, side of a square
constexpr float rim = 1.5F;                           // pixels of background around a square
constexpr float latticeWidth = 1.2F;

Point controlPointOf(const Frame& frame, std::uint32_t point) {
  return point_of(*frame.mesh, frame.space.view(frame.control_points), point);
}

std::uint32_t countOf(const Frame& frame) {
  return std::uint32_t(frame.control_points.size() / std::size_t(frame.mesh->space_dimension));
}

std::vector<QVector3D> controlPointsOf(const Frame& frame) {
  std::vector<QVector3D> positions;
  for (std::uint32_t point = 0; point < countOf(frame); ++point) {
    positions.push_back(asVector(frame.space.into(controlPointOf(frame, point))));
  }
  return positions;
}

/// Adds a square around a point: two triangles parallel to the screen. `side` is in logical pixels.
void addSquare(const Overlay::Canvas& canvas, const QVector3D& at, float side, std::vector<QVector3D>& corners) {
  const float half = side / 2 * float(canvas.unitsPerPixel / canvas.frame.space.unit());
  const QVector3D right = canvas.scene.toView.row(0).toVector3D().normalized() * half;
  const QVector3D up = canvas.scene.toView.row(1).toVector3D().normalized() * half;
  for (const auto& corner : {-right - up, right - up, right + up, -right - up, right + up, up - right}) {
    corners.push_back(at + corner);
  }
}

void drawSquares(const Overlay::Canvas& canvas, const std::vector<QVector3D>& positions, float side, QColor colour) {
  for (const bool ground : {true, false}) {
    std::vector<QVector3D> corners;
    for (const QVector3D& at : positions) {
      addSquare(canvas, at, side + (ground ? 2 * rim : 0), corners);
    }
    canvas.painter.drawInSpace(canvas.scene, corners, ObjectDrawing::Shape::triangles,
                               ground ? canvas.scene.background : colour);
  }
}

}  // namespace

const Frame* ControlPoints::frame(int panel) const {
  const Frame* frame = document_.solvers().frame(panel);
  const bool has = frame != nullptr && info(document_.algorithm(panel)).has_control_points;
  return has && !frame->control_points.empty() ? frame : nullptr;
}

std::optional<ControlPoints::PointId> ControlPoints::at(const View& view, QPointF place) const {
  std::optional<PointId> nearest;
  if (const Frame* shown = frame(view.panel())) {
    double least = pointReach;
    for (std::uint32_t point = 0; point < countOf(*shown); ++point) {
      const double apart = QLineF(place, view.viewPosition(controlPointOf(*shown, point))).length();
      if (apart <= least) {
        least = apart;
        nearest = PointId{view.panel(), point};
      }
    }
  }
  return nearest;
}

Point ControlPoints::position(const PointId& id) const {
  const Frame* shown = frame(id.panel);
  return shown != nullptr && id.point < countOf(*shown) ? controlPointOf(*shown, id.point) : Point(Point::Zero());
}

void ControlPoints::mark(const std::optional<PointId>& id, bool held) {
  if (id != marked_ || held != held_) {
    marked_ = id;
    held_ = held;
    emit changed();
  }
}

void ControlPoints::draw(const Canvas& canvas) {
  const Frame* shown = frame(canvas.panel);
  if (shown == nullptr || canvas.frame.control_points.empty()) {
    return;
  }
  const std::vector<QVector3D> positions = controlPointsOf(canvas.frame);
  drawLattice(canvas, positions);
  drawSquares(canvas, positions, pointSize, colours::marked);
  if (marked_ && marked_->point < positions.size()) {
    drawSquares(canvas, {positions[marked_->point]}, markedPointSize, held_ ? colours::lit : colours::marked);
  }
}

/// Draws lines between neighbours along each axis. The index along the first axis changes fastest. Draws no lines if
/// the frame is older than the current lattice.
void ControlPoints::drawLattice(const Canvas& canvas, const std::vector<QVector3D>& positions) const {
  const Mesh& mesh = *canvas.frame.mesh;
  std::vector<std::size_t> counts;
  std::size_t all = 1;
  for (int k = 0; k < mesh.space_dimension; ++k) {
    counts.push_back(document_.elastic().lattice[std::size_t(mesh.axes[std::size_t(k)])]);
    all *= counts.back();
  }
  if (all != positions.size()) {
    return;
  }
  std::vector<QVector3D> ends;
  std::size_t stride = 1;
  for (std::size_t k = 0; k < counts.size(); stride *= counts[k], ++k) {
    for (std::size_t i = 0; i < all; ++i) {
      if (i / stride % counts[k] + 1 < counts[k]) {
        ends.insert(ends.end(), {positions[i], positions[i + stride]});
      }
    }
  }
  canvas.painter.drawInSpace(canvas.scene, ends, ObjectDrawing::Shape::segments, QColor(colour_map::neutral),
                             latticeWidth);
}

}  // namespace chainmail
