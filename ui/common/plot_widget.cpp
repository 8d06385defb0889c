#include "common/plot_widget.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <cmath>

#include "common/text.h"
#include "report/table/format.h"

namespace chainmail {
namespace {

constexpr double reach = 6;       // logical pixels from the pointer; lines within this distance are read
constexpr double markReach = 10;  // logical pixels from the pointer; marks within this distance are read

/// Returns the point of a series of lines that is nearest to `x`, up to a distance.
std::optional<std::array<double, 2>> nearestPoint(const report::PlotPanel& panel, std::size_t series, double x,
                                                  double distance) {
  std::optional<std::array<double, 2>> found;
  for (const report::PlotCurve& curve : panel.curves) {
    for (const auto& point : curve.points) {
      if (const double off = std::abs(point[0] - x); curve.series == series && off <= distance) {
        distance = off;
        found = point;
      }
    }
  }
  return found;
}

QString valueWithUnit(double value, const report::PlotAxis& axis) {
  return (text(report::figure(value)) + QLatin1Char(' ') + text(axis.unit)).trimmed();
}

}  // namespace

PlotWidget::PlotWidget(const QString& emptyText) : emptyText_(emptyText) {
  setMouseTracking(true);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Expanding);
}

void PlotWidget::show(report::Plot plot) {
  layout_.reset();
  plot_ = std::move(plot);
  update();
}

/// Draws the plot anew if something has changed, and returns its layout.
const report::PlotLayout& PlotWidget::drawn() {
  if (!layout_) {
    report::SvgStyle style = plotStyle(palette(), font());
    style.width = width();
    style.height = height();
    style.parts = report::PlotParts::panels;
    layout_.emplace(plot_, style);
    drawing_.load(plotDrawing(plot_, style));
  }
  return *layout_;
}

void PlotWidget::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  if (report::is_empty(plot_)) {
    painter.setPen(palette().color(QPalette::PlaceholderText));
    painter.drawText(rect(), int(Qt::AlignCenter) | Qt::TextWordWrap, emptyText_);
    return;
  }
  drawn();
  painter.setRenderHint(QPainter::Antialiasing);
  drawing_.render(&painter, rect());
}

QString PlotWidget::readingAt(QPointF position) {
  if (report::is_empty(plot_)) {
    return {};
  }
  const QString mark = markReading(position);
  return mark.isEmpty() ? curveReading(position) : mark;
}

QString PlotWidget::markReading(QPointF position) {
  const report::PlotLayout& layout = drawn();
  const report::PlotMark* nearest = nullptr;
  double least = markReach;
  for (std::size_t panel = 0; panel < plot_.panels.size(); ++panel) {
    for (const report::PlotMark& mark : plot_.panels[panel].marks) {
      const auto [x, y] = layout.position(panel, mark.x, mark.y);
      if (const double off = QLineF({x, y}, position).length(); off < least) {
        least = off;
        nearest = &mark;
      }
    }
  }
  return nearest == nullptr ? QString() : text(nearest->title);
}

QString PlotWidget::curveReading(QPointF position) {
  for (std::size_t panel = 0; panel < plot_.panels.size(); ++panel) {
    const auto [left, top, width, height] = drawn().area(panel);
    if (QRectF(left, top, width, height).contains(position)) {
      return curveReading(plot_.panels[panel], (position.x() - left) / width, 1 / width);
    }
  }
  return {};
}

/// Returns the value of x at a share of the panel's width and, below it, one line of text per series. Lines are read on
/// linear axes only.
QString PlotWidget::curveReading(const report::PlotPanel& panel, double share, double pixel) const {
  if (!plot_.x.linear || !plot_.x.ends) {
    return {};
  }
  const auto [from, to] = *plot_.x.ends;
  const double x = from + share * (to - from);
  QStringList lines;
  for (std::size_t series = 0; series < plot_.series.size(); ++series) {
    if (const auto point = nearestPoint(panel, series, x, reach * pixel * (to - from))) {
      lines << QStringLiteral("%1: %2").arg(text(plot_.series[series].label), valueWithUnit((*point)[1], plot_.y));
    }
  }
  return lines.isEmpty() ? QString()
                         : valueWithUnit(x - plot_.x.zero, plot_.x) + QLatin1Char('\n') + lines.join(QLatin1Char('\n'));
}

void PlotWidget::mouseMoveEvent(QMouseEvent* event) {
  const QString reading = readingAt(event->position());
  if (reading == shownReading_) {
    return;
  }
  shownReading_ = reading;
  reading.isEmpty() ? QToolTip::hideText() : QToolTip::showText(event->globalPosition().toPoint(), reading, this);
}

/// Shows the reading as tool tip. If there is none, the widget's own tool tip is shown.
bool PlotWidget::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = dynamic_cast<QHelpEvent*>(event);
    if (const QString reading = readingAt(help->pos()); !reading.isEmpty()) {
      QToolTip::showText(help->globalPos(), reading, this);
      return true;
    }
  }
  return QWidget::event(event);
}

void PlotWidget::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) {
    layout_.reset();
  }
  QWidget::changeEvent(event);
}

void PlotWidget::resizeEvent(QResizeEvent* event) {
  layout_.reset();
  QWidget::resizeEvent(event);
}

void PlotLegend::show(report::Plot plot) {
  plot_ = std::move(plot);
  draw();
}

void PlotLegend::draw() {
  report::SvgStyle style = plotStyle(palette(), font());
  style.parts = report::PlotParts::legend;
  drawing_.load(plotDrawing(plot_, style));
  updateGeometry();
  update();
}

void PlotLegend::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) {
    draw();
  }
  QWidget::changeEvent(event);
}

void PlotLegend::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  drawing_.render(&painter, QRectF(QPointF(), drawing_.defaultSize()));
}

}  // namespace chainmail
