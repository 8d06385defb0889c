#include "command_line/softness.h"

#include <iostream>
#include <string>

#include "command_line/script.h"

namespace chainmail::command_line {
namespace {

/// Returns the kind of energy without its option: that of links if a number is given that the material ignores.
api::EnergyKind usual_energy(const SoftnessArguments& arguments, const api::LinkSoftness& usual) {
  const auto numbers = api::softness_numbers();
  for (std::size_t i = region_numbers; i < numbers.size(); ++i) {
    const auto value = numbers[i].value;
    if (arguments.numbers[i]->count() > 0 || usual.*value != api::LinkSoftness().*value) {
      return api::link_energy;
    }
  }
  return api::EnergyKind::material;
}

}  // namespace

SoftnessArguments add_softness(CLI::App& app) {
  SoftnessArguments arguments;
  for (const api::SoftnessNumber& one : api::softness_numbers()) {
    arguments.numbers.push_back(add_parameter(app, api::parameter(one.name)));
  }
  arguments.energy = add_energy(app, api::EnergyKind::material);
  arguments.axes = add_value(app, "--frame", "axes|object|AXIS:DEGREES",
                             "valid regions lie along the axes of the world, the principal axes of the object at rest, "
                             "or axes turned by a rotation; AXIS is x, y, z or X,Y,Z [axes]");
  return arguments;
}

void SoftnessChoice::apply_to(api::Body& body) const {
  body.set_energy(energy);
  body.set_softness(links);
}

SoftnessChoice softness_of(const SoftnessArguments& arguments, const api::LinkSoftness& usual) {
  api::Body model(api::make_line(2));  // knows the lateral stiffness that suits a kind of energy
  model.set_softness(usual);
  model.set_energy(energy_of(arguments.energy, usual_energy(arguments, usual)));
  SoftnessChoice choice{model.softness(), model.energy()};
  const auto numbers = api::softness_numbers();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (arguments.numbers[i]->count() > 0) {
      choice.links.*numbers[i].value = value_of(arguments.numbers[i], api::parameter(numbers[i].name));
    }
  }
  return choice;
}

void turn_axes(const SoftnessArguments& arguments, api::Body& body) {
  const auto text = value_of(arguments.axes);
  if (!text || *text == "axes") {
    return;
  }
  if (*text == "object") {
    if (!body.set_frame_of_object()) {
      std::cerr << "chainmail: --frame object: the object has equal spreads, so not all of its principal axes exist; "
                   "the axes nearest to those of the world are used. Give a rotation, such as z:45, instead\n";
    }
    return;
  }
  try {
    body.set_frame(parse_rotation("--frame", *text));
  } catch (const api::Error& error) {
    const bool is_rotation = text->find(':') != std::string::npos;
    throw is_rotation ? api::Error("--frame", error.problem(), error.remedy())
                      : api::Error("--frame", "'" + api::printable(*text) + "' is not known",
                                   "use axes, object, or a rotation such as z:45 or 1,2,3:30");
  }
}

}  // namespace chainmail::command_line
