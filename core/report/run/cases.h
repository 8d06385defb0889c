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

/// Returns the built-in objects of the comparison, each with its three drags. All links have this softness, except
/// those of the stiff inclusion.
std::vector<Case> default_cases(const Softness& softness);

}  // namespace chainmail::report
