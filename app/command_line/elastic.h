#pragma once

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

}  // namespace chainmail::command_line
