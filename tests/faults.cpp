#include "faults.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstring>
#include <string_view>

namespace chainmail::test {
namespace {

std::array<char, PATH_MAX> folder{};
std::atomic<int> armed_call{-1}, left{0}, armed_error{0};
std::atomic<bool> has_failed{false}, stays_armed{false};

bool is_below(std::string_view path) {
  const std::string_view root(folder.data());
  return !root.empty() && path.substr(0, root.size()) == root;
}

bool is_below(int descriptor) {
  std::array<char, PATH_MAX> path{};
  std::array<char, 40> link{};
  snprintf(link.data(), link.size(), "/proc/self/fd/%d", descriptor);
  const ssize_t size = readlink(link.data(), path.data(), path.size());
  return size > 0 && is_below(std::string_view(path.data(), static_cast<std::size_t>(size)));
}

/// Returns true if this call has to fail, and sets errno.
template <class Where>
bool fails(FileCall call, Where where) {
  if (armed_call.load() != static_cast<int>(call) || !is_below(where)) {
    return false;
  }
  const int before = left.fetch_sub(1);
  if (before > 1 || (before < 1 && !stays_armed)) {
    return false;
  }
  has_failed = true;
  errno = armed_error;
  return true;
}

/// Returns the function that this program would call without this file.
template <class Function>
Function* next(Function* /*type*/, const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

mode_t mode_of(int flags, va_list arguments) { return (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0; }

bool writes(int flags) { return (flags & O_ACCMODE) != O_RDONLY; }

}  // namespace

const std::vector<NamedCall>& file_calls() {
  static const std::vector<NamedCall> calls{
      {FileCall::open, "open"}, {FileCall::write, "write"}, {FileCall::sync, "fsync"}, {FileCall::rename, "rename"}};
  return calls;
}

void arm_fault(const std::string& below, FileCall call, int n, int error, bool stays) {
  strncpy(folder.data(), below.c_str(), folder.size() - 1);
  has_failed = false;
  stays_armed = stays;
  armed_error = error;
  left = n;
  armed_call = static_cast<int>(call);
}

bool disarm_fault() {
  armed_call = -1;
  return has_failed;
}

}  // namespace chainmail::test

// The calls of the C library, in place of its own.

using chainmail::test::fails;
using chainmail::test::FileCall;
using chainmail::test::next;

extern "C" {

#define CHAINMAIL_OPEN(NAME)                                                               \
  int NAME(const char* path, int flags, ...) {                                             \
    va_list arguments;                                                                     \
    va_start(arguments, flags);                                                            \
    const mode_t mode = chainmail::test::mode_of(flags, arguments);                        \
    va_end(arguments);                                                                     \
    if (chainmail::test::writes(flags) && fails(FileCall::open, std::string_view(path))) { \
      return -1;                                                                           \
    }                                                                                      \
    static const auto original = next<int(const char*, int, ...)>(nullptr, #NAME);         \
    return original(path, flags, mode);                                                    \
  }
CHAINMAIL_OPEN(open)
CHAINMAIL_OPEN(open64)

ssize_t write(int descriptor, const void* bytes, size_t size) {
  static const auto original = next<ssize_t(int, const void*, size_t)>(nullptr, "write");
  return fails(FileCall::write, descriptor) ? -1 : original(descriptor, bytes, size);
}

ssize_t writev(int descriptor, const iovec* parts, int count) {
  static const auto original = next<ssize_t(int, const iovec*, int)>(nullptr, "writev");
  return fails(FileCall::write, descriptor) ? -1 : original(descriptor, parts, count);
}

int fsync(int descriptor) {
  static const auto original = next<int(int)>(nullptr, "fsync");
  return fails(FileCall::sync, descriptor) ? -1 : original(descriptor);
}

int rename(const char* from, const char* to) {
  static const auto original = next<int(const char*, const char*)>(nullptr, "rename");
  return fails(FileCall::rename, std::string_view(to)) ? -1 : original(from, to);
}
}
