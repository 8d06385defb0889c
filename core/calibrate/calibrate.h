#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "body/softness.h"
#include "elastic/material.h"
#include "mesh/cuts.h"
#include "mesh/described.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "solver/deformer.h"

namespace chainmail {

// Shortest and longest drags, as shares of the object's largest extent.
inline constexpr double shortest_drag = 0.05, farthest_drag = 0.20;

/// Target and effort of a calibration.
struct CalibrationOptions {
  ElasticOptions elastic;
  std::vector<ElementId> pins;                     // in any order; at least one
  Algorithm algorithm = Algorithm::natural_queue;  // of the ChainMail family
  std::uint64_t seed = 1;                          // random seed of the drags
  int drags = 4;
  int held_out = 4;  // they grab other elements if possible
  int evaluations = 200;
  int max_sweeps = 100;              // of 0, 1, 3, 10, 30 and 100
  std::vector<ElementId> not_these;  // elements that no drag grabs, in any order
  RelaxationScheme scheme = RelaxationScheme::equilibrium;
  EnergyKind energy = link_energy;
  StrainLaw law = {};  // of the reference solution
};

template <>
inline constexpr std::array members_of<CalibrationOptions>{
    number<&CalibrationOptions::drags>("drags", "Drags", "number of drags to fit", 1),
    number<&CalibrationOptions::held_out>("held_out", "Held-out drags", "number of drags that only test the result", 0),
    number<&CalibrationOptions::evaluations>("evaluations", "Evaluations",
                                             "largest number of evaluations; each runs all drags", 1),
    number<&CalibrationOptions::max_sweeps>("most_sweeps", "Sweeps", "largest number of sweeps tried", 0)};

/// Distance of the elements from the reference solution at the end of a drag.
struct Residual {
  double rms = 0, max = 0;  // divided by the handle's displacement
  double relative = 0;      // RMS divided by that of the reference's displacements; about 1 if nothing moves

  bool operator==(const Residual&) const = default;
};

/// A drag from rest, with its residuals.
struct CalibrationDrag {
  ElementId element = 0;
  Point target = Point::Zero();  // mesh units
  Residual before, after;
  Residual nothing;  // if only the handle moves

  bool operator==(const CalibrationDrag&) const = default;
};

/// Drags, and their residuals: the means over the drags, and the largest of the maxima.
struct TestedDrags {
  std::vector<CalibrationDrag> drags;
  Residual before, after, nothing;  // default softness without sweeps, or at equilibrium; calibrated; if nothing moves

  bool operator==(const TestedDrags&) const = default;
};

/// The best softness, and the best number of sweeps of relaxation after each move.
struct CalibrationResult {
  LinkSoftness softness;
  int sweeps = 0;        // 0 with the scheme `equilibrium`
  int evaluations = 0;   // number of evaluations made
  TestedDrags fitted;    // drags used by the search
  TestedDrags held_out;  // drags not used by the search

  bool operator==(const CalibrationResult&) const = default;
};

/// Finds one softness for all links and the number of sweeps that together have the lowest mean relative error against
/// neo-Hookean FEM on the same cells. Each drag moves a random element by `shortest_drag` to `farthest_drag` of the
/// object's size. The same options give the same result.
///
/// With sweeps, the search varies compression, stretch and shear. With the scheme `equilibrium`, it also varies the
/// numbers of the energy; then it starts at several points, because the error has several minima.
///
/// Throws Error if nothing is pinned, a number is out of range, the object has no static solution, or no reference
/// converges. Throws Cancelled if it is cancelled.
CalibrationResult calibrate(const MeshPointer& mesh, const Cuts& cuts, const CalibrationOptions& options,
                            const Progress& progress = {});

}  // namespace chainmail
