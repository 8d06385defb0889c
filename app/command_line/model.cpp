#include "command_line/model.h"

#include <iostream>

#include "mesh/layers.h"

namespace chainmail::command_line {
namespace {

/// Returns the kind of energy without its option: that of links if a number is given that the material ignores.
EnergyKind usual_energy(const SoftnessArguments& arguments, const LinkSoftness& usual) {
  for (std::size_t i = region_numbers; i < softness_numbers.size(); ++i) {
    const auto value = softness_numbers[i].value;
    if (arguments.numbers[i] || usual.*value != LinkSoftness().*value) {
      return link_energy;
    }
  }
  return standard_energy;
}

Choices<StrainLaw::Kind> laws_by_name() {
  Choices<StrainLaw::Kind> all;
  for (const StrainLaw::Kind kind : strain_laws) {
    all.emplace_back(name(kind), kind);
  }
  return all;
}

void add_law(Options& options, const std::string& type, const std::string& help, StrainLawArguments& arguments) {
  arguments.app = &options.app();
  options.add("--material", type, help + " [neo-hookean]", arguments.materials);
}

/// Reads the name of a layer, or ids separated by commas.
PinnedElements parse_pins(const std::string& where, const std::string& text) {
  if (is_side(text)) {
    return {text, {}};
  }
  PinnedElements pins;
  for (const std::string& word : words_of(where, text)) {
    const auto id = parse_count(word);
    require(id.has_value(), where, in_quotes(word) + " is not an element's id",
            "use ids from 0, separated by commas, or " + pin_names());
    pins.ids.push_back(*id);
  }
  std::ranges::sort(pins.ids);
  return pins;
}

/// Returns the text of --frame if it can be one.
std::string parse_frame(const std::string& where, const std::string& text) {
  if (text != "axes" && text != "object") {
    require(text.find(':') != std::string::npos, where, in_quotes(text) + " is not known",
            "use axes, object, or a rotation such as z:45 or 1,2,3:30");
    parse_rotation(where, text);
  }
  return text;
}

}  // namespace

// Softness

void add_energy(Options& options, const std::string& usual, std::optional<EnergyKind>& energy) {
  options.add("--energy", choices_of(energy_kinds(), &EnergyKindInfo::kind),
              "elastic energy that relaxation lowers, of links or of the material of cells; isotropic ignores " +
                  softness_names(", ", region_numbers, softness_numbers.size() - 1) + " and " +
                  std::string(softness_numbers.back().parameter->name) + ", material too, at equilibrium [" + usual +
                  "]",
              energy);
}

void add_softness(Options& options, SoftnessArguments& arguments) {
  for (std::size_t i = 0; i < softness_numbers.size(); ++i) {
    options.add(*softness_numbers[i].parameter, arguments.numbers[i]);
  }
  add_energy(options,
             std::string(info(standard_energy).name) + "; " + std::string(info(link_energy).name) +
                 " if one of these numbers is given",
             arguments.energy);
  options.add("--frame", "axes|object|AXIS:DEGREES",
              "valid regions lie along the axes of the world, the principal axes of the object at rest, "
              "or axes turned by a rotation; AXIS is x, y, z or X,Y,Z [axes]",
              arguments.axes, parse_frame);
}

Softness softness_of(const SoftnessArguments& arguments, const LinkSoftness& usual) {
  Softness softness = standard_softness();
  softness.global = usual;
  set_energy(softness, arguments.energy.value_or(usual_energy(arguments, usual)));
  for (std::size_t i = 0; i < softness_numbers.size(); ++i) {
    double& number = softness.global.*softness_numbers[i].value;
    number = arguments.numbers[i].value_or(number);
  }
  return softness;
}

RegionAxes axes_of(const SoftnessArguments& arguments, const Mesh& mesh) {
  const std::string text = arguments.axes.value_or("axes");
  if (text == "axes") {
    return {};
  }
  if (text == "object") {
    const PrincipalAxes principal = principal_axes(mesh);
    if (!principal.are_unique) {
      std::cerr << "chainmail: --frame object: the object has equal spreads, so not all of its principal axes exist; "
                   "the axes nearest to those of the world are used. Give a rotation, such as z:45, instead\n";
    }
    return principal.axes;
  }
  return error_at("--frame", [&] { return axes_after(parse_rotation("--frame", text), mesh); });
}

Rotation parse_rotation(const std::string& where, std::string_view text) {
  const std::size_t mark = text.find(':');
  const std::string_view axis = text.substr(0, mark);
  require(mark != std::string_view::npos, where, "it has no axis or no angle",
          "write AXIS:DEGREES, such as z:30 or 0,1,1:30");
  Rotation rotation{Point::Zero(), parse_number_of(where, text.substr(mark + 1))};
  if (const std::size_t k = std::string_view("xyz").find(axis); axis.size() == 1 && k != std::string_view::npos) {
    rotation.axis[int(k)] = 1;
    return rotation;
  }
  require(std::ranges::count(axis, ',') == 2, where, in_quotes(axis) + " is not an axis",
          "use x, y, z, or three coordinates");
  rotation.axis = Point(parse_coordinates(where, axis).data());
  require(rotation.axis != Point::Zero(), where, "the rotation has no axis: all its coordinates are 0",
          "use x, y, z, or other coordinates");
  return rotation;
}

std::vector<double> parse_coordinates(const std::string& where, std::string_view text) {
  std::vector<double> coordinates;
  for (const std::string_view number : split(text)) {
    coordinates.push_back(parse_number_of(where, number));
    require(coordinates.size() <= 3, where, "it has more than three coordinates", "write X[,Y[,Z]]");
  }
  return coordinates;
}

// Elasticity

void add_strain_laws(Options& options, ElasticOptions& elastic, StrainLawArguments& arguments) {
  add_law(options, "M,M,…",
          "materials of the reference solution: neo-hookean, or gent and fung, which stiffen as they are stretched",
          arguments);
  for (const Member<ElasticOptions>& member : members_of<ElasticOptions>) {
    if (is_of_law(member)) {
      options.add(member, elastic);
    }
  }
}

void add_elastic(Options& options, ElasticOptions& elastic, StrainLawArguments& arguments) {
  for (const Member<ElasticOptions>& member : members_of<ElasticOptions>) {
    if (member.number) {
      options.add(member, elastic);
    } else {
      add_law(options, joined_words(names_of(laws_by_name()), "|"),
              "law of the material, for relaxation to it and for the algorithm neo-hookean; gent and fung stiffen "
              "as they are stretched",
              arguments);
    }
  }
}

std::vector<StrainLaw> strain_laws_of(const StrainLawArguments& arguments, const ElasticOptions& elastic) {
  std::vector<StrainLaw> laws;
  for (const std::string& word :
       words_of("--material", arguments.materials.value_or(name(StrainLaw::Kind::neo_hookean)))) {
    laws.push_back(elastic.law);
    laws.back().kind = chosen("--material", word, laws_by_name());
    const auto number = number_of(laws.back().kind);
    error_at(number ? option_of(*number) : "--material", [&] { check(laws.back(), elastic.material); });
  }
  for (const StrainLaw::Kind kind : strain_laws) {
    const auto number = number_of(kind);
    if (number && arguments.app->count(option_of(*number)) > 0) {
      require(std::ranges::count(laws, kind, &StrainLaw::kind) > 0, option_of(*number),
              "the material '" + name(kind) + "' does not take part", "add --material " + name(kind));
    }
  }
  return laws;
}

// Pins

std::vector<ElementId> pins_of(const std::optional<PinnedElements>& pins, const std::string& object, const Mesh& mesh) {
  require(pins.has_value(), object, "it has no pins, so physics has no solution",
          "add --pins bottom, --pins boundary, or --pins ID,ID,…");
  if (!pins->layer.empty()) {
    return error_at("--pins", [&] { return elements_at(mesh, pins->layer); });
  }
  for (const ElementId id : pins->ids) {
    require(id < mesh.element_count(), "--pins", object + " has no element " + std::to_string(id),
            "use an id from 0 to " + std::to_string(mesh.element_count() - 1));
  }
  return pins->ids;
}

void add_pins(Options& options, std::optional<PinnedElements>& pins) {
  options.add("--pins", "LAYER|ID,ID,…", "pinned elements: a layer (" + pin_names() + ") or ids", pins, parse_pins);
}

std::string pin_names() {
  std::string names;
  for (const ObjectSide& side : object_sides) {
    names += std::string(side.name) + "|";
  }
  return names + "boundary";
}

}  // namespace chainmail::command_line
