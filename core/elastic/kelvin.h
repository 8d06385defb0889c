#pragma once

#include <Eigen/Core>
#include <array>

#include "mesh/texture.h"

namespace chainmail {

// Kelvin's fundamental solution: what a unit force does to an infinite elastic body. The shear modulus is 1, so that
// tractions are in shear moduli; length is in any unit. Row l, column k: the force along axis l, its effect along axis
// k.

/// A flat triangle of a surface, with what its integrals need.
struct Facet {
  /// As seen from outside the solid, counterclockwise; not all on a line.
  explicit Facet(const std::array<Point, 3>& corners);

  std::array<Point, 3> corner;
  std::array<Point, 3> along;    // the edge from each corner to the next: its direction,
  std::array<Point, 3> outward;  // what is across it in the plane, away from the triangle,
  std::array<double, 3> length;  // and its length
  Point normal;                  // out of the solid
  Point centroid;
  double area = 0;
};

/// Displacement at a place from the force (r: the vector to there), and the traction on a plane there with this normal.
Eigen::Matrix3d kelvin_displacement(const Point& r, double poisson);
Eigen::Matrix3d kelvin_traction(const Point& r, const Point& normal, double poisson);

/// The integrals of both over a facet, with the force at a point.
struct KelvinIntegrals {
  Eigen::Matrix3d displacement, traction;
};

/// In closed form: exact near and far alike. The point may lie on the facet but not on its edges; the integral of the
/// traction, which jumps there, is then that of one of its two sides.
KelvinIntegrals integrate_kelvin(const Facet& facet, const Point& point, double poisson);

/// The solid angle under which a point sees a facet, from -2π to 2π: above 0 where it sees the inner side.
double solid_angle(const Facet& facet, const Point& point);

}  // namespace chainmail
