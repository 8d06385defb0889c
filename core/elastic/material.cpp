#include "elastic/material.h"

#include <cstdio>

#include "mesh/error.h"

namespace chainmail {
namespace {

std::string in_short(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

}  // namespace

void check(const ElasticOptions& options) {
  check_members(options);
  check(options.law, options.material);
}

std::string name(StrainLaw::Kind kind) { return std::string(strain_law_names[std::size_t(kind)]); }

std::string label(const StrainLaw& law) {
  switch (law.kind) {
    case StrainLaw::Kind::gent:
      return "Gent (limit " + in_short(law.gent_limit) + ")";
    case StrainLaw::Kind::fung:
      return "Fung (exponent " + in_short(law.fung_exponent) + ")";
    default:
      return "neo-Hookean";
  }
}

/// Beyond its bound, the energy of a material that is compressed to nothing would fall without limit.
void check(const StrainLaw& law, const Material& material) {
  const auto number = number_of(law.kind);
  if (!number) {
    return;
  }
  const bool is_gent = law.kind == StrainLaw::Kind::gent;
  const double value = is_gent ? law.gent_limit : law.fung_exponent;
  check(*number, value);
  const auto [mu, lambda] = lame(material);
  if (lambda == 0) {
    throw Error(std::string(number->name),
                "the material '" + name(law.kind) + "' does not exist for a Poisson's ratio of 0",
                "use a higher Poisson's ratio, or the material 'neo-hookean'");
  }
  if (is_gent ? lambda * value < 2 * mu : lambda < 2 * mu * value) {
    throw Error(std::string(number->name),
                in_short(value) + " is too " + (is_gent ? "low" : "high") + " for a Poisson's ratio of " +
                    in_short(material.poisson) + ", for which it is at " + (is_gent ? "least " : "most ") +
                    in_short(is_gent ? 2 * mu / lambda : lambda / (2 * mu)),
                "change it, or use a higher Poisson's ratio");
  }
}

Lame lame(const Material& material) {
  const auto [young, poisson] = material;
  return {young / (2 * (1 + poisson)), young * poisson / ((1 + poisson) * (1 - 2 * poisson))};
}

}  // namespace chainmail
