#pragma once

#include <vector>

#include "chainmail/body.h"
#include "command_line/common.h"

namespace chainmail::command_line {

/// The options for the softness of all links, for the kind of energy, and for the axes of valid regions.
struct SoftnessArguments {
  std::vector<CLI::Option*> numbers;
  CLI::Option *energy = nullptr, *axes = nullptr;
};
SoftnessArguments add_softness(CLI::App& app);

/// The softness of all links that have none of their own, and the kind of energy.
struct SoftnessChoice {
  api::LinkSoftness links;
  api::EnergyKind energy;

  void apply_to(api::Body& body) const;
};
/// Returns the numbers of `usual`, where options override them. Without the option for it, the energy is that of links
/// if a number that only links have is given, else that of the material. Throws Error, with the option, if a value is
/// out of range or the kind of energy is not known.
SoftnessChoice softness_of(const SoftnessArguments& arguments, const api::LinkSoftness& usual = {});

/// Turns the axes of a body as the option says. Throws Error, with the option, if its value is not one or does not fit
/// the mesh. Warns, on standard error, if principal axes do not exist.
void turn_axes(const SoftnessArguments& arguments, api::Body& body);

}  // namespace chainmail::command_line
