#include "command_line/model.h"

#include <algorithm>
#include <iostream>

#include "command_line/script.h"
#include "mesh/layers.h"

namespace chainmail::command_line {
namespace {

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

Choices<EnergyKind> energies() {
  Choices<EnergyKind> all;
  for (const EnergyKindInfo& one : energy_kinds()) {
    all.emplace_back(one.name, one.kind);
  }
  return all;
}

Choices<StrainLaw::Kind> laws_by_name() {
  Choices<StrainLaw::Kind> all;
  for (const StrainLaw::Kind kind : strain_laws) {
    all.emplace_back(name(kind), kind);
  }
  return all;
}

std::array<std::uint32_t, 3> lattice_of(const std::string& text) {
  std::vector<std::uint32_t> counts;
  for (const std::string_view word : split(text, 'x')) {
    const auto count = parse_count(word);
    if (!count || counts.size() == 3) {
      throw Error("--lattice", in_quotes(text) + " is not a number of control points",
                  "write one number for all axes, or one for each, as 4x4x4");
    }
    counts.push_back(*count);
  }
  counts.resize(3, counts.back());  // a plane has no third axis
  return {counts[0], counts[1], counts[2]};
}

std::uint32_t iterations_of(const std::string& text) {
  const auto count = parse_count(text);
  if (!count) {
    throw Error("--iterations", in_quotes(text) + " is not a number of iterations",
                "use " + range_of(parameters::iterations));
  }
  return *count;
}

StrainLawArguments add_laws(CLI::App& app, const std::string& type, const std::string& help) {
  return {add_value(app, "--material", type, help + " [neo-hookean]"), add_parameter(app, parameters::gent_limit),
          add_parameter(app, parameters::fung_exponent)};
}

}  // namespace

CLI::Option* add_energy(CLI::App& app, EnergyKind usual) {
  return add_choice(app, "--energy", energies(),
                    "elastic energy that relaxation lowers, of links or of the material of cells; isotropic ignores " +
                        softness_names(", ", region_numbers, softness_numbers.size() - 1) + " and " +
                        std::string(softness_numbers.back().parameter->name) + ", material too, at equilibrium [" +
                        std::string(info(usual).name) + "]");
}

EnergyKind energy_of(const CLI::Option* option, EnergyKind usual) { return choice_of(option, energies(), usual); }

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
  Softness softness = standard_softness();
  softness.global = usual;
  set_energy(softness, energy_of(arguments.energy, usual_energy(arguments, usual)));
  for (std::size_t i = 0; i < softness_numbers.size(); ++i) {
    if (arguments.numbers[i]->count() > 0) {
      softness.global.*softness_numbers[i].value = value_of(arguments.numbers[i], *softness_numbers[i].parameter);
    }
  }
  return softness;
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
    return axes_after(parse_rotation("--frame", *text), mesh);
  } catch (const Error& error) {
    const bool is_rotation = text->find(':') != std::string::npos;
    throw is_rotation ? error.at("--frame")
                      : Error("--frame", "'" + printable(*text) + "' is not known",
                              "use axes, object, or a rotation such as z:45 or 1,2,3:30");
  }
}

ElasticArguments add_material(CLI::App& app) {
  return {add_parameter(app, parameters::young), add_parameter(app, parameters::poisson), nullptr, nullptr};
}

ElasticArguments add_elastic(CLI::App& app) {
  ElasticArguments arguments = add_material(app);
  arguments.lattice = add_value(app, "--lattice", "N|NxN[xN]", help_of(parameters::lattice));
  arguments.iterations = add_parameter(app, parameters::iterations);
  return arguments;
}

ElasticOptions elastic_of(const ElasticArguments& arguments) {
  ElasticOptions options;
  options.material = {number_of(arguments.young, options.material.young),
                      number_of(arguments.poisson, options.material.poisson)};
  if (const auto lattice = value_of(arguments.lattice)) {
    options.lattice = lattice_of(*lattice);
  }
  if (const auto iterations = value_of(arguments.iterations)) {
    options.iterations = iterations_of(*iterations);
  }
  in_options({{"young", "--young"}, {"poisson", "--poisson"}, {"lattice", "--lattice"}, {"iterations", "--iterations"}},
             [&] { check(options); });
  return options;
}

StrainLawArguments add_strain_laws(CLI::App& app) {
  return add_laws(app, "M,M,…",
                  "materials of the reference solution: neo-hookean, or gent and fung, which stiffen as they are "
                  "stretched");
}

StrainLawArguments add_strain_law(CLI::App& app) {
  return add_laws(app, joined_words(names_of(laws_by_name()), "|"),
                  "law of the material, for relaxation to it and for the algorithm neo-hookean; gent and fung stiffen "
                  "as they are stretched");
}

StrainLaw own_law_of(const StrainLawArguments& arguments, const Material& material) {
  const std::vector<StrainLaw> laws = strain_laws_of(arguments, material);
  if (laws.size() > 1) {
    throw Error("--material", "it names several materials", "name one");
  }
  return laws.front();
}

std::vector<StrainLaw> strain_laws_of(const StrainLawArguments& arguments, const Material& material) {
  const auto names = names_of(laws_by_name());
  std::vector<StrainLaw> laws;
  for (const std::string& word : words_of("--material", value_of(arguments.materials).value_or(names.front()))) {
    check_word("--material", word, names);
    laws.push_back({strain_law_of(word), value_of(arguments.gent_limit, parameters::gent_limit),
                    value_of(arguments.fung_exponent, parameters::fung_exponent)});
    in_options({{"gent-limit", "--gent-limit"}, {"fung-exponent", "--fung-exponent"}},
               [&] { check(laws.back(), material); });
  }
  for (const auto& [option, kind] : {std::pair(arguments.gent_limit, StrainLaw::Kind::gent),
                                     std::pair(arguments.fung_exponent, StrainLaw::Kind::fung)}) {
    if (option->count() > 0 && std::ranges::count(laws, kind, &StrainLaw::kind) == 0) {
      throw Error(option->get_name(), "the material '" + name(kind) + "' does not take part",
                  "add --material " + name(kind));
    }
  }
  return laws;
}

std::optional<std::vector<ElementId>> pins_by_name(const std::string& where, const std::string& word,
                                                   const Mesh& mesh) {
  const ObjectSide* side = find_side(word);
  if (side == nullptr && word != "boundary") {
    return std::nullopt;
  }
  std::vector<ElementId> pins = side == nullptr ? boundary(mesh) : layer(mesh, *side);
  if (pins.empty()) {
    throw side == nullptr
        ? Error(where, "the object is closed and has no boundary", "pin a layer, like bottom, or elements by id")
        : Error(where, "the object does not extend along that axis", "pin another layer, or elements by id");
  }
  return pins;
}

std::vector<ElementId> pins_of(const CLI::Option* option, const std::string& object, const Mesh& mesh) {
  const auto list = value_of(option);
  if (!list) {
    throw Error(object, "it has no pins, so physics has no solution",
                "add --pins bottom, --pins boundary, or --pins ID,ID,…");
  }
  if (auto pins = pins_by_name("--pins", *list, mesh)) {
    return *std::move(pins);
  }
  std::vector<ElementId> pins;
  for (const std::string& word : words_of("--pins", *list)) {
    const auto id = parse_count(word);
    if (!id) {
      throw Error("--pins", in_quotes(word) + " is not an element's id",
                  "use ids from 0, separated by commas, or " + pin_names());
    }
    if (*id >= mesh.element_count()) {
      throw Error("--pins", object + " has no element " + word,
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
  for (const ObjectSide& side : object_sides) {
    names += std::string(side.name) + "|";
  }
  return names + "boundary";
}

}  // namespace chainmail::command_line
