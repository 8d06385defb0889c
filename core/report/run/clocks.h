#pragma once

#include <functional>

namespace chainmail::report {

/// Two clocks in seconds from an arbitrary moment: elapsed time, and the processor time of the thread. The second one
/// does not count the time in which other programs run, which is not a cost of an algorithm.
struct Clocks {
  std::function<double()> wall;
  std::function<double()> own;
};

/// Returns the clocks of the machine and of the calling thread. If the system has no clock for threads, both are the
/// clock of the machine.
Clocks machine_clocks();

/// Returns the time in seconds that `work` takes, without the time of other programs: the shorter of the two times. The
/// outer readings are those of the thread's clock, because reading it takes longer than a small pass.
template <class Work>
double seconds_of(const Clocks& clocks, Work work) {
  const double own = clocks.own(), wall = clocks.wall();
  work();
  const double by_wall = clocks.wall() - wall, by_own = clocks.own() - own;
  return by_wall < by_own ? by_wall : by_own;
}

}  // namespace chainmail::report
