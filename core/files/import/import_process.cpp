#include "files/import/import_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <new>
#include <numeric>
#include <optional>

#include "files/text/outputs.h"
#include "files/text/program_folder.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

[[noreturn]] void fail_writing(const std::filesystem::path& path, const std::string& problem) {
  const std::string why = system_reason();
  throw WriteFailure(shown(path), problem + " (" + why + ")",
                     system_remedy("free some space, or set TMPDIR to another folder"));
}

}  // namespace

void ImportInput::link(const std::string& name, RegularFile file) {
  const int channel = import::first_input + static_cast<int>(linked_.size());
  assert(channel <= import::last_input);
  const auto path = folder() / name;
  if (symlink(("/proc/self/fd/" + std::to_string(channel)).c_str(), path.c_str()) != 0) {
    fail_writing(path, "a link cannot be created");
  }
  linked_.push_back(std::move(file));
  name_first(name);
}

void ImportInput::write(const std::string& name, std::string_view bytes) {
  const auto path = folder() / name;
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  if (!file.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush()) {
    fail_writing(path, "it cannot be written to its end");
  }
  name_first(name);
}

std::uint64_t ImportInput::linked_size() const {
  return std::accumulate(linked_.begin(), linked_.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const RegularFile& file) { return sum + file.size(); });
}

void ImportInput::name_first(const std::string& name) {
  if (main_name_.empty()) {
    main_name_ = name;
  }
}

namespace {

constexpr int wait_milliseconds = 30;               // between two checks for cancelling
constexpr int first_free = import::last_input + 1;  // descriptors below have a meaning in the program

/// Finds the program at the given path, in the folder of this program, or where an installation has it.
std::filesystem::path import_program(const std::filesystem::path& given) {
  std::error_code none;
  if (std::filesystem::is_regular_file(given, none)) {
    return given;
  }
  const auto folder = program_folder();
  for (const char* subfolder : {"", "../bin", "../libexec/chainmail"}) {
    if (auto program = folder / subfolder / "chainmail-import"; std::filesystem::is_regular_file(program, none)) {
      return program;
    }
  }
  throw Error("chainmail-import", "the program that reads this format is missing", "install it in the same folder");
}

/// Returns the environment of the program: only variables that locate its libraries or configure a sanitizer. No other
/// variable of the user can affect a library. The private folder replaces the home folder.
std::vector<std::string> environment_in(const std::string& folder) {
  std::vector<std::string> variables{"HOME=" + folder, "TMPDIR=" + folder, "LC_ALL=C", "OMP_NUM_THREADS=1",
                                     "OPENBLAS_NUM_THREADS=1"};
  for (const char* kept : {"LD_LIBRARY_PATH", "CHAINMAIL_WITHOUT_SANDBOX", "ASAN_OPTIONS", "LSAN_OPTIONS",
                           "TSAN_OPTIONS", "UBSAN_OPTIONS"}) {
    if (const char* value = std::getenv(kept)) {
      variables.push_back(std::string(kept) + "=" + value);
    }
  }
  return variables;
}

/// Returns pointers to the words, followed by null, as system calls expect.
std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers(words.size() + 1, nullptr);
  std::transform(words.begin(), words.end(), pointers.begin(), [](std::string& word) { return word.data(); });
  return pointers;
}

/// Throws Error for a failed system call, from errno.
[[noreturn]] void fail_start(const std::string& problem) {
  const std::string why = system_reason();
  throw Error("chainmail-import", problem + " (" + why + ")", system_remedy("install it again"));
}

/// A copy of a descriptor that no other child inherits, with a number above those that the program uses.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int copied) : number_(fcntl(copied, F_DUPFD_CLOEXEC, first_free)) {
    if (number_ < 0) {
      errno = errno == EINVAL ? EMFILE : errno;  // the limit is below first_free
      fail_start("no more files can be opened");
    }
  }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() {
    if (number_ >= 0) {
      ::close(number_);
    }
  }

  int number() const { return number_; }

 private:
  int number_ = -1;
};

class Pipe {
 public:
  Pipe() {
    std::array<int, 2> ends{-1, -1};
#ifdef __linux__
    const bool opened = pipe2(ends.data(), O_CLOEXEC) == 0;  // no child of another thread inherits it
#else
    const bool opened = pipe(ends.data()) == 0;
#endif
    if (!opened) {
      fail_start("a pipe cannot be created");
    }
    const Closed guard{ends};
    out_ = Descriptor(ends[0]);
    in_ = Descriptor(ends[1]);
  }

  int out() const { return out_.number(); }
  int in() const { return in_.number(); }
  void close_in() { in_ = Descriptor(); }

 private:
  struct Closed {
    const std::array<int, 2>& ends;
    ~Closed() {
      ::close(ends[0]);
      ::close(ends[1]);
    }
  };

  Descriptor out_, in_;
};

/// The descriptors that the program starts with.
class SpawnActions {
 public:
  SpawnActions() {
    check(posix_spawn_file_actions_init(&actions_));
    for (int standard = 0; standard <= 2; ++standard) {
      check(posix_spawn_file_actions_addopen(&actions_, standard, "/dev/null", standard == 0 ? O_RDONLY : O_WRONLY, 0));
    }
  }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }

  void give(int descriptor, int as) { check(posix_spawn_file_actions_adddup2(&actions_, descriptor, as)); }
  void close(int number) { check(posix_spawn_file_actions_addclose(&actions_, number)); }
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  static void check(int error) {
    if (error != 0) {
      throw std::bad_alloc();  // no other error is possible
    }
  }

  posix_spawn_file_actions_t actions_;
};

/// The running program. The destructor ends it.
class Child {
 public:
  Child(std::vector<std::string> words, const ImportInput& input, const Pipe& result, const Pipe& shares) {
    SpawnActions actions;
    actions.give(result.in(), import::result_channel);
    actions.give(shares.in(), import::share_channel);
    std::vector<Descriptor> files;  // copies, with numbers above the targets
    int as = import::first_input;
    for (const RegularFile& file : input.linked()) {
      files.emplace_back(file.descriptor());
      actions.give(files.back().number(), as++);
    }
    while (as <= import::last_input) {
      actions.close(as++);  // an open file of ours with this number is no input
    }
    auto environment = environment_in(input.folder().string());
    const int error = posix_spawn(&process_, words[0].c_str(), actions.get(), nullptr, pointers_to(words).data(),
                                  pointers_to(environment).data());
    if (error != 0) {
      process_ = 0;
      errno = error;
      fail_start(shown(words[0]) + " cannot be started");
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (process_ != 0) {
      kill(process_, SIGKILL);
      while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
      }
    }
  }

  /// Returns the status of waitpid, or nothing while the program runs.
  std::optional<int> ended() {
    int status = 0;
    const pid_t found = waitpid(process_, &status, WNOHANG);
    if (found != process_ && !(found < 0 && errno == ECHILD)) {
      return std::nullopt;
    }
    process_ = 0;
    return status;  // 0 if a caller ignores SIGCHLD: then the system does not keep it
  }

  /// Number of bytes that it has read, or 0 if the system does not count them.
  double bytes_read() const {
    std::ifstream counts("/proc/" + std::to_string(process_) + "/io");
    std::string word;
    double bytes = 0;
    return counts >> word >> bytes && word == "rchar:" ? bytes : 0;
  }

 private:
  pid_t process_ = 0;
};

enum class Ending { closed, too_much, too_late };

/// Reads both pipes until the program has closed the result, or exceeds a limit.
class Listener {
 public:
  using Clock = std::chrono::steady_clock;

  Listener(const Pipe& result, const Pipe& shares, const ImportLimits& limits, const Progress& progress)
      : result_(result),
        shares_(shares),
        limits_(limits),
        progress_(progress),
        end_(Clock::now() + std::chrono::seconds(limits.wall_seconds)) {}

  /// `share()` returns the share that is done, for tasks that do not report it.
  template <class Share>
  Ending listen(Share share) {
    for (;;) {
      std::array<pollfd, 2> ready{{{result_.out(), POLLIN, 0}, {shares_.out(), POLLIN, 0}}};
      poll(ready.data(), shares_open_ ? 2 : 1, wait_milliseconds);
      progress_.report(std::max(share_, share()));
      if (shares_open_ && ready[1].revents != 0) {
        take_share();
      }
      if (ready[0].revents != 0 && !take_result()) {
        if (shares_open_ && poll(&ready[1], 1, 0) > 0) {
          take_share();
        }
        return bytes_.size() <= limits_.bytes ? Ending::closed : Ending::too_much;
      }
      if (is_late()) {
        return Ending::too_late;
      }
    }
  }
  bool is_late() const { return Clock::now() > end_; }
  /// True if the program has reported that it works.
  bool heard() const { return heard_; }
  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  void take_share() {
    double share = 0;
    const ssize_t got = read(shares_.out(), &share, sizeof share);
    shares_open_ = got > 0;
    heard_ = heard_ || got > 0;
    if (got == ssize_t{sizeof share} && share >= 0 && share <= 1) {
      share_ = share;
    }
  }
  bool take_result() {
    const std::size_t before = bytes_.size();
    bytes_.resize(before + piece);
    const ssize_t got = read(result_.out(), bytes_.data() + before, piece);
    bytes_.resize(before + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    return (got > 0 || (got < 0 && errno == EINTR)) && bytes_.size() <= limits_.bytes;
  }

  static constexpr std::size_t piece = std::size_t{1} << 20;

  const Pipe& result_;
  const Pipe& shares_;
  const ImportLimits& limits_;
  const Progress& progress_;
  Clock::time_point end_;
  std::vector<std::byte> bytes_;
  double share_ = 0;
  bool shares_open_ = true, heard_ = false;
};

[[noreturn]] void refuse_memory(const std::string& where, const ImportLimits& limits) {
  throw Error(where, "reading it takes more than " + std::to_string(limits.bytes >> 20) + " MiB of memory",
              "use a smaller file, or another format");
}

[[noreturn]] void refuse_time(const std::string& where, unsigned seconds) {
  throw Error(where, "reading it takes longer than " + std::to_string(seconds) + " s",
              "use a smaller file, or another format");
}

/// Throws Error for a program that ended before it could do anything: it is not ours, or lacks a library.
void check_start(int status, bool heard) {
  if (!heard && WIFEXITED(status)) {
    throw Error("chainmail-import",
                "it ended as soon as it started (exit status " + std::to_string(WEXITSTATUS(status)) + ")",
                "install it and the libraries that it needs again");
  }
}

/// Throws Error for a `status` of waitpid that is not success.
void check_end(int status, const std::string& where, const ImportLimits& limits) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == import::out_of_memory) {
    refuse_memory(where, limits);
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
    refuse_time(where, limits.seconds);
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) {
    throw Error(where, "the system ended the program that reads it, probably because memory was short",
                "close other programs, or use a smaller file");
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw Error(where, "it is damaged: the library that reads it failed on it",
                "export it again, or in another format");
  }
}

}  // namespace

ImportLimits limits_for(std::uint64_t size) {
  ImportLimits limits;
  rlimit own{};
  limits.bytes = (std::uint64_t{2} << 30) + 40 * size;
  if (getrlimit(RLIMIT_AS, &own) == 0) {
    limits.bytes = std::min<std::uint64_t>(limits.bytes, own.rlim_cur);
  }
  if (getrlimit(RLIMIT_CPU, &own) == 0) {
    limits.seconds = static_cast<unsigned>(std::min<rlim_t>(limits.seconds, own.rlim_cur));
  }
  return limits;
}

Imported run_import(const std::string& task, const ImportInput& input, const std::vector<std::string>& arguments,
                    const ImportLimits& limits, const Progress& progress, const std::filesystem::path& program) {
  std::vector<std::string> words{import_program(program).string(), std::to_string(limits.bytes),
                                 std::to_string(limits.seconds), task, input.main_file().string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  Pipe result, shares;
  Child child(std::move(words), input, result, shares);
  result.close_in();
  shares.close_in();
  const std::string where = shown(input.shown_as());
  const double size = input.bytes_to_read();
  Listener listener(result, shares, limits, progress);
  switch (listener.listen([&] { return size > 0 ? std::min(1.0, child.bytes_read() / size) : 0; })) {
    case Ending::too_much:
      refuse_memory(where, limits);
    case Ending::too_late:
      refuse_time(where, limits.wall_seconds);
    case Ending::closed:
      break;
  }
  std::optional<int> status;
  while (!(status = child.ended())) {  // ends immediately, unless it runs on after closing the pipe
    progress.report(1);
    if (listener.is_late()) {
      refuse_time(where, limits.wall_seconds);
    }
    poll(nullptr, 0, 1);
  }
  check_start(*status, listener.heard() || !listener.bytes().empty());
  check_end(*status, where, limits);
  Imported imported = decode_imported(listener.bytes(), input.shown_as());
  if (const auto* refusal = std::get_if<Refusal>(&imported)) {
    throw Error(where, refusal->problem, refusal->remedy);
  }
  return imported;
}

}  // namespace chainmail
