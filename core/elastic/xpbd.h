#pragma once

#include <memory>

#include "elastic/elastic.h"

namespace chainmail {

/// The time step of XPBD. It decides on how fast the object follows, and a little on where it comes to rest.
struct XpbdStep {
  /// The square of the time step, times the stiffness of the mean spring, over the mass of an element. The answer at
  /// rest differs from the least energy in proportion to this, because one iteration does not meet all constraints.
  double springs_over_inertia = 2;
  double damping = 0.02;  // share of its velocity that an element loses in a time step
};

/// Makes a solver with another time step than the usual one.
std::unique_ptr<ElasticSolver> make_xpbd(const ElasticProblem& problem, const XpbdStep& step, const Progress& progress);

}  // namespace chainmail
