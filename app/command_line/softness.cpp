#include "command_line/softness.h"

#include <string>
#include <vector>

namespace chainmail::command_line {
namespace {

std::vector<std::string> energy_names() {
  std::vector<std::string> names;
  for (const EnergyKindInfo& one : energy_kinds()) {
    names.emplace_back(one.name);
  }
  return names;
}

}  // namespace

CLI::Option* add_energy(CLI::App& app) {
  std::string names;
  for (const std::string& name : energy_names()) {
    names += (names.empty() ? "" : "|") + name;
  }
  return add_value(app, "--energy", names,
                   "elastic energy that relaxation lowers; isotropic ignores lateral, stiffness and exponent [" +
                       std::string(info(standard_energy).name) + "]");
}

EnergyKind energy_of(const CLI::Option* option) {
  const auto name = value_of(option);
  if (!name) {
    return standard_energy;
  }
  check_word("--energy", *name, energy_names());
  return energy_kind_of(*name);
}

SoftnessArguments add_softness(CLI::App& app) {
  SoftnessArguments arguments;
  for (std::size_t i = 0; i < softness_numbers.size(); ++i) {
    arguments.numbers[i] = add_parameter(app, *softness_numbers[i].parameter);
  }
  arguments.energy = add_energy(app);
  return arguments;
}

Softness softness_of(const SoftnessArguments& arguments, const LinkSoftness& usual) {
  Softness softness{usual, {}};
  set_energy(softness, energy_of(arguments.energy));
  for (std::size_t i = 0; i < softness_numbers.size(); ++i) {
    if (arguments.numbers[i]->count() > 0) {
      softness.global.*softness_numbers[i].value = value_of(arguments.numbers[i], *softness_numbers[i].parameter);
    }
  }
  return softness;
}

}  // namespace chainmail::command_line
