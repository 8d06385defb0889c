#pragma once

#include <array>
#include <string_view>

namespace chainmail {

/// Names a relaxation scheme in code. Each one has exactly one row in the table below.
enum class RelaxationScheme { mean, link, equilibrium };

/// One row of the table of relaxation schemes: everything that other code knows about a scheme.
struct RelaxationSchemeInfo {
  RelaxationScheme scheme;
  std::string_view name;     // on the command line, in JSON and in session files
  std::string_view label;    // in the window
  std::string_view summary;  // what it does, in a few words, for help texts
  bool sweeps;               // true: it moves element by element, with a step; false: it solves for the whole object
};

inline constexpr std::array relaxation_schemes{
    RelaxationSchemeInfo{RelaxationScheme::mean, "mean", "mean",
                         "element by element, to the position of least energy while all others stay", true},
    RelaxationSchemeInfo{RelaxationScheme::link, "link", "link",
                         "link by link, both ends share the error (Schill 2001)", true},
    RelaxationSchemeInfo{RelaxationScheme::equilibrium, "equilibrium", "equilibrium",
                         "the whole object at once, to the valid state of least energy", false}};

static_assert(relaxation_schemes[0].scheme == RelaxationScheme(0) &&
                  relaxation_schemes[1].scheme == RelaxationScheme(1) &&
                  relaxation_schemes[2].scheme == RelaxationScheme(2),
              "info() finds a row by its scheme");

inline constexpr std::array<std::string_view, relaxation_schemes.size()> relaxation_scheme_names{
    relaxation_schemes[0].name, relaxation_schemes[1].name, relaxation_schemes[2].name};

/// Returns the row of a scheme.
constexpr const RelaxationSchemeInfo& info(RelaxationScheme scheme) {
  return relaxation_schemes[static_cast<std::size_t>(scheme)];
}

/// Largest number of iterations of the scheme `equilibrium`, where a user does not choose.
inline constexpr int equilibrium_iterations = 200;

}  // namespace chainmail
