#include "report/page/plot.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <locale>
#include <sstream>

#include "report/table/format.h"

namespace chainmail::report {
namespace {

constexpr int max_ticks = 6;
constexpr int smallest_plain = -3, largest_plain = 3;  // decades of an axis without powers

std::string superscript(int number) {
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char character : std::to_string(number)) {
    text += character == '-' ? "⁻" : digits[character - '0'];
  }
  return text;
}

/// Returns the label of a decade. All labels of an axis have one style: powers if one of them is small or large.
std::string label_of(int decade, bool as_power) {
  return as_power ? "10" + superscript(decade) : figure(std::pow(10, decade));
}

/// Returns the labels of a linear axis, all with the decimals that the finest needs.
std::string label_of(double value, double finest) {
  const std::string last = figure(finest);
  const auto point = last.find('.');
  if (value == 0 || point == std::string::npos || last.find('e') != std::string::npos) {
    return figure(value);
  }
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(static_cast<int>(last.size() - point - 1)) << value;
  return text.str();
}

/// Returns 1, 2 or 5 times a power of ten.
double round_number_above(double highest) {
  if (!(highest > 0)) {
    return 1;
  }
  const double power = std::pow(10, std::floor(std::log10(highest)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (highest <= digit * power) {
      return digit * power;
    }
  }
  return 10 * power;
}

}  // namespace

Axis Axis::logarithmic(const std::vector<double>& values, double smallest) {
  Axis axis;
  axis.is_logarithmic_ = true;
  axis.smallest_ = smallest;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const double value : values) {
    if (value < smallest) {
      axis.has_zero_ = true;
    } else if (std::isfinite(value)) {
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  int low = 0, high = 1, step = 1;
  if (most > 0) {
    low = static_cast<int>(std::floor(std::log10(least)));
    high = std::max(low + 1, static_cast<int>(std::ceil(std::log10(most))));
    step = (high - low) / max_ticks + 1;
    high += (step - (high - low) % step) % step;  // extends the axis, so that the last decade has a tick
  }
  axis.low_ = low;
  axis.high_ = high;
  if (axis.has_zero_) {
    axis.ticks_.push_back({of_zero, "0", true});
  }
  const bool as_powers = low < smallest_plain || high > largest_plain;
  for (int decade = low; decade <= high; decade += step) {
    axis.ticks_.push_back({axis.position(std::pow(10, decade)), label_of(decade, as_powers)});
  }
  return axis;
}

Axis Axis::linear(double low, double high, const std::vector<LabelledValue>& ticks) {
  Axis axis;
  axis.low_ = low;
  axis.high_ = high;
  for (const auto& [value, label] : ticks) {
    axis.ticks_.push_back({axis.position(value), label});
  }
  return axis;
}

Axis Axis::from_zero_to(double highest) {
  const double end = round_number_above(highest);
  return linear(0, end, {{0, figure(0)}, {end / 2, label_of(end / 2, end / 2)}, {end, label_of(end, end / 2)}});
}

double Axis::position(double value) const {
  if (!is_logarithmic_) {
    return (value - low_) / (high_ - low_);
  }
  if (!(value >= smallest_)) {
    return has_zero_ ? of_zero : 0;
  }
  const double share = (std::log10(value) - low_) / (high_ - low_);
  return first_decade() + (1 - first_decade()) * std::clamp(share, 0.0, 1.0);
}

std::size_t style_of(Algorithm algorithm) {
  const auto all = every_algorithm();
  return static_cast<std::size_t>(std::ranges::find(all, algorithm, &AlgorithmInfo::algorithm) - all.begin());
}

const PlotStyle& style_at(std::size_t index) {
  const auto all = every_algorithm();
  return all[index % all.size()].style;
}

namespace {

std::vector<double> values_of_x(const Plot& plot) {
  std::vector<double> values;
  for (const PlotPanel& panel : plot.panels) {
    for (const PlotMark& mark : panel.marks) {
      values.insert(values.end(), {mark.x_low, mark.x_high});
    }
    for (const PlotCurve& curve : panel.curves) {
      std::ranges::transform(curve.points, std::back_inserter(values), [](const auto& point) { return point[0]; });
    }
  }
  return values;
}

std::vector<double> values_of_y(const Plot& plot) {
  std::vector<double> values;
  for (const PlotPanel& panel : plot.panels) {
    std::ranges::transform(panel.marks, std::back_inserter(values), &PlotMark::y);
    for (const PlotCurve& curve : panel.curves) {
      std::ranges::transform(curve.points, std::back_inserter(values), [](const auto& point) { return point[1]; });
    }
    if (panel.level) {
      values.push_back(panel.level->y);
    }
  }
  return values;
}

template <class Values>
Axis axis_of(const PlotAxis& axis, const Values& values) {
  if (!axis.linear) {
    return Axis::logarithmic(values(), axis.smallest);
  }
  if (axis.ends) {
    return Axis::linear(axis.ends->front(), axis.ends->back(), axis.ticks);
  }
  const std::vector<double> all = values();
  return Axis::from_zero_to(all.empty() ? 0 : *std::ranges::max_element(all));
}

}  // namespace

PlotAxes::PlotAxes(const Plot& plot)
    : x(axis_of(plot.x, [&] { return values_of_x(plot); })), y(axis_of(plot.y, [&] { return values_of_y(plot); })) {}

bool is_empty(const Plot& plot) {
  return std::ranges::all_of(plot.panels,
                             [](const PlotPanel& panel) { return panel.marks.empty() && panel.curves.empty(); });
}

std::size_t series_of(Plot& plot, Algorithm algorithm) {
  const std::size_t style = style_of(algorithm);
  const auto found = std::ranges::find(plot.series, style, &PlotSeries::style);
  if (found != plot.series.end()) {
    return static_cast<std::size_t>(found - plot.series.begin());
  }
  plot.series.push_back({std::string(info(algorithm).label), style});
  return plot.series.size() - 1;
}

}  // namespace chainmail::report
