#pragma once

#include <QMetaObject>
#include <atomic>
#include <chrono>
#include <new>
#include <thread>

namespace chainmail {

/// Calls a function or a member function of `receiver` in the GUI thread, soon. For other threads: the window would
/// wait for ever for an announcement that is lost, so this waits some seconds for memory if there is none. Throws
/// std::bad_alloc after that.
template <class Receiver, class Call>
void announce(Receiver* receiver, const Call& call) {
  constexpr int tries = 500;
  constexpr std::chrono::milliseconds pause(10);
  for (int i = 1;; ++i) {
    try {
      QMetaObject::invokeMethod(receiver, call, Qt::QueuedConnection);
      return;
    } catch (const std::bad_alloc&) {
      if (i == tries) {
        throw;
      }
      std::this_thread::sleep_for(pause);
    }
  }
}

/// The same, unless such a call is on its way: `announced` is true from now until the call resets it. For callers that
/// try again later: throws std::bad_alloc at once if there is no memory.
template <class Receiver, class Call>
void announceOnce(std::atomic<bool>& announced, Receiver* receiver, const Call& call) {
  if (announced.exchange(true)) {
    return;
  }
  try {
    QMetaObject::invokeMethod(receiver, call, Qt::QueuedConnection);
  } catch (...) {
    announced = false;
    throw;
  }
}

}  // namespace chainmail
