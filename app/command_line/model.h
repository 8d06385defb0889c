#pragma once

#include <vector>

#include "chainmail/body.h"
#include "command_line/common.h"

namespace chainmail::command_line {

/// The options for methods of elasticity and free-form deformation.
struct ElasticArguments {
  CLI::Option *young = nullptr, *poisson = nullptr, *lattice = nullptr, *iterations = nullptr;
};
ElasticArguments add_elastic(CLI::App& app);
/// Adds only the options of the material.
ElasticArguments add_material(CLI::App& app);
/// Throws Error, with the option, if a value is out of range. The law is neo-Hookean.
api::Elasticity elastic_of(const ElasticArguments& arguments);

/// The options for the law of a material: one, or several.
struct StrainLawArguments {
  CLI::Option *materials = nullptr, *gent_limit = nullptr, *fung_exponent = nullptr;
};
/// Adds the options for the law of the object's own material.
StrainLawArguments add_strain_law(CLI::App& app);
/// Sets that law; neo-Hookean if none is named. Throws Error, with the option.
void read_own_law(const StrainLawArguments& arguments, api::Elasticity& elastic);
/// Adds the options for the materials of the reference solution.
StrainLawArguments add_strain_laws(CLI::App& app);
/// Returns the settings once with each law to compare with; neo-Hookean if none is named. Throws Error, with the
/// option.
std::vector<api::Elasticity> strain_laws_of(const StrainLawArguments& arguments, const api::Elasticity& elastic);

/// Returns the elements of `boundary` or of a layer, like `bottom`; nothing for any other word. Throws Error, with the
/// option, if the object has no boundary or layer with this name.
std::optional<std::vector<api::ElementId>> pins_by_name(const std::string& where, const std::string& word,
                                                        const api::Mesh& mesh);
/// Returns the elements of `--pins`, a layer or ids separated by commas, in ascending order. Throws Error if the option
/// is missing; `object` is the object's name for error messages.
std::vector<api::ElementId> pins_of(const CLI::Option* pins, const std::string& object, const api::Mesh& mesh);
CLI::Option* add_pins(CLI::App& app);
/// Returns all names of layers, separated by `|`.
std::string pin_names();

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
