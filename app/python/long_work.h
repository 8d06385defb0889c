#pragma once

#include <cxxabi.h>
#include <pybind11/pybind11.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <system_error>
#include <utility>

#include "python/object.h"

namespace chainmail::python {

/// Calls what may ask for the lock of Python. When Python ends, it ends every other thread that asks for it, by
/// unwinding the stack. On the way, objects of Python would be destroyed without the lock, which ends the process with
/// a signal. So such a thread stays here until the process has ended. `call` must not have objects that unwinding
/// destroys.
template <class Call>
auto outlive_python(Call call) {
  try {
    return call();
  } catch (const abi::__forced_unwind&) {
    while (true) {
      ::pause();
    }
  }
}

/// Lets other threads have the lock of Python while it exists.
class Unlocked {
 public:
  Unlocked() : state_(PyEval_SaveThread()) {}
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;
  ~Unlocked() {
    outlive_python([this] { PyEval_RestoreThread(state_); });
  }

 private:
  PyThreadState* state_;
};

/// Waits for work in another thread, without the lock of Python. Calls `progress`, unless it is None, with the share
/// that is done. Ctrl-C and an exception of `progress` cancel the job; the exception is thrown when the work has ended.
void wait_for_work(const Progress& job, const pybind11::object& progress,
                   const std::function<bool(std::chrono::milliseconds)>& is_done_within);

/// Runs work that may take long in a thread of its own, while this thread looks for Ctrl-C: Python handles signals only
/// between its own instructions. The work gets the job, or a new one if it is null, and must not touch Python. If the
/// system has no memory for another thread, the work runs in this one, and Ctrl-C waits for it.
template <class Work>
auto run_long(const Progress* given, const pybind11::object& progress, Work work) {
  const Progress job = given != nullptr ? *given : Progress::watched();
  // The C library ends the program if a thread finds no memory for its first exception, so some is kept for that.
  auto reserve = std::make_unique_for_overwrite<std::array<std::byte, 1 << 20>>();
  std::future<decltype(work(job))> result;
  try {
    result = std::async(std::launch::async, [&work, &job, kept = std::move(reserve)]() mutable {
      kept.reset();
      static_cast<void>(std::uncaught_exceptions());  // takes the memory
      return work(job);
    });
  } catch (const std::system_error&) {
    const Unlocked unlocked;
    return work(job);
  }
  wait_for_work(job, progress,
                [&](std::chrono::milliseconds time) { return result.wait_for(time) == std::future_status::ready; });
  return result.get();
}

}  // namespace chainmail::python
