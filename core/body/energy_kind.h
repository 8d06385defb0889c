#pragma once

#include <span>
#include <string_view>

namespace chainmail {

/// The elastic energy that relaxation lowers: of the links, or of the material of the cells or of a surface in space.
/// Each kind has one entry in the table of energy_kind.cpp; the formulas are in equilibrium/link_energy.h,
/// equilibrium/material_energy.h and equilibrium/surface_energy.h.
enum class EnergyKind { isotropic, axial, corotated, material };

/// The energy of a new object. Objects without cells and faces, and sweeps, have that of links in its place.
inline constexpr EnergyKind standard_energy = EnergyKind::material;
/// The energy of links that comes closest to a material. Recorded moves and files that name no energy mean this one,
/// and calibration adjusts it.
inline constexpr EnergyKind link_energy = EnergyKind::corotated;

/// Returns the kind of energy that links have if that of the material cannot be used.
constexpr EnergyKind energy_of_links(EnergyKind kind) { return kind == EnergyKind::material ? link_energy : kind; }

/// One row of the table: everything that other code knows about a kind of energy.
struct EnergyKindInfo {
  EnergyKind kind;
  std::string_view name;   // on the command line and in files
  std::string_view label;  // in the window
  std::string_view help;   // one sentence
  double lateral;          // lateral stiffness that suits most objects
};

/// All kinds, in the order of the constants.
std::span<const EnergyKindInfo> energy_kinds();
const EnergyKindInfo& info(EnergyKind kind);
/// Returns the kind of this name. Throws Error, with all names, if there is none.
EnergyKind energy_kind_of(std::string_view name);

}  // namespace chainmail
