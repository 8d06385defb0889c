#include "elastic/material.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesh/error.h"

namespace chainmail {

void check(const ElasticOptions& options) {
  if (!(options.material.young > 0 && std::isfinite(options.material.young))) {
    throw Error("young", "Young's modulus must lie above 0", "steel has 2e11 pascals, liver a few thousand");
  }
  if (!(options.material.poisson >= 0 && options.material.poisson < 0.5)) {
    throw Error(
        "poisson", "Poisson's ratio must lie in [0, 0.5)",
        "0 is cork, 0.3 steel, 0.45 soft tissue; 0.5 would keep the volume exactly, which these methods cannot");
  }
  if (std::ranges::any_of(options.lattice, [](std::uint32_t count) {
        return count < fewest_control_points || count > most_control_points;
      })) {
    throw Error("lattice",
                "free-form deformation has " + std::to_string(fewest_control_points) + " to " +
                    std::to_string(most_control_points) + " control points along each axis",
                "choose 4");
  }
}

Lame lame(const Material& material) {
  const auto [young, poisson] = material;
  return {young / (2 * (1 + poisson)), young * poisson / ((1 + poisson) * (1 - 2 * poisson))};
}

}  // namespace chainmail
