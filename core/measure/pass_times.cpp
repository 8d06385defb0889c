#include "measure/pass_times.h"

#include <algorithm>
#include <cmath>

namespace chainmail {
namespace {

// A user sends 60 moves per second. This limits the memory if a script sends more.
constexpr std::size_t entries_kept = 4096;

}  // namespace

PassTimes::PassTimes() {
  entries_.reserve(2 * entries_kept + 2);  // the most entries that forget_before leaves, and one more
  milliseconds_.reserve(entries_kept);
}

void PassTimes::clear() {
  entries_.clear();
  first_ = 0;
}

void PassTimes::forget_before(Clock::time_point limit) {
  while (first_ < entries_.size() && (entries_[first_].when < limit || entries_.size() - first_ > entries_kept)) {
    ++first_;
  }
  if (2 * first_ > entries_.size()) {
    entries_.erase(entries_.begin(), entries_.begin() + static_cast<std::ptrdiff_t>(first_));
    first_ = 0;
  }
}

void PassTimes::add(Clock::time_point when, double milliseconds) {
  entries_.push_back({when, milliseconds});
  forget_before(when - std::chrono::seconds(1));
}

PassTimes::Summary PassTimes::summary(Clock::time_point now) {
  forget_before(now - std::chrono::seconds(1));
  if (first_ == entries_.size()) {
    return {};
  }
  milliseconds_.clear();
  for (std::size_t i = first_; i < entries_.size(); ++i) {
    milliseconds_.push_back(entries_[i].milliseconds);
  }
  const auto middle = milliseconds_.begin() + static_cast<std::ptrdiff_t>(milliseconds_.size() / 2);
  std::nth_element(milliseconds_.begin(), middle, milliseconds_.end());
  return {*middle, *std::max_element(milliseconds_.begin(), milliseconds_.end()),
          static_cast<int>(milliseconds_.size())};
}

namespace {

/// Returns the value below which a share of the sorted times lies, interpolated.
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * double(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const auto above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - double(below));
}

}  // namespace

TimeSpread spread_of(std::vector<double> times) {
  if (times.empty()) {
    return {};
  }
  std::sort(times.begin(), times.end());
  return {quantile(times, 0.5), quantile(times, 0.25), quantile(times, 0.75),
          times.front(),        times.back(),          static_cast<int>(times.size())};
}

}  // namespace chainmail
