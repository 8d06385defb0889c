#include "report/table/machine.h"

#include <ctime>
#include <fstream>
#include <thread>

namespace chainmail::report {
namespace {

/// Returns the processor's name from /proc/cpuinfo, which only Linux has.
std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("model name")) {
      const auto begin = line.find_first_not_of(": \t", line.find(':'));
      return begin == std::string::npos ? "unknown" : line.substr(begin);
    }
  }
  return "unknown";
}

std::string compiler() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#elif defined(__GNUC__)
  return "GCC " __VERSION__;
#else
  return "unknown";
#endif
}

std::string build() {
  const std::string type = CHAINMAIL_BUILD_TYPE;
#ifdef NDEBUG
  return type.empty() ? "optimised" : type;
#else
  return type.empty() ? "with assertions" : type + ", with assertions";
#endif
}

}  // namespace

Machine this_machine() { return {processor(), std::thread::hardware_concurrency(), compiler(), build()}; }

std::string now_in_words() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &parts);
  return text;
}

}  // namespace chainmail::report
