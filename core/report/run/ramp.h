#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/described.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "report/run/clocks.h"
#include "report/table/results.h"
#include "solver/deformer.h"

namespace chainmail {
namespace report {

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

}  // namespace report

template <>
inline constexpr std::array members_of<report::RampOptions>{
    number<&report::RampOptions::budget>("budget", "Time of a pass", "time for a pass (s)", parameters::above_zero,
                                         parameters::no_highest),
    number<&report::RampOptions::drags>("drags", "Drags", "number of drags at each size", 1),
    number<&report::RampOptions::moves>("moves", "Moves", "number of moves in a drag", 1),
    number<&report::RampOptions::largest>("largest", "Largest grid", "largest number of elements in a grid", 16,
                                          element_limit)};

namespace report {

/// Throws Error if a number is out of its range, or an algorithm is not of the ChainMail family.
void check(const RampOptions& options);

/// Returns a width that is about a tenth larger.
std::uint32_t next_width(std::uint32_t width);

/// Returns the width of a square grid, an object of a ramp.
std::uint32_t width_of(const ObjectInfo& grid);

/// Runs the ramp of Dean 2004, chapter 6: square grids grow until no algorithm can answer a move within the budget. The
/// grids are the objects of one series.
///
/// At each size, all algorithms make the same drags from rest, one algorithm after another. An algorithm leaves the
/// ramp when the 99th percentile of its passes exceeds the budget in two attempts (see RampRace). Time that other
/// programs take does not count. `progress` receives the share of the largest grid. Cancelling takes effect between
/// passes; then the last size is missing.
Results ramp(const RampOptions& options, const Progress& progress = {});

/// The passes of one algorithm at one size.
struct RampPasses {
  std::vector<double> ms;
  std::uint64_t moved = 0;  // number of moved elements in all passes
};

/// Returns the figures of a size. It is in real time if the 99th percentile of the passes is within the budget
/// (seconds), or if there are no passes.
Row ramp_row(Algorithm algorithm, const RampPasses& passes, double budget);

/// Returns the seed of the drags at a size. It differs for each size and for each of the two attempts.
std::uint64_t ramp_seed(std::uint64_t seed, std::uint32_t width, int attempt);

/// Decides the order of events in a ramp: the next size, and the algorithms that measure it. The caller runs the
/// passes.
/// At each size, all remaining algorithms make one attempt. An algorithm that exceeds the budget makes a second
/// attempt with other drags. It leaves the ramp if it exceeds the budget again.
class RampRace {
 public:
  /// `widths` must be ascending.
  RampRace(std::vector<std::uint32_t> widths, std::vector<Algorithm> algorithms, double budget);

  /// True when no size or no algorithm is left.
  bool is_over() const { return size_ == widths_.size() || in_race_.empty(); }
  std::uint32_t width() const { return widths_[size_]; }
  const std::vector<Algorithm>& in_race() const { return in_race_; }
  /// Returns 0 for the first attempt, 1 for the second.
  int attempt() const { return attempt_; }
  /// Returns the algorithms that make the current attempt.
  const std::vector<Algorithm>& attempting() const { return attempting_; }

  /// Takes the passes of an attempt, in the order of attempting(). If a second attempt must follow, returns nothing.
  /// Otherwise returns the rows of the size, in the order of algorithms, and moves to the next size.
  std::vector<Row> finish_attempt(std::span<const RampPasses> passes);

 private:
  std::vector<std::uint32_t> widths_;
  double budget_;
  std::size_t size_ = 0;  // index into widths_
  int attempt_ = 0;
  std::vector<Algorithm> in_race_, attempting_;
  std::vector<Row> rows_;  // of this size
};

}  // namespace report
}  // namespace chainmail
