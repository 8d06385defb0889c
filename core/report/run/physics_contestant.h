#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report/run/cases.h"
#include "report/run/compare.h"

namespace chainmail::report {

/// A contestant of the comparison with physics.
struct PhysicsContestant {
  std::optional<Algorithm> algorithm;  // none: only the handle and the pins move
  int sweeps = 0;                      // number of relaxation sweeps after each move
  std::optional<LinkSoftness> calibrated =
      {};                     // result of the calibration on this object; none: the object's own softness
  bool equilibrium = false;   // true: relaxed to the equilibrium after each move, instead of sweeps
  int limit = 0;              // most iterations per move, whether they converge or not; 0: those of the method
  bool open_regions = false;  // true: the energy of the material, and regions that do not bind; nothing is calibrated

  bool operator==(const PhysicsContestant&) const = default;
};
/// Returns the name in files: `nothing`, or that of the algorithm.
std::string name(const PhysicsContestant& contestant);
/// Returns the name in tables, with the cells that the method works on: `Linear FEM, on the same cells`.
std::string label(const PhysicsContestant& contestant);
/// Returns true for methods of elasticity, which do some work before their first move.
bool prepares(const PhysicsContestant& contestant);

/// Returns the numbers of iterations per move to which a contestant can be limited, ascending; empty if it does not
/// iterate.
std::span<const int> limits_of(const PhysicsContestant& contestant);

/// Returns the softness with which a contestant runs on an object of this softness.
Softness softness_of(const PhysicsContestant& contestant, const Softness& object);

/// The softness and the sweeps with which an algorithm is closest to the reference solution on one object.
struct Calibration {
  Algorithm algorithm = Algorithm::natural_queue;
  bool equilibrium = false;  // true: relaxed to the equilibrium, instead of sweeps
  LinkSoftness softness = {};
  int sweeps = 0;
  int drags = 0,
      evaluations = 0;  // number of drags for the search, and number of evaluations, each of which runs all drags
  double seconds = 0;   // duration of the calibration
  std::string refusal;  // reason why there is no result; empty if there is one
};

/// Calibrates an algorithm on an object, with sweeps or at equilibrium, with drags of elements that are not in
/// `handles`. Throws Error and Cancelled.
using Calibrator = std::function<Calibration(const Case& object, Algorithm algorithm, bool equilibrium,
                                             const std::vector<ElementId>& handles, const Progress& progress)>;

/// Returns all contestants: first the object that does not move, then the ChainMail family with each number of sweeps,
/// with the equilibrium if `equilibrium`, also in open regions, and calibrated, then the methods of elasticity without
/// sweeps.
std::vector<PhysicsContestant> contestants_of(const std::vector<Algorithm>& algorithms, const std::vector<int>& sweeps,
                                              bool equilibrium, const std::vector<Calibration>& calibrations);

}  // namespace chainmail::report
