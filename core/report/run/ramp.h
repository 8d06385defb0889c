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
  std::vector<Algorithm> algorithms;  // in the order of the table; none: every one
  std::uint64_t seed = 1;             // of the drags
  double budget = 1.0 / 60;           // for a pass, in seconds
  LinkSoftness softness;
  Precision precision = Precision::single_precision;
  std::uint64_t largest = 4'000'000;  // elements
  int drags = 10;                     // at each size, beside one to warm up
  int moves = 30;                     // a drag
  Clocks clocks = machine_clocks();
};

/// How one algorithm did at one size.
struct RampRow {
  std::uint32_t width = 0;  // elements along each side of the square grid
  std::uint64_t elements = 0;
  std::uint64_t links = 0;
  Algorithm algorithm = Algorithm::natural_queue;
  int passes = 0;
  double median_ms = 0;
  double p99_ms = 0;      // the 99th percentile
  double mean_moved = 0;  // elements a pass
  bool repeated = false;  // it missed the budget once; these are the figures of fresh drags
  bool in_real_time = true;
};

/// What came out for one algorithm.
struct RampVerdict {
  Algorithm algorithm = Algorithm::natural_queue;
  std::optional<std::uint32_t> largest_width;  // of the grids it kept in real time
  bool lost = false;                           // at the next size; else that was the last size there was
  std::optional<Growth> growth;                // of the median
};

struct Ramp {
  RampOptions options;
  std::vector<RampRow> rows;  // size by size
  std::vector<RampVerdict> verdicts;
  double seconds = 0;    // that it took
  bool stopped = false;  // by `stop`; then the last size is left out
};

/// Told from the thread that measures, drag by drag.
struct RampProgress {
  std::uint32_t width = 0;  // of the grid at hand
  int drag = 0, drags = 0;  // done at this size, and in all
  bool repeated = false;
  std::span<const Algorithm> in_race;
  std::span<const RampRow> rows;  // of the sizes that are done
};

/// Exponents are fitted over grids from this many elements on: below, what a pass costs at all shows.
inline constexpr double growth_from = 1000;

/// The sizes: every width from 4 on, then about a tenth more each time.
std::uint32_t next_width(std::uint32_t width);

/// Dean 2004, chapter 6: square grids grow until an algorithm can no longer answer a move within the budget.
///
/// At each size all algorithms make the same drags, from rest each, one algorithm after another. One is out when
/// the 99th percentile of its passes exceeds the budget, and does so again with fresh drags: a hiccup of the
/// machine does not count, nor does the time that other programs take. `stop` is looked at between passes.
Ramp ramp(const RampOptions& options, const std::function<void(const RampProgress&)>& progress = {},
          const std::stop_token& stop = {});

}  // namespace chainmail::report
