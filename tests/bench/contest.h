#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace chainmail::bench {

/// A time that was measured.
struct Run {
  std::string name, mesh, algorithm;
  std::uint64_t elements = 0;
  double moved = 0;  // elements, a pass
  double ms = 0;     // a pass; median over the repetitions
  double ns_per_moved() const { return moved > 0 ? 1e6 * ms / moved : 0; }
};

/// One of those that are compared: `pass` makes the next move and says how many elements moved.
struct Contestant {
  std::string algorithm;
  std::function<std::uint64_t()> pass;
};

/// Contestants over one mesh and drag. Google Benchmark times them in one process and thread: each
/// repetition is a number of passes, and the repetitions come in random order, so that what else the
/// machine does, and how warm it is, falls on all alike.
struct Contest {
  std::string name, mesh;
  std::uint64_t elements = 0;
  int passes = 1;  // a repetition
  std::vector<Contestant> contestants;
};

/// Runs the contest, and says each result on a line.
std::vector<Run> run(const Contest& contest);

/// Of these, the run of one algorithm.
const Run& of(const std::vector<Run>& runs, const std::string& algorithm);

}  // namespace chainmail::bench
