#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail::report {

/// One drag: the handle's element, and its target in each move (mesh units).
struct ScriptedDrag {
  ElementId element = 0;
  std::vector<Point> targets;
};

/// Returns drags like those of a user, each from rest: a random element follows a smooth random walk in the plane of
/// the first two axes of the scene. The same seed gives the same drags.
/// The speed is in proportion to the object's width, as if the object fills the screen. At 60 moves per second the
/// handle crosses the width in a little less than a second; in some drags it is up to twice as fast or slow. It starts
/// and stops slowly.
std::vector<ScriptedDrag> scripted_drags(const Mesh& mesh, std::uint64_t seed, int drags, int moves);

}  // namespace chainmail::report
