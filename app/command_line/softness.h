#pragma once

#include <array>

#include "body/softness.h"
#include "command_line/common.h"

namespace chainmail::command_line {

/// The option for the kind of energy. Its help names the kind without the option.
CLI::Option* add_energy(CLI::App& app, EnergyKind usual);
/// Returns the kind of energy; `usual` without the option. Throws Error if it is not known.
EnergyKind energy_of(const CLI::Option* option, EnergyKind usual);

/// The options for the softness of all links, for the kind of energy, and for the axes of valid regions.
struct SoftnessArguments {
  std::array<CLI::Option*, softness_numbers.size()> numbers{};
  CLI::Option *energy = nullptr, *axes = nullptr;
};
SoftnessArguments add_softness(CLI::App& app);
/// Returns the softness of all links: the numbers of `usual`, where options override them. Without the option for it,
/// the energy is that of links if a number that only links have is given, else that of the material. Throws Error, with
/// the option, if a value is out of range or the kind of energy is not known.
Softness softness_of(const SoftnessArguments& arguments, const LinkSoftness& usual = {});

/// Returns the axes of the option for this mesh; those of the world without the option. Throws Error, with the option,
/// if the value is not one or does not fit the mesh. Warns, on standard error, if principal axes do not exist.
RegionAxes axes_of(const SoftnessArguments& arguments, const Mesh& mesh);

}  // namespace chainmail::command_line
