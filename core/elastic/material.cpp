#include "elastic/material.h"

namespace chainmail {

void check(const ElasticOptions& options) {
  check(parameters::young, options.material.young);
  check(parameters::poisson, options.material.poisson);
  for (const std::uint32_t count : options.lattice) {
    check(parameters::lattice, count);
  }
  check(parameters::iterations, options.iterations);
}

Lame lame(const Material& material) {
  const auto [young, poisson] = material;
  return {young / (2 * (1 + poisson)), young * poisson / ((1 + poisson) * (1 - 2 * poisson))};
}

}  // namespace chainmail
