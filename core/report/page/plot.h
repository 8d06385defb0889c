#pragma once

#include <array>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "report/run/compare.h"

namespace chainmail::report {

/// A mark in a plot, with the quartiles of x as its error bar.
struct PlotMark {
  double x = 0, x_low = 0, x_high = 0;
  double y = 0;
  std::size_t series = 0;  // into Plot::series
  bool hollow = false;
  std::string note;   // beside it
  std::string title;  // what it is, in words
};

/// A line through values, which have their marks.
struct PlotCurve {
  std::size_t series = 0;                     // into Plot::series
  std::vector<std::array<double, 2>> points;  // x and y
};

/// A value of y to compare marks with, drawn as a dashed line from side to side.
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

/// What one shape and colour stands for: a look of report/page/looks.h.
struct PlotSeries {
  std::string label;
  std::size_t look = 0;
};

/// Panels side by side, three a row, with one pair of logarithmic axes and one legend for all.
struct Plot {
  std::string title;  // for those who hear it
  std::string x_label, y_label;
  std::vector<PlotSeries> series;
  std::vector<PlotPanel> panels;
  std::vector<std::string> legend_notes;
  /// Values up to this are as good as none: a shaded strip, and what it means.
  std::optional<double> good_below;
  std::string good_label;
  double smallest_y = 1e-12;  // what is less stands at 0
};

/// Writes the plot as an SVG element that stands alone or within HTML. Lines and text are in `ink`, a colour;
/// marks keep theirs, which the colour-blind can tell apart, and differ in shape.
void write_svg(std::ostream& out, const Plot& plot, const std::string& ink = "currentColor");

/// The series that an algorithm's marks belong to; added where it is not there yet.
std::size_t series_of(Plot& plot, Algorithm algorithm);

/// Speed against error on one object, a panel a drag, every contestant a mark.
Plot violation_plot(const CaseResult& result);
Plot distance_plot(const CaseResult& result);

}  // namespace chainmail::report
