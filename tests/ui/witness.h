#pragma once

#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <deque>
#include <string>

namespace chainmail {

/// Runs a test with many events in a separate process and remembers the last events. If that process crashes, hangs or
/// is ended by a sanitizer, the witness prints them.
class Witness {
 public:
  /// Calls `test` in another process. Returns its result, or 1 if the process did not end normally.
  template <class Test>
  static int watch(const Test& test) {
    int ends[2];
    if (pipe(ends) != 0) {
      std::perror("pipe");
      return 1;
    }
    const pid_t child = fork();
    if (child == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);  // if one process ends, the other ends too
      close(ends[0]);
      return test(Witness(ends[1]));
    }
    close(ends[1]);
    Witness witness(ends[0]);
    return witness.look(child);
  }

  /// Call it before each event.
  void tell(const std::string& line) const {
    const std::string whole = line + '\n';
    if (write(end_, whole.data(), whole.size()) < 0) {
      std::perror("the witness is gone");
    }
  }

 private:
  static constexpr int patience = 120'000;  // milliseconds from one event to the next
  static constexpr std::size_t remembered = 25;

  explicit Witness(int end) : end_(end) {}

  int look(pid_t child) {
    const bool hangs = !listen();
    if (hangs) {
      kill(child, SIGABRT);
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
      return 0;
    }
    std::fprintf(stderr, "%s. The last events, the newest at the end:\n",
                 hangs ? "No event for two minutes" : "The test ended with an error");
    for (const std::string& line : lines_) {
      std::fprintf(stderr, "  %s\n", line.c_str());
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
  }

  /// Reads until the end of the pipe. Returns false if no event arrives for too long.
  bool listen() {
    pollfd waits{end_, POLLIN, 0};
    std::string text;
    while (poll(&waits, 1, patience) > 0) {
      char piece[4096];
      const ssize_t size = read(end_, piece, sizeof piece);
      if (size <= 0) {
        return true;
      }
      text.append(piece, std::size_t(size));
      for (std::size_t at = 0; (at = text.find('\n')) != std::string::npos; text.erase(0, at + 1)) {
        remember(text.substr(0, at));
      }
    }
    return false;
  }

  void remember(const std::string& line) {
    lines_.push_back(line);
    if (lines_.size() > remembered) {
      lines_.pop_front();
    }
  }

  int end_;
  std::deque<std::string> lines_;
};

}  // namespace chainmail
