#pragma once

#include <cxxabi.h>
#include <pybind11/pybind11.h>
#include <unistd.h>

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

}  // namespace chainmail::python
