#include "files/import/sandbox.h"

#ifdef CHAINMAIL_HAS_SANDBOX

#include <fcntl.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>
#include <type_traits>
#include <vector>

#include "files/import/landlock.h"

namespace chainmail::import {
namespace {

// The filter lists the allowed calls, so unknown calls are denied. A denied call returns ENOSYS, as in an old kernel:
// the C library then uses an older call, or reports an error. New threads are denied, too: no library needs them, and a
// damaged file could start tens of thousands.

/// Calls that are safe with any arguments.
constexpr std::array harmless{
    // reading files; newfstatat and statx also see the size and times of a file that is named
    "close", "close_range", "dup", "dup2", "dup3", "fstat", "fstatfs", "getdents", "getdents64", "lseek", "newfstatat",
    "pread64", "preadv", "read", "readv", "statx",
    // pipes and open descriptors
    "pipe", "pipe2", "poll", "ppoll", "pselect6", "select", "write", "writev",
    // memory
    "brk", "madvise", "mincore", "mmap", "mprotect", "mremap", "munmap",
    // threads that run already, and signals within this process
    "exit", "exit_group", "futex", "get_robust_list", "getpid", "gettid", "restart_syscall", "rseq", "rt_sigaction",
    "rt_sigpending", "rt_sigprocmask", "rt_sigreturn", "sched_getaffinity", "sched_getparam", "sched_getscheduler",
    "sched_yield", "set_robust_list", "set_tid_address", "sigaltstack",
    // time, information about the machine and the user
    "clock_getres", "clock_gettime", "clock_nanosleep", "getcpu", "getegid", "geteuid", "getgid", "getpgrp", "getppid",
    "getrandom", "getrlimit", "getrusage", "gettimeofday", "getuid", "nanosleep", "sysinfo", "time", "times", "uname"};

/// Compares some bits of an argument of a call.
scmp_arg_cmp bits(unsigned argument, scmp_datum_t mask, scmp_datum_t wanted) {
  return {argument, SCMP_CMP_MASKED_EQ, mask, wanted};
}
scmp_arg_cmp equal(unsigned argument, scmp_datum_t wanted) { return {argument, SCMP_CMP_EQ, wanted, 0}; }

/// Builds the filter, and remembers errors.
class Filter {
 public:
  Filter() : context_(seccomp_init(SCMP_ACT_ERRNO(ENOSYS)), &seccomp_release) {}

  /// Allows a call with these arguments, if this machine has the call.
  void allow(const char* call, const std::vector<scmp_arg_cmp>& arguments = {}) {
    const int number = seccomp_syscall_resolve_name(call);
    good_ = good_ && context_ &&
            (number == __NR_SCMP_ERROR || seccomp_rule_add_array(context_.get(), SCMP_ACT_ALLOW, number,
                                                                 unsigned(arguments.size()), arguments.data()) == 0);
  }

  /// Applies the filter to all threads of this process: libraries may have started some.
  bool load() const {
    return good_ && seccomp_attr_set(context_.get(), SCMP_FLTATR_CTL_TSYNC, 1) == 0 &&
           seccomp_load(context_.get()) == 0;
  }

 private:
  std::unique_ptr<std::remove_pointer_t<scmp_filter_ctx>, decltype(&seccomp_release)> context_;
  bool good_ = true;
};

void allow_opening(Filter& filter) {
  constexpr int changes = (O_ACCMODE | O_CREAT | O_TRUNC | O_TMPFILE) & ~O_DIRECTORY;  // O_TMPFILE holds this bit too
  filter.allow("open", {bits(1, changes, O_RDONLY)});
  filter.allow("openat", {bits(2, changes, O_RDONLY)});
}

void allow_own_affairs(Filter& filter) {
  for (const int command : {F_DUPFD, F_DUPFD_CLOEXEC, F_GETFD, F_SETFD, F_GETFL}) {
    filter.allow("fcntl", {equal(1, scmp_datum_t(command))});
  }
  filter.allow("tgkill", {equal(0, scmp_datum_t(getpid()))});  // used by abort
  filter.allow("prctl", {equal(0, PR_SET_NAME)});
  filter.allow("prlimit64", {equal(0, 0), equal(2, 0)});  // reads its own limits
}

/// Files that are open for writing cannot grow.
bool forbid_writing_files() {
  const rlimit both{0, 0};
  return setrlimit(RLIMIT_FSIZE, &both) == 0;
}

}  // namespace

bool enter_sandbox(const SandboxFiles& files) {
  Filter filter;
  std::for_each(harmless.begin(), harmless.end(), [&](const char* call) { filter.allow(call); });
  allow_opening(filter);
  allow_own_affairs(filter);
  return forbid_writing_files() && prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         (!sandbox_hides_files() || give_up_files(files.folder, files.inputs)) && filter.load();
}

bool sandbox_hides_files() { return landlock_version() > 0; }

}  // namespace chainmail::import

#else

namespace chainmail::import {

bool enter_sandbox(const SandboxFiles& /*files*/) { return false; }

bool sandbox_hides_files() { return false; }

}  // namespace chainmail::import

#endif
