#include "chainmail/options.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "api/access.h"
#include "body/energy_kind.h"
#include "elastic/material.h"
#include "equilibrium/relaxation_scheme.h"
#include "mesh/parameters.h"

namespace chainmail::api {

static_assert(link_energy == EnergyKind(int(inner::link_energy)));

namespace {

Parameter public_parameter(const inner::Parameter* one) {
  return {one->name, one->label, one->unit, one->default_value, one->lowest, one->highest, one->help};
}

namespace table = inner::parameters;
/// The numbers that are not those of a link's softness.
constexpr std::array other_parameters{&table::relax_step, &table::relax_until, &table::spacing,       &table::young,
                                      &table::poisson,    &table::gent_limit,  &table::fung_exponent, &table::thickness,
                                      &table::lattice,    &table::iterations};

/// The checks of core need no more of a parameter.
inner::Parameter inner_parameter(const Parameter& one) {
  return {.name = one.name,
          .label = one.label,
          .unit = one.unit,
          .default_value = one.default_value,
          .lowest = one.lowest,
          .highest = one.highest,
          .slider_highest = one.highest,
          .step = 0,
          .decimals = 0,
          .help = one.help};
}

}  // namespace

std::span<const Parameter> parameters() {
  static const std::vector<Parameter> all = [] {
    std::vector<Parameter> made;
    std::ranges::transform(inner::softness_numbers, std::back_inserter(made),
                           [](const inner::SoftnessNumber& number) { return public_parameter(number.parameter); });
    std::ranges::transform(other_parameters, std::back_inserter(made), public_parameter);
    return made;
  }();
  return all;
}

const Parameter& parameter(std::string_view name) {
  const auto all = parameters();
  const auto found = std::ranges::find(all, name, &Parameter::name);
  if (found == all.end()) {
    throw Error("parameter '" + std::string(name.substr(0, 60)) + "'", "there is no such parameter",
                "use one of parameters()");
  }
  return *found;
}

std::string range_of(const Parameter& parameter) { return inner::range_of(inner_parameter(parameter)); }

void check(const Parameter& parameter, double value) {
  guarded([&] { inner::check(inner_parameter(parameter), value); });
}

std::span<const EnergyKindInfo> energy_kinds() {
  static const std::vector<EnergyKindInfo> kinds = [] {
    std::vector<EnergyKindInfo> all;
    for (const inner::EnergyKindInfo& one : inner::energy_kinds()) {
      all.push_back({energy_of(one.kind), one.name, one.label, one.help});
    }
    return all;
  }();
  return kinds;
}

std::span<const RelaxationSchemeInfo> relaxation_schemes() {
  static const std::vector<RelaxationSchemeInfo> schemes = [] {
    std::vector<RelaxationSchemeInfo> all;
    std::ranges::transform(
        inner::relaxation_schemes, std::back_inserter(all), [](const inner::RelaxationSchemeInfo& one) {
          return RelaxationSchemeInfo{RelaxationScheme(int(one.scheme)), one.name, one.summary, one.sweeps};
        });
    return all;
  }();
  return schemes;
}

std::string name_of(StrainLaw law) { return inner::name(inner::StrainLaw::Kind(int(law))); }

}  // namespace chainmail::api
