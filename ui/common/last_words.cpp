#include "common/last_words.h"

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <string_view>

namespace chainmail {
namespace {

constexpr std::array deadlySignals{SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV};
constexpr std::size_t stackBytes = 64 * 1024;  // a signal may come because the stack is full

/// Calls only functions that a handler of signals may call.
void sayLastWords() {
  constexpr std::string_view words =
      "workbench: an unexpected error ends the program; start it again, and it offers your unsaved work\n";
  const auto written = ::write(STDERR_FILENO, words.data(), words.size());
  static_cast<void>(written);
}

/// The default action of the signal, which ends the program, follows when this returns.
void receiveSignal(int /*signal*/) { sayLastWords(); }

[[noreturn]] void terminate() { std::abort(); }  // its signal says the words

}  // namespace

void prepareLastWords() {
  static std::array<char, stackBytes> stack;
  stack_t own{};
  own.ss_sp = stack.data();
  own.ss_size = stack.size();
  ::sigaltstack(&own, nullptr);
  for (const int signal : deadlySignals) {
    struct sigaction present {};
    if (::sigaction(signal, nullptr, &present) == 0 && present.sa_handler == SIG_DFL) {
      struct sigaction action {};
      action.sa_handler = &receiveSignal;
      action.sa_flags = static_cast<int>(SA_ONSTACK | SA_RESETHAND);
      ::sigaction(signal, &action, nullptr);
    }
  }
  std::set_terminate(&terminate);
}

}  // namespace chainmail
