#include "tools/valid_regions.h"

#include <QMatrix4x4>
#include <QVector3D>
#include <array>
#include <cmath>

#include "common/actions.h"
#include "common/colours.h"
#include "drawing/camera.h"
#include "panels/view.h"

namespace chainmail {
namespace {

constexpr float barPixels = 9;  // on each side of the line
constexpr float dashPixels = 4;
constexpr int maxDashes = 400;  // per edge: more are indistinguishable

/// The shape of a valid region: a box in 3D, a rectangle in 2D, and in 1D a bar that is a few pixels thick, so that its
/// ends are visible next to the links. Positions are in mesh units; lines are pairs of ends, faces are triangles.
class RegionShape {
 public:
  /// `unitsPerPixel` is in mesh units per logical pixel, in the plane through the centre of the view. The shape is in
  /// the space of frames.
  RegionShape(const NeighbourRegion& region, const FrameSpace& space, const QMatrix4x4& toView, int spaceDimension,
              double unitsPerPixel);

  std::vector<QVector3D> faces() const;
  std::vector<QVector3D> edges() const;
  std::vector<QVector3D> dashedEdges() const;
  /// Returns the line from the neighbour to the nearest point of its region.
  std::vector<QVector3D> wayIn() const { return {at_, nearest_}; }
  /// Returns a cross at the neighbour, parallel to the view.
  std::vector<QVector3D> cross(double pixels) const;

 private:
  // Corner i is at the high end of axis k if bit k of i is set.
  std::array<QVector3D, 8> corners_;
  QVector3D at_, nearest_;
  QVector3D right_, up_;  // directions of the view, one pixel long
};

RegionShape::RegionShape(const NeighbourRegion& region, const FrameSpace& space, const QMatrix4x4& toView,
                         int spaceDimension, double unitsPerPixel)
    : at_(asVector(space.into(region.at))), nearest_(asVector(space.into(region.nearest))) {
  const auto pixel = float(unitsPerPixel / space.unit());
  right_ = toView.row(0).toVector3D().normalized() * pixel;
  up_ = toView.row(1).toVector3D().normalized() * pixel;
  for (int i = 0; i < 8; ++i) {
    corners_[std::size_t(i)] = asVector(space.into(region.corner(i)));
  }
  if (spaceDimension == 1) {
    // The bar is horizontal or vertical, across the axis of the mesh.
    const QVector3D low = asVector(space.into(region.low)), high = asVector(space.into(region.high));
    const QVector3D along = (high - low).normalized();
    const bool upright = std::abs(QVector3D::dotProduct(along, up_)) > std::abs(QVector3D::dotProduct(along, right_));
    const QVector3D across = (upright ? right_ : up_) * barPixels;
    corners_ = {low - across, high - across, low + across, high + across,
                low - across, high - across, low + across, high + across};
  }
}

std::vector<QVector3D> RegionShape::faces() const {
  std::vector<QVector3D> triangles;
  for (int k = 0; k < 3; ++k) {
    const int a = 1 << (k + 1) % 3, b = 1 << (k + 2) % 3;
    for (const int from : {0, 1 << k}) {
      for (const int corner : {from, from + a, from + b, from + a, from + b, from + a + b}) {
        triangles.push_back(corners_[std::size_t(corner)]);
      }
    }
  }
  return triangles;
}

std::vector<QVector3D> RegionShape::edges() const {
  std::vector<QVector3D> ends;
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 3; ++k) {
      const QVector3D &from = corners_[std::size_t(i)], &to = corners_[std::size_t(i | 1 << k)];
      if ((i >> k & 1) == 0 && from != to) {
        ends.insert(ends.end(), {from, to});
      }
    }
  }
  return ends;
}

std::vector<QVector3D> RegionShape::dashedEdges() const {
  const auto whole = edges();
  std::vector<QVector3D> ends;
  for (std::size_t i = 0; i < whole.size(); i += 2) {
    const QVector3D along = whole[i + 1] - whole[i];
    const double dashes = along.length() / (dashPixels * up_.length());
    const int count = int(std::min<double>(maxDashes, std::ceil(dashes))) | 1;  // odd, so that both ends are drawn
    for (int dash = 0; dash < count; dash += 2) {
      ends.push_back(whole[i] + along * (float(dash) / float(count)));
      ends.push_back(whole[i] + along * (float(dash + 1) / float(count)));
    }
  }
  return ends;
}

std::vector<QVector3D> RegionShape::cross(double pixels) const {
  const QVector3D right = right_ * float(pixels), up = up_ * float(pixels);
  return {at_ - right - up, at_ + right + up, at_ - right + up, at_ + right - up};
}

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

/// A disc beside an element in a plane, in which the valid regions of its neighbours are drawn larger. It exists only
/// where they are too small to be read in the view itself.
class RegionLens {
 public:
  RegionLens(const Overlay::Canvas& canvas, ElementId element, const std::vector<NeighbourRegion>& regions);

  bool isUseful() const { return useful_; }
  /// Draws the disc and, in it, the links to the neighbours.
  void draw() const;
  /// Returns a region as it appears in the disc.
  NeighbourRegion magnified(const NeighbourRegion& region) const;

 private:
  Point magnified(const Point& point) const;
  QVector3D drawn(const Point& point) const;
  std::vector<QVector3D> rim() const;

  const Overlay::Canvas& canvas_;
  const std::vector<NeighbourRegion>& regions_;
  Point element_, centre_ = Point::Zero();  // mesh units
  double scale_ = 1;
  bool useful_ = false;
};

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

// Largest numbers of elements and regions. More boxes would hide each other and take time.
constexpr std::size_t elementsShown = 8;
constexpr std::size_t regionsOfEach = 200;
constexpr double planeOpacity = 0.2, spaceOpacity = 0.12;  // of each face, of which two or more lie on each other
constexpr float insideWidth = 1.5F, outsideWidth = 2.5F;   // pixels
constexpr float crossSize = 7, ringSize = 12;              // pixels

}  // namespace

ValidRegions::ValidRegions(const Document& document) : document_(document) {
  const auto follow = [this] {
    if (shown_) {
      emit changed();
    }
  };
  connect(&document.highlight(), &Highlight::changed, this, follow);
  connect(&document.selection(), &Selection::changed, this, follow);
  connect(&document, &Document::softnessChanged, this, follow);
}

void ValidRegions::fill(Actions& actions) {
  actions.add("View", {{"showValidRegions", "&Valid regions", "region", "V",
                        "Shows where the neighbours of the element under the cursor may lie. Solid box with ring: the "
                        "neighbour is inside. Dashed box with cross: it is outside",
                        [this](bool on) {
                          shown_ = on;
                          emit changed();
                        },
                        IsOn([this] { return shown_; })}});
}

std::vector<ElementId> ValidRegions::elements() const {
  if (!shown_) {
    return {};
  }
  if (const auto& element = document_.highlight().marks().element) {
    return {*element};
  }
  const auto& selected = document_.selection().elements();
  return selected.size() <= elementsShown ? selected : std::vector<ElementId>();
}

QString ValidRegions::note(int /*panel*/) const {
  if (!shown_) {
    return {};
  }
  const auto all = elements();
  if (all.empty()) {
    return document_.selection().elements().size() > elementsShown
               ? QStringLiteral("valid regions: shown for up to %1 selected elements").arg(elementsShown)
               : QStringLiteral("valid regions: point at an element");
  }
  const bool tooMany = std::any_of(all.begin(), all.end(), [this](ElementId e) {
    return e < document_.mesh()->element_count() && document_.mesh()->neighbours_of(e).size() > regionsOfEach;
  });
  return tooMany ? QStringLiteral("valid regions: shown for the first %1 neighbours").arg(regionsOfEach) : QString();
}

void ValidRegions::draw(const Canvas& canvas) {
  for (const ElementId element : elements()) {
    if (element >= canvas.frame.mesh->element_count()) {
      continue;  // it belongs to the previous mesh
    }
    const auto regions = neighbour_regions(*canvas.frame.mesh, *document_.wholeSoftness(), document_.cuts(),
                                           canvas.frame.view(), element, regionsOfEach);
    for (const auto& region : regions) {
      draw(canvas, region);
    }
    const RegionLens lens(canvas, element, regions);
    if (document_.highlight().marks().element && lens.isUseful()) {
      lens.draw();
      for (const auto& region : regions) {
        draw(canvas, lens.magnified(region));
      }
    }
  }
}

/// Draws a region. Not only the colour shows whether the neighbour is inside, but also the line style and a mark. A
/// line joins a neighbour that is outside to the nearest point inside.
void ValidRegions::draw(const Canvas& canvas, const NeighbourRegion& region) const {
  const QColor colour = region.inside ? colours::inside : colours::outside;
  const RegionShape shape(region, canvas.frame.space, canvas.scene.toView, canvas.frame.mesh->space_dimension,
                          canvas.unitsPerPixel);
  QColor faint = colour;
  faint.setAlphaF(float(canvas.frame.mesh->space_dimension < 3 ? planeOpacity : spaceOpacity));
  canvas.painter.drawInSpace(canvas.scene, shape.faces(), ObjectDrawing::Shape::triangles, faint);
  canvas.painter.drawInSpace(canvas.scene, region.inside ? shape.edges() : shape.dashedEdges(),
                             ObjectDrawing::Shape::segments, colour, region.inside ? insideWidth : outsideWidth);
  if (!region.inside) {
    canvas.painter.drawInSpace(canvas.scene, shape.wayIn(), ObjectDrawing::Shape::segments, colour, outsideWidth);
    canvas.painter.drawInSpace(canvas.scene, shape.cross(crossSize), ObjectDrawing::Shape::segments, colour,
                               outsideWidth);
  } else {
    canvas.painter.drawElements(canvas.scene, std::span(&region.neighbour, 1), colour, ringSize,
                                ObjectDrawing::Mark::ring);
  }
}

}  // namespace chainmail
