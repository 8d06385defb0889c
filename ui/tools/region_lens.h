#pragma once

#include <vector>

#include "measure/neighbour_regions.h"
#include "panels/overlay.h"

namespace chainmail {

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

}  // namespace chainmail
