#pragma once

#include <cstdint>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>

namespace chainmail::bench {

// Resources that this process has used, as counted by the kernel.

/// Returns the processor time so far (ms): CLOCK_THREAD_CPUTIME_ID is for this thread, CLOCK_PROCESS_CPUTIME_ID for all
/// threads.
inline double cpu_milliseconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return 1e3 * double(now.tv_sec) + 1e-6 * double(now.tv_nsec);
}

/// Returns the number after a name such as `VmRSS:` in /proc/…/status.
inline double from_status(const std::filesystem::path& status, const std::string& name) {
  std::ifstream in(status);
  for (std::string word; in >> word;) {
    if (double number = 0; word == name && in >> number) {
      return number;
    }
  }
  return 0;
}

/// Returns the resident bytes of the process.
inline double resident_bytes() { return 1024 * from_status("/proc/self/status", "VmRSS:"); }

/// Returns how often the threads of this process have gone to sleep. Each time, they also woke up.
inline double wake_ups() {
  double sum = 0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    sum += from_status(task.path() / "status", "voluntary_ctxt_switches:");
  }
  return sum;
}

}  // namespace chainmail::bench
