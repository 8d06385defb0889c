#pragma once

#include <cstdint>
#include <string_view>

namespace chainmail::api {

/// Id of an element: its index in the order of the arrays or of the file, from 0. No cut renumbers elements.
using ElementId = std::uint32_t;

/// Id of a link: an unordered pair of elements. Links are numbered by their first element, then in the order of that
/// element's neighbours.
using LinkId = std::uint32_t;

/// A position or a displacement on the axes x, y and z (mesh units).
struct Vector3 {
  double x = 0;  ///< On the axis x (mesh units).
  double y = 0;  ///< On the axis y (mesh units).
  double z = 0;  ///< On the axis z (mesh units).

  /// True if all coordinates are equal.
  bool operator==(const Vector3&) const = default;
};

/// Returns the sum of two vectors.
constexpr Vector3 operator+(const Vector3& a, const Vector3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
/// Returns the difference of two vectors.
constexpr Vector3 operator-(const Vector3& a, const Vector3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
/// Returns a multiple of a vector.
constexpr Vector3 operator*(double factor, const Vector3& a) { return {factor * a.x, factor * a.y, factor * a.z}; }

/// Returns the scalar product of two vectors.
constexpr double dot(const Vector3& a, const Vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
/// Returns the vector product of two vectors.
constexpr Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A rotation about an axis. In a plane, only the axis across it is possible, and on a line none.
struct Rotation {
  Vector3 axis = {};   ///< Axis of any length above 0, unless there is no rotation.
  double degrees = 0;  ///< Counterclockwise as seen from the tip of the axis.

  /// True if axis and angle are equal.
  bool operator==(const Rotation&) const = default;
};

/// Type of the numbers in which an object stores its positions and a method computes: float or double.
enum class Precision {
  single_precision,  ///< float: half the memory
  double_precision   ///< double
};

/// Relaxation scheme.
enum class RelaxationScheme {
  mean,        ///< Moves each element toward the mean of the positions that its neighbours imply (Frisken-Gibson 1999).
  link,        ///< Moves the two ends of each link, which share its deflection (Schill 2001).
  equilibrium  ///< Moves the whole object at once, to the valid state of least energy.
};

/// Returns the version of the library, like `0.1.0`.
std::string_view version();

}  // namespace chainmail::api
