#include "command_line/model.h"

#include <algorithm>
#include <iostream>
#include <string>

#include "command_line/script.h"

namespace chainmail::command_line {

namespace {

std::array<std::uint32_t, 3> lattice_of(const std::string& text) {
  std::array<std::uint32_t, 3> counts{};
  std::size_t axis = 0;
  for (std::size_t begin = 0; begin <= text.size(); ++axis) {
    const std::size_t end = std::min(text.find('x', begin), text.size());
    const auto count = api::parse_count(text.substr(begin, end - begin));
    if (!count || axis == 3) {
      throw api::Error("--lattice", api::in_quotes(text) + " is not a number of control points",
                       "write one number for all axes, or one for each, as 4x4x4");
    }
    counts[axis] = *count;
    begin = end + 1;
  }
  if (axis == 1) {
    counts = {counts[0], counts[0], counts[0]};
  } else if (axis == 2) {
    counts[2] = counts[1];  // a plane has no third axis
  }
  return counts;
}

std::uint32_t iterations_of(const std::string& text) {
  const auto count = api::parse_count(text);
  if (!count) {
    throw api::Error("--iterations", api::in_quotes(text) + " is not a number of iterations",
                     "use " + api::range_of(api::parameter("iterations")));
  }
  return *count;
}

}  // namespace

ElasticArguments add_material(CLI::App& app) {
  return {add_parameter(app, api::parameter("young")), add_parameter(app, api::parameter("poisson")), nullptr, nullptr};
}

ElasticArguments add_elastic(CLI::App& app) {
  ElasticArguments arguments = add_material(app);
  arguments.lattice = add_value(app, "--lattice", "N|NxN[xN]", help_of(api::parameter("lattice")));
  arguments.iterations = add_parameter(app, api::parameter("iterations"));
  return arguments;
}

api::Elasticity elastic_of(const ElasticArguments& arguments) {
  api::Elasticity elastic;
  if (const auto young = value_of(arguments.young)) {
    elastic.young = parse_number_of("--young", *young);
  }
  if (const auto poisson = value_of(arguments.poisson)) {
    elastic.poisson = parse_number_of("--poisson", *poisson);
  }
  if (const auto lattice = arguments.lattice == nullptr ? std::nullopt : value_of(arguments.lattice)) {
    elastic.control_points = lattice_of(*lattice);
  }
  if (const auto iterations = arguments.iterations == nullptr ? std::nullopt : value_of(arguments.iterations)) {
    elastic.iterations = iterations_of(*iterations);
  }
  in_options({{"young", "--young"}, {"poisson", "--poisson"}, {"lattice", "--lattice"}, {"iterations", "--iterations"}},
             [&] { api::check(elastic); });
  return elastic;
}

StrainLawArguments add_strain_laws(CLI::App& app) {
  return {add_value(app, "--material", "M,M,…",
                    "materials of the reference solution: neo-hookean, or gent and fung, which stiffen as they are "
                    "stretched [neo-hookean]"),
          add_parameter(app, api::parameter("gent-limit")), add_parameter(app, api::parameter("fung-exponent"))};
}

StrainLawArguments add_strain_law(CLI::App& app) {
  return {
      add_value(app, "--material", "neo-hookean|gent|fung",
                "law of the material, for relaxation to it and for the algorithm neo-hookean; gent and fung stiffen "
                "as they are stretched [neo-hookean]"),
      add_parameter(app, api::parameter("gent-limit")), add_parameter(app, api::parameter("fung-exponent"))};
}

void read_own_law(const StrainLawArguments& arguments, api::Elasticity& elastic) {
  const auto laws = strain_laws_of(arguments, elastic);
  if (laws.size() > 1) {
    throw api::Error("--material", "it names several materials", "name one");
  }
  elastic = laws.front();
}

std::vector<api::Elasticity> strain_laws_of(const StrainLawArguments& arguments, const api::Elasticity& elastic) {
  std::vector<api::Elasticity> laws;
  const std::vector<std::string> names{api::name_of(api::StrainLaw::neo_hookean), api::name_of(api::StrainLaw::gent),
                                       api::name_of(api::StrainLaw::fung)};
  for (const std::string& word : words_of("--material", value_of(arguments.materials).value_or(names[0]))) {
    check_word("--material", word, names);
    laws.push_back(elastic);
    laws.back().law = api::StrainLaw(std::ranges::find(names, word) - names.begin());
    laws.back().gent_limit = value_of(arguments.gent_limit, api::parameter("gent-limit"));
    laws.back().fung_exponent = value_of(arguments.fung_exponent, api::parameter("fung-exponent"));
    in_options({{"gent-limit", "--gent-limit"}, {"fung-exponent", "--fung-exponent"}},
               [&] { api::check(laws.back()); });
  }
  for (const auto& [option, law] : {std::pair(arguments.gent_limit, api::StrainLaw::gent),
                                    std::pair(arguments.fung_exponent, api::StrainLaw::fung)}) {
    if (option->count() > 0 && std::ranges::count(laws, law, &api::Elasticity::law) == 0) {
      throw api::Error(option->get_name(), "the material '" + api::name_of(law) + "' does not take part",
                       "add --material " + api::name_of(law));
    }
  }
  return laws;
}

std::optional<std::vector<api::ElementId>> pins_by_name(const std::string& where, const std::string& word,
                                                        const api::Mesh& mesh) {
  const auto sides = api::side_names();
  if (std::ranges::find(sides, word) == sides.end()) {
    return std::nullopt;
  }
  try {
    return mesh.side(word);
  } catch (const api::Error& error) {
    throw api::Error(
        where, error.problem(),
        word == "boundary" ? "pin a layer, like bottom, or elements by id" : "pin another layer, or elements by id");
  }
}

std::vector<api::ElementId> pins_of(const CLI::Option* option, const std::string& object, const api::Mesh& mesh) {
  const auto list = value_of(option);
  if (!list) {
    throw api::Error(object, "it has no pins, so physics has no solution",
                     "add --pins bottom, --pins boundary, or --pins ID,ID,…");
  }
  if (auto pins = pins_by_name("--pins", *list, mesh)) {
    return *std::move(pins);
  }
  std::vector<api::ElementId> pins;
  for (const std::string& word : words_of("--pins", *list)) {
    const auto id = api::parse_count(word);
    if (!id) {
      throw api::Error("--pins", api::in_quotes(word) + " is not an element's id",
                       "use ids from 0, separated by commas, or " + pin_names());
    }
    if (*id >= mesh.element_count()) {
      throw api::Error("--pins", object + " has no element " + word,
                       "use an id from 0 to " + std::to_string(mesh.element_count() - 1));
    }
    pins.push_back(*id);
  }
  std::ranges::sort(pins);
  return pins;
}

CLI::Option* add_pins(CLI::App& app) {
  return add_value(app, "--pins", "LAYER|ID,ID,…", "pinned elements: a layer (" + pin_names() + ") or ids");
}

std::string pin_names() {
  std::string names;
  for (const std::string_view side : api::side_names()) {
    names += (names.empty() ? "" : "|") + std::string(side);
  }
  return names;
}

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
