#pragma once

namespace chainmail {

/// Names an algorithm in code. Each one has exactly one entry in the table of solver/algorithms.cpp.
enum class Algorithm {
  generalized,
  spiral,
  natural_queue,
  enhanced,
  chainmail_3d,
  exact,
  linear_fem,
  neo_hookean,
  boundary_elements,
  free_form,
  corotational,
  arap,
  xpbd,
  projective,
  quasi_newton,
  neo_hookean_xpbd
};

}  // namespace chainmail
