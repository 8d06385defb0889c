#pragma once

#include <array>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "report/page/plot.h"

namespace chainmail::report {

enum class PlotParts { whole, panels, legend };

/// How a plot is drawn. Lengths are CSS pixels, of which 96 are an inch.
struct SvgStyle {
  std::string ink = "currentColor";  // colour of lines and text
  /// Size of the whole drawing. 0: the natural size, with up to three panels per row and the legend beside them. In a
  /// given size, panels become as large as possible, with the title above, and the legend above or beside them; both
  /// are left out if there is no room. The legend alone always has its natural size.
  double width = 0, height = 0;
  PlotParts parts = PlotParts::whole;
  std::string ground = {};  // colour of the background; empty: none
  std::string font = "system-ui, DejaVu Sans, sans-serif";
  double font_size = 11;
  std::function<std::string(std::string_view)> adapt = {};  // adapts the colour of a series to the background
};

/// The style of a file, readable on light and dark backgrounds.
inline const SvgStyle file_ink{.ink = "#808080"};

/// A rectangle of a drawing, in its pixels.
struct PlotArea {
  double left = 0, top = 0, width = 0, height = 0;
};

/// The positions of a plot's parts in its drawing.
struct PlotLayout {
  PlotLayout(const Plot& plot, const SvgStyle& style);

  /// Returns width and height of the drawing, in pixels.
  std::array<double, 2> size() const { return {scale * width, scale * height}; }
  /// Returns the area between the axes of a panel.
  PlotArea area(std::size_t panel) const;
  /// Returns the position of a value, in pixels of the drawing.
  std::array<double, 2> position(std::size_t panel, double x, double y) const;
  /// Returns the upper left corner of a panel's area, in units.
  std::array<double, 2> corner(std::size_t panel) const;

  PlotAxes axes;
  double scale = 1;  // pixels per unit; lengths below are in units, of which the size of the font is 11
  bool is_natural = true;
  double width = 0, height = 0;  // of the drawing
  int columns = 1, rows = 1;
  double panel_width = 250, panel_height = 210;
  double left = 70, between = 34, right = 34;    // before the first column, between columns, and after the last
  double top = 26, bottom = 46;                  // above and below each panel
  double heading = 0;                            // height of what is above the first row
  double y_title = 0, x_title = 34;              // baselines of the titles: in the drawing, and below each panel
  std::vector<std::string> title = {};           // lines
  std::vector<std::array<double, 2>> keys = {};  // centres of the keys of the series, then of the notes

 private:
  void take_natural_size(const Plot& plot);
  void fit_best(const Plot& plot, PlotParts parts);
  void fit(const Plot& plot, PlotParts parts, int panels_per_row, bool legend_beside);
  double add_legend_column(const Plot& plot, double x, double y);
  double add_legend_rows(const Plot& plot, double y);
};

/// Writes the plot as an SVG element, which is valid as a file and within HTML. Marks differ in shape, and in colours
/// that colour-blind readers can tell apart.
void write_svg(std::ostream& out, const Plot& plot, const SvgStyle& style = {});

/// Returns a mark, see style_at, as a square SVG drawing.
std::string mark_svg(std::size_t mark, bool hollow, const SvgStyle& style);

}  // namespace chainmail::report
