#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "simulate/command.h"

namespace chainmail::report {

/// A recorded drag, as commands from rest. The last `Release` is missing if the element is still grabbed when the
/// errors are measured.
struct RecordedMoves {
  std::string name;
  std::string description;
  std::vector<Command> commands;
  // If the handle is a patch, the element at its centre and its radius (mesh units).
  std::optional<ElementId> centre = {};
  double radius = 0;
  /// The displacement of a point of the object at rest at the end of the drag, if theory knows it (mesh units).
  std::function<Point(const Point& rest)> closed_form = {};
};

/// An object at rest, and the drags to run on it.
struct Case {
  std::string name;
  std::string description;
  MeshPointer mesh;
  std::vector<LinkId> cuts;
  std::vector<ElementId> pins;
  Softness softness;
  std::vector<RecordedMoves> drags;
  ElasticOptions elastic = {};
  StrainLaw law = {};  // of the reference solution; no contestant knows it
};

/// A motion of a handle from where it was grabbed.
struct Motion {
  Point by = Point::Zero();  // displacement of its pivot (mesh units)
  Rotation rotation = {};    // about its pivot
};

/// Returns a drag of a program: grabs elements of an object at rest, and moves them along a path, one pass per motion.
/// Throws Error if an element does not exist, is given twice or is pinned, and if the path is empty or a motion is not
/// possible.
RecordedMoves drag_along(const std::string& name, const Body& body, const std::vector<ElementId>& elements,
                         const std::vector<Motion>& path);

/// Returns an object of a program, with its cuts, pins, softness and elasticity, at rest.
Case case_of(const Body& body, const std::string& name);

/// Returns the built-in objects of the comparison, each with its three drags. All links have this softness, except
/// those of the stiff inclusion.
std::vector<Case> default_cases(const Softness& softness);

}  // namespace chainmail::report
