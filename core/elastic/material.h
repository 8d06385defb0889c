#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "mesh/described.h"
#include "mesh/parameters.h"

namespace chainmail {

/// A homogeneous, isotropic elastic material.
struct Material {
  double young = parameters::young.default_value;      // Young's modulus: force per square of a mesh unit
  double poisson = parameters::poisson.default_value;  // Poisson's ratio

  bool operator==(const Material&) const = default;
};

/// How the energy of an elastic material grows with the strain. At small strains, all are the same linear elasticity.
/// `stiffening.h` has the formulas.
struct StrainLaw {
  enum class Kind { neo_hookean, gent, fung };

  Kind kind = Kind::neo_hookean;
  double gent_limit = parameters::gent_limit.default_value;        // of Gent: I₁ − 3 stays below it
  double fung_exponent = parameters::fung_exponent.default_value;  // of Fung: factor of I₁ − 3 in the exponent

  bool operator==(const StrainLaw&) const = default;
};
/// All laws, in the order of the constants.
inline constexpr std::array strain_laws{StrainLaw::Kind::neo_hookean, StrainLaw::Kind::gent, StrainLaw::Kind::fung};
inline constexpr std::array<std::string_view, strain_laws.size()> strain_law_names{"neo-hookean", "gent", "fung"};
inline constexpr std::array<std::string_view, strain_laws.size()> strain_law_labels{"Neo-Hookean", "Gent", "Fung"};
/// Returns `neo-hookean`, `gent` or `fung`.
std::string name(StrainLaw::Kind kind);
/// Returns the number that only this law has; nothing if it has none.
constexpr std::optional<Parameter> number_of(StrainLaw::Kind kind) {
  return kind == StrainLaw::Kind::gent   ? std::optional(parameters::gent_limit)
         : kind == StrainLaw::Kind::fung ? std::optional(parameters::fung_exponent)
                                         : std::nullopt;
}
/// Returns a description for readers, with the parameter: `Gent (limit 2)`.
std::string label(const StrainLaw& law);
/// Throws Error, with the name of the parameter, if the law does not exist for this material.
void check(const StrainLaw& law, const Material& material);

/// Settings of the methods of elasticity, of free-form deformation and of relaxation to the material.
struct ElasticOptions {
  static constexpr auto control_points = static_cast<std::uint32_t>(parameters::lattice.default_value);

  Material material;
  /// Control points along each axis. Fewer than 2 span nothing, and each one costs time for every element.
  std::array<std::uint32_t, 3> lattice{control_points, control_points, control_points};
  /// Most iterations of a method that iterates, for one move.
  std::uint32_t iterations = static_cast<std::uint32_t>(parameters::iterations.default_value);

  /// Of neo-Hookean FEM and of relaxation to the material. The other methods are linear or have none.
  StrainLaw law = {};
  /// Of surfaces in space, in relaxation to the material: a share of the longest side of the object's bounds at rest.
  double thickness = parameters::thickness.default_value;

  bool operator==(const ElasticOptions&) const = default;
};

template <>
inline constexpr std::array members_of<ElasticOptions>{
    number<&ElasticOptions::material, &Material::young>("young", parameters::young),
    number<&ElasticOptions::material, &Material::poisson>("poisson", parameters::poisson),
    may_be_absent(shown_as(
        "Law", strain_law_labels,
        choice<&ElasticOptions::law, &StrainLaw::kind>(
            "law", strain_law_names,
            "how the material stiffens, in relaxation to the material and in neo-Hookean FEM: gent toward a limit, "
            "fung exponentially"))),
    may_be_absent(number<&ElasticOptions::law, &StrainLaw::gent_limit>("gent_limit", parameters::gent_limit)),
    may_be_absent(number<&ElasticOptions::law, &StrainLaw::fung_exponent>("fung_exponent", parameters::fung_exponent)),
    may_be_absent(number<&ElasticOptions::thickness>("thickness", parameters::thickness)),
    number<&ElasticOptions::lattice>("lattice", parameters::lattice),
    may_be_absent(number<&ElasticOptions::iterations>("iterations", parameters::iterations))};

/// Returns true for the numbers of single laws, and for those that only surfaces in space have.
constexpr bool is_of_law(const MemberInfo& member) {
  return member.number == parameters::gent_limit || member.number == parameters::fung_exponent;
}
constexpr bool is_of_surfaces(const MemberInfo& member) { return member.number == parameters::thickness; }

/// Throws Error, with the name of the parameter, if one of the options is out of range or the law does not exist for
/// the material.
void check(const ElasticOptions& options);

/// Lamé's parameters of a material in three dimensions.
struct Lame {
  double mu = 0, lambda = 0;
};
Lame lame(const Material& material);

}  // namespace chainmail
