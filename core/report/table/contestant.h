#pragma once

#include <optional>
#include <span>
#include <string>

#include "body/softness.h"
#include "equilibrium/relaxation_scheme.h"
#include "solver/algorithms.h"

namespace chainmail::report {

/// Who takes part in a comparison: an algorithm, and what follows each of its moves.
struct Contestant {
  std::optional<Algorithm> algorithm = {};      // none: only the handle and the pins move, or see `solver`
  int sweeps = 0;                               // number of relaxation sweeps after each move
  bool equilibrium = false;                     // true: relaxed to the equilibrium after each move, instead of sweeps
  std::optional<LinkSoftness> calibrated = {};  // found on this object; none: the object's own softness
  bool open_regions = false;  // true: the energy of the material, and regions that do not bind; nothing is calibrated
  int limit = 0;              // most iterations per move, whether they converge or not; 0: those of the method
  std::string solver = {};    // a solver of somebody else

  bool is_relaxed() const { return sweeps > 0 || equilibrium; }
  bool operator==(const Contestant&) const = default;
};

/// The name in files: that of the algorithm or the solver, or `nothing`.
std::string name(const Contestant& contestant);
/// The name in tables, with the cells that the method works on: `Linear FEM, on the same cells`, `Natural Queue
/// ChainMail, 10 sweeps`.
std::string label(const Contestant& contestant);
/// A short note beside a mark in a plot: `eq.`, `mat.`, `cal.`, or nothing.
std::string note(const Contestant& contestant);
/// The explanation of a note in a legend.
std::string note_in_words(std::string_view note);

/// The same without numbers of iterations and sweeps: a curve connects all that have the same one.
Contestant curve_of(const Contestant& contestant);
/// Returns true for methods of elasticity, which do some work before their first move.
bool prepares(const Contestant& contestant);
/// Returns true if the algorithm also takes part with relaxation to the equilibrium.
bool takes_part_at_equilibrium(Algorithm algorithm);

/// Returns the numbers of iterations per move to which a contestant can be limited, ascending; empty if it does not
/// iterate.
std::span<const int> limits_of(const Contestant& contestant);

/// Returns the softness with which a contestant runs on an object of this softness.
Softness softness_of(const Contestant& contestant, const Softness& object);

}  // namespace chainmail::report
