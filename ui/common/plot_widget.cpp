#include "common/plot_widget.h"

#include <QHelpEvent>
#include <QMouseEvent>
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
  painting_.reset();
  plot_ = std::move(plot);
  update();
}

PlotPainting& PlotWidget::painting() {
  if (!painting_) {
    painting_.emplace(plot_, palette());
  }
  painting_->layOut(rect(), QFontMetricsF(font(), this));
  return *painting_;
}

void PlotWidget::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  if (report::is_empty(plot_)) {
    painter.setPen(palette().color(QPalette::PlaceholderText));
    painter.drawText(rect(), int(Qt::AlignCenter) | Qt::TextWordWrap, emptyText_);
    return;
  }
  painting().paint(painter);
}

QPointF PlotWidget::positionOf(double x, double y) { return painting().positionOf(x, y); }

QString PlotWidget::readingAt(QPointF position) {
  if (report::is_empty(plot_)) {
    return {};
  }
  const QString mark = markReading(position);
  return mark.isEmpty() ? curveReading(position) : mark;
}

QString PlotWidget::markReading(QPointF position) {
  const PlotPainting& drawn = painting();
  const report::PlotMark* nearest = nullptr;
  double least = markReach;
  for (const report::PlotMark& mark : plot_.panels.front().marks) {
    if (const double off = QLineF(drawn.positionOf(mark.x, mark.y), position).length(); off < least) {
      least = off;
      nearest = &mark;
    }
  }
  return nearest == nullptr ? QString() : text(nearest->title);
}

/// Returns the value of x and, below it, one line of text per series. Lines are read on linear axes only.
QString PlotWidget::curveReading(QPointF position) {
  const QRectF inner = painting().inner();
  if (!plot_.x.linear || !plot_.x.ends || !inner.contains(position)) {
    return {};
  }
  const auto [from, to] = *plot_.x.ends;
  const double perPixel = (to - from) / inner.width();
  QStringList lines;
  double x = from + perPixel * (position.x() - inner.left());
  for (std::size_t series = 0; series < plot_.series.size(); ++series) {
    if (const auto point = nearestPoint(plot_.panels.front(), series, x, reach * perPixel)) {
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
  if (event->type() == QEvent::PaletteChange) {
    painting_.reset();
  }
  QWidget::changeEvent(event);
}

void PlotLegend::show(report::Plot plot) {
  plot_ = std::move(plot);
  updateGeometry();
  update();
}

QSize PlotLegend::sizeHint() const {
  return PlotPainting(plot_, palette()).legendSize(QFontMetricsF(font(), this)).toSize() + QSize(0, 1);
}

void PlotLegend::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  PlotPainting(plot_, palette()).paintLegend(painter, rect());
}

}  // namespace chainmail
