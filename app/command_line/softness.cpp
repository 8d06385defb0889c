#include "command_line/softness.h"

#include <iostream>
#include <string>
#include <vector>

#include "command_line/script.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail::command_line {
namespace {

std::vector<std::string> energy_names() {
  std::vector<std::string> names;
  for (const EnergyKindInfo& one : energy_kinds()) {
    names.emplace_back(one.name);
  }
  return names;
}

/// Returns the kind of energy without its option: that of links if a number is given that the material ignores.
EnergyKind usual_energy(const SoftnessArguments& arguments, const LinkSoftness& usual) {
  for (std::size_t i = region_numbers; i < softness_numbers.size(); ++i) {
    const auto value = softness_numbers[i].value;
    if (arguments.numbers[i]->count() > 0 || usual.*value != LinkSoftness().*value) {
      return link_energy;
    }
  }
  return standard_energy;
}

}  // namespace

CLI::Option* add_energy(CLI::App& app, EnergyKind usual) {
  std::string names;
  for (const std::string& name : energy_names()) {
    names += (names.empty() ? "" : "|") + name;
  }
  return add_value(app, "--energy", names,
                   "elastic energy that relaxation lowers, of links or of the material of cells; isotropic ignores " +
                       softness_names(", ", region_numbers, softness_numbers.size() - 1) + " and " +
                       std::string(softness_numbers.back().parameter->name) + ", material too, at equilibrium [" +
                       std::string(info(usual).name) + "]");
}

EnergyKind energy_of(const CLI::Option* option, EnergyKind usual) {
  const auto name = value_of(option);
  if (!name) {
    return usual;
  }
  check_word("--energy", *name, energy_names());
  return energy_kind_of(*name);
}

RegionAxes axes_of(const SoftnessArguments& arguments, const Mesh& mesh) {
  const auto text = value_of(arguments.axes);
  if (!text || *text == "axes") {
    return {};
  }
  if (*text == "object") {
    const PrincipalAxes principal = principal_axes(mesh);
    if (!principal.are_unique) {
      std::cerr << "chainmail: --frame object: the object has equal spreads, so not all of its principal axes exist; "
                   "the axes nearest to those of the world are used. Give a rotation, such as z:45, instead\n";
    }
    return principal.axes;
  }
  try {
    RegionAxes axes(AxesKind::given, parse_rotation("--frame", *text).vector());
    check(axes, mesh);
    return axes;
  } catch (const Error& error) {
    const bool is_rotation = text->find(':') != std::string::npos;
    throw is_rotation ? Error("--frame", error.problem(), error.remedy())
                      : Error("--frame", "'" + printable(*text) + "' is not known",
                              "use axes, object, or a rotation such as z:45 or 1,2,3:30");
  }
}

SoftnessArguments add_softness(CLI::App& app) {
  SoftnessArguments arguments;
  for (std::size_t i = 0; i < softness_numbers.size(); ++i) {
    arguments.numbers[i] = add_parameter(app, *softness_numbers[i].parameter);
  }
  arguments.energy = add_energy(app, standard_energy);
  arguments.axes = add_value(app, "--frame", "axes|object|AXIS:DEGREES",
                             "valid regions lie along the axes of the world, the principal axes of the object at rest, "
                             "or axes turned by a rotation; AXIS is x, y, z or X,Y,Z [axes]");
  return arguments;
}

Softness softness_of(const SoftnessArguments& arguments, const LinkSoftness& usual) {
  Softness softness{usual, {}};
  set_energy(softness, energy_of(arguments.energy, usual_energy(arguments, usual)));
  for (std::size_t i = 0; i < softness_numbers.size(); ++i) {
    if (arguments.numbers[i]->count() > 0) {
      softness.global.*softness_numbers[i].value = value_of(arguments.numbers[i], *softness_numbers[i].parameter);
    }
  }
  return softness;
}

}  // namespace chainmail::command_line
