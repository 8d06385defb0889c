#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "body/region.h"
#include "mesh/mesh.h"

namespace chainmail {

enum class Precision { single_precision, double_precision };
/// Their names in files and on the command line, in the order of the constants.
inline constexpr std::array<std::string_view, 2> precision_names{"float", "double"};
constexpr std::string_view name(Precision precision) { return precision_names[std::size_t(precision)]; }

/// Largest coordinate that a solver stores (mesh units), so that sums of a few of them are finite.
double position_limit(Precision precision);
/// Throws Error if the rest positions of a mesh are out of the range of a precision.
void check(Precision precision, const Mesh& mesh);

/// Position of an element (mesh units). In 3D it is padded, so that all axes are computed at once. Size in bytes for
/// one, two and three dimensions: 4, 8, 16 in float; 8, 16, 32 in double.
template <class Scalar, int Dimension>
struct Position {
  static constexpr int lanes = Dimension == 3 ? 4 : Dimension;

  Scalar& operator[](int k) { return at[k]; }
  const Scalar& operator[](int k) const { return at[k]; }
  bool operator==(const Position& other) const {
    bool equal = true;
    for (int k = 0; k < Dimension; ++k) {
      equal &= at[k] == other.at[k];
    }
    return equal;
  }

  alignas(lanes * sizeof(Scalar)) Scalar at[lanes];
};

/// Returns a position clamped into a region whose lower bounds are relative to `low`, and upper bounds to `high` (mesh
/// units).
template <class Scalar, int Dimension>
Position<Scalar, Dimension> clamped(const Position<Scalar, Dimension>& position, const Scalar* low, const Scalar* high,
                                    const Region<Scalar, Dimension>& region) {
  Position<Scalar, Dimension> result = position;
  for (int k = 0; k < Dimension; ++k) {
    const Scalar lowest = low[k] + region.low[k];
    const Scalar highest = high[k] + region.high[k];
    result[k] = result[k] < lowest ? lowest : result[k];
    result[k] = highest < result[k] ? highest : result[k];
  }
  return result;
}

/// Turns vectors from turned axes into the world, on the axes that exist.
struct AxisTurn {
  int dimension = 0;
  std::array<std::array<double, 3>, 3> rows{};  // row k gives axis k of the world

  template <class Of>
  double operator()(int k, Of of) const {
    double sum = 0;
    for (int j = 0; j < dimension; ++j) {
      sum += rows[std::size_t(k)][std::size_t(j)] * of(j);
    }
    return sum;
  }
};

/// The current positions of all elements, without a copy. Valid until the solver changes.
class PositionView {
 public:
  /// If `from_rest` is given, the elements hold displacements from the rest positions of this mesh; otherwise, if
  /// `origin` is given, from this point, on the axes that exist (mesh units). If `turn` is given, their coordinates are
  /// along turned axes, or in another unit.
  PositionView(const void* first, std::size_t stride, Precision precision, const Mesh* from_rest = nullptr,
               const AxisTurn* turn = nullptr, const double* origin = nullptr)
      : first_(static_cast<const std::byte*>(first)),
        stride_(stride),
        precision_(precision),
        from_rest_(from_rest),
        turn_(turn),
        origin_(origin) {}

  /// Returns coordinate k (of the axes that exist) of an element, in mesh units.
  double operator()(ElementId element, int k) const {
    const double at = turn_ == nullptr ? held(element, k) : (*turn_)(k, [&](int j) { return held(element, j); });
    return from_rest_ != nullptr ? rest(element, k) + at : origin_ != nullptr ? origin_[k] + at : at;
  }

  /// Returns the distance from one element to another along axis k (mesh units). Displacements keep their digits,
  /// however far the object is from the origin or from rest.
  double between(ElementId from, ElementId to, int k) const {
    const auto held_apart = [&](int j) { return held(to, j) - held(from, j); };
    const double apart = turn_ == nullptr ? held_apart(k) : (*turn_)(k, held_apart);
    return from_rest_ == nullptr ? apart : rest(to, k) - rest(from, k) + apart;
  }

 private:
  double held(ElementId element, int k) const {
    const std::byte* at = first_ + element * stride_;
    return precision_ == Precision::single_precision ? double(reinterpret_cast<const float*>(at)[k])
                                                     : reinterpret_cast<const double*>(at)[k];
  }
  double rest(ElementId element, int k) const {
    return from_rest_->rest[std::size_t{element} * static_cast<std::size_t>(from_rest_->space_dimension) + k];
  }

  const std::byte* first_;
  std::size_t stride_;
  Precision precision_;
  const Mesh* from_rest_;
  const AxisTurn* turn_;
  const double* origin_;
};

/// Returns the position of an element with all three coordinates (mesh units).
Point point_of(const Mesh& mesh, const PositionView& positions, ElementId element);

/// Returns the coordinates that exist, space_dimension for each element, of positions: x, y and z for each element
/// (mesh units). Throws Error, with the element, if there are not as many as the mesh has, if one is not finite or out
/// of the range of the precision, and if one is on an axis that does not exist and is not that of the object.
std::vector<double> coordinates_of(const Mesh& mesh, std::span<const double> positions, Precision precision);

/// Returns the displacements of elements from rest, space_dimension coordinates each (mesh units).
std::vector<double> displacements_of(const Mesh& mesh, const PositionView& positions,
                                     std::span<const ElementId> elements);
/// The same for all elements.
std::vector<double> displacements_of(const Mesh& mesh, const PositionView& positions);

}  // namespace chainmail
