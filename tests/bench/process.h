#pragma once

#include <cstdint>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>

namespace chainmail::bench {

/// What this process has used, as the kernel counts it.

/// Processor time so far: CLOCK_THREAD_CPUTIME_ID of this thread, CLOCK_PROCESS_CPUTIME_ID of all (ms).
inline double cpu_milliseconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return 1e3 * double(now.tv_sec) + 1e-6 * double(now.tv_nsec);
}

/// The number that stands behind a name such as `VmRSS:` in /proc/…/status.
inline double from_status(const std::filesystem::path& status, const std::string& name) {
  std::ifstream in(status);
  for (std::string word; in >> word;) {
    if (double number = 0; word == name && in >> number) {
      return number;
    }
  }
  return 0;
}

/// Bytes that are in memory now.
inline double resident_bytes() { return 1024 * from_status("/proc/self/status", "VmRSS:"); }

/// How often its threads went to sleep, and so woke up.
inline double wake_ups() {
  double sum = 0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    sum += from_status(task.path() / "status", "voluntary_ctxt_switches:");
  }
  return sum;
}

}  // namespace chainmail::bench
