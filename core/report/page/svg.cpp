#include "report/page/svg.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include "report/table/format.h"

namespace chainmail::report {
namespace {

// Lengths in CSS pixels at the natural size of the drawing.
constexpr double panel_width = 250, panel_height = 210;
constexpr double left = 70, between = 34, top = 26, bottom = 46, right = 8;
constexpr double legend_width = 235, legend_row = 19, note_row = 16;
constexpr double mark_size = 4.6;
constexpr double note_width = 16, note_height = 9;
constexpr int panels_per_row = 3;

/// Formats a coordinate in hundredths.
std::string coordinate(double number) {
  std::array<char, 400> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed, 2).ptr;
  return {digits.data(), end};
}

class SvgDrawing {
 public:
  SvgDrawing(std::ostream& out, const Plot& plot, const std::string& ink)
      : out_(out), plot_(plot), ink_(escaped(ink)), axes_(plot) {
    const auto count = static_cast<int>(plot.panels.size());
    columns_ = std::clamp(count, 1, panels_per_row);
    rows_ = std::max(1, (count + panels_per_row - 1) / panels_per_row);
  }

  void draw() {
    begin();
    for (std::size_t i = 0; i < plot_.panels.size(); ++i) {
      const auto column = static_cast<int>(i) % panels_per_row, row = static_cast<int>(i) / panels_per_row;
      out_ << "<g transform=\"translate(" << coordinate(left + column * (panel_width + between)) << ' '
           << coordinate(top + row * (panel_height + top + bottom)) << ")\">\n";
      draw_panel(plot_.panels[i], column == 0);
      out_ << "</g>\n";
    }
    draw_legend();
    out_ << "</svg>\n";
  }

 private:
  double width() const { return left + columns_ * (panel_width + between) + legend_width + right; }
  double height() const { return std::max(rows_ * (top + panel_height + bottom), legend_end()); }
  double notes_begin() const { return top + 6 + double(plot_.series.size()) * legend_row + 6; }
  double legend_end() const { return notes_begin() + double(plot_.legend_notes.size()) * note_row; }
  double at_x(double value) const { return axes_.x.position(value) * panel_width; }
  double at_y(double value) const { return (1 - axes_.y.position(value)) * panel_height; }

  void begin() {
    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"" << coordinate(width()) << "\" height=\""
         << coordinate(height()) << "\" viewBox=\"0 0 " << coordinate(width()) << ' ' << coordinate(height())
         << "\" font-family=\"system-ui, 'DejaVu Sans', sans-serif\" font-size=\"11\">\n<title>" << escaped(plot_.title)
         << "</title>\n";
  }

  void text(double x, double y, std::string_view anchor, std::string_view words, std::string_view more = "") {
    out_ << "<text x=\"" << coordinate(x) << "\" y=\"" << coordinate(y) << "\" text-anchor=\"" << anchor << "\" fill=\""
         << ink_ << '"' << more << '>' << escaped(words) << "</text>\n";
  }

  void line(double x1, double y1, double x2, double y2, std::string_view more) {
    out_ << "<line x1=\"" << coordinate(x1) << "\" y1=\"" << coordinate(y1) << "\" x2=\"" << coordinate(x2)
         << "\" y2=\"" << coordinate(y2) << "\" stroke=\"" << ink_ << '"' << more << "/>\n";
  }

  void draw_panel(const PlotPanel& panel, bool first) {
    if (plot_.good_below && at_y(*plot_.good_below) < panel_height) {
      const double y = at_y(*plot_.good_below);
      out_ << "<rect x=\"0\" y=\"" << coordinate(y) << "\" width=\"" << coordinate(panel_width) << "\" height=\""
           << coordinate(panel_height - y) << "\" fill=\"" << ink_ << "\" fill-opacity=\"0.07\"/>\n";
      text(6, std::min(y + 14, panel_height - 4), "start", plot_.good_label,
           " fill-opacity=\"0.65\" font-style=\"italic\"");
    }
    text(0, -9, "start", panel.title, " font-weight=\"bold\"");
    draw_axes(first);
    if (panel.level) {
      const double y = at_y(panel.level->y);
      line(0, y, panel_width, y, " stroke-opacity=\"0.8\" stroke-dasharray=\"6 3\"");
      text(panel_width - 4, y - 4, "end", panel.level->label, " font-size=\"9\" font-style=\"italic\"");
    }
    for (const PlotCurve& curve : panel.curves) {
      draw_curve(curve);
    }
    for (const PlotMark& mark : panel.marks) {
      draw_bar(mark);
    }
    std::vector<std::array<double, 2>> notes;
    for (const PlotMark& mark : panel.marks) {
      draw_mark(at_x(mark.x), at_y(mark.y), mark.series, mark.hollow, mark.title);
      draw_note(mark, notes);
    }
  }

  /// Writes the note of a mark unless it would cover another note: above the mark, or else below it.
  void draw_note(const PlotMark& mark, std::vector<std::array<double, 2>>& notes) {
    for (const double below : {-4.0, 11.0}) {
      const double x = at_x(mark.x) + 7, y = at_y(mark.y) + below;
      const bool covers = std::ranges::any_of(notes, [&](const auto& one) {
        return std::abs(one[0] - x) < note_width && std::abs(one[1] - y) < note_height;
      });
      if (!mark.note.empty() && !covers) {
        text(x, y, "start", mark.note, " font-size=\"9\"");
        notes.push_back({x, y});
        return;
      }
    }
  }

  void draw_axes(bool first) {
    for (const auto& [share, label, zero] : axes_.y.ticks()) {
      const double y = (1 - share) * panel_height;
      line(0, y, panel_width, y,
           zero ? " stroke-opacity=\"0.6\" stroke-dasharray=\"4 3\"" : " stroke-opacity=\"0.18\"");
      if (first) {
        text(-7, y + 4, "end", label, zero ? " font-weight=\"bold\"" : "");
      }
    }
    for (const auto& [share, label, zero] : axes_.x.ticks()) {
      const double x = share * panel_width;
      line(x, 0, x, panel_height, " stroke-opacity=\"0.18\"");
      text(x, panel_height + 16, "middle", label);
    }
    line(0, 0, 0, panel_height, "");
    line(0, panel_height, panel_width, panel_height, "");
    text(panel_width / 2, panel_height + 34, "middle", plot_.x.title);
    if (first) {
      text(0, 0, "middle", plot_.y.title,
           " transform=\"translate(-56 " + coordinate(panel_height / 2) + ") rotate(-90)\"");
    }
  }

  void draw_bar(const PlotMark& mark) {
    const double y = at_y(mark.y), low = at_x(mark.x_low), high = at_x(mark.x_high);
    if (high - low < 2.5 * mark_size) {
      return;  // the mark would hide it
    }
    line(low, y, high, y, " stroke-opacity=\"0.8\"");
    line(low, y - 3, low, y + 3, " stroke-opacity=\"0.8\"");
    line(high, y - 3, high, y + 3, " stroke-opacity=\"0.8\"");
  }

  std::string colour_of(std::size_t series) const {
    const PlotSeries& one = plot_.series[series];
    const std::string_view colour = one.colour.empty() ? style_at(one.style).colour : std::string_view(one.colour);
    return colour.empty() ? ink_ : std::string(colour);
  }

  void draw_curve(const PlotCurve& curve) {
    out_ << "<polyline points=\"";
    for (const auto& [x, y] : curve.points) {
      out_ << coordinate(at_x(x)) << ',' << coordinate(at_y(y)) << ' ';
    }
    out_ << "\" fill=\"none\" stroke=\"" << colour_of(curve.series) << "\" stroke-opacity=\"0.7\"/>\n";
  }

  void draw_mark(double x, double y, std::size_t series, bool hollow, std::string_view title) {
    const PlotStyle& style = style_at(plot_.series[series].style);
    const std::string colour = colour_of(series);
    out_ << "<path transform=\"translate(" << coordinate(x) << ' ' << coordinate(y) << ") scale("
         << coordinate(mark_size) << ")\" d=\"" << style.path << "\" stroke=\"" << colour
         << "\" stroke-width=\"0.33\" fill=\"" << (hollow ? "none" : colour) << "\" fill-opacity=\"0.75\">";
    if (!title.empty()) {
      out_ << "<title>" << escaped(title) << "</title>";
    }
    out_ << "</path>\n";
  }

  /// Draws the mark of a series in the legend, or a short line for a series of lines.
  void draw_key(double x, double y, std::size_t series) {
    if (plot_.series[series].colour.empty()) {
      draw_mark(x, y, series, false, "");
    } else {
      out_ << "<path d=\"M" << coordinate(x - 8) << ' ' << coordinate(y) << "h16\" stroke=\"" << colour_of(series)
           << "\"/>\n";
    }
  }

  void draw_legend() {
    const double x = left + columns_ * (panel_width + between) + 8;
    double y = top + 6;
    for (std::size_t i = 0; i < plot_.series.size(); ++i, y += legend_row) {
      draw_key(x, y, i);
      text(x + 13, y + 4, "start", plot_.series[i].label);
    }
    y = notes_begin();
    for (const std::string& note : plot_.legend_notes) {
      text(x - 5, y + 4, "start", note, " font-size=\"10\" fill-opacity=\"0.75\"");
      y += note_row;
    }
  }

  std::ostream& out_;
  const Plot& plot_;
  std::string ink_;
  PlotAxes axes_;
  int columns_ = 1, rows_ = 1;
};

}  // namespace

void write_svg(std::ostream& out, const Plot& plot, const std::string& ink) { SvgDrawing(out, plot, ink).draw(); }

}  // namespace chainmail::report
