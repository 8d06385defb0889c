#pragma once

#include <array>

#include "command_line/common.h"
#include "solve/softness.h"

namespace chainmail::command_line {

/// The option for the kind of energy.
CLI::Option* add_energy(CLI::App& app);
/// Returns the kind of energy; the standard one without the option. Throws Error if it is not known.
EnergyKind energy_of(const CLI::Option* option);

/// The options for the softness of all links and for the kind of energy.
struct SoftnessArguments {
  std::array<CLI::Option*, softness_numbers.size()> numbers{};
  CLI::Option* energy = nullptr;
};
SoftnessArguments add_softness(CLI::App& app);
/// Returns the softness of all links: the numbers of `usual`, where options override them. Throws Error, with the
/// option, if a value is out of range or the kind of energy is not known.
Softness softness_of(const SoftnessArguments& arguments, const LinkSoftness& usual = {});

}  // namespace chainmail::command_line
