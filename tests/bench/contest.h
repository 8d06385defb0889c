#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "measure/pass_times.h"

namespace chainmail::bench {

/// One of the compared algorithms. `pass` makes the next move and returns how many elements moved.
struct Contestant {
  std::string drag, mesh, algorithm;
  std::uint64_t elements = 0;
  int passes = 1;  // per repetition
  std::function<std::uint64_t()> pass;
};

/// The measured time of a contestant.
struct Run {
  std::string drag, mesh, algorithm;
  std::uint64_t elements = 0;
  double moved = 0;  // mean number of elements per pass
  double ms = 0;     // per pass; median over the repetitions of this process

  double ns_per_moved() const { return moved > 0 ? 1e6 * ms / moved : 0; }
};

/// Lets Google Benchmark time the contestants in one process and thread. A repetition is a number of passes. The
/// repetitions run in random order, so that other load and the temperature of the machine affect all contestants alike.
/// Prints one line per result.
std::vector<Run> run(const std::vector<Contestant>& contest);

/// Returns the run of an algorithm; if it ran on several meshes, also name the mesh.
const Run& of(const std::vector<Run>& runs, const std::string& algorithm, const std::string& mesh = {});

inline double median(std::vector<double> values) { return spread_of(std::move(values)).median; }

}  // namespace chainmail::bench
