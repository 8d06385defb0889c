#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "report/run/cases.h"
#include "report/run/compare.h"

namespace chainmail::report {

/// A contestant of the comparison with physics.
struct PhysicsContestant {
  std::optional<Algorithm> algorithm;           // none: nothing but the handle and the pins moves
  int sweeps = 0;                               // of relaxation after each move
  std::optional<LinkSoftness> calibrated = {};  // found by calibration on this object; none: the softness of the object
};
/// Returns the name in files: `nothing`, or that of the algorithm.
std::string name(const PhysicsContestant& contestant);
/// Returns the name in tables, with the cells that the method works on: `Linear FEM, on the same cells`.
std::string label(const PhysicsContestant& contestant);
/// True for methods of elasticity, which prepare something before their first move.
bool prepares(const PhysicsContestant& contestant);

/// The softness and the sweeps with which an algorithm is closest to the reference solution on one object.
struct Calibration {
  Algorithm algorithm = Algorithm::natural_queue;
  LinkSoftness softness;
  int sweeps = 0;
  int drags = 0, evaluations = 0;  // drags to fit, and number of trials of all of them
  double seconds = 0;              // time of the calibration
  std::string refusal;             // reason why there is no result; empty if there is
};

/// Calibrates an algorithm on an object with drags of other elements than `handles`. Throws Error, and Cancelled if
/// stopped.
using Calibrator = std::function<Calibration(const Case& object, Algorithm algorithm,
                                             const std::vector<ElementId>& handles, const std::stop_token& stop)>;

/// Returns all contestants: first nothing that moves, then the ChainMail family with each number of sweeps and
/// calibrated, then the methods of elasticity without sweeps.
std::vector<PhysicsContestant> contestants_of(const std::vector<Algorithm>& algorithms, const std::vector<int>& sweeps,
                                              const std::vector<Calibration>& calibrations);

}  // namespace chainmail::report
