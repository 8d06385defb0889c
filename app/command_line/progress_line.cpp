#include "command_line/progress_line.h"

#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <iostream>
#include <system_error>
#include <utility>

namespace chainmail::command_line {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr auto clear_line = "\r\x1b[K";

// A terminal shows work of more than 300 ms, and rewrites its line five times per second.
constexpr std::chrono::milliseconds until_shown(300), between_rewrites(200);
constexpr std::chrono::seconds until_first_line(10), between_lines(60);

// What is left is not estimated from less.
constexpr double least_share = 0.02;
constexpr std::chrono::seconds least_time(5);

/// Returns a duration as people say it: "40 s", "3 min", "1 h 10 min".
std::string duration_in_words(Seconds duration) {
  const auto rounded = [&](int unit) { return unit * std::lround(duration.count() / unit); };
  if (const long seconds = std::max(5L, rounded(5)); seconds < 60) {
    return std::to_string(seconds) + " s";
  }
  if (const long minutes = rounded(60) / 60; minutes < 60) {
    return std::to_string(minutes) + " min";
  }
  const long minutes = rounded(600) / 60;
  return std::to_string(minutes / 60) + " h" + (minutes % 60 == 0 ? "" : " " + std::to_string(minutes % 60) + " min");
}

/// Returns ", about 3 min left"; nothing while that cannot be estimated.
std::string rest_in_words(double share, Seconds elapsed) {
  if (share <= least_share || share >= 1 || elapsed < least_time) {
    return {};
  }
  return ", about " + duration_in_words(elapsed * (1 - share) / share) + " left";
}

std::string percent(double share) { return std::to_string(int(100 * share)) + " %"; }

}  // namespace

ProgressLine::ProgressLine(std::ostream& out, bool is_terminal, Time start)
    : out_(out), is_terminal_(is_terminal), start_(start) {
  next_ = start + (is_terminal ? Time::duration(until_shown) : until_first_line);
}

ProgressLine::~ProgressLine() {
  if (is_shown_ && is_terminal_) {
    out_ << clear_line << std::flush;
  }
}

void ProgressLine::show(const Progress& job, Time now) {
  const double share = job.share();
  const Seconds elapsed = now - start_;
  const std::string rest = rest_in_words(share, elapsed);
  // One string, because standard error writes each part of a line at once.
  if (is_terminal_) {
    out_ << clear_line + (share > 0 ? percent(share) + ", " : "") + job.text() + rest << std::flush;
  } else {
    out_ << (share > 0 ? percent(share) + " " : "") + "after " + duration_in_words(elapsed) + rest + ": " + job.text() +
                '\n'
         << std::flush;
  }
  is_shown_ = true;
  next_ = now + (is_terminal_ ? Time::duration(between_rewrites) : between_lines);
}

Watch::Watch(std::string text) : line_(std::cerr, isatty(STDERR_FILENO) != 0, std::chrono::steady_clock::now()) {
  job_.say(std::move(text));
  try {
    thread_ = std::jthread([this](const std::stop_token& stop) { show(stop); });
  } catch (const std::system_error&) {
    // The system starts no more threads: the work runs without a line.
  }
}

void Watch::show(const std::stop_token& stop) {
  // Signals reach the threads that work, and a pipe that nobody reads must not end the work.
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);
  try {
    std::unique_lock lock(mutex_);
    while (!over_.wait_until(lock, stop, line_.next(), [&] { return stop.stop_requested(); })) {
      line_.show(job_, std::chrono::steady_clock::now());
    }
  } catch (const std::exception&) {
    // A line that cannot be written must not end the work.
  }
}

}  // namespace chainmail::command_line
