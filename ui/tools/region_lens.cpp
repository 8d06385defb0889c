#include "tools/region_lens.h"

#include <cmath>

#include "common/colours.h"
#include "panels/view.h"

namespace chainmail {
namespace {

constexpr double radius = 75, distance = 24;  // pixels; the distance is that from the cursor to the rim
constexpr double inner = 0.85;                // share of the radius that the regions fill
constexpr double readable = 40;               // pixels from the element to the far end of its regions
constexpr int corners = 64;                   // of the polygon that approximates the disc
constexpr float rimWidth = 2, linkWidth = 1.5F;

/// Returns the greatest distance from the element to a point that the lens shows.
double reachOf(const Point& element, const std::vector<NeighbourRegion>& regions) {
  double reach = 0;
  for (const NeighbourRegion& region : regions) {
    for (const Point& point : {region.corner(0), region.corner(7), region.at}) {
      reach = std::max(reach, (point - element).norm());
    }
  }
  return reach;
}

/// Returns the centre of the lens, in pixels: above and beside the element, on the side with more room.
QPointF centreBeside(QPointF element, QSize view) {
  const double away = (radius + distance) / std::sqrt(2.0) + distance;
  return {element.x() + (element.x() < view.width() / 2.0 ? away : -away),
          element.y() + (element.y() < view.height() / 2.0 ? away : -away)};
}

}  // namespace

RegionLens::RegionLens(const Overlay::Canvas& canvas, ElementId element, const std::vector<NeighbourRegion>& regions)
    : canvas_(canvas), regions_(regions), element_(point_of(*canvas.frame.mesh, canvas.frame.view(), element)) {
  const double reach = reachOf(element_, regions);
  useful_ = canvas.frame.mesh->space_dimension == 2 && reach > 0 && reach < readable * canvas.unitsPerPixel;
  if (useful_) {
    scale_ = inner * radius * canvas.unitsPerPixel / reach;
    centre_ = canvas.view.pointAt(centreBeside(canvas.view.viewPosition(element_), canvas.view.size()), element_);
  }
}

Point RegionLens::magnified(const Point& point) const { return centre_ + scale_ * (point - element_); }

NeighbourRegion RegionLens::magnified(const NeighbourRegion& region) const {
  NeighbourRegion larger = region;
  for (Point* point : {&larger.at, &larger.nearest}) {
    *point = magnified(*point);
  }
  for (Point* point : {&larger.low, &larger.high}) {
    *point = region.axes.into_axes(magnified(region.axes.into_world(*point)));
  }
  return larger;
}

QVector3D RegionLens::drawn(const Point& point) const { return asVector(canvas_.frame.space.into(point)); }

std::vector<QVector3D> RegionLens::rim() const {
  const auto& toView = canvas_.scene.toView;
  const auto length = float(radius * canvas_.unitsPerPixel / canvas_.frame.space.unit());
  const QVector3D right = toView.row(0).toVector3D().normalized() * length;
  const QVector3D up = toView.row(1).toVector3D().normalized() * length;
  std::vector<QVector3D> points;
  for (int i = 0; i <= corners; ++i) {
    const auto angle = float(2 * M_PI * i / corners);
    points.push_back(drawn(centre_) + std::cos(angle) * right + std::sin(angle) * up);
  }
  return points;
}

void RegionLens::draw() const {
  const auto points = rim();
  std::vector<QVector3D> disc, circle, links;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    disc.insert(disc.end(), {drawn(centre_), points[i], points[i + 1]});
    circle.insert(circle.end(), {points[i], points[i + 1]});
  }
  for (const NeighbourRegion& region : regions_) {
    links.insert(links.end(), {drawn(centre_), drawn(magnified(region.at))});
  }
  ObjectDrawing& painter = canvas_.painter;
  painter.drawInSpace(canvas_.scene, disc, ObjectDrawing::Shape::triangles, colours::background);
  painter.drawInSpace(canvas_.scene, circle, ObjectDrawing::Shape::segments, colours::marked, rimWidth);
  painter.drawInSpace(canvas_.scene, links, ObjectDrawing::Shape::segments, colours::marked, linkWidth);
}

}  // namespace chainmail
