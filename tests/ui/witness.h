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

/// Looks on while a test does many things in a process of its own, and remembers the last of them: whatever becomes of
/// that process, a crash, a sanitizer's verdict or standing still, they are told.
class Witness {
 public:
  /// Calls `test` in another process; what it returns, or 1 where it came to no such end.
  template <class Test>
  static int watch(const Test& test) {
    int ends[2];
    if (pipe(ends) != 0) {
      std::perror("pipe");
      return 1;
    }
    const pid_t child = fork();
    if (child == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);  // whoever ends the one ends the other
      close(ends[0]);
      return test(Witness(ends[1]));
    }
    close(ends[1]);
    Witness witness(ends[0]);
    return witness.look(child);
  }

  /// To be called before each thing is done.
  void tell(const std::string& line) const {
    const std::string whole = line + '\n';
    if (write(end_, whole.data(), whole.size()) < 0) {
      std::perror("the witness is gone");
    }
  }

 private:
  static constexpr int patience = 120'000;  // milliseconds from one thing to the next
  static constexpr std::size_t remembered = 25;

  explicit Witness(int end) : end_(end) {}

  int look(pid_t child) {
    const bool stands = !listen();
    if (stands) {
      kill(child, SIGABRT);
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
      return 0;
    }
    std::fprintf(stderr, "%s. What was done last, the newest at the end:\n",
                 stands ? "It stood still for two minutes" : "It ended badly");
    for (const std::string& line : lines_) {
      std::fprintf(stderr, "  %s\n", line.c_str());
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
  }

  /// To the end of what is told; false where nothing is told for too long.
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
