#include "command_line/progress_line.h"

#include <unistd.h>

#include <iostream>
#include <system_error>
#include <utility>

namespace chainmail::command_line {
namespace {

constexpr auto clear_line = "\r\x1b[K";
constexpr std::chrono::milliseconds between_lines(200);

}  // namespace

std::string percent(double share) { return std::to_string(int(100 * share)) + "% "; }

ProgressLine::ProgressLine(std::chrono::milliseconds delay)
    : is_terminal_(isatty(STDERR_FILENO) != 0), next_(std::chrono::steady_clock::now() + delay) {}

ProgressLine::~ProgressLine() {
  if (is_shown_) {
    std::cerr << clear_line << std::flush;
  }
}

void ProgressLine::write(const std::string& text) {
  std::cerr << clear_line << text << std::flush;
  is_shown_ = true;
  next_ = std::chrono::steady_clock::now() + between_lines;
}

Watch::Watch(std::string text) {
  job_.say(std::move(text));
  if (line_.is_terminal()) {
    try {
      thread_ = std::jthread([this](const std::stop_token& stop) { show(stop); });
    } catch (const std::system_error&) {
      // The system starts no more threads: the work runs without a line.
    }
  }
}

void Watch::show(const std::stop_token& stop) {
  try {
    std::unique_lock lock(mutex_);
    while (!over_.wait_for(lock, stop, between_lines, [&] { return stop.stop_requested(); })) {
      line_.show([&] { return percent(job_.share()) + job_.text(); });
    }
  } catch (const std::exception&) {
    // A line that cannot be written must not end the work.
  }
}

}  // namespace chainmail::command_line
