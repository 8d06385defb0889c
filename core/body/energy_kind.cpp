#include "body/energy_kind.h"

#include <algorithm>
#include <array>
#include <string>

#include "mesh/error.h"
#include "mesh/parameters.h"

namespace chainmail {
namespace {

constexpr std::array all_energy_kinds{
    EnergyKindInfo{EnergyKind::isotropic, "isotropic", "Isotropic",
                   "Each link resists motion along it and across it alike; the numbers of its stiffness do not count.",
                   parameters::lateral.default_value},
    EnergyKindInfo{EnergyKind::axial, "axial", "Axial",
                   "Each link resists motion along its rest vector, and across it in the share of its lateral "
                   "stiffness. It suits small rotations.",
                   0.03},
    EnergyKindInfo{
        EnergyKind::corotated, "corotated", "Co-rotated",
        "Each link is a spring, and resists motion across its rest vector turned with its surroundings: close "
        "to an elastic solid, also in large rotations.",
        parameters::lateral.default_value},
    EnergyKindInfo{EnergyKind::material, "material", "Material",
                   "The cells resist as an elastic material with Poisson's ratio does, and a surface in space as a "
                   "thin shell of it; nothing is calibrated. Where there are neither, it is that of co-rotated links.",
                   parameters::lateral.default_value}};
static_assert(all_energy_kinds[0].kind == EnergyKind(0) && all_energy_kinds[1].kind == EnergyKind(1) &&
                  all_energy_kinds[2].kind == EnergyKind(2) && all_energy_kinds[3].kind == EnergyKind(3),
              "info() finds a row by its kind");

}  // namespace

std::span<const EnergyKindInfo> energy_kinds() { return all_energy_kinds; }

const EnergyKindInfo& info(EnergyKind kind) { return all_energy_kinds[static_cast<std::size_t>(kind)]; }

EnergyKind energy_kind_of(std::string_view name) {
  const auto found = std::ranges::find(all_energy_kinds, name, &EnergyKindInfo::name);
  if (found != all_energy_kinds.end()) {
    return found->kind;
  }
  std::string names;
  for (const EnergyKindInfo& one : all_energy_kinds) {
    const bool is_last = &one == &all_energy_kinds.back();
    names += (names.empty() ? "" : is_last ? " or " : ", ") + std::string(one.name);
  }
  throw Error("energy", "there is no such kind of energy", "use " + names);
}

}  // namespace chainmail
