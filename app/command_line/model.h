#pragma once

#include <array>

#include "body/softness.h"
#include "command_line/common.h"

namespace chainmail::command_line {

// The options that say how an object deforms: softness, energy, axes of regions, elasticity, and pins.

/// The option for the kind of energy. Its help names the kind without the option.
CLI::Option* add_energy(CLI::App& app, EnergyKind usual);
/// Returns the kind of energy; `usual` without the option. Throws Error if it is not known.
EnergyKind energy_of(const CLI::Option* option, EnergyKind usual);

/// The options for the softness of all links, for the kind of energy, and for the axes of valid regions.
struct SoftnessArguments {
  std::array<CLI::Option*, softness_numbers.size()> numbers{};
  CLI::Option *energy = nullptr, *axes = nullptr;
};
SoftnessArguments add_softness(CLI::App& app);
/// Returns the softness of all links, with the numbers of `usual`, where options override them. Without the option for
/// it, the energy is that of links if a number that only links have is given, else that of the material. Throws Error,
/// with the option, if a value is out of range or the kind of energy is not known.
Softness softness_of(const SoftnessArguments& arguments, const LinkSoftness& usual = {});
/// Returns the axes of the option for this mesh; those of the world without the option. Throws Error, with the option,
/// if the value is not one or does not fit the mesh. Warns, on standard error, if principal axes do not exist.
RegionAxes axes_of(const SoftnessArguments& arguments, const Mesh& mesh);

/// The options for methods of elasticity and free-form deformation.
struct ElasticArguments {
  CLI::Option *young = nullptr, *poisson = nullptr, *lattice = nullptr, *iterations = nullptr;
};
ElasticArguments add_elastic(CLI::App& app);
/// Adds only the options of the material.
ElasticArguments add_material(CLI::App& app);
/// Throws Error, with the option, if a value is out of range. The law is neo-Hookean.
ElasticOptions elastic_of(const ElasticArguments& arguments);

/// The options for the law of a material: one, or several.
struct StrainLawArguments {
  CLI::Option *materials = nullptr, *gent_limit = nullptr, *fung_exponent = nullptr;
};
/// Adds the options for the law of the object's own material.
StrainLawArguments add_strain_law(CLI::App& app);
/// Returns that law; neo-Hookean if none is named. Throws Error, with the option.
StrainLaw own_law_of(const StrainLawArguments& arguments, const Material& material);
/// Adds the options for the materials of the reference solution.
StrainLawArguments add_strain_laws(CLI::App& app);
/// Returns the laws to compare with; neo-Hookean if none is named. Throws Error, with the option.
std::vector<StrainLaw> strain_laws_of(const StrainLawArguments& arguments, const Material& material);

/// Returns the elements of `boundary` or of a layer, like `bottom`; nothing for any other word. Throws Error, with the
/// option, if the object has no boundary or layer with this name.
std::optional<std::vector<ElementId>> pins_by_name(const std::string& where, const std::string& word, const Mesh& mesh);
/// Returns the elements of `--pins`, a layer or ids separated by commas, in ascending order. Throws Error if the option
/// is missing; `object` is the object's name for error messages.
std::vector<ElementId> pins_of(const CLI::Option* pins, const std::string& object, const Mesh& mesh);
CLI::Option* add_pins(CLI::App& app);
/// Returns all names of layers, separated by `|`.
std::string pin_names();

}  // namespace chainmail::command_line
