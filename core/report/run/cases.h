#pragma once

#include <string>
#include <vector>

#include "simulate/command.h"

namespace chainmail::report {

/// A recorded drag, as commands from rest. The last `Release` is missing if the handle is still held when the errors
/// are measured.
struct RecordedMoves {
  std::string name;
  std::string description;
  std::vector<Command> commands;
};

/// An object at rest, and the drags to carry out on it.
struct Case {
  std::string name;
  std::string description;
  MeshPointer mesh;
  std::vector<LinkId> cuts;
  std::vector<ElementId> pins;
  Softness softness;
  std::vector<RecordedMoves> drags;
  ElasticOptions elastic = {};
};

/// Returns the objects of the comparison by default, each with its three drags. All links have this softness, except
/// those of the stiff inclusion.
std::vector<Case> default_cases(const LinkSoftness& softness);

}  // namespace chainmail::report
