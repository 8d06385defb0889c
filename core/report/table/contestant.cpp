#include "report/table/contestant.h"

#include <array>

namespace chainmail::report {
namespace {

constexpr std::string_view at_equilibrium = "eq.", to_material = "mat.", by_calibration = "cal.";

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

std::string counted(int count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

std::string without_family(std::string_view label) {
  constexpr std::string_view family = " ChainMail";
  return std::string(label.ends_with(family) ? label.substr(0, label.size() - family.size()) : label);
}

}  // namespace

std::string name(const Contestant& contestant) {
  return contestant.algorithm        ? std::string(info(*contestant.algorithm).name)
         : contestant.solver.empty() ? "nothing"
                                     : contestant.solver;
}

std::string label(const Contestant& contestant) {
  if (!contestant.algorithm) {
    return contestant.solver.empty() ? "Nothing moves" : contestant.solver;
  }
  const std::string title(info(*contestant.algorithm).label);
  std::string text = title + cells_of(*contestant.algorithm);
  if (contestant.open_regions) {
    // No region binds, so what it measures is the minimisation, which begins with the answer of the pass.
    text = "Material, multigrid, after " + title;
  } else if (contestant.equilibrium) {
    text = without_family(title) + " + equilibrium";
  } else if (contestant.sweeps > 0 && !contestant.calibrated) {
    text += ", " + counted(contestant.sweeps, "sweep");
  }
  if (contestant.calibrated) {
    text += ", calibrated" + (contestant.sweeps == 0 ? "" : " (" + std::to_string(contestant.sweeps) + " sweeps)");
  }
  return text + (contestant.limit > 0 ? ", " + counted(contestant.limit, "iteration") : "");
}

std::string note(const Contestant& contestant) {
  std::string text(contestant.open_regions ? to_material : contestant.equilibrium ? at_equilibrium : "");
  return contestant.calibrated ? text + (text.empty() ? "" : " ") + std::string(by_calibration) : text;
}

std::string note_in_words(std::string_view note) {
  return std::string(note) + (note == to_material      ? ": to the material, regions open"
                              : note == at_equilibrium ? ": relaxed to the equilibrium"
                                                       : ": calibrated on other drags");
}

Contestant curve_of(const Contestant& contestant) {
  Contestant curve = contestant;
  curve.limit = curve.sweeps = 0;
  return curve;
}

bool prepares(const Contestant& contestant) { return contestant.algorithm && info(*contestant.algorithm).elastic; }

bool takes_part_at_equilibrium(Algorithm algorithm) {
  return algorithm == Algorithm::exact || algorithm == Algorithm::natural_queue;
}

std::span<const int> limits_of(const Contestant& contestant) {
  static constexpr std::array limits{1, 2, 5, 10, 20, 50, 100, 200, 500, 1000};
  static constexpr std::size_t of_equilibrium = 8;  // equilibrium_iterations end it
  static_assert(limits[of_equilibrium - 1] == equilibrium_iterations);
  const bool obeys = contestant.algorithm && info(*contestant.algorithm).obeys_iterations;
  return contestant.equilibrium ? std::span<const int>(limits).first(of_equilibrium)
                                : std::span<const int>(limits).first(obeys ? limits.size() : 0);
}

Softness softness_of(const Contestant& contestant, const Softness& object) {
  if (contestant.open_regions) {
    constexpr LinkSoftness open{.compression = 0, .stretch = 1000, .shear = 1000};
    return {open, {}, EnergyKind::material, object.axes};
  }
  return contestant.calibrated ? Softness{*contestant.calibrated, {}, link_energy, object.axes} : object;
}

}  // namespace chainmail::report
