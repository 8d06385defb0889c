#pragma once

#include <dlfcn.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>

/// Replaces the function by which a program starts threads, so only one source of a program may include it.
namespace chainmail::test {

inline std::atomic<bool> threads_fail = false;

/// While it exists, the system starts no more threads.
struct NoThreads {
  NoThreads() { threads_fail = true; }
  NoThreads(const NoThreads&) = delete;
  NoThreads& operator=(const NoThreads&) = delete;
  ~NoThreads() { threads_fail = false; }
};

}  // namespace chainmail::test

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                              void* argument) noexcept {
  static const auto original = reinterpret_cast<decltype(&pthread_create)>(::dlsym(RTLD_NEXT, "pthread_create"));
  return chainmail::test::threads_fail ? EAGAIN : original(thread, attributes, start, argument);
}
