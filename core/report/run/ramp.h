#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "report/run/clocks.h"
#include "report/run/growth.h"
#include "solve/solver.h"

namespace chainmail::report {

struct RampOptions {
  std::vector<Algorithm> algorithms;  // in the order of the table; none: the ChainMail family
  std::uint64_t seed = 1;             // of the drags
  double budget = 1.0 / 60;           // for a pass, in seconds
  LinkSoftness softness;
  Precision precision = Precision::single_precision;
  std::uint64_t largest = 4'000'000;  // elements
  int drags = 10;                     // at each size, besides one to warm up
  int moves = 30;                     // per drag
  Clocks clocks = machine_clocks();
};

/// The figures of one algorithm at one size.
struct RampRow {
  std::uint32_t width = 0;  // elements along each side of the square grid
  std::uint64_t elements = 0;
  std::uint64_t links = 0;
  Algorithm algorithm = Algorithm::natural_queue;
  int passes = 0;
  double median_ms = 0;
  double p99_ms = 0;      // the 99th percentile
  double mean_moved = 0;  // elements per pass
  bool repeated = false;  // the budget was missed once; these are the figures of the second attempt
  bool in_real_time = true;
};

/// The result for one algorithm.
struct RampVerdict {
  Algorithm algorithm = Algorithm::natural_queue;
  std::optional<std::uint32_t> largest_width;  // of the grids in real time
  bool lost = false;                           // real time was lost at the next size; otherwise there was no next size
  std::optional<Growth> growth;                // of the median
};

struct Ramp {
  RampOptions options;
  std::vector<RampRow> rows;  // size by size
  std::vector<RampVerdict> verdicts;
  double seconds = 0;    // time of the whole ramp
  bool stopped = false;  // by `stop`; then the last size is missing
};

/// Reported by the measuring thread, drag by drag.
struct RampProgress {
  std::uint32_t width = 0;  // of the present grid
  int drag = 0, drags = 0;  // done at this size, and all of this attempt
  bool repeated = false;
  std::span<const Algorithm> in_race;
  std::span<const RampRow> rows;  // of the finished sizes
};

/// Exponents are fitted over grids from this many elements on. In smaller grids the fixed cost of a pass shows.
inline constexpr double growth_from = 1000;

/// Returns a width that is about a tenth larger.
std::uint32_t next_width(std::uint32_t width);
/// Returns the widths of square grids from `first` up to `largest` elements. Each width is `growth` times the last one,
/// or next_width() of it if `growth` is 0.
std::vector<std::uint32_t> ramp_widths(std::uint32_t first, std::uint64_t largest, double growth = 0);

/// Dean 2004, chapter 6: square grids grow until an algorithm can no longer answer a move within the budget.
///
/// At each size, all algorithms make the same drags from rest, one algorithm after another. An algorithm leaves the
/// ramp when the 99th percentile of its passes exceeds the budget in two attempts (see RampRace). Time that other
/// programs take does not count. `stop` is checked between passes.
Ramp ramp(const RampOptions& options, const std::function<void(const RampProgress&)>& progress = {},
          const std::stop_token& stop = {});

}  // namespace chainmail::report
