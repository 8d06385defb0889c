#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/contest.h"

namespace chainmail::bench {

/// The file build/bench.json, to which each program of tests/run bench adds its part. Each program runs several times,
/// and each run adds its values to the earlier ones:
///
///     {"machine": …,
///      "runs": [{"name", "mesh", "algorithm", "elements", "moved", "ms", "ms_quartiles", "ns_per_moved"}],
///      "ratios": {…}, "quartiles": {"/KEY/OF/A/RATIO": [lower, upper]}, "samples": {…}}
///
/// `ms`, `ns_per_moved` and the numbers in `ratios` are medians over the runs.
class Results {
 public:
  /// Reads the results that other programs and earlier runs wrote to this file.
  explicit Results(std::string path);

  /// Adds each timing, named after its drag.
  void add(const std::vector<Run>& runs);
  /// Adds a figure of this run. `place` is a JSON pointer into "ratios".
  void add(const std::string& place, double value);
  const nlohmann::json& all() const { return all_; }
  void write() const;

 private:
  /// Adds a value to the samples of `key`. Returns the spread of all samples.
  TimeSpread sample(const std::string& key, double value);

  std::string path_;
  nlohmann::json all_;
};

}  // namespace chainmail::bench
