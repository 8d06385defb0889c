#include "report/page/svg.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>
#include <vector>

#include "report/table/format.h"

namespace chainmail::report {
namespace {

// Lengths in units, which are CSS pixels at the natural size of the drawing.
constexpr double natural_font = 11, text_line = 14;
constexpr double bold = 1.05;  // how much wider bold text is
constexpr double natural_margin = 8, margin = 3;
constexpr double legend_width = 235, natural_key = 19, natural_note = 16;
constexpr double key_middle = 8, key_width = 21, between_keys = 12;
constexpr double mark_size = 4.6;
constexpr double note_width = 16, note_height = 9, note_font = 9, legend_note_font = 10;
constexpr double label_height = 12;
constexpr double smallest_panel = 40;
constexpr int max_columns = 3;

/// Formats a coordinate in hundredths.
std::string coordinate(double number) {
  std::array<char, 400> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed, 2).ptr;
  return {digits.data(), end};
}

/// Returns an estimate of the width of a text in a usual font without serifs. It rather is too large.
double text_width(std::string_view words, double size = natural_font) {
  double width = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const char letter = words[i];
    if ((letter & 0xc0) == 0x80) {
      continue;  // belongs to the character before
    }
    const bool is_raised = words.substr(i, 2) == "\xe2\x81";
    width += is_raised                                                              ? 0.42
             : (letter & 0x80) != 0                                                 ? 0.85
             : std::string_view(" .,:;'|!()[]/-ijlIftr").find(letter) != words.npos ? 0.4
             : std::string_view("mwMW%@").find(letter) != words.npos                ? 0.97
             : letter >= 'A' && letter <= 'Z'                                       ? 0.74
                                                                                    : 0.635;
  }
  return width * size;
}

std::string elided(std::string_view words, double width, double size = natural_font) {
  if (text_width(words, size) <= width) {
    return std::string(words);
  }
  const std::string_view dots = "…";
  do {
    while (!words.empty() && (words.back() & 0xc0) == 0x80) {
      words.remove_suffix(1);
    }
    words.remove_suffix(words.empty() ? 0 : 1);
  } while (!words.empty() && text_width(words, size) + text_width(dots, size) > width);
  return std::string(words) + std::string(dots);
}

/// Breaks a text into lines at its spaces.
std::vector<std::string> broken_into_lines(std::string_view words, double width) {
  std::vector<std::string> lines;
  while (!words.empty()) {
    const std::string_view word = words.substr(0, words.find(' '));
    words.remove_prefix(std::min(words.size(), word.size() + 1));
    if (lines.empty() || text_width(lines.back() + " " + std::string(word)) > width) {
      lines.push_back(elided(word, width));
    } else {
      lines.back() += " " + std::string(word);
    }
  }
  return lines;
}

using Span = std::array<double, 2>;

/// Returns which spans to show so that none covers another. The ends have priority.
std::vector<bool> shown_apart(const std::vector<Span>& spans) {
  std::vector<bool> shown(spans.size(), false);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const std::size_t one = i == 0 ? 0 : i == 1 ? spans.size() - 1 : i - 1;
    bool is_free = true;
    for (std::size_t other = 0; other < spans.size(); ++other) {
      is_free = is_free && (!shown[other] || spans[other][1] <= spans[one][0] || spans[one][1] <= spans[other][0]);
    }
    shown[one] = is_free;
  }
  return shown;
}

double widest_label(const Axis& axis) {
  double width = 0;
  for (const Tick& tick : axis.ticks()) {
    width = std::max(width, text_width(tick.label));
  }
  return width;
}

/// Returns the width of the widest entry of the legend.
double widest_key(const Plot& plot) {
  double width = 0;
  for (const PlotSeries& series : plot.series) {
    width = std::max(width, key_width + text_width(series.label));
  }
  for (const std::string& note : plot.legend_notes) {
    width = std::max(width, key_middle + text_width(note, legend_note_font));
  }
  return width;
}

/// Returns the points of a line that are within the axes, and those where it enters and leaves them, as shares.
std::vector<std::array<double, 2>> inside(const PlotCurve& curve, const PlotAxes& axes) {
  std::vector<std::array<double, 2>> all, kept;
  for (const auto& [x, y] : curve.points) {
    all.push_back({axes.x.position(x), std::clamp(axes.y.position(y), 0.0, 1.0)});
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto [x, y] = all[i];
    const double edge = std::clamp(x, 0.0, 1.0);
    const std::size_t next = x < edge ? i + 1 : i - 1;  // the neighbour towards the inside
    if (x == edge) {
      kept.push_back({x, y});
    } else if (next < all.size() && all[next][0] != x && (all[next][0] > edge) == (x < edge)) {
      kept.push_back({edge, y + (edge - x) / (all[next][0] - x) * (all[next][1] - y)});
    }
  }
  return kept;
}

void write_mark(std::ostream& out, std::string_view transform, std::size_t mark, std::string_view colour, bool hollow,
                std::string_view title) {
  out << "<path" << transform << " d=\"" << style_at(mark).path << "\" stroke=\"" << colour
      << "\" stroke-width=\"0.33\" fill=\"" << (hollow ? "none" : colour) << "\" fill-opacity=\"0.75\">";
  if (!title.empty()) {
    out << "<title>" << escaped(title) << "</title>";
  }
  out << "</path>\n";
}

std::string adapted(std::string_view colour, const SvgStyle& style) {
  return colour.empty() ? escaped(style.ink) : escaped(style.adapt ? style.adapt(colour) : std::string(colour));
}

}  // namespace

PlotLayout::PlotLayout(const Plot& plot, const SvgStyle& style)
    : axes(plot),
      scale(style.font_size / natural_font),
      is_natural(style.parts == PlotParts::whole && !(style.width > 0)),
      width(style.width / scale),
      height(style.height / scale) {
  if (is_natural) {
    take_natural_size(plot);
  } else if (style.parts == PlotParts::legend) {
    width = widest_key(plot) + 2 * margin;
    height = add_legend_column(plot, margin + key_middle, text_line / 2);
  } else {
    fit_best(plot, style.parts);
  }
}

void PlotLayout::take_natural_size(const Plot& plot) {
  const auto count = static_cast<int>(plot.panels.size());
  columns = std::clamp(count, 1, max_columns);
  rows = std::max(1, (count + max_columns - 1) / max_columns);
  const double legend = left + columns * (panel_width + between);
  width = legend + legend_width + natural_margin;
  height = std::max(rows * (top + panel_height + bottom), add_legend_column(plot, legend + key_middle, top + 6));
}

/// Chooses the number of columns and the side of the legend that leave the largest panels. In a small drawing, there is
/// no room for title and legend.
void PlotLayout::fit_best(const Plot& plot, PlotParts parts) {
  const PlotLayout unfitted = *this;
  double largest = 0;
  for (int column = 1; column <= std::clamp(static_cast<int>(plot.panels.size()), 1, max_columns); ++column) {
    for (const bool beside : {false, true}) {
      PlotLayout one = unfitted;
      one.fit(plot, parts, column, beside);
      const double size = std::min(one.panel_width, 2 * one.panel_height);
      if (size > largest) {
        largest = size;
        *this = one;
      }
    }
  }
  if (largest < smallest_panel && parts == PlotParts::whole) {
    *this = unfitted;
    fit_best(plot, PlotParts::panels);
  }
}

void PlotLayout::fit(const Plot& plot, PlotParts parts, int panels_per_row, bool legend_beside) {
  const int count = std::max(1, static_cast<int>(plot.panels.size()));
  columns = panels_per_row;
  rows = (count + columns - 1) / columns;
  left = margin + widest_label(axes.y) + 7;
  right = natural_margin;
  between = std::max(12.0, widest_label(axes.x) + 4);
  top = count > 1 ? 20 : 6;
  bottom = plot.x.title.empty() ? 19 : 33;
  x_title = 29;
  const bool has_legend = parts == PlotParts::whole;
  if (has_legend) {
    title = broken_into_lines(plot.title, (width - 2 * margin) / bold);
    heading = margin + double(title.size()) * text_line;
    heading = legend_beside ? heading : add_legend_rows(plot, heading);
  }
  if (!plot.y.title.empty()) {
    y_title = heading + 11;
    heading += text_line;
  }
  const double legend = has_legend && legend_beside ? widest_key(plot) + margin : 0;
  const double lowest = legend > 0 ? add_legend_column(plot, width - legend + key_middle, heading + text_line) : 0;
  panel_width = std::max(1.0, (width - left - right - legend - (columns - 1) * between) / columns);
  panel_height = lowest > height ? 1 : std::max(1.0, (height - heading) / rows - top - bottom);
}

/// Adds the keys one below the other. Returns where they end.
double PlotLayout::add_legend_column(const Plot& plot, double x, double y) {
  for (std::size_t i = 0; i < plot.series.size(); ++i, y += is_natural ? natural_key : text_line + 1) {
    keys.push_back({x, y});
  }
  y += is_natural ? 6 : 1;
  for (std::size_t i = 0; i < plot.legend_notes.size(); ++i, y += is_natural ? natural_note : text_line) {
    keys.push_back({x, y});
  }
  return is_natural ? y : y - text_line / 2;
}

/// Adds the keys one after the other, in as many lines as needed. Returns where they end.
double PlotLayout::add_legend_rows(const Plot& plot, double y) {
  double x = margin;
  const auto add = [&](double key) {
    if (x > margin && x + key > width - margin) {
      x = margin;
      y += text_line;
    }
    keys.push_back({x + key_middle, y + text_line / 2});
    x += key + between_keys;
  };
  for (const PlotSeries& series : plot.series) {
    add(key_width + text_width(series.label));
  }
  for (const std::string& note : plot.legend_notes) {
    add(text_width(note, legend_note_font));
  }
  return keys.empty() ? y : y + text_line + margin;
}

std::array<double, 2> PlotLayout::corner(std::size_t panel) const {
  const auto column = static_cast<int>(panel) % columns, row = static_cast<int>(panel) / columns;
  return {left + column * (panel_width + between), heading + top + row * (panel_height + top + bottom)};
}

PlotArea PlotLayout::area(std::size_t panel) const {
  const auto [x, y] = corner(panel);
  return {scale * x, scale * y, scale * panel_width, scale * panel_height};
}

std::array<double, 2> PlotLayout::position(std::size_t panel, double x, double y) const {
  const PlotArea inner = area(panel);
  return {inner.left + inner.width * axes.x.position(x), inner.top + inner.height * (1 - axes.y.position(y))};
}

namespace {

class SvgDrawing {
 public:
  SvgDrawing(std::ostream& out, const Plot& plot, const SvgStyle& style)
      : out_(out), plot_(plot), style_(style), ink_(escaped(style.ink)), layout_(plot, style) {}

  void draw() {
    begin();
    if (style_.parts != PlotParts::legend) {
      draw_heading();
      for (std::size_t i = 0; i < plot_.panels.size(); ++i) {
        const auto [x, y] = layout_.corner(i);
        out_ << "<g transform=\"translate(" << coordinate(x) << ' ' << coordinate(y) << ")\">\n";
        draw_panel(plot_.panels[i], static_cast<int>(i) % layout_.columns);
        out_ << "</g>\n";
      }
    }
    draw_legend();
    out_ << "</svg>\n";
  }

 private:
  double width() const { return layout_.panel_width; }
  double height() const { return layout_.panel_height; }
  double at_x(double value) const { return layout_.axes.x.position(value) * width(); }
  double at_y(double value) const { return (1 - layout_.axes.y.position(value)) * height(); }

  void begin() {
    const auto [whole_width, whole_height] = layout_.size();
    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"" << coordinate(whole_width)
         << "\" height=\"" << coordinate(whole_height) << "\" viewBox=\"0 0 " << coordinate(layout_.width) << ' '
         << coordinate(layout_.height) << "\" font-family=\"" << escaped(style_.font) << "\" font-size=\"11\">\n<title>"
         << escaped(plot_.title) << "</title>\n";
    if (!style_.ground.empty()) {
      out_ << "<rect width=\"" << coordinate(layout_.width) << "\" height=\"" << coordinate(layout_.height)
           << "\" fill=\"" << escaped(style_.ground) << "\"/>\n";
    }
  }

  void text(double x, double y, std::string_view anchor, std::string_view words, std::string_view more = "") {
    out_ << "<text x=\"" << coordinate(x) << "\" y=\"" << coordinate(y) << "\" text-anchor=\"" << anchor << "\" fill=\""
         << ink_ << '"' << more << '>' << escaped(words) << "</text>\n";
  }

  void line(double x1, double y1, double x2, double y2, std::string_view more) {
    out_ << "<line x1=\"" << coordinate(x1) << "\" y1=\"" << coordinate(y1) << "\" x2=\"" << coordinate(x2)
         << "\" y2=\"" << coordinate(y2) << "\" stroke=\"" << ink_ << '"' << more << "/>\n";
  }

  void draw_heading() {
    double y = margin + 9;
    for (const std::string& words : layout_.title) {
      text(margin, y, "start", words, " font-weight=\"bold\"");
      y += text_line;
    }
    if (layout_.y_title > 0) {
      text(margin, layout_.y_title, "start", elided(plot_.y.title, layout_.width - 2 * margin));
    }
  }

  void draw_panel(const PlotPanel& panel, int column) {
    if (plot_.good_below && at_y(*plot_.good_below) < height()) {
      const double y = at_y(*plot_.good_below);
      out_ << "<rect x=\"0\" y=\"" << coordinate(y) << "\" width=\"" << coordinate(width()) << "\" height=\""
           << coordinate(height() - y) << "\" fill=\"" << ink_ << "\" fill-opacity=\"0.07\"/>\n";
      if (height() - y > text_line && width() > text_width(plot_.good_label)) {
        text(6, y + 14, "start", plot_.good_label, " fill-opacity=\"0.65\" font-style=\"italic\"");
      }
    }
    if (layout_.top > text_line) {
      const double room = width() + (column + 1 < layout_.columns ? layout_.between : layout_.right);
      text(0, -9, "start", elided(panel.title, room / bold), " font-weight=\"bold\"");
    }
    draw_axes(column);
    if (panel.level) {
      const double y = at_y(panel.level->y);
      line(0, y, width(), y, " stroke-opacity=\"0.8\" stroke-dasharray=\"6 3\"");
      text(width() - 4, y - 4, "end", elided(panel.level->label, width(), note_font),
           " font-size=\"9\" font-style=\"italic\"");
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
      draw_note(mark, room_after(column), notes);
    }
  }

  /// Writes the note of a mark unless it would cover another note: above the mark, or else below it. It is before a
  /// mark at the edge.
  void draw_note(const PlotMark& mark, double room, std::vector<std::array<double, 2>>& notes) {
    const double note = text_width(mark.note, note_font), after = at_x(mark.x) + 7;
    const double x = after + note > width() + room ? after - 14 - note : after;
    for (const double below : {-4.0, 11.0}) {
      const double y = at_y(mark.y) + below;
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

  // Free units on both sides of the panels of a column.
  double room_before(int column) const { return column == 0 ? layout_.left : layout_.between / 2; }
  double room_after(int column) const { return column + 1 == layout_.columns ? layout_.right : layout_.between / 2; }

  /// Returns the centre of a text below a panel, moved from `x` into the room of the panel.
  double centre_of(std::string_view words, double x, int column) const {
    const double half = text_width(words) / 2, last = width() + room_after(column) - half;
    return std::min(std::max(x, half - room_before(column)), last);
  }

  void draw_axes(int column) {
    draw_y_ticks(column == 0);
    draw_x_ticks(column);
    line(0, 0, 0, height(), "");
    line(0, height(), width(), height(), "");
    const std::string title = elided(plot_.x.title, room_before(column) + width() + room_after(column));
    text(centre_of(title, width() / 2, column), height() + layout_.x_title, "middle", title);
    if (column == 0 && layout_.is_natural) {
      text(0, 0, "middle", plot_.y.title, " transform=\"translate(-56 " + coordinate(height() / 2) + ") rotate(-90)\"");
    }
  }

  void draw_y_ticks(bool with_labels) {
    const std::vector<Tick>& ticks = layout_.axes.y.ticks();
    std::vector<Span> spans;
    spans.reserve(ticks.size());
    for (const Tick& tick : ticks) {
      spans.push_back(
          {(1 - tick.position) * height() - label_height / 2, (1 - tick.position) * height() + label_height / 2});
    }
    const std::vector<bool> shown = shown_apart(spans);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      const auto& [share, label, zero] = ticks[i];
      const double y = (1 - share) * height();
      line(0, y, width(), y, zero ? " stroke-opacity=\"0.6\" stroke-dasharray=\"4 3\"" : " stroke-opacity=\"0.18\"");
      if (with_labels && shown[i]) {
        text(-7, y + 4, "end", label, zero ? " font-weight=\"bold\"" : "");
      }
    }
  }

  void draw_x_ticks(int column) {
    const std::vector<Tick>& ticks = layout_.axes.x.ticks();
    std::vector<Span> spans;
    for (const Tick& tick : ticks) {
      const double centre = centre_of(tick.label, tick.position * width(), column), half = text_width(tick.label) / 2;
      spans.push_back({centre - half - 1, centre + half + 1});
    }
    const std::vector<bool> shown = shown_apart(spans);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      const double x = ticks[i].position * width();
      line(x, 0, x, height(), " stroke-opacity=\"0.18\"");
      if (shown[i]) {
        text((spans[i][0] + spans[i][1]) / 2, height() + 16, "middle", ticks[i].label);
      }
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

  bool has_marks(std::size_t series) const { return plot_.series[series].colour.empty(); }

  std::string colour_of(std::size_t series) const {
    const PlotSeries& one = plot_.series[series];
    return adapted(has_marks(series) ? style_at(one.style).colour : std::string_view(one.colour), style_);
  }

  void draw_curve(const PlotCurve& curve) {
    const std::vector<std::array<double, 2>> points = inside(curve, layout_.axes);
    out_ << "<polyline points=\"";
    const double half = points.size() == 1 ? 0.7 : 0;  // a single point is a dot
    for (const auto& [x, y] : points) {
      out_ << coordinate(x * width() - half) << ',' << coordinate((1 - y) * height()) << ' ';
    }
    if (half > 0) {
      out_ << coordinate(points[0][0] * width() + half) << ',' << coordinate((1 - points[0][1]) * height());
    }
    out_ << "\" fill=\"none\" stroke=\"" << colour_of(curve.series)
         << (has_marks(curve.series) ? "\" stroke-opacity=\"0.7\"/>\n" : "\" stroke-width=\"1.3\"/>\n");
  }

  void draw_mark(double x, double y, std::size_t series, bool hollow, std::string_view title) {
    write_mark(
        out_,
        " transform=\"translate(" + coordinate(x) + ' ' + coordinate(y) + ") scale(" + coordinate(mark_size) + ")\"",
        plot_.series[series].style, colour_of(series), hollow, title);
  }

  /// Draws the mark of a series in the legend, or a short line for a series of lines.
  void draw_key(double x, double y, std::size_t series) {
    if (has_marks(series)) {
      draw_mark(x, y, series, false, "");
    } else {
      out_ << "<path d=\"M" << coordinate(x - 8) << ' ' << coordinate(y) << "h16\" stroke=\"" << colour_of(series)
           << "\"/>\n";
    }
  }

  void draw_legend() {
    for (std::size_t i = 0; i < layout_.keys.size(); ++i) {
      const auto [x, y] = layout_.keys[i];
      const double room = layout_.width - x;
      if (i < plot_.series.size()) {
        draw_key(x, y, i);
        text(x + 13, y + 4, "start", elided(plot_.series[i].label, room - 13));
      } else {
        text(x - 5, y + 4, "start", elided(plot_.legend_notes[i - plot_.series.size()], room + 5, legend_note_font),
             " font-size=\"10\" fill-opacity=\"0.75\"");
      }
    }
  }

  std::ostream& out_;
  const Plot& plot_;
  const SvgStyle& style_;
  std::string ink_;
  PlotLayout layout_;
};

}  // namespace

void write_svg(std::ostream& out, const Plot& plot, const SvgStyle& style) { SvgDrawing(out, plot, style).draw(); }

std::string mark_svg(std::size_t mark, bool hollow, const SvgStyle& style) {
  std::ostringstream out;
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-1.6 -1.6 3.2 3.2\">";
  write_mark(out, "", mark, adapted(style_at(mark).colour, style), hollow, "");
  out << "</svg>\n";
  return out.str();
}

}  // namespace chainmail::report
