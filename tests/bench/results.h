#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/contest.h"

namespace chainmail::bench {

/// build/bench.json, to which each program of tests/run bench adds its part:
/// {"machine": …, "runs": [{"name", "mesh", "algorithm", "elements", "moved", "ms", "ns_per_moved"}], "ratios": {…}}.
class Results {
 public:
  /// With what other programs wrote there before.
  explicit Results(std::string path);

  /// Each run, named after its drag; the same one again takes the place of the first.
  void add(const std::vector<Run>& runs);
  nlohmann::json& ratios() { return all_["ratios"]; }
  const nlohmann::json& all() const { return all_; }
  void write() const;

 private:
  std::string path_;
  nlohmann::json all_;
};

}  // namespace chainmail::bench
