#include "command_line/watched.h"

#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <iostream>
#include <mutex>
#include <thread>
#include <utility>

namespace chainmail::command_line {

struct Watch::Line {
  Line(std::string text, const JobState& job)
      : thread([text = std::move(text), &job, this](const std::stop_token& stop) { show(text, job, stop); }) {}

  void show(const std::string& text, const JobState& job, const std::stop_token& stop) {
    std::unique_lock lock(mutex);
    // Short jobs show nothing.
    while (!over.wait_for(lock, stop, std::chrono::milliseconds(300), [&] { return stop.stop_requested(); })) {
      std::cerr << "\r\x1b[K" << int(100 * job.share.load(std::memory_order_relaxed)) << "% " << text << std::flush;
    }
    std::cerr << "\r\x1b[K" << std::flush;
  }

  std::mutex mutex;
  std::condition_variable_any over;
  std::jthread thread;  // last: it uses the others
};

Watch::Watch(std::string text) {
  if (isatty(STDERR_FILENO) != 0) {
    line_ = std::make_unique<Line>(std::move(text), job_);
  }
}

Watch::~Watch() = default;

}  // namespace chainmail::command_line
