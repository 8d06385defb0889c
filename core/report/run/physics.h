#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "measure/physical_error.h"
#include "report/run/compare.h"
#include "report/run/growth.h"
#include "report/run/physics_contestant.h"

namespace chainmail::report {

/// Options of the comparison with physics: ChainMail, linear FEM, BEM and free-form deformation against neo-Hookean
/// FEM.
struct PhysicsOptions {
  PhysicsOptions() {
    contest.sweeps = {0, 1, 3, 10, 30, 100};
    contest.seconds = 1.5;
  }

  /// No algorithms: all take part. The sweeps are those of the ChainMail family.
  CompareOptions contest;
  double growth_seconds = 1;  // budget of each contestant for growing objects of each kind; 0: none grow
  Calibrator calibrate;       // finds the softness of the calibrated contestants; none: no contestant is calibrated
};

/// Times of a method of elasticity before its first move (ms), over some repetitions.
struct Preparation {
  TimeSpread factorize;  // once for an object, its pins and its cuts
  TimeSpread grab;       // for each element that becomes the handle: the response of the object to it

  double ms() const { return factorize.median + grab.median; }
};

/// Times (ms, over repetitions of the drag) and errors of a contestant on one drag.
struct PhysicsMeasurement {
  TimeSpread ms_per_move;     // mean of the moves after the first, with the sweeps that follow
  TimeSpread first_move;      // of the first move, with everything prepared
  TimeSpread move_after_cut;  // of the move after the cut, with all preparation that it repeats; if there is a cut
  Preparation prepare;
  PhysicalError error;
};

struct PhysicsEntry {
  PhysicsContestant contestant;
  std::optional<PhysicsMeasurement> measurement;
  std::string refusal;  // if there is no measurement: the reason
};

struct PhysicsDrag {
  std::string name, description;
  ElementId handle = 0;
  int moves = 0;
  bool has_cut = false;               // a cut precedes the last move
  double hand = 0;                    // displacement of the handle (mesh units)
  std::vector<PhysicsEntry> entries;  // all contestants, in the same order for all drags; none without a reference
  std::string no_truth;               // reason why there is no reference solution; empty if there is
};

struct PhysicsObject {
  std::string name, description;
  std::uint64_t elements = 0, links = 0, pins = 0;
  std::vector<PhysicsDrag> drags;
  std::vector<Calibration> calibrations;
};

/// A contestant at one size.
struct GrowthPoint {
  std::uint64_t elements = 0;
  double ms_per_move = 0, prepare_ms = 0;
  std::optional<PhysicalError> error;  // none if there is no reference solution
};

struct GrowthSeries {
  PhysicsContestant contestant;
  std::vector<GrowthPoint> points;
  std::string end;               // reason why it grew no further
  std::optional<Growth> growth;  // of the time per move
};

/// One kind of object, growing.
struct PhysicsGrowth {
  std::string name, description;
  std::vector<GrowthSeries> series;
};

struct PhysicsReport {
  PhysicsOptions options;
  ElasticOptions elastic;
  std::vector<PhysicsObject> objects;
  std::vector<PhysicsGrowth> growths;
  bool stopped = false;  // then only the finished parts are there
};

/// Compares with neo-Hookean FEM in double, converged on the same cells, with the cuts of the drag, at the end of each
/// drag. The cases must have pins and no cuts. Throws Error, naming the case, if physics has no answer to it. A drag
/// whose reference does not converge, and a contestant that cannot take part, are listed with the reason.
PhysicsReport compare_with_physics(const std::vector<Case>& cases, const PhysicsOptions& options,
                                   const Progress& progress = {}, const std::stop_token& stop = {});

/// Measures the growth on one kind of object. `made` returns an object with about that many elements.
PhysicsGrowth grow(const std::string& name, const std::string& description,
                   const std::function<Case(std::uint64_t elements)>& made, const PhysicsOptions& options,
                   const std::function<void(double)>& tell, const std::stop_token& stop);

}  // namespace chainmail::report
