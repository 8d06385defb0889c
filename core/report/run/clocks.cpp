#include "report/run/clocks.h"

#include <chrono>
#include <ctime>

namespace chainmail::report {
namespace {

double wall() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

#ifdef CLOCK_THREAD_CPUTIME_ID
double own() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}
#else
double own() { return wall(); }
#endif

}  // namespace

Clocks machine_clocks() { return {wall, own}; }

}  // namespace chainmail::report
