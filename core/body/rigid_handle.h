#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "body/body_view.h"

namespace chainmail {

/// A handle of many elements, in displacements from rest. Each element is at the handle's displacement, which is that
/// of its pivot, plus an offset of its own. A translation keeps the offsets; a rotation changes them.
///
/// It begins with the positions that the elements have at that time. They differ from those of the pose if something
/// else than this handle has moved them: the restoration of validity, relaxation or another handle. Then the pivot is
/// their mean.
template <class Scalar, int Dimension>
class RigidHandle {
 public:
  using View = BodyView<Scalar, Dimension>;
  using Offset = Position<Scalar, Dimension>;

  void begin(const View& body, const Handle& handle) {
    mesh_ = body.mesh;
    pose_ = handle.pose();
    offsets_.clear();
    arms_.clear();
    for (const ElementId element : handle.elements()) {
      double absolute[Dimension];
      for (int k = 0; k < Dimension; ++k) {
        absolute[k] = body.absolute(element, k);
      }
      offsets_.push_back(body.positions[element]);
      arms_.push_back(mesh_->to_point(absolute));
    }
    take_pivot();
    for (Point& arm : arms_) {
      arm -= pose_.pivot;
    }
  }

  /// Returns the displacement of the handle at a pose.
  Offset at(const Pose& pose) const {
    Offset at{};
    for (int k = 0; k < Dimension; ++k) {
      const int axis = mesh_->axes[std::size_t(k)];
      at[k] = static_cast<Scalar>(pose.pivot[axis] - pose_.pivot[axis]);
    }
    return at;
  }

  /// Returns the position of the pivot (mesh units) while the handle is at a displacement.
  Point pivot_at(const Offset& at) const {
    Point pivot = pose_.pivot;
    for (int k = 0; k < Dimension; ++k) {
      pivot[mesh_->axes[std::size_t(k)]] += double(at[k]);
    }
    return pivot;
  }

  /// Returns the offset of each element after a rotation, measured from the grab.
  std::vector<Offset> offsets(const Point& rotation) const {
    // R R0⁻¹ − I, of the rotation R and the one at the beginning R0, is (turn − turn0) R0ᵀ: exactly 0 for no change.
    const Eigen::Matrix3d before = turn_of(pose_.rotation);
    const Eigen::Matrix3d turn = (turn_of(rotation) - before) * (before + Eigen::Matrix3d::Identity()).transpose();
    std::vector<Offset> offsets = offsets_;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      const Point displacement = turn * arms_[i];
      for (int k = 0; k < Dimension; ++k) {
        offsets[i][k] += static_cast<Scalar>(displacement[mesh_->axes[std::size_t(k)]]);
      }
    }
    return offsets;
  }

 private:
  /// Sets the pivot to the mean of the positions, unless it is that up to rounding.
  void take_pivot() {
    Point mean = Point::Zero();
    double size = 0;
    for (const Point& position : arms_) {
      mean += position / double(arms_.size());
      size = std::max(size, position.template lpNorm<Eigen::Infinity>());
    }
    const double rounding = 64 * std::numeric_limits<Scalar>::epsilon() * size;
    if ((mean - pose_.pivot).template lpNorm<Eigen::Infinity>() > rounding) {
      pose_.pivot = mean;
    }
  }

  const Mesh* mesh_ = nullptr;
  Pose pose_;                    // at the beginning
  std::vector<Offset> offsets_;  // at the beginning, when the handle's displacement is 0
  std::vector<Point> arms_;      // from the pivot to each element at the beginning (mesh units)
};

}  // namespace chainmail
