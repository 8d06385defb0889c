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

/// The comparison with physics: ChainMail, linear FEM, BEM and free-form deformation against neo-Hookean FEM.
struct PhysicsOptions {
  PhysicsOptions() {
    contest.sweeps = {0, 1, 3, 10, 30, 100};
    contest.seconds = 1.5;
  }

  /// Without algorithms every one takes part; the sweeps are those of the ChainMail family.
  CompareOptions contest;
  double growth_seconds = 1;  // that each contestant may take on growing objects of each kind; 0: they do not grow
  Calibrator calibrate;       // finds the softness of the calibrated contestants; none: there are no such
};

/// What a method of elasticity does before its first move (ms), over some repetitions.
struct Preparation {
  TimeSpread factorize;  // once for an object, its pins and its cuts
  TimeSpread grab;       // for each element that becomes the handle: how the object answers to it

  double ms() const { return factorize.median + grab.median; }
};

/// How a contestant did on one drag. Times are over repetitions of the drag, in ms.
struct PhysicsMeasurement {
  TimeSpread ms_per_move;     // of the moves after the first, on average, with the sweeps that follow
  TimeSpread first_move;      // of the first move, with everything prepared
  TimeSpread move_after_cut;  // of the move after the cut, with all that must be prepared anew; where there is a cut
  Preparation prepare;
  PhysicalError error;
};

struct PhysicsEntry {
  PhysicsContestant contestant;
  std::optional<PhysicsMeasurement> measurement;
  std::string refusal;  // where there is none: why
};

struct PhysicsDrag {
  std::string name, description;
  ElementId handle = 0;
  int moves = 0;
  bool has_cut = false;               // before the last move
  double hand = 0;                    // how far the handle went (mesh units)
  std::vector<PhysicsEntry> entries;  // every contestant, in one order for all drags; none without a reference
  std::string no_truth;               // why there is no reference solution; empty where there is
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
  std::optional<PhysicalError> error;  // none where the reference solution was no longer found
};

struct GrowthSeries {
  PhysicsContestant contestant;
  std::vector<GrowthPoint> points;
  std::string end;               // why it grew no further
  std::optional<Growth> growth;  // of the time a move
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
  bool stopped = false;  // then it holds what was finished
};

/// The cases must be pinned, without cuts. Errors are those at the end of each drag against neo-Hookean FEM in double,
/// converged on the same cells, with the cuts of the drag. Throws Error, naming the case, where physics has no answer
/// to it; a drag whose reference does not converge, and a contestant that cannot take part, are listed with the reason.
PhysicsReport compare_with_physics(const std::vector<Case>& cases, const PhysicsOptions& options,
                                   const Progress& progress = {}, const std::stop_token& stop = {});

/// The growth of one kind of object: `made` gives about so many elements.
PhysicsGrowth grow(const std::string& name, const std::string& description,
                   const std::function<Case(std::uint64_t elements)>& made, const PhysicsOptions& options,
                   const std::function<void(double)>& tell, const std::stop_token& stop);

}  // namespace chainmail::report
