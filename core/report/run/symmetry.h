#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "report/run/physics_contestant.h"

namespace chainmail::report {

/// The angles by which an object is turned, in its plane or about z (degrees).
inline constexpr std::array<double, 2> symmetry_angles{45, 90};

/// By how much the answer on a turned object, turned back, differs from the answer on the object itself. About 0 for a
/// method that is invariant under rotation.
struct TurnDifference {
  double degrees = 0;
  double max = 0;       // largest distance of an element (mean rest lengths)
  double relative = 0;  // RMS of the distances over the RMS of the displacements
};

/// The differences of a contestant on one object.
struct Symmetry {
  PhysicsContestant contestant;
  std::vector<TurnDifference> turns;  // one per angle; none if there is a refusal
  std::string refusal;
};

/// Returns the differences of a contestant, if it took part.
const Symmetry* find_symmetry(const std::vector<Symmetry>& all, const PhysicsContestant& contestant);

/// Returns the rotation vector across the plane of the object, or about z.
Point rotation_by(const Mesh& mesh, double degrees);

/// Returns the case with its object, its axes of valid regions and its drags turned about the origin. Its 3D lists
/// stay those of the object, though its links no longer follow the axes.
Case turned(const Case& object, const Point& rotation);

/// Runs one move of each contestant, in double, on the object and on its turned copies: the end of the drag `bend`, or
/// of the first one. Of contestants that differ in sweeps only, those without sweeps take part. None for objects on a
/// line.
std::vector<Symmetry> symmetry_under_rotation(const Case& object, const std::vector<PhysicsContestant>& contestants,
                                              const CompareOptions& options, const Progress& progress);

}  // namespace chainmail::report
