#include "command_line/progress_line.h"

#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <iostream>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

namespace chainmail::command_line {
namespace {

constexpr auto clear_line = "\r\x1b[K";

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
  next_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(200);
}

struct Watch::Line {
  Line(std::function<std::string(const api::Job&)> text, const api::Job& job)
      : thread([text = std::move(text), job, this](const std::stop_token& stop) {
          try {
            show(text, job, stop);
          } catch (const std::exception&) {
            // A line that cannot be written must not end the work.
          }
        }) {}

  void show(const std::function<std::string(const api::Job&)>& text, const api::Job& job, const std::stop_token& stop) {
    ProgressLine line;
    std::unique_lock lock(mutex);
    // Short jobs show nothing.
    while (!over.wait_for(lock, stop, std::chrono::milliseconds(300), [&] { return stop.stop_requested(); })) {
      if (std::string words = text(job); !words.empty()) {
        line.show([&] { return words; });
      }
    }
  }

  std::mutex mutex;
  std::condition_variable_any over;
  std::jthread thread;  // last member, because it uses the others
};

Watch::Watch(const std::string& text) : Watch([text](const api::Job& job) { return percent(job.share()) + text; }) {}

Watch::Watch(std::function<std::string(const api::Job&)> line) {
  if (isatty(STDERR_FILENO) != 0) {
    try {
      line_ = std::make_unique<Line>(std::move(line), job_);
    } catch (const std::system_error&) {
      // The system starts no more threads: the work runs without a line.
    }
  }
}

Watch::~Watch() = default;

}  // namespace chainmail::command_line
