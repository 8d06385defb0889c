#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "measure/converging_reference.h"
#include "measure/physical_error.h"
#include "report/run/compare.h"
#include "report/run/growth.h"
#include "report/run/physics_contestant.h"
#include "report/run/shape_figures.h"
#include "report/run/symmetry.h"

namespace chainmail::report {

/// Options of the comparison with physics: ChainMail, linear FEM, BEM and free-form deformation against neo-Hookean
/// FEM.
struct PhysicsOptions {
  PhysicsOptions() {
    contest.sweeps = {0, 1, 3, 10, 30, 100};
    contest.seconds = 1.5;
  }

  /// Options of the contest. If its list of algorithms is empty, all take part. Its sweeps apply to the ChainMail
  /// family.
  CompareOptions contest;
  std::optional<ConvergingOptions> refine;  // the reference is computed on refined cells; the handles must be patches
  double growth_seconds = 1;  // time budget per contestant and kind of growing object; 0: growth is not measured
  Calibrator calibrate;       // finds the softness of the calibrated contestants; empty: no contestant is calibrated
};

/// Times of the preparation of a method of elasticity (ms), over some repetitions.
struct Preparation {
  TimeSpread factorize;  // once per object with its pins and cuts
  TimeSpread grab;       // once per handle: the response of the object to it

  double ms() const { return factorize.median + grab.median; }
};

/// Times (ms, over repetitions of the drag) and errors of a contestant on one drag.
struct PhysicsMeasurement {
  TimeSpread ms_per_move;     // mean of the moves after the first, with their sweeps
  TimeSpread first_move;      // first move, after all preparation
  TimeSpread move_after_cut;  // move after the cut, if there is one, with the preparation that it repeats
  Preparation prepare;
  PhysicalError error;
  std::optional<int> iterations = {};   // per move, if CompareOptions::own_limit set them
  std::optional<double> residual = {};  // at the end of the drag, of contestants at equilibrium
  std::optional<bool> binds = {};       // true if valid regions change the equilibrium there
  std::optional<std::uint64_t> bytes;   // memory of the solver after its first drag; none where it is not known
  ShapeFigures shape;  // at the end of the drag; the reference of the Hausdorff distance is the reference solution
};

struct PhysicsEntry {
  PhysicsContestant contestant;
  std::optional<PhysicsMeasurement> measurement;
  std::string refusal;  // reason why there is no measurement; empty if there is one
  int left_out = 0;     // of a mean of drags: number of drags without a measurement, whose first refusal is above
};

struct PhysicsDrag {
  std::string name, description;
  ElementId handle = 0;
  int moves = 0;
  bool has_cut = false;               // a cut precedes the last move
  double handle_displacement = 0;     // mesh units
  std::vector<PhysicsEntry> entries;  // all contestants, in the same order for all drags; none without a reference
  std::string no_reference;           // reason why there is no reference solution; empty if there is one
  std::optional<ConvergedReference> refined = {};  // its levels, if it was computed on refined cells
};

struct PhysicsObject {
  std::string name, description;
  std::uint64_t elements = 0, links = 0, pins = 0;
  std::vector<PhysicsDrag> drags;
  std::vector<Calibration> calibrations;
  StrainLaw law;                        // of the reference solution
  std::vector<Symmetry> symmetry = {};  // of contestants without sweeps
};

/// Figures of a contestant at one size.
struct GrowthPoint {
  std::uint64_t elements = 0;
  double ms_per_move = 0, prepare_ms = 0;
  std::optional<PhysicalError> error;  // none if there is no reference solution
};

struct GrowthSeries {
  PhysicsContestant contestant;
  std::vector<GrowthPoint> points;
  std::string end;               // reason why it grew no further
  std::optional<Growth> growth;  // growth of the time per move
};

/// Results for one kind of object at growing sizes.
struct PhysicsGrowth {
  std::string name, description;
  std::vector<GrowthSeries> series;
};

struct PhysicsReport {
  PhysicsOptions options;
  ElasticOptions elastic;
  std::vector<PhysicsObject> objects;
  std::vector<PhysicsGrowth> growths;
  bool stopped = false;  // true: the report contains only the finished parts
};

/// A contestant that iterates makes the least number of iterations per move with which its answer at the end of a drag
/// is within this share of its own limit, the answer after as many as it wants.
inline constexpr double own_limit_of_comparisons = 0.01;

/// Compares all contestants, at the end of each drag, with neo-Hookean FEM in double, converged on the same cells with
/// the cuts of the drag. The cases must have pins and no cuts. Throws Error with the name of the case if physics has no
/// solution for it. A drag whose reference does not converge is listed with the reason, and so is a contestant that
/// cannot take part.
PhysicsReport compare_with_physics(const std::vector<Case>& cases, const PhysicsOptions& options,
                                   const Progress& progress = {});

/// Calibrates Natural Queue and Exact ChainMail, as far as they take part and support the object.
std::vector<Calibration> calibrations_of(const Case& object, const PhysicsOptions& options, const Progress& progress);

/// Measures the growth of time and error on one kind of object. `made` returns an object with about the given number of
/// elements.
PhysicsGrowth grow(const std::string& name, const std::string& description,
                   const std::function<Case(std::uint64_t elements)>& made, const PhysicsOptions& options,
                   const Progress& progress);

}  // namespace chainmail::report
