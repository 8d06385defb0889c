#pragma once

#include <string>
#include <vector>

#include "solve/solver.h"

namespace chainmail::bench {

/// The meshes that are measured. Called `grid1024` (kind and side), `jittered_…` where each interior
/// coordinate is off its place by up to 0.3 spacings, and `…_3d` where a plane is given a third coordinate.
/// Made anew at each call.
MeshPointer make_mesh(const std::string& name);

/// Stiff links: the whole body follows every move.
inline constexpr LinkSoftness stiff{0.999, 1.001, 0.0005};
/// Each link as stiff as any other, up to 200 times: it gives 1e-4 to 2e-2, log-uniform.
Softness mixed_softness(const Mesh& mesh);

enum class Drag { local, whole_body, whole_body_mixed };
std::string name(Drag drag);
Softness softness(Drag drag, const Mesh& mesh);

/// The hand: an element, and where it goes, on a closed path, so that passes may be repeated at will.
struct Hand {
  ElementId element = 0;
  std::vector<Point> targets;
};

/// The drags, the same for all algorithms. Both go round a circle about the element's rest position, in 3D a
/// tilted one, so that every axis changes its direction twice a round.
///
/// Local: the middle element, softness as it is by default, a radius at which some hundred elements move a pass.
/// Whole-body: the first corner, on a circle a quarter as wide as the object; each of its 32 steps (2.5 % of the
/// width: the hand is round in half a second) is beyond what all links give together, so all elements move
/// in every pass.
Hand hand(Drag drag, const Mesh& mesh);

}  // namespace chainmail::bench
