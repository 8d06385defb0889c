#pragma once

#include "report/cases.h"

namespace chainmail::report {

/// A bar of tetrahedra, three times as long as it is wide and high, pinned at its left layer; about so many elements.
Case pinned_bar(std::uint64_t elements, const Softness& softness, const ElasticOptions& elastic);
/// A square sheet of triangles, pinned at its top layer.
Case pinned_sheet(std::uint64_t elements, const Softness& softness, const ElasticOptions& elastic);

/// The objects that are compared with physics where nobody says otherwise, with their drags.
std::vector<Case> physics_cases(const Softness& softness, const ElasticOptions& elastic);

/// Three drags, from rest, of the element farthest from the pins, on the surface where the object has one: a nudge (5 %
/// of the object's largest extent, obliquely), a pull (20 % away from the pins) and a bend (20 % across). Throws Error
/// where all is pinned, or nothing.
std::vector<RecordedMoves> physics_drags(const Case& object);

}  // namespace chainmail::report
