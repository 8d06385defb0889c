#include "common/plot_painting.h"

#include <QBuffer>
#include <QPdfWriter>
#include <QSvgGenerator>
#include <QSvgRenderer>
#include <cmath>

#include "common/as_path.h"
#include "common/colours.h"
#include "common/text.h"
#include "common/theme.h"

namespace chainmail {
namespace {

// Logical pixels.
constexpr double markUnit = 4.6;  // unit of a style, which is drawn about (0, 0)
constexpr double markSide = 3.2;  // side of a style's square, in its units
constexpr double curveWidth = 1.4;
constexpr double keyWidth = 22, betweenKeys = 16, betweenLabels = 5;

constexpr QSizeF pdfPage{160, 90};     // mm
constexpr QSizeF savedSize{640, 360};  // logical pixels
constexpr double savedPixelRatio = 3;

constexpr double leastContrast = 3;  // contrast of marks with the background (WCAG 2.1, 1.4.11)

QColor mixed(const QColor& one, const QColor& other, double share) {
  const auto mix = [share](double a, double b) { return float(a + share * (b - a)); };
  return QColor::fromRgbF(mix(one.redF(), other.redF()), mix(one.greenF(), other.greenF()),
                          mix(one.blueF(), other.blueF()));
}

/// Returns the colour of a style, mixed with the text colour until it has enough contrast to the background.
QColor styleColour(std::size_t style, const QPalette& palette) {
  const QColor ink = palette.color(QPalette::WindowText), ground = palette.color(QPalette::Window);
  const QString name = text(report::style_at(style).colour);
  if (name.isEmpty()) {
    return ink;
  }
  QColor colour(name);
  for (int step = 0; step < 10 && colours::contrast(colour, ground) < leastContrast; ++step) {
    colour = mixed(colour, ink, 0.1);
  }
  return colour;
}

/// Looks are SVG paths, which Qt's SVG renderer draws as vectors.
void paintMark(QPainter& painter, std::size_t style, const QColor& colour, bool hollow, const QRectF& square) {
  const QString svg =
      QStringLiteral(
          "<svg xmlns='http://www.w3.org/2000/svg' viewBox='-1.6 -1.6 3.2 3.2'>"
          "<path d='%1' stroke='%2' stroke-width='0.33' fill='%3' fill-opacity='0.75'/></svg>")
          .arg(text(report::style_at(style).path), colour.name(), hollow ? QStringLiteral("none") : colour.name());
  QSvgRenderer(svg.toUtf8()).render(&painter, square);
}

QRectF markSquare(QPointF centre) {
  const double side = markUnit * markSide;
  return {centre.x() - side / 2, centre.y() - side / 2, side, side};
}

void paintWords(QPainter& painter, const QRectF& area, const QString& words) {
  painter.drawText(area, int(Qt::AlignLeft | Qt::AlignVCenter) | Qt::TextDontClip | Qt::TextSingleLine, words);
}

/// Writes the note of a mark unless it would cover another note: above the mark, or else below it.
void paintNote(QPainter& painter, QPointF mark, const QString& note, std::vector<QRectF>& notes) {
  const QFontMetricsF metrics(painter.font(), painter.device());
  for (const double below : {-4.0, metrics.ascent() + 2}) {
    const QRectF area = metrics.boundingRect(note).translated(mark + QPointF(7, below));
    const bool covers = std::ranges::any_of(notes, [&](const QRectF& one) { return one.intersects(area); });
    if (!note.isEmpty() && !covers) {
      painter.drawText(mark + QPointF(7, below), note);
      notes.push_back(area);
      return;
    }
  }
}

}  // namespace

PlotPainting::PlotPainting(const report::Plot& plot, const QPalette& palette)
    : plot_(plot), palette_(palette), axes_(plot) {}

QColor PlotPainting::colourOf(std::size_t series) const {
  const report::PlotSeries& one = plot_.series[series];
  return one.colour.empty() ? styleColour(one.style, palette_) : QColor(text(one.colour));
}

QPointF PlotPainting::positionOf(double x, double y) const {
  return {inner_.left() + inner_.width() * axes_.x.position(x),
          inner_.bottom() - inner_.height() * axes_.y.position(y)};
}

void PlotPainting::layOut(const QRectF& area, const QFontMetricsF& metrics) {
  double width = 0;
  for (const report::Tick& tick : axes_.y.ticks()) {
    width = std::max(width, metrics.horizontalAdvance(text(tick.label)));
  }
  const double line = metrics.height();
  const double above = plot_.y.title.empty() ? line / 2 : line * 1.5;
  const double below = (plot_.x.title.empty() ? 1 : 2) * line + 3;
  const bool marks = panel() != nullptr && !panel()->marks.empty();
  inner_ = area.adjusted(width + 6, above, marks ? -markUnit - 2 : -1, -below);
  layOutLabels(area, metrics);
}

/// Leaves out labels that do not fit between their neighbours. Labels at the ends have priority.
void PlotPainting::layOutLabels(const QRectF& area, const QFontMetricsF& metrics) {
  labels_.clear();
  const double line = metrics.height();
  const auto add = [this](const QRectF& label, const QString& words, const QMarginsF& gap) {
    if (std::ranges::none_of(labels_, [&](const Label& one) { return one.area.intersects(label + gap); })) {
      labels_.push_back({label, words});
    }
  };
  const auto addTicks = [](const std::vector<report::Tick>& ticks, const auto& addOne) {
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      addOne(ticks[i == 0 ? 0 : i == 1 ? ticks.size() - 1 : i - 1]);
    }
  };
  addTicks(axes_.y.ticks(), [&](const report::Tick& tick) {
    const double width = metrics.horizontalAdvance(text(tick.label));
    const double y = inner_.bottom() - inner_.height() * tick.position;
    add({inner_.left() - 6 - width, y - line / 2, width, line}, text(tick.label), {});
  });
  addTicks(axes_.x.ticks(), [&](const report::Tick& tick) {
    const double width = metrics.horizontalAdvance(text(tick.label));
    const double x = inner_.left() + inner_.width() * tick.position - width / 2;
    const double end = std::max(inner_.left(), area.right() - width);
    add({std::clamp(x, inner_.left(), end), inner_.bottom() + 2, width, line}, text(tick.label),
        {betweenLabels, 0, betweenLabels, 0});
  });
  const auto title = [&](double y, const std::string& words, Qt::Alignment side) {
    const QString fitting = metrics.elidedText(text(words), Qt::ElideRight, area.width());
    const double width = metrics.horizontalAdvance(fitting);
    const double x = side == Qt::AlignLeft ? area.left() : inner_.center().x() - width / 2;
    labels_.push_back(
        {{std::clamp(x, area.left(), std::max(area.left(), area.right() - width)), y, width, line}, fitting});
  };
  title(area.top(), plot_.y.title, Qt::AlignLeft);
  title(inner_.bottom() + 2 + line, plot_.x.title, Qt::AlignHCenter);
}

void PlotPainting::paint(QPainter& painter) const {
  painter.save();
  paintStrip(painter);
  paintGrid(painter);
  paintLabels(painter);
  painter.setRenderHint(QPainter::Antialiasing);
  if (panel() != nullptr) {
    paintLevel(painter);
    paintCurves(painter);
    paintMarks(painter);
  }
  painter.restore();
}

void PlotPainting::paintStrip(QPainter& painter) const {
  if (!plot_.good_below) {
    return;
  }
  QColor shade = palette_.color(QPalette::WindowText);
  const QRectF strip(QPointF(inner_.left(), positionOf(0, *plot_.good_below).y()), inner_.bottomRight());
  shade.setAlphaF(0.07F);
  painter.fillRect(strip, shade);
  painter.setPen(palette_.color(QPalette::PlaceholderText));
  const QFontMetricsF metrics(painter.font(), painter.device());
  if (strip.height() >= metrics.height() && strip.width() > metrics.horizontalAdvance(text(plot_.good_label))) {
    painter.drawText(strip.adjusted(4, 1, 0, 0), int(Qt::AlignLeft | Qt::AlignTop), text(plot_.good_label));
  }
}

void PlotPainting::paintGrid(QPainter& painter) const {
  const QPen grid(palette_.color(QPalette::Mid), 0);
  const QPen zero(palette_.color(QPalette::PlaceholderText), 1, Qt::DashLine);
  for (const report::Tick& tick : axes_.y.ticks()) {
    const double y = inner_.bottom() - inner_.height() * tick.position;
    painter.setPen(tick.is_zero ? zero : grid);
    painter.drawLine(QLineF(inner_.left(), y, inner_.right(), y));
  }
  painter.setPen(grid);
  for (const report::Tick& tick : axes_.x.ticks()) {
    const double x = inner_.left() + inner_.width() * tick.position;
    painter.drawLine(QLineF(x, inner_.top(), x, inner_.bottom()));
  }
  painter.drawLine(inner_.bottomLeft(), inner_.topLeft());
  painter.drawLine(inner_.bottomLeft(), inner_.bottomRight());
}

void PlotPainting::paintLabels(QPainter& painter) const {
  painter.setPen(palette_.color(QPalette::WindowText));
  for (const Label& label : labels_) {
    paintWords(painter, label.area, label.text);
  }
}

void PlotPainting::paintLevel(QPainter& painter) const {
  if (const auto& level = panel()->level) {
    const double y = positionOf(0, level->y).y();
    painter.setPen(QPen(palette_.color(QPalette::WindowText), 1, Qt::DashLine));
    painter.drawLine(QLineF(inner_.left(), y, inner_.right(), y));
    painter.drawText(QPointF(inner_.left() + 4, y - 3), text(level->label));
  }
}

void PlotPainting::paintCurves(QPainter& painter) const {
  painter.save();
  painter.setClipRect(inner_.adjusted(-1, -1, 1, 1));
  for (const report::PlotCurve& curve : panel()->curves) {
    painter.setPen(QPen(colourOf(curve.series), curveWidth, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    QPolygonF line;
    line.reserve(qsizetype(curve.points.size()));
    for (const auto& [x, y] : curve.points) {
      line << positionOf(x, y);
    }
    line.size() == 1 ? painter.drawPoint(line.first()) : painter.drawPolyline(line);
  }
  painter.restore();
}

void PlotPainting::paintMarks(QPainter& painter) const {
  for (const report::PlotMark& mark : panel()->marks) {
    const QPointF low = positionOf(mark.x_low, mark.y), high = positionOf(mark.x_high, mark.y);
    if (high.x() - low.x() > 2.5 * markUnit) {  // else the mark hides the bar
      painter.setPen(QPen(colourOf(mark.series), 1));
      painter.drawLine(low, high);
      for (const QPointF& end : {low, high}) {
        painter.drawLine(end - QPointF(0, 3), end + QPointF(0, 3));
      }
    }
  }
  painter.setPen(palette_.color(QPalette::WindowText));
  std::vector<QRectF> notes;
  for (const report::PlotMark& mark : panel()->marks) {
    const QPointF centre = positionOf(mark.x, mark.y);
    paintMark(painter, plot_.series[mark.series].style, colourOf(mark.series), mark.hollow, markSquare(centre));
    paintNote(painter, centre, text(mark.note), notes);
  }
}

/// Paints the key of a series: a short line for lines, the mark for marks.
void PlotPainting::paintKey(QPainter& painter, std::size_t series, QPointF centre) const {
  const report::PlotSeries& one = plot_.series[series];
  if (one.colour.empty()) {
    paintMark(painter, one.style, colourOf(series), false, markSquare(centre));
    return;
  }
  const QPointF half((keyWidth - 6) / 2, 0);
  painter.setPen(QPen(colourOf(series), 2 * curveWidth));
  painter.drawLine(centre - half, centre + half);
}

double PlotPainting::paintHeading(QPainter& painter, const QRectF& area) const {
  const QFontMetricsF metrics(painter.font(), painter.device());
  QRectF line(area.left(), area.top(), area.width(), metrics.height() + 3);
  painter.setPen(palette_.color(QPalette::WindowText));
  paintWords(painter, line, text(plot_.title));
  line.moveTop(line.bottom());
  for (std::size_t series = 0; series < plot_.series.size(); ++series) {
    const QString label = text(plot_.series[series].label);
    const double width = keyWidth + metrics.horizontalAdvance(label);
    if (line.left() > area.left() && line.left() + width > area.right()) {
      line.moveTopLeft({area.left(), line.bottom()});
    }
    paintKey(painter, series, {line.left() + (keyWidth - 6) / 2, line.center().y()});
    painter.setPen(palette_.color(QPalette::WindowText));
    paintWords(painter, {line.left() + keyWidth, line.top(), width, line.height()}, label);
    line.moveLeft(line.left() + width + betweenKeys);
  }
  if (!plot_.legend_notes.empty()) {
    line.moveTopLeft({area.left(), line.bottom()});
    QStringList notes;
    std::ranges::transform(plot_.legend_notes, std::back_inserter(notes),
                           [](const std::string& one) { return text(one); });
    paintWords(painter, line, notes.join(QStringLiteral("  ·  ")));
  }
  return line.bottom();
}

QSizeF PlotPainting::legendSize(const QFontMetricsF& metrics) const {
  double width = 0;
  for (const report::PlotSeries& series : plot_.series) {
    width = std::max(width, keyWidth + metrics.horizontalAdvance(text(series.label)));
  }
  for (const std::string& note : plot_.legend_notes) {
    width = std::max(width, metrics.horizontalAdvance(text(note)));
  }
  const std::size_t lines = plot_.series.size() + plot_.legend_notes.size();
  return {std::ceil(width), double(lines) * (metrics.height() + 1)};
}

void PlotPainting::paintLegend(QPainter& painter, const QRectF& area) const {
  const QFontMetricsF metrics(painter.font(), painter.device());
  QRectF line(area.left(), area.top(), area.width(), metrics.height() + 1);
  for (std::size_t series = 0; series < plot_.series.size(); ++series) {
    paintKey(painter, series, {line.left() + (keyWidth - 6) / 2, line.center().y()});
    painter.setPen(palette_.color(QPalette::WindowText));
    paintWords(painter, line.adjusted(keyWidth, 0, 0, 0), text(plot_.series[series].label));
    line.moveTop(line.bottom());
  }
  for (const std::string& note : plot_.legend_notes) {
    paintWords(painter, line, text(note));
    line.moveTop(line.bottom());
  }
}

QPixmap plotMark(Algorithm algorithm, bool hollow, int size, double devicePixelRatio, const QPalette& palette) {
  const std::size_t style = report::style_of(algorithm);
  QPixmap picture(QSize(size, size) * devicePixelRatio);
  picture.setDevicePixelRatio(devicePixelRatio);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  paintMark(painter, style, styleColour(style, palette), hollow, QRectF(0, 0, size, size));
  return picture;
}

namespace {

/// Paints the plot and its legend on paper; the area has the size `savedSize`.
void paintPage(QPainter& painter, const report::Plot& plot) {
  QFont font;
  font.setPixelSize(13);
  painter.setFont(font);
  const QRectF area = QRectF({}, savedSize).adjusted(14, 10, -16, -8);
  PlotPainting painting(plot, paletteOn(colours::Ground::light));
  const double below = painting.paintHeading(painter, area);
  painting.layOut(area.adjusted(0, below - area.top() + 4, 0, 0), QFontMetricsF(font, painter.device()));
  painting.paint(painter);
}

bool writePdf(QIODevice& file, const report::Plot& plot) {
  QPdfWriter writer(&file);
  writer.setPageSize(QPageSize(pdfPage, QPageSize::Millimeter));
  writer.setPageMargins({});
  writer.setTitle(text(plot.title));
  QPainter painter;
  if (!painter.begin(&writer)) {
    return false;
  }
  painter.scale(writer.width() / savedSize.width(), writer.height() / savedSize.height());
  paintPage(painter, plot);
  return painter.end();
}

/// Returns a title without the characters of markup: Qt 6.4 does not escape the title of an SVG, later versions may.
QString titleForSvg(const report::Plot& plot) {
  QString title = text(plot.title);
  title.removeIf([](QChar letter) { return letter == u'<' || letter == u'>' || letter == u'&'; });
  return title;
}

bool writeSvg(QIODevice& file, const report::Plot& plot) {
  QSvgGenerator writer;
  writer.setOutputDevice(&file);
  writer.setTitle(titleForSvg(plot));
  writer.setSize(savedSize.toSize());
  writer.setViewBox(QRectF({}, savedSize));
  QPainter painter;
  if (!painter.begin(&writer)) {
    return false;
  }
  painter.fillRect(QRectF({}, savedSize), paletteOn(colours::Ground::light).color(QPalette::Base));
  paintPage(painter, plot);
  return painter.end();
}

bool writePng(QIODevice& file, const report::Plot& plot) {
  QImage image((savedSize * savedPixelRatio).toSize(), QImage::Format_RGB32);
  image.setDevicePixelRatio(savedPixelRatio);
  image.fill(paletteOn(colours::Ground::light).color(QPalette::Base));
  QPainter painter(&image);
  paintPage(painter, plot);
  painter.end();
  return image.save(&file, "PNG");
}

}  // namespace

QStringList plotFilters() {
  return {QStringLiteral("SVG drawing (*.svg)"), QStringLiteral("PDF drawing (*.pdf)"),
          QStringLiteral("PNG picture (*.png)")};
}

void savePlot(const report::Plot& plot, const QString& path) {
  const auto endsIn = [&path](const char* ending) { return path.endsWith(QLatin1String(ending), Qt::CaseInsensitive); };
  const auto write = endsIn(".pdf") ? writePdf : endsIn(".svg") ? writeSvg : writePng;
  QBuffer buffer;
  buffer.open(QIODevice::WriteOnly);
  writeBytes(path, write(buffer, plot) ? buffer.data() : QByteArray());
}

}  // namespace chainmail
