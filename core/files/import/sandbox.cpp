#include "files/import/sandbox.h"

#ifdef CHAINMAIL_HAS_SANDBOX

#include <fcntl.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

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

// Landlock.

// The kernel's interface, which never changes (linux/landlock.h). Headers that are older than the kernel lack a part.
// The numbers of these calls are the same on all processors that ChainMail supports.
constexpr long create_ruleset = 444, add_rule = 445, restrict_self = 446;
constexpr unsigned ask_version = 1;  // a flag of create_ruleset
constexpr int path_beneath = 1;      // a kind of rule
constexpr std::uint64_t read_file = 1U << 2U, read_folder = 1U << 3U;

struct Ruleset {
  std::uint64_t handled;  // accesses that are denied without a rule
};
struct [[gnu::packed]] PathRule {
  std::uint64_t allowed;
  std::int32_t parent;  // the descriptor of a file, or of a folder and what is in it
};

/// Returns all accesses to files that a version knows, one bit for each.
std::uint64_t accesses(int version) {
  const int count = version >= 5 ? 16 : version >= 3 ? 15 : version == 2 ? 14 : 13;
  return (std::uint64_t{1} << unsigned(count)) - 1;
}

/// The rules, in a descriptor. Remembers errors.
class Rules {
 public:
  explicit Rules(int version) {
    const Ruleset all{accesses(version)};
    descriptor_ = int(syscall(create_ruleset, &all, sizeof all, 0));
    good_ = descriptor_ >= 0;
  }
  Rules(const Rules&) = delete;
  Rules& operator=(const Rules&) = delete;
  ~Rules() { close(descriptor_); }

  void allow(std::uint64_t access, int parent) {
    const PathRule rule{access, parent};
    const bool added = syscall(add_rule, descriptor_, path_beneath, &rule, 0) == 0;
    good_ = good_ && (added || errno == EBADFD);  // a file without a path, such as one in memory, needs no rule
  }
  void allow_folder(const std::filesystem::path& folder) {
    const int parent = open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
    allow(read_file | read_folder, parent);
    close(parent);
  }
  bool apply() const { return good_ && syscall(restrict_self, descriptor_, 0) == 0; }

 private:
  int descriptor_ = -1;
  bool good_ = false;
};

/// Landlock is the part of the kernel by which a program gives up access to files (Linux 5.13 and later). Returns the
/// version of its interface, or 0 if the kernel does not have it or does not use it.
int landlock_version() { return std::max(0, int(syscall(create_ruleset, nullptr, 0, ask_version))); }

/// Gives up access to all files, except that this thread, and the threads it starts, may still read what is in a folder
/// and may open these files again, for example by /proc/self/fd. An empty path means no folder. Open descriptors stay
/// as they are. The thread must not be able to gain privileges (PR_SET_NO_NEW_PRIVS). Returns false if this fails.
[[nodiscard]] bool give_up_files(const std::filesystem::path& folder, std::span<const int> files) {
  Rules rules(landlock_version());
  rules.allow_folder(folder);
  std::for_each(files.begin(), files.end(), [&](int file) { rules.allow(read_file, file); });
  return rules.apply();
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
