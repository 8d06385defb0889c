#pragma once

#include "report/run/cases.h"

namespace chainmail::report {

/// A bar of tetrahedra, three times as long as it is wide and high, pinned at its left layer; about so many elements.
Case pinned_bar(std::uint64_t elements, const Softness& softness, const ElasticOptions& elastic, bool with_cut = true);
/// A square sheet of triangles, pinned at its top layer.
Case pinned_sheet(std::uint64_t elements, const Softness& softness, const ElasticOptions& elastic,
                  bool with_cut = true);

/// The objects that are compared with physics by default, with their drags.
std::vector<Case> physics_cases(const Softness& softness, const ElasticOptions& elastic);

/// Up to three elements, on the surface where the object has one: the farthest from the pins, then the farthest from
/// those and the pins, and again. Of several the one with the lowest id. Throws Error where all is pinned, or nothing.
std::vector<ElementId> physics_handles(const Case& object);

/// The drags of an object, from rest. For each handle a nudge (5 % of the object's largest extent, obliquely), a pull
/// (20 % away from the pins) and a bend (20 % across); then `cut, then move`: half of the first handle's pull, a
/// cut into the object between the handle and the nearest pin, as deep as linear elasticity still has an answer, and
/// one move more. It is left out where there is no such cut. To find it takes about the time to factorize.
std::vector<RecordedMoves> physics_drags(const Case& object, bool with_cut = true);

}  // namespace chainmail::report
