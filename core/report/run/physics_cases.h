#pragma once

#include "report/run/cases.h"

namespace chainmail::report {

/// Returns a bar of tetrahedra with about this many elements, three times as long as wide and high, pinned at its left
/// layer.
Case pinned_bar(std::uint64_t elements, const Softness& softness, const ElasticOptions& elastic, bool with_cut = true);
/// Returns a square sheet of triangles, pinned at its top layer.
Case pinned_sheet(std::uint64_t elements, const Softness& softness, const ElasticOptions& elastic,
                  bool with_cut = true);

/// Returns the objects of the comparison with physics by default, with their drags.
std::vector<Case> physics_cases(const Softness& softness, const ElasticOptions& elastic);

/// Returns the elements that can be a handle: of an object in space its boundary, of others all elements.
std::vector<ElementId> possible_handles(const Mesh& mesh);

/// Returns up to three handles: the element farthest from the pins, then the one farthest from that and the pins, and
/// again. Of several elements at the same distance it takes the lowest id. Throws Error if nothing is pinned, or all.
std::vector<ElementId> physics_handles(const Case& object);

/// Returns the drags of an object, from rest. For each handle: a nudge (5 % of the object's largest extent, obliquely),
/// a pull (20 % away from the pins) and a bend (20 % across). Then `cut, then move`: half of the first handle's pull, a
/// cut between the handle and the nearest pin, as deep as linear elasticity still has an answer, and one more move. It
/// is missing if there is no such cut. Finding the cut takes about as long as a factorization.
std::vector<RecordedMoves> physics_drags(const Case& object, bool with_cut = true);

}  // namespace chainmail::report
