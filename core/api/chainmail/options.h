#pragma once

#include <span>
#include <string>
#include <string_view>

#include "chainmail/body.h"
#include "chainmail/types.h"

namespace chainmail::api {

// What a user may choose, with names and help, for programs that offer it.

/// A number that a user may set.
struct Parameter {
  std::string_view name;   ///< Its name, as on the command line and in files.
  std::string_view label;  ///< Its title.
  std::string_view unit;   ///< Its unit; empty for a number without one.
  double default_value;    ///< The value where nothing else is said.
  double lowest;           ///< Lowest value.
  double highest;          ///< Highest value; the largest number if there is no limit.
  std::string_view help;   ///< What it means, in a few words.
};
/// Returns all of them: the numbers of a link's softness, `relax-step` and `relax-until` of relaxation, `spacing` of a
/// lattice, and `young`, `poisson`, `gent-limit`, `fung-exponent`, `lattice` and `iterations` of Elasticity.
std::span<const Parameter> parameters();
/// Returns the one of this name. Throws Error if there is none.
const Parameter& parameter(std::string_view name);
/// Returns the accepted range in words, like `0 to 1`, `1 or more` or `a number above 0`.
std::string range_of(const Parameter& parameter);
/// Throws Error about the parameter's name, with the range, if a value is out of range or not a number.
void check(const Parameter& parameter, double value);

/// What is known about a kind of elastic energy.
struct EnergyKindInfo {
  EnergyKind kind;         ///< The kind.
  std::string_view name;   ///< Its name, as on the command line and in files.
  std::string_view label;  ///< Its title.
  std::string_view help;   ///< What it means, in one or two sentences.
};
/// Returns all kinds, in the order of the constants.
std::span<const EnergyKindInfo> energy_kinds();
/// The energy of links that comes closest to a material: the one that calibrate() adjusts.
inline constexpr EnergyKind link_energy = EnergyKind::corotated;

/// What is known about a relaxation scheme.
struct RelaxationSchemeInfo {
  RelaxationScheme scheme;  ///< The scheme.
  std::string_view name;    ///< Its name, as on the command line and in files.
  std::string_view help;    ///< What it does, in a few words.
  bool sweeps;              ///< True if it moves element by element; false if it solves for the whole object.
};
/// Returns all schemes, in the order of the constants.
std::span<const RelaxationSchemeInfo> relaxation_schemes();

/// Returns the name of a strain law: `neo-hookean`, `gent` or `fung`.
std::string name_of(StrainLaw law);

}  // namespace chainmail::api
