#pragma once

#include <functional>

namespace chainmail::report {

/// Two clocks, in seconds from some moment each. Of a piece of work, the wall's tells how long it took, and
/// the thread's own how long it ran: what it waited for other programs is no cost of an algorithm's.
struct Clocks {
  std::function<double()> wall;
  std::function<double()> own;
};

/// Those of the machine and of the calling thread; where threads have no clock, the wall's twice.
Clocks machine_clocks();

/// The seconds that `work` takes, less what other programs took from it: the shorter of the two times. The
/// own clock is asked outside, because asking takes longer than a small pass.
template <class Work>
double seconds_of(const Clocks& clocks, Work work) {
  const double own = clocks.own(), wall = clocks.wall();
  work();
  const double by_wall = clocks.wall() - wall, by_own = clocks.own() - own;
  return by_wall < by_own ? by_wall : by_own;
}

}  // namespace chainmail::report
