#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "report/run/ramp.h"

namespace chainmail::report {

/// The passes of one contestant at one size.
struct RampPasses {
  std::vector<double> ms;
  std::uint64_t moved = 0;  // number of moved elements in all passes
};

/// Returns the figures of a size. It is in real time if the 99th percentile of the passes is within the budget
/// (seconds), or if there are no passes.
RampRow ramp_row(const Mesh& mesh, std::uint32_t width, Algorithm algorithm, const RampPasses& passes, double budget);

/// Returns the result for one algorithm from its rows, which are in the order of sizes. Rows of other algorithms are
/// ignored.
RampVerdict ramp_verdict(Algorithm algorithm, std::span<const RampRow> rows);

/// Returns the seed of the drags at a size. It differs for each size and for each of the two attempts.
std::uint64_t ramp_seed(std::uint64_t seed, std::uint32_t width, int attempt);

/// Decides the order of events in a ramp: the next size, and the contestants that measure it. The caller runs the
/// passes.
/// At each size, all remaining contestants make one attempt. A contestant that exceeds the budget makes a second
/// attempt with other drags. It leaves the ramp if it exceeds the budget again.
class RampRace {
 public:
  struct Result {
    std::size_t contestant = 0;
    RampRow row;
  };

  /// `widths` must be ascending. Contestants are identified by their index; two of them may have the same algorithm.
  RampRace(std::vector<std::uint32_t> widths, std::vector<Algorithm> contestants, double budget);

  /// True when no size or no contestant is left.
  bool is_over() const { return size_ == widths_.size() || in_race_.empty(); }
  std::uint32_t width() const { return widths_[size_]; }
  const std::vector<std::size_t>& in_race() const { return in_race_; }
  /// Returns 0 for the first attempt, 1 for the second.
  int attempt() const { return attempt_; }
  /// Returns the contestants that make the current attempt.
  const std::vector<std::size_t>& attempting() const { return attempting_; }

  /// Takes the passes of an attempt, in the order of attempting(). If a second attempt must follow, returns nothing.
  /// Otherwise returns the results of the size, in the order of the contestants, and moves to the next size.
  std::vector<Result> finish_attempt(const Mesh& mesh, std::span<const RampPasses> passes);

 private:
  std::vector<std::uint32_t> widths_;
  std::vector<Algorithm> algorithms_;
  double budget_;
  std::size_t size_ = 0;  // index into widths_
  int attempt_ = 0;
  std::vector<std::size_t> in_race_, attempting_;
  std::vector<Result> results_;  // of this size
};

}  // namespace chainmail::report
