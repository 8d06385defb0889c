#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "measure/time_spread.h"

namespace chainmail::bench {

/// One of those that are compared: `pass` makes the next move and says how many elements moved.
struct Contestant {
  std::string drag, mesh, algorithm;
  std::uint64_t elements = 0;
  int passes = 1;  // a repetition
  std::function<std::uint64_t()> pass;
};

/// A time that was measured.
struct Run {
  std::string drag, mesh, algorithm;
  std::uint64_t elements = 0;
  double moved = 0;  // elements, a pass
  double ms = 0;     // a pass; median over the repetitions of this process

  double ns_per_moved() const { return moved > 0 ? 1e6 * ms / moved : 0; }
};

/// Google Benchmark times the contestants in one process and thread. A repetition is a number of passes, and
/// the repetitions come in random order: what else the machine does, and how warm it is, falls on all alike.
/// Says each result on a line.
std::vector<Run> run(const std::vector<Contestant>& contest);

/// Of these, the run of one algorithm, on one mesh where it ran on several.
const Run& of(const std::vector<Run>& runs, const std::string& algorithm, const std::string& mesh = {});

inline double median(std::vector<double> values) { return spread_of(std::move(values)).median; }

}  // namespace chainmail::bench
