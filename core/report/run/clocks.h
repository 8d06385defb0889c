#pragma once

#include <functional>

namespace chainmail::report {

/// Two clocks, each in seconds from some moment: elapsed time, and the time that the thread itself ran. Time that the
/// thread waits for other programs is not a cost of an algorithm.
struct Clocks {
  std::function<double()> wall;
  std::function<double()> own;
};

/// Returns the clocks of the machine and of the calling thread. Where threads have no clock, both are that of the
/// machine.
Clocks machine_clocks();

/// Returns the seconds that `work` takes without the time of other programs: the shorter of the two times. The clock of
/// the thread is read outside, because reading it takes longer than a small pass.
template <class Work>
double seconds_of(const Clocks& clocks, Work work) {
  const double own = clocks.own(), wall = clocks.wall();
  work();
  const double by_wall = clocks.wall() - wall, by_own = clocks.own() - own;
  return by_wall < by_own ? by_wall : by_own;
}

}  // namespace chainmail::report
