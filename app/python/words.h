#pragma once

#include <array>
#include <string_view>

#include "chainmail/body.h"
#include "chainmail/compare.h"
#include "chainmail/types.h"
#include "python/arrays.h"

namespace chainmail::python {

// The enumerations of the interface are words in Python, in the order of their constants.

inline constexpr std::array<std::string_view, 2> precision_words{"float", "double"};
inline constexpr std::array<std::string_view, 3> scheme_words{"mean", "link", "equilibrium"};
inline constexpr std::array<std::string_view, 4> energy_words{"isotropic", "axial", "corotated", "material"};
inline constexpr std::array<std::string_view, 3> law_words{"neo-hookean", "gent", "fung"};
inline constexpr std::array<std::string_view, 2> reference_words{"exact", "physics"};

inline api::Precision precision_of(std::string_view word) {
  return static_cast<api::Precision>(word_of("precision", word, precision_words));
}
inline api::RelaxationScheme scheme_of(std::string_view word) {
  return static_cast<api::RelaxationScheme>(word_of("scheme", word, scheme_words));
}
inline api::EnergyKind energy_of(std::string_view word) {
  return static_cast<api::EnergyKind>(word_of("energy", word, energy_words));
}
inline api::StrainLaw law_of(std::string_view word) {
  return static_cast<api::StrainLaw>(word_of("law", word, law_words));
}
inline api::Reference reference_of(std::string_view word) {
  return static_cast<api::Reference>(word_of("against", word, reference_words));
}

inline std::string_view word_for(api::Precision precision) { return precision_words[std::size_t(precision)]; }
inline std::string_view word_for(api::EnergyKind energy) { return energy_words[std::size_t(energy)]; }
inline std::string_view word_for(api::StrainLaw law) { return law_words[std::size_t(law)]; }

}  // namespace chainmail::python
