#include "simulate/frame_space.h"

#include <algorithm>
#include <cmath>

namespace chainmail {
namespace {

constexpr std::size_t copied_at_once = 64;        // elements
constexpr double smallest = 1e-4, largest = 1e5;  // radius of an object that is shown in mesh units

double unit_of(const Mesh& mesh) {
  const double radius = (mesh.box[1] - mesh.box[0]).norm() / 2;
  const bool usual = radius == 0 || (radius >= smallest && radius <= largest);
  return usual ? 1 : std::exp2(std::round(std::log2(radius)));
}

}  // namespace

FrameSpace::FrameSpace(const Mesh& mesh) : dimension_(mesh.space_dimension), unit_(unit_of(mesh)) {
  is_of_mesh_ = unit_ == 1 && !is_far(mesh);
  if (is_of_mesh_) {
    return;
  }
  origin_ = (mesh.box[0] + mesh.box[1]) / 2;
  scale_.dimension = dimension_;
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension_); ++k) {
    on_axes_[k] = origin_[mesh.axes[k]];
    scale_.rows[k][k] = unit_;
  }
}

void FrameSpace::move(std::span<const double> coordinates, double unit, std::span<float> out) const {
  const auto dimension = static_cast<std::size_t>(dimension_);
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    out[i] = static_cast<float>((coordinates[i] - on_axes_[i % dimension]) / unit);
  }
}

/// Converts a part at a time, so that it takes no memory.
void FrameSpace::copy(const Body& body, ElementId first, double unit, std::span<float> out) const {
  if (is_of_mesh_) {
    body.copy_positions(first, out);
    return;
  }
  const auto dimension = static_cast<std::size_t>(dimension_);
  std::array<double, 3 * copied_at_once> part;
  for (std::size_t at = 0; at < out.size();) {
    const auto some = std::span(part).first(std::min(out.size() - at, dimension * copied_at_once));
    body.copy_positions(first + static_cast<ElementId>(at / dimension), some);
    move(some, unit, out.subspan(at, some.size()));
    at += some.size();
  }
}

PositionView FrameSpace::view(std::span<const float> coordinates) const {
  const std::size_t stride = std::size_t(dimension_) * sizeof(float);
  return {coordinates.data(),
          stride,
          Precision::single_precision,
          nullptr,
          is_of_mesh_ ? nullptr : &scale_,
          is_of_mesh_ ? nullptr : on_axes_.data()};
}

}  // namespace chainmail
