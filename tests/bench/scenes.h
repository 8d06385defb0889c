#pragma once

#include <string>
#include <vector>

#include "solver/deformer.h"

namespace chainmail::bench {

/// Makes a measured mesh. The name is kind and side, as in `grid1024`. `jittered_…`: each interior coordinate is moved
/// by up to 0.3 spacings. `…_3d`: a plane mesh gets a third coordinate. Every call makes a new mesh.
MeshPointer make_mesh(const std::string& name);

/// Stiff links, so that the whole body follows every move.
inline constexpr LinkSoftness stiff{0.999, 1.001, 0.0005};
/// Returns a different softness for each link: a slack of 1e-4 to 2e-2 of the rest length, log-uniform.
Softness mixed_softness(const Mesh& mesh);

enum class Drag { local, whole_body, whole_body_mixed };
std::string name(Drag drag);
Softness softness(Drag drag, const Mesh& mesh);

/// The handle: an element and its targets. The path is closed, so that passes can be repeated any number of times.
struct DragPath {
  ElementId element = 0;
  std::vector<Point> targets;
};

/// Returns the handle of a drag. The drags are the same for all algorithms. The handle moves on a circle about the rest
/// position of its element, in 3D on a tilted one, so that every axis changes its direction twice per round.
///
/// Local: the middle element, default softness, and a radius at which some hundred elements move in each pass.
/// Whole-body: the first corner, on a circle with a diameter of a quarter of the object's width. Each of the 32 moves
/// of a round (2.5 % of the width) is larger than the slack of all links together, so all elements move in every pass.
DragPath path_of(Drag drag, const Mesh& mesh);

}  // namespace chainmail::bench
