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
  std::optional<Algorithm> algorithm;           // none: nothing moves but the handle and the pins
  int sweeps = 0;                               // of relaxation after each move
  std::optional<LinkSoftness> calibrated = {};  // found by calibration on this object; none: the softness of the object
};
/// As files call it: `nothing`, or the algorithm's name.
std::string name(const PhysicsContestant& contestant);
/// As tables call it, with the cells that it works on: `Linear FEM, on the same cells`.
std::string label(const PhysicsContestant& contestant);
/// True for the methods of elasticity, which prepare something before their first move.
bool prepares(const PhysicsContestant& contestant);

/// The softness and the sweeps with which an algorithm comes closest to the reference solution on one object.
struct Calibration {
  Algorithm algorithm = Algorithm::natural_queue;
  LinkSoftness softness;
  int sweeps = 0;
  int drags = 0, evaluations = 0;  // drags that it came close to, and how often it tried them all
  double seconds = 0;              // that it took
  std::string refusal;             // why there is none; empty where there is one
};

/// Calibrates an algorithm on an object by drags of its own, none of them of an element in `handles`. Throws Error, and
/// Cancelled when stopped.
using Calibrator = std::function<Calibration(const Case& object, Algorithm algorithm,
                                             const std::vector<ElementId>& handles, const std::stop_token& stop)>;

/// Those who take part: nothing moving first, the ChainMail family by all numbers of sweeps and then calibrated, the
/// methods of elasticity without sweeps.
std::vector<PhysicsContestant> contestants_of(const std::vector<Algorithm>& algorithms, const std::vector<int>& sweeps,
                                              const std::vector<Calibration>& calibrations);

}  // namespace chainmail::report
