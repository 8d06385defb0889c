#pragma once

#include <QMatrix4x4>
#include <QVector3D>
#include <array>
#include <vector>

#include "measure/neighbour_regions.h"

namespace chainmail {

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

}  // namespace chainmail
