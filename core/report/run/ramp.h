#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "mesh/progress.h"
#include "report/run/clocks.h"
#include "report/run/growth.h"
#include "solver/deformer.h"

namespace chainmail::report {

struct RampOptions {
  std::vector<Algorithm> algorithms;  // in the order of the table; empty: the ChainMail family
  std::uint64_t seed = 1;             // random seed of the drags
  double budget = 1.0 / 60;           // time limit of a pass (s)
  LinkSoftness softness;
  Precision precision = Precision::single_precision;
  std::uint64_t largest = 4'000'000;  // largest number of elements in a grid
  int drags = 10;                     // number of drags at each size, without the warm-up
  int moves = 30;                     // number of moves per drag
  Clocks clocks = machine_clocks();
};

/// Throws Error if a number is out of its range, or an algorithm is not of the ChainMail family.
void check(const RampOptions& options);

/// The figures of one algorithm at one size.
struct RampRow {
  std::uint32_t width = 0;  // number of elements along each side of the square grid
  std::uint64_t elements = 0;
  std::uint64_t links = 0;
  Algorithm algorithm = Algorithm::natural_queue;
  int passes = 0;
  double median_ms = 0;
  double p99_ms = 0;      // the 99th percentile
  double mean_moved = 0;  // number of elements per pass
  bool repeated = false;  // true: the first attempt exceeded the budget, and these are the figures of the second one
  bool in_real_time = true;
};

/// The result for one algorithm.
struct RampVerdict {
  Algorithm algorithm = Algorithm::natural_queue;
  std::optional<std::uint32_t> largest_width;  // width of the largest grid in real time
  bool lost = false;                           // true: the next size was too slow; false: there was no next size
  std::optional<Growth> growth;                // growth of the median
};

struct Ramp {
  RampOptions options;
  std::vector<RampRow> rows;  // in the order of sizes
  std::vector<RampVerdict> verdicts;
  double seconds = 0;    // time of the whole ramp
  bool stopped = false;  // true: it was cancelled, and the last size is missing
};

/// Reported by the measuring thread, drag by drag.
struct RampProgress {
  std::uint32_t width = 0;  // width of the current grid
  int drag = 0, drags = 0;  // number of finished drags, and of all drags in this attempt
  bool repeated = false;
  std::span<const Algorithm> in_race;
  std::span<const RampRow> rows;  // rows of the finished sizes
};

/// Smallest number of elements of the grids from which exponents are fitted. In smaller grids the fixed cost of a pass
/// is too large a part of the time.
inline constexpr double growth_from = 1000;

/// Returns a width that is about a tenth larger.
std::uint32_t next_width(std::uint32_t width);

/// Runs the ramp of Dean 2004, chapter 6: square grids grow until no algorithm can answer a move within the budget.
///
/// At each size, all algorithms make the same drags from rest, one algorithm after another. An algorithm leaves the
/// ramp when the 99th percentile of its passes exceeds the budget in two attempts (see RampRace). Time that other
/// programs take does not count. Cancelling `job` takes effect between passes.
Ramp ramp(const RampOptions& options, const std::function<void(const RampProgress&)>& progress = {},
          const Progress& job = {});

}  // namespace chainmail::report
