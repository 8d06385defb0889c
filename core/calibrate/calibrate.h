#pragma once

#include <cstdint>
#include <vector>

#include "elastic/material.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "solve/softness.h"
#include "solve/solver.h"

namespace chainmail {

// Drags go this far: shares of the object's largest extent.
inline constexpr double shortest_drag = 0.05, farthest_drag = 0.20;

/// What softness and relaxation shall come close to, and how hard to try.
struct CalibrationOptions {
  ElasticOptions elastic;
  std::vector<ElementId> pins;                     // in any order; some there must be
  Algorithm algorithm = Algorithm::natural_queue;  // of the ChainMail family
  std::uint64_t seed = 1;                          // of the drags
  int drags = 4;
  int held_out = 4;       // more drags, of other elements where there are any, on which the result is only tested
  int evaluations = 200;  // each carries all drags out
  int most_sweeps = 100;  // that are tried, of 0, 1, 3, 10, 30 and 100
  std::vector<ElementId> not_these;  // elements that no drag takes hold of, in any order
  RelaxationScheme scheme = RelaxationScheme::mean;
};

/// How far elements stand from the reference solution at the end of a drag.
struct Residual {
  double rms = 0, max = 0;  // over the handle's displacement
  double relative = 0;      // RMS over that of the reference's displacements; about 1 where nothing moves

  bool operator==(const Residual&) const = default;
};

/// A drag that was tried, from rest.
struct CalibrationDrag {
  ElementId element = 0;
  Point target = Point::Zero();  // mesh units
  Residual before, after;
  Residual nothing;  // where nothing moves but the handle

  bool operator==(const CalibrationDrag&) const = default;
};

/// Some drags, and their residuals together: means over the drags, and of the maxima the largest.
struct TestedDrags {
  std::vector<CalibrationDrag> drags;
  Residual before, after, nothing;  // by the default softness without sweeps; calibrated; where nothing moves

  bool operator==(const TestedDrags&) const = default;
};

/// The softness and the sweeps of relaxation after each move that came closest.
struct CalibrationResult {
  LinkSoftness softness;
  int sweeps = 0;
  int evaluations = 0;   // that were made
  TestedDrags fitted;    // the drags that it came close to
  TestedDrags held_out;  // drags that it did not see: what to expect of others

  bool operator==(const CalibrationResult&) const = default;
};

/// Finds the softness, the same for all links, and the sweeps for which the mean relative error against neo-Hookean FEM
/// on the same cells is lowest, over drags of random elements by `shortest_drag` to `farthest_drag` of the object's
/// size. The result is the same for the same options.
///
/// Throws Error where nothing is pinned, where a number is out of its range, where the object has no static answer, and
/// where no drag's reference converges; and Cancelled.
CalibrationResult calibrate(const MeshPointer& mesh, const Cuts& cuts, const CalibrationOptions& options,
                            const Progress& progress = {});

}  // namespace chainmail
