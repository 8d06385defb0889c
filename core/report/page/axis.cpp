#include "report/page/axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/page/format.h"

namespace chainmail::report {
namespace {

constexpr int most_ticks = 6;

std::string superscript(int number) {
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char character : std::to_string(number)) {
    text += character == '-' ? "⁻" : digits[character - '0'];
  }
  return text;
}

std::string label_of(int decade) {
  return decade < -3 || decade > 2 ? "10" + superscript(decade) : figure(std::pow(10, decade));
}

}  // namespace

LogAxis::LogAxis(const std::vector<double>& values, double smallest) : smallest_(smallest) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const double value : values) {
    if (value < smallest) {
      has_zero_ = true;
    } else if (std::isfinite(value)) {
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  if (most > 0) {
    low_ = static_cast<int>(std::floor(std::log10(least)));
    high_ = std::max(low_ + 1, static_cast<int>(std::ceil(std::log10(most))));
    step_ = (high_ - low_) / most_ticks + 1;
    high_ += (step_ - (high_ - low_) % step_) % step_;  // so that the last decade has its tick
  }
}

double LogAxis::place(double value) const {
  if (!(value >= smallest_)) {
    return has_zero_ ? of_zero : 0;
  }
  const double share = (std::log10(value) - low_) / (high_ - low_);
  return first_decade() + (1 - first_decade()) * std::clamp(share, 0.0, 1.0);
}

std::vector<LogAxis::Tick> LogAxis::ticks() const {
  std::vector<Tick> ticks;
  if (has_zero_) {
    ticks.push_back({of_zero, "0"});
  }
  for (int decade = low_; decade <= high_; decade += step_) {
    ticks.push_back({place(std::pow(10, decade)), label_of(decade)});
  }
  return ticks;
}

}  // namespace chainmail::report
