#pragma once

#include <Eigen/Core>
#include <array>

#include "mesh/texture.h"

namespace chainmail {

// Kelvin's fundamental solution: the effect of a unit force in an infinite elastic body. The shear modulus is 1, so
// tractions are in units of the shear modulus. The unit of length is free. Row l, column k: effect along axis k of the
// force along axis l.

/// A flat triangle of a surface, with what its integrals need.
struct Facet {
  /// The corners are counterclockwise as seen from outside the solid, and not on one line.
  explicit Facet(const std::array<Point, 3>& corners);

  std::array<Point, 3> corner;
  std::array<Point, 3> along;    // direction of the edge from each corner to the next
  std::array<Point, 3> outward;  // direction across that edge, in the plane, away from the triangle
  std::array<double, 3> length;  // length of that edge
  Point normal;                  // points out of the solid
  Point centroid;
  double area = 0;
};

/// Returns the displacement at r (the vector from the force), and the traction there on a plane with this normal.
Eigen::Matrix3d kelvin_displacement(const Point& r, double poisson);
Eigen::Matrix3d kelvin_traction(const Point& r, const Point& normal, double poisson);

/// Integrals of kelvin_displacement and kelvin_traction over a facet, with the force at one point.
struct KelvinIntegrals {
  Eigen::Matrix3d displacement, traction;
};

/// Computes the integrals in closed form, so they are exact both near and far. The point may lie on the facet, but not
/// on its edges. The integral of the traction jumps there; the result is the value on one of the two sides.
KelvinIntegrals integrate_kelvin(const Facet& facet, const Point& point, double poisson);

/// Returns the solid angle of a facet as seen from a point, from -2π to 2π. It is positive if the point sees the inner
/// side (van Oosterom and Strackee 1983).
double solid_angle(const Facet& facet, const Point& point);

}  // namespace chainmail
