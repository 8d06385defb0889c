#pragma once

#include <QVector3D>
#include <cstdint>
#include <vector>

#include "simulate/frame.h"

namespace chainmail {

/// Smooth normals of a surface in space: for each element, the sum of the normals of its faces, weighted by their areas
/// (not normalised). An element at a crease has none, so that light does not blur the crease. A new frame only computes
/// the normals of faces that moved.
class SurfaceNormals {
 public:
  /// Sets the faces, three corners each.
  void setFaces(std::vector<ElementId> corners, std::size_t elements);
  /// Computes the normals of a frame.
  void follow(const Frame& frame);

  /// One normal per element; 0 for an element at a crease or without faces.
  const std::vector<QVector3D>& normals() const { return normals_; }
  /// Returns the blocks of Frame::block_elements elements whose normals the last follow() computed, in order, as pairs
  /// of first and end.
  const std::vector<std::array<std::size_t, 2>>& changedBlocks() const { return changed_; }

 private:
  void computeAll(const Frame& frame);
  void computeAround(const Frame& frame);
  void collect(const Frame& frame);
  QVector3D normalAt(const Frame& frame, ElementId element) const;
  QVector3D faceNormal(const Frame& frame, std::uint32_t face) const;

  std::vector<ElementId> corners_;
  std::vector<std::uint32_t> first_, around_;  // the faces around each element
  std::vector<QVector3D> normals_;
  std::vector<bool> marked_;          // the elements in outdated_
  std::vector<ElementId> outdated_;   // elements to compute
  std::vector<bool> outdatedBlocks_;  // the blocks that contain them
  std::vector<std::array<std::size_t, 2>> changed_;
  std::uint64_t number_ = 0, series_ = 0;  // of the newest frame; number 0 before the first
};

}  // namespace chainmail
