#pragma once

#include <QMatrix4x4>
#include <QVector3D>
#include <array>
#include <vector>

#include "measure/neighbour_regions.h"

namespace chainmail {

/// A valid region as it is drawn: in space a box, in the plane a rectangle, and on a line a bar a few pixels thick,
/// that its ends can be seen beside the links. Corners in mesh units; lines as pairs of ends, faces as triangles.
class RegionShape {
 public:
  /// Pixels are logical ones, in the plane through the view's centre.
  RegionShape(const NeighbourRegion& region, const QMatrix4x4& toView, int spaceDimension, double unitsPerPixel);

  std::vector<QVector3D> faces() const;
  std::vector<QVector3D> edges() const;
  std::vector<QVector3D> dashedEdges() const;
  /// From where the neighbour is to the nearest place of its region.
  std::vector<QVector3D> wayIn() const { return {at_, nearest_}; }
  /// A cross, upright in the view, over where the neighbour is.
  std::vector<QVector3D> cross(double pixels) const;

 private:
  // Corner i lies at the high end of axis k where bit k of i is set.
  std::array<QVector3D, 8> corners_;
  QVector3D at_, nearest_;
  QVector3D right_, up_;  // of the view, a pixel long
};

}  // namespace chainmail
