#pragma once

#include "mesh/mesh.h"

namespace chainmail::report {

/// A beam along x that is clamped at x = 0, with a square section. Lengths in mesh units.
struct Beam {
  double length = 1, height = 1;
  Point middle = Point::Zero();  // of the clamped section
  double poisson = 0;
};

/// Returns the displacement of a point of the beam if the section at its end moves by `deflection` along z without
/// turning: the theory of shear beams of Timoshenko (1921), with the shear coefficient of Cowper (1966) for a square
/// section, 10 (1 + ν) / (12 + 11 ν). For small deflections.
Point timoshenko(const Beam& beam, double deflection, const Point& rest);

/// Returns the displacement of a point of a sheet in the plane z = 0, clamped at x = 0, whose section at the end turns
/// by `angle` (radians): pure bending. Poisson's ratio must be 0: then this solves the equations of linear elasticity
/// exactly, also at both ends. For small angles.
Point pure_bending(const Beam& sheet, double angle, const Point& rest);

}  // namespace chainmail::report
