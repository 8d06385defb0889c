#pragma once

#include <array>

#include "body/handle.h"
#include "body/softness.h"
#include "command_line/common.h"

namespace chainmail::command_line {

// The options that say how an object deforms: softness, energy, axes of regions, elasticity, and pins.

/// Adds the option for the kind of energy. Its help gives `usual` as the default.
void add_energy(Options& options, const std::string& usual, std::optional<EnergyKind>& energy);

/// The softness of all links, the kind of energy, and the axes of valid regions.
struct SoftnessArguments {
  std::array<std::optional<double>, softness_numbers.size()> numbers;
  std::optional<EnergyKind> energy;
  std::optional<std::string> axes;
};
void add_softness(Options& options, SoftnessArguments& arguments);
/// Returns the softness of all links, with the numbers of `usual`, where options override them. Without the option for
/// it, the energy is that of links if a number that only links have is given, else that of the material.
Softness softness_of(const SoftnessArguments& arguments, const LinkSoftness& usual = {});
/// Returns the axes of the option for this mesh. Throws Error, with the option, if the value is not one or does not fit
/// the mesh. Warns, on standard error, if principal axes do not exist.
RegionAxes axes_of(const SoftnessArguments& arguments, const Mesh& mesh);
/// Reads `x|y|z:DEGREES` or `X,Y,Z:DEGREES`. Throws Error at `where`.
Rotation parse_rotation(const std::string& where, std::string_view text);

/// The laws of materials, by their names.
struct StrainLawArguments {
  const CLI::App* app = nullptr;
  std::optional<std::string> materials;
};
/// Adds the options of elasticity, with the law of the object's own material.
void add_elastic(Options& options, ElasticOptions& elastic, StrainLawArguments& arguments);
/// Adds the options for the materials of the reference solution, and for the numbers of their laws.
void add_strain_laws(Options& options, ElasticOptions& elastic, StrainLawArguments& arguments);
/// Returns the laws, of which there may be one or several. Throws Error, with the option.
std::vector<StrainLaw> strain_laws_of(const StrainLawArguments& arguments, const ElasticOptions& elastic);

/// The elements of `--pins`: a layer, or ids.
struct PinnedElements {
  std::string layer;
  std::vector<ElementId> ids;
};
void add_pins(Options& options, std::optional<PinnedElements>& pins);
/// Returns the pinned elements in ascending order. Throws Error if the option is missing; `object` is the object's name
/// for error messages.
std::vector<ElementId> pins_of(const std::optional<PinnedElements>& pins, const std::string& object, const Mesh& mesh);
/// Returns all names of layers, separated by `|`.
std::string pin_names();

/// Reads the three coordinates, or fewer, of a point.
std::vector<double> parse_coordinates(const std::string& where, std::string_view text);

}  // namespace chainmail::command_line
