#include "measure/pass_times.h"

#include <algorithm>
#include <vector>

namespace chainmail {
namespace {

// A hand sends 60 moves a second; this many bound the memory of a script that sends more.
constexpr std::size_t entries_kept = 4096;

}  // namespace

void PassTimes::forget_before(Clock::time_point limit) {
  while (!entries_.empty() && (entries_.front().when < limit || entries_.size() > entries_kept)) {
    entries_.pop_front();
  }
}

void PassTimes::add(Clock::time_point when, double milliseconds) {
  entries_.push_back({when, milliseconds});
  forget_before(when - std::chrono::seconds(1));
}

PassTimes::Summary PassTimes::summary(Clock::time_point now) {
  forget_before(now - std::chrono::seconds(1));
  if (entries_.empty()) {
    return {};
  }
  std::vector<double> times;
  for (const Entry& entry : entries_) {
    times.push_back(entry.milliseconds);
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return {*middle, *std::max_element(times.begin(), times.end()), static_cast<int>(times.size())};
}

}  // namespace chainmail
