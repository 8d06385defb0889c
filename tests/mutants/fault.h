#pragma once

// Included by the copies of sources that contain faults of tests/mutants/mutants.py. All faults are in one build. Each
// has a number, and the environment variable CHAINMAIL_FAULT switches one on. If CHAINMAIL_FAULTS_REACHED names a
// file instead, the byte of each fault whose place is executed becomes 1.

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <exception>
#include <type_traits>
#include <utility>

// A fault may look wrong to the optimiser, too. That must not end the build.
#ifndef __clang__
#pragma GCC diagnostic warning "-Warray-bounds"
#pragma GCC diagnostic warning "-Wmaybe-uninitialized"
#pragma GCC diagnostic warning "-Wstringop-overflow"
#endif

inline int chainmail_active_fault = 0;
inline char* chainmail_reached_faults = nullptr;  // memory of the file, also in a process that may not write files
inline constexpr int chainmail_fault_limit = 4096;

/// Runs before all other initialisations. Each source has one, and the first does the work.
__attribute__((constructor(101))) static void chainmail_choose_fault() {
  if (const char* number = std::getenv("CHAINMAIL_FAULT")) {
    chainmail_active_fault = std::atoi(number);
  }
  const char* path = std::getenv("CHAINMAIL_FAULTS_REACHED");
  if (path == nullptr || chainmail_reached_faults != nullptr) {
    return;
  }
  const int file = open(path, O_RDWR | O_CLOEXEC);
  void* memory = mmap(nullptr, chainmail_fault_limit, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory != MAP_FAILED) {
    chainmail_reached_faults = static_cast<char*>(memory);
  }
  close(file);
}

/// True if the fault is switched on.
inline bool chainmail_fault(int number) {
  if (chainmail_reached_faults != nullptr) [[unlikely]] {
    chainmail_reached_faults[number] = 1;
  }
  return chainmail_active_fault == number;
}

/// True if the fault is switched on and its place was executed before.
inline bool chainmail_fault_again(int number) {
  static std::atomic<bool> was_here = false;
  return chainmail_fault(number) && was_here.exchange(true);
}

/// Carries out a check at once; if the fault is switched on, at the end of the block, unless that ends by an exception.
template <class Check>
class ChainmailLate {
 public:
  ChainmailLate(int number, Check check) : check_(std::move(check)), is_late_(chainmail_fault(number)) {
    if (!is_late_) {
      check_();
    }
  }
  ChainmailLate(const ChainmailLate&) = delete;
  ChainmailLate& operator=(const ChainmailLate&) = delete;
  ~ChainmailLate() noexcept(false) {
    if (is_late_ && std::uncaught_exceptions() == exceptions_) {
      check_();
    }
  }

 private:
  Check check_;
  bool is_late_;
  int exceptions_ = std::uncaught_exceptions();
};

/// Returns the first value, or the second one if the fault is switched on. Compiles only if both have one type.
template <class T>
const T& chainmail_swapped(int number, const T& first, const T& second) {
  return chainmail_fault(number) ? second : first;
}

/// Returns the value, or an empty one if the fault is switched on. A member that is a reference still refers to the
/// value, not to a copy.
template <class T>
const T& chainmail_or_empty(int number, const T& value) {
  static const T empty{};
  return chainmail_fault(number) ? empty : value;
}

/// What an option has if nobody sets it.
template <class Options>
inline const Options chainmail_default{};
