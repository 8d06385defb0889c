#include "files/import_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "files/import/channels.h"
#include "files/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr int wait_milliseconds = 30;  // between two looks at whether it was cancelled

/// Beside this program, or where an installation has it.
std::filesystem::path import_program() {
  std::error_code none;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
  for (const char* place : {"", "../bin", "../libexec/chainmail"}) {
    if (auto program = folder / place / "chainmail-import"; std::filesystem::is_regular_file(program, none)) {
      return program;
    }
  }
  throw Error("chainmail-import", "the program that reads this format is not beside this one",
              "install it in the same folder");
}

/// A pipe that no other child gets hold of.
class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0 || !move_out_of_the_way(ends_[0]) || !move_out_of_the_way(ends_[1])) {
      throw Error("chainmail-import", std::string("no pipe can be made (") + std::strerror(errno) + ")",
                  "close other programs");
    }
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    close_end(0);
    close_end(1);
  }

  int out() const { return ends_[0]; }
  int in() const { return ends_[1]; }
  void close_in() { close_end(1); }

 private:
  /// Of the places that the ends take in the program.
  static bool move_out_of_the_way(int& end) {
    const int moved = fcntl(end, F_DUPFD_CLOEXEC, import::share_channel + 1);
    ::close(std::exchange(end, moved));
    return moved >= 0;
  }
  void close_end(int i) {
    if (ends_[i] >= 0) {
      ::close(std::exchange(ends_[i], -1));
    }
  }

  std::array<int, 2> ends_{-1, -1};
};

/// The program at work, which does not outlive this.
class Child {
 public:
  Child(std::vector<std::string> words, const Pipe& result, const Pipe& shares) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (int standard = 0; standard <= 2; ++standard) {
      posix_spawn_file_actions_addopen(&actions, standard, "/dev/null", standard == 0 ? O_RDONLY : O_WRONLY, 0);
    }
    posix_spawn_file_actions_adddup2(&actions, result.in(), import::result_channel);
    posix_spawn_file_actions_adddup2(&actions, shares.in(), import::share_channel);
    std::vector<char*> arguments(words.size() + 1, nullptr);
    std::transform(words.begin(), words.end(), arguments.begin(), [](std::string& word) { return word.data(); });
    const int error = posix_spawn(&process_, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) {
      process_ = 0;
      throw Error(shown(words[0]), std::string("it cannot be started (") + std::strerror(error) + ")",
                  "install it anew");
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (process_ != 0) {
      kill(process_, SIGKILL);
      wait();
    }
  }

  /// How it ended, as waitpid has it.
  int wait() {
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = 0;
    return status;
  }

 private:
  pid_t process_ = 0;
};

/// Reads both pipes until the program has closed the result.
class Listener {
 public:
  Listener(const Pipe& result, const Pipe& shares, std::uint64_t most, const Progress& progress)
      : result_(result), shares_(shares), most_(most), progress_(progress) {}

  /// False where there was more than it may hand over.
  bool listen() {
    for (;;) {
      std::array<pollfd, 2> ready{{{result_.out(), POLLIN, 0}, {shares_.out(), POLLIN, 0}}};
      poll(ready.data(), shares_open_ ? 2 : 1, wait_milliseconds);
      progress_.report(share_);
      if (shares_open_ && ready[1].revents != 0) {
        take_share();
      }
      if (ready[0].revents != 0 && !take_result()) {
        return bytes_.size() <= most_;
      }
    }
  }
  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  void take_share() {
    double share = 0;
    const ssize_t got = read(shares_.out(), &share, sizeof share);
    shares_open_ = got > 0;
    if (got == ssize_t{sizeof share} && share >= 0 && share <= 1) {
      share_ = share;
    }
  }
  bool take_result() {
    const std::size_t before = bytes_.size();
    bytes_.resize(before + piece);
    const ssize_t got = read(result_.out(), bytes_.data() + before, piece);
    bytes_.resize(before + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    return (got > 0 || (got < 0 && errno == EINTR)) && bytes_.size() <= most_;
  }

  static constexpr std::size_t piece = std::size_t{1} << 20;

  const Pipe& result_;
  const Pipe& shares_;
  std::uint64_t most_;
  const Progress& progress_;
  std::vector<std::byte> bytes_;
  double share_ = 0;
  bool shares_open_ = true;
};

[[noreturn]] void refuse_end(int status, const std::string& where, const ImportLimits& limits) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == import::out_of_memory) {
    throw Error(where, "reading it takes more than " + std::to_string(limits.bytes >> 20) + " MiB of memory",
                "use a smaller file, or another format");
  }
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)) {
    throw Error(where, "reading it takes longer than " + std::to_string(limits.seconds) + " s",
                "use a smaller file, or another format");
  }
  throw Error(where, "it is damaged: the library that reads it failed on it", "export it anew, or in another format");
}

}  // namespace

ImportLimits limits_for(const std::filesystem::path& path) {
  std::error_code none;
  const auto size = std::filesystem::file_size(path, none);
  ImportLimits limits;
  limits.bytes = (std::uint64_t{2} << 30) + 40 * std::uint64_t{none ? 0 : size};
  return limits;
}

Imported run_import(const std::string& task, const std::filesystem::path& path,
                    const std::vector<std::string>& arguments, const ImportLimits& limits, const Progress& progress) {
  std::vector<std::string> words{import_program().string(), std::to_string(limits.bytes),
                                 std::to_string(limits.seconds), task, path.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  Pipe result, shares;
  Child child(std::move(words), result, shares);
  result.close_in();
  shares.close_in();
  Listener listener(result, shares, limits.bytes, progress);
  const bool whole = listener.listen();
  const int status = whole ? child.wait() : 0;
  if (!whole || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    refuse_end(whole ? status : import::out_of_memory << 8, shown(path), limits);
  }
  Imported imported = decode_imported(listener.bytes(), path);
  if (const auto* refusal = std::get_if<Refusal>(&imported)) {
    throw Error(shown(path), refusal->problem, refusal->remedy);
  }
  return imported;
}

}  // namespace chainmail
