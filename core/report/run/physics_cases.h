#pragma once

#include "report/run/cases.h"

namespace chainmail::report {

/// The most handles of an object, and the moves of a drag.
inline constexpr std::size_t max_handles = 3;
inline constexpr int moves_of_drag = 24;

/// Returns a bar of tetrahedra with about this many elements. It is three times as long as wide and high, and pinned at
/// its left layer.
Case pinned_bar(std::uint64_t elements, const Softness& softness, const ElasticOptions& elastic, bool with_cut = true);
/// Returns a square sheet of triangles, pinned at its top layer.
Case pinned_sheet(std::uint64_t elements, const Softness& softness, const ElasticOptions& elastic,
                  bool with_cut = true);

/// Returns the built-in objects of the comparison with physics, with their drags.
std::vector<Case> physics_cases(const Softness& softness, const ElasticOptions& elastic);

/// Returns the elements that can be handles: the boundary of a solid; all elements of other objects.
std::vector<ElementId> possible_handles(const Mesh& mesh);

/// Returns up to `most` handles. Each is the element farthest from the pins and from the handles before it; at equal
/// distances, the one with the lowest id. Throws Error if nothing or everything is pinned.
std::vector<ElementId> physics_handles(const Case& object, std::size_t most = max_handles);

/// Returns the drags of an object, from rest. For each handle: a nudge (5 % of the object's largest extent, obliquely),
/// a pull (20 % away from the pins) and a bend (20 % across). Then `cut, then move`: half of the first handle's pull,
/// the deepest cut between the handle and the nearest pin that leaves linear elasticity a unique solution, and one more
/// move. It is missing if there is no such cut. Finding the cut takes about as long as a factorization.
///
/// With a radius, as a share of the largest extent, a handle is the patch of all elements without a pin within it.
std::vector<RecordedMoves> physics_drags(const Case& object, bool with_cut = true, double radius_share = 0,
                                         std::size_t handles = max_handles, int moves = moves_of_drag);
/// Returns each case with each law of the material of the reference solution. Names say the law, except neo-Hookean
/// alone.
std::vector<Case> with_laws(const std::vector<Case>& cases, const std::vector<StrainLaw>& laws);
/// The radius of the patches of comparisons with a refined reference.
inline constexpr double patch_share = 0.16;

}  // namespace chainmail::report
