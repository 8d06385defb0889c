#include "report/run/physics_contestant.h"

#include <algorithm>
#include <array>

namespace chainmail::report {
namespace {

/// Returns a remark on the cells that a method works on. Some have the same cells as the reference solution, so
/// their errors do not include the error of the mesh.
const char* cells_of(Algorithm algorithm) {
  switch (algorithm) {
    case Algorithm::linear_fem:
    case Algorithm::neo_hookean:
    case Algorithm::corotational:
      return ", on the same cells";
    case Algorithm::boundary_elements:
      return ", on its surface mesh";
    default:
      return "";
  }
}

}  // namespace

std::string name(const PhysicsContestant& contestant) {
  return contestant.algorithm ? std::string(info(*contestant.algorithm).name) : "nothing";
}

std::string label(const PhysicsContestant& contestant) {
  if (!contestant.algorithm) {
    return "Nothing moves";
  }
  if (contestant.limit > 0) {
    PhysicsContestant unlimited = contestant;
    unlimited.limit = 0;
    return label(unlimited) + ", " + std::to_string(contestant.limit) +
           (contestant.limit == 1 ? " iteration" : " iterations");
  }
  if (contestant.open_regions) {
    // No region binds, so what it measures is the minimisation, which begins with the answer of the pass.
    return "Material, multigrid, after " + std::string(info(*contestant.algorithm).label);
  }
  if (!contestant.calibrated) {
    return label(Contestant{*contestant.algorithm, contestant.sweeps, contestant.equilibrium}) +
           cells_of(*contestant.algorithm);
  }
  return label(Contestant{*contestant.algorithm, 0, contestant.equilibrium}) + ", calibrated" +
         (contestant.sweeps == 0 ? "" : " (" + std::to_string(contestant.sweeps) + " sweeps)");
}

Softness softness_of(const PhysicsContestant& contestant, const Softness& object) {
  if (contestant.open_regions) {
    constexpr LinkSoftness open{.compression = 0, .stretch = 1000, .shear = 1000};
    return {open, {}, EnergyKind::material, object.axes};
  }
  return contestant.calibrated ? Softness{*contestant.calibrated, {}, link_energy, object.axes} : object;
}

bool prepares(const PhysicsContestant& contestant) {
  return contestant.algorithm && info(*contestant.algorithm).elastic;
}

std::span<const int> limits_of(const PhysicsContestant& contestant) {
  static constexpr std::array limits{1, 2, 5, 10, 20, 50, 100, 200, 500, 1000};
  static constexpr std::size_t of_equilibrium = 8;  // equilibrium_iterations end it
  static_assert(limits[of_equilibrium - 1] == equilibrium_iterations);
  const bool obeys = contestant.algorithm && info(*contestant.algorithm).obeys_iterations;
  return contestant.equilibrium ? std::span<const int>(limits).first(of_equilibrium)
                                : std::span<const int>(limits).first(obeys ? limits.size() : 0);
}

std::vector<PhysicsContestant> contestants_of(const std::vector<Algorithm>& algorithms, const std::vector<int>& sweeps,
                                              bool equilibrium, const std::vector<Calibration>& calibrations) {
  std::vector<PhysicsContestant> contestants{{std::nullopt, 0}};
  for (const Algorithm algorithm : algorithms) {
    if (info(algorithm).elastic) {
      contestants.push_back({algorithm, 0});
      continue;
    }
    for (const int count : sweeps) {
      contestants.push_back({algorithm, count});
    }
    if (equilibrium && takes_part_at_equilibrium(algorithm)) {
      contestants.push_back({algorithm, 0, {}, true});
      contestants.push_back({algorithm, 0, {}, true, 0, true});
    }
    for (const Calibration& found : calibrations) {
      if (found.algorithm == algorithm && found.refusal.empty()) {
        contestants.push_back({algorithm, found.sweeps, found.softness, found.equilibrium});
      }
    }
  }
  return contestants;
}

}  // namespace chainmail::report
