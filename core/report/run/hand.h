#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail::report {

/// One drag: an element in the hand, and where the hand goes, move by move (mesh units).
struct HandDrag {
  ElementId element = 0;
  std::vector<Point> targets;
};

/// Drags as a user makes them, from rest each: a random element on a smooth random walk in the plane of the
/// first two axes that the scene carries.
///
/// The hand's speed is a share of the object's width, as on a screen that the object fills: it crosses the
/// width in somewhat less than a second at 60 moves a second, half or twice as fast in some drags, and sets out
/// and comes to a stop softly. The same for the same seed.
std::vector<HandDrag> hand_drags(const Mesh& mesh, std::uint64_t seed, int drags, int moves);

}  // namespace chainmail::report
