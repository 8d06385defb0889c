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

/// What softness and relaxation shall come close to, and how hard to try.
struct CalibrationOptions {
  ElasticOptions elastic;
  std::vector<ElementId> pins;                     // in any order; some there must be
  Algorithm algorithm = Algorithm::natural_queue;  // of the ChainMail family
  std::uint64_t seed = 1;                          // of the drags
  int drags = 4;
  int evaluations = 200;  // each carries all drags out
  RelaxationScheme scheme = RelaxationScheme::mean;
};

/// How far elements stand from the truth at the end of a drag, over the hand's displacement.
struct Residual {
  double rms = 0, max = 0;

  bool operator==(const Residual&) const = default;
};

/// A drag that was tried, from rest.
struct CalibrationDrag {
  ElementId element = 0;
  Point target = Point::Zero();  // mesh units
  Residual before, after;

  bool operator==(const CalibrationDrag&) const = default;
};

/// The softness and the sweeps of relaxation after each move that came closest.
struct CalibrationResult {
  LinkSoftness softness;
  int sweeps = 0;
  double rms = 0, max = 0;                // the mean over the drags of the RMS, and the worst of the maxima
  double rms_before = 0, max_before = 0;  // the same of the default softness without sweeps
  int evaluations = 0;                    // that were made
  std::vector<CalibrationDrag> drags;

  bool operator==(const CalibrationResult&) const = default;
};

/// Looks for the softness, the same for all links, and the sweeps with which an algorithm comes closest to the truth,
/// neo-Hookean FEM, over drags of random elements by 5 to 20 % of the object's size. The same for the same options.
///
/// Throws Error where nothing is pinned, where a number is out of its range, where the object has no static answer, and
/// where no drag's truth converges; and Cancelled.
CalibrationResult calibrate(const MeshPointer& mesh, const Cuts& cuts, const CalibrationOptions& options,
                            const Progress& progress = {});

}  // namespace chainmail
