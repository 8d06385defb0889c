#pragma once

#include <vector>

#include "measure/time_spread.h"

namespace chainmail::report {

/// The times of a drag's moves over its repetitions (ms).
class MoveTimes {
 public:
  /// Of one repetition, move by move; each has as many.
  void add(std::vector<double> ms) { runs_.push_back(std::move(ms)); }

  /// Of a move on average, over the repetitions.
  TimeSpread spread() const;
  /// Of the moves, the largest median over the repetitions.
  double worst() const;

 private:
  std::vector<std::vector<double>> runs_;
};

}  // namespace chainmail::report
