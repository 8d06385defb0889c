#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/page/axis.h"
#include "report/run/compare.h"

namespace chainmail::report {

/// A point of a plot, with the quartiles of x as its error bar.
struct PlotMark {
  double x = 0, x_low = 0, x_high = 0;
  double y = 0;
  std::size_t series = 0;  // index into Plot::series
  bool hollow = false;
  std::string note;   // drawn next to the mark
  std::string title;  // the mark in words: what a reading of it says
};

/// A line through values.
struct PlotCurve {
  std::size_t series = 0;                     // index into Plot::series
  std::vector<std::array<double, 2>> points;  // x and y
};

/// A value of y to compare marks with, drawn as a dashed line across the panel.
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

/// How values of x or y are shown.
struct PlotAxis {
  std::string title;        // with the unit
  std::string unit;         // follows a value in a reading
  double smallest = 1e-12;  // on a logarithmic axis: smaller values count as 0
  bool linear = false;
  /// The ends of a linear axis, and its ticks. Without ends it runs from 0 to a round number.
  std::optional<std::array<double, 2>> ends = {};
  std::vector<LabelledValue> ticks = {};
  double zero = 0;  // readings of a linear axis count from here
};

/// What one shape and colour stands for.
struct PlotSeries {
  std::string label;
  std::size_t look = 0;     // shape and colour of the marks: a look of report/page/looks.h
  std::string colour = {};  // of a series of lines without marks, as #rrggbb
};

/// Panels that share one pair of axes and one legend.
struct Plot {
  std::string title;  // for screen readers, and over saved pictures
  PlotAxis x{{}, {}, 1e-9}, y;
  std::vector<PlotSeries> series;
  std::vector<PlotPanel> panels;
  std::vector<std::string> legend_notes;
  /// Values of y up to this are good: a shaded strip, and its label.
  std::optional<double> good_below;
  std::string good_label;
};

/// The axes of a plot, over all of its panels.
struct PlotAxes {
  explicit PlotAxes(const Plot& plot);
  Axis x, y;
};

/// True if the plot has neither a mark nor a line.
bool is_empty(const Plot& plot);

/// Returns the index of the series of an algorithm's marks. Adds the series if it is missing.
std::size_t series_of(Plot& plot, Algorithm algorithm);

/// An error that a plot can show against time.
struct PlottedError {
  std::string_view name, unit;
  std::optional<double> (*of)(const Errors& errors);
  std::optional<double> good_below = {};
};
std::span<const PlottedError> plotted_errors();

/// Returns a plot of time against an error, with one mark for each contestant; of one drag, or with one panel for each
/// drag of an object.
Plot error_plot(const DragResult& drag, const PlottedError& error);
Plot error_plot(const CaseResult& object, const PlottedError& error);
/// Returns such a plot of the largest violation.
Plot violation_plot(const CaseResult& object);
/// Returns such a plot of the RMS distance to Exact ChainMail.
Plot distance_plot(const CaseResult& object);

}  // namespace chainmail::report
