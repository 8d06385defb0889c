#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measure/converging_reference.h"
#include "report/run/compare.h"

namespace chainmail::report {

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

/// Options of the comparison with physics: ChainMail, linear FEM, BEM and free-form deformation against neo-Hookean
/// FEM.
struct PhysicsOptions : CompareOptions {
  PhysicsOptions() {
    sweeps = {0, 1, 3, 10, 30, 100};
    seconds = 1.5;
    own_limit = own_limit_of_comparisons;
  }

  std::optional<ConvergingOptions> refine;  // the reference is computed on refined cells; the handles must be patches
  double growth_seconds = 1;  // time budget per contestant and kind of growing object; 0: growth is not measured
  Calibrator calibrate;       // finds the softness of the calibrated contestants; empty: no contestant is calibrated
  bool turned = true;         // each object also runs turned
  std::vector<Contestant> contestants =
      {};  // empty: those that the options above name; else instead of those that the options above name
};

/// Compares all contestants, at the end of each drag, with neo-Hookean FEM in double, converged on the same cells with
/// the cuts of the drag. The cases must have pins and no cuts. Throws Error with the name of the case if physics has no
/// solution for it. A drag whose reference does not converge is listed with the reason, and so is a contestant that
/// cannot take part.
Results compare_with_physics(const std::vector<Case>& cases, const PhysicsOptions& options,
                             const Progress& progress = {}, const Finished& finished = {});

/// Calibrates Natural Queue and Exact ChainMail, as far as they take part and support the object.
std::vector<Calibration> calibrations_of(const Case& object, const PhysicsOptions& options, const Progress& progress);
/// Describes what a calibration found, or why there is nothing.
std::string in_words(const Calibration& calibration);

/// Returns all contestants: first the object that does not move, then the ChainMail family with each number of sweeps,
/// with the equilibrium if `equilibrium`, also in open regions, and calibrated, then the methods of elasticity without
/// sweeps.
std::vector<Contestant> contestants_of(const std::vector<Algorithm>& algorithms, const std::vector<int>& sweeps,
                                       bool equilibrium, const std::vector<Calibration>& calibrations);

/// Measures the growth of time and error on one kind of object, as objects of one series. `made` returns an object with
/// about the given number of elements.
Results grow(const std::string& name, const std::string& description,
             const std::function<Case(std::uint64_t elements)>& made, const PhysicsOptions& options,
             const Progress& progress);

/// Adds by how much the answers of contestants differ on turned copies of an object: rows of the object, the last one
/// of the results. One move runs in double, to the end of the drag `bend` or of the first one; of contestants that
/// differ in sweeps only, those without sweeps take part. None for objects on a line.
void add_turned(Results& results, const Case& object, const std::vector<Contestant>& contestants,
                const RunOptions& options, const Progress& progress);
/// Returns the rotation vector across the plane of the object, or about z.
Point rotation_by(const Mesh& mesh, double degrees);
/// Returns the case with its object, its axes of valid regions and its drags turned about the origin. Its 3D lists
/// stay those of the object, though its links no longer follow the axes.
Case turned(const Case& object, const Point& rotation);

}  // namespace chainmail::report
