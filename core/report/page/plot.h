#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solver/algorithms.h"

namespace chainmail::report {

/// A labelled position on an axis.
struct Tick {
  double position = 0;
  std::string label;
  bool is_zero = false;  // the position of 0 on a logarithmic axis
};

/// A value with its label, for the ticks of a linear axis.
struct LabelledValue {
  double value = 0;
  std::string label;
};

/// Maps values to positions along an axis, from 0 at its beginning to 1 at its end.
class Axis {
 public:
  /// Returns a logarithmic axis over the decades of `values`. Values below `smallest` count as 0. If there are any, 0
  /// has its own position between the beginning and the first decade. Values beyond the axis are drawn at its ends.
  static Axis logarithmic(const std::vector<double>& values, double smallest);
  /// Returns a linear axis. Values beyond it have positions below 0 or above 1.
  static Axis linear(double low, double high, const std::vector<LabelledValue>& ticks);
  /// Returns a linear axis from 0 to 1, 2 or 5 times a power of ten, with ticks at both ends and in the middle.
  static Axis from_zero_to(double highest);

  double position(double value) const;
  /// Returns the ticks, few enough that their labels do not overlap.
  const std::vector<Tick>& ticks() const { return ticks_; }
  /// Returns the position of the first decade. It comes after that of 0.
  double first_decade() const { return has_zero_ ? behind_zero : 0; }

 private:
  static constexpr double of_zero = 0.05, behind_zero = 0.13;

  bool is_logarithmic_ = false, has_zero_ = false;
  double smallest_ = 0;
  double low_ = 0, high_ = 1;  // values; for a logarithmic axis their decades
  std::vector<Tick> ticks_;
};

/// Returns the index of an algorithm's style.
std::size_t style_of(Algorithm algorithm);
/// Returns the style with this index. After the last one they repeat.
const PlotStyle& style_at(std::size_t index);

/// A point of a plot, with the quartiles of x as its error bar.
struct PlotMark {
  double x = 0, x_low = 0, x_high = 0;
  double y = 0;
  std::size_t series = 0;  // index into Plot::series
  bool hollow = false;
  std::string note;   // drawn next to the mark
  std::string title;  // text that describes the mark, for its tooltip
};

/// A line through values.
struct PlotCurve {
  std::size_t series = 0;                     // index into Plot::series
  std::vector<std::array<double, 2>> points;  // x and y
};

/// A value of y for comparison, drawn as a dashed line across the panel.
struct PlotLevel {
  double y = 0;
  std::string label;
};

struct PlotPanel {
  std::string title;
  std::vector<PlotMark> marks;
  std::vector<PlotCurve> curves = {};
  std::optional<PlotLevel> level = {};
};

/// Describes an axis: its title, unit and scale.
struct PlotAxis {
  std::string title;        // with the unit
  std::string unit;         // written after a value in a tooltip
  double smallest = 1e-12;  // on a logarithmic axis: smaller values count as 0
  bool linear = false;
  /// Ends and ticks of a linear axis. Without ends, the axis runs from 0 to a round number.
  std::optional<std::array<double, 2>> ends = {};
  std::vector<LabelledValue> ticks = {};
  double zero = 0;  // tooltips show values of a linear axis minus this
};

/// An entry of the legend: a name with its shape and colour.
struct PlotSeries {
  std::string label;
  std::size_t style = 0;    // shape and colour of the marks: see style_at
  std::string colour = {};  // colour of a series of lines without marks, as #rrggbb
};

/// Panels that share one pair of axes and one legend.
struct Plot {
  std::string title;  // for screen readers, and over saved pictures
  PlotAxis x{{}, {}, 1e-9}, y;
  std::vector<PlotSeries> series;
  std::vector<PlotPanel> panels;
  std::vector<std::string> legend_notes;
  /// Values of y up to this are good. They are drawn as a shaded strip with a label.
  std::optional<double> good_below;
  std::string good_label;
};

/// The axes of a plot. All panels share them.
struct PlotAxes {
  explicit PlotAxes(const Plot& plot);
  Axis x, y;
};

/// Returns true if the plot has no mark and no line.
bool is_empty(const Plot& plot);

/// Returns the index of the series of an algorithm's marks. Adds the series if it is missing.
std::size_t series_of(Plot& plot, Algorithm algorithm);

}  // namespace chainmail::report
