#include "panels/legend.h"

#include <QEvent>
#include <QLinearGradient>
#include <QPainter>

#include "common/shown_number.h"
#include "common/text.h"
#include "drawing/colour_map.h"

namespace chainmail {
namespace {

constexpr int legendMargin = 8;  // pixels, the same as in the other lines of a panel
constexpr int gap = 6;           // pixels between the bar and its numbers
constexpr int barHeight = 10;
constexpr int widestBar = 280;

QString legendNumber(float value) { return shownNumber(double(value), 'g', 3); }

/// Draws a text at the left of a line and removes its width from the line.
void drawText(QPainter& painter, QRect& line, const QString& text) {
  painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter, text);
  line.setLeft(line.left() + painter.fontMetrics().horizontalAdvance(text) + gap);
}

QRect barIn(QRect line, int width) {
  const int height = std::max(barHeight, line.height() / 2);  // texts are large in the lecture mode
  return {line.left(), line.center().y() - height / 2, width, height};
}

}  // namespace

Legend::Legend() {
  fitHeight();
  hide();
}

/// Two lines of text.
void Legend::fitHeight() { setFixedHeight(2 * fontMetrics().height() + 6); }

void Legend::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::FontChange) {
    fitHeight();
  }
}

void Legend::follow(const Colouring& colouring, int panel) {
  setVisible(colouring.mode() != ColourMode::plain);
  setToolTip(colouring.sharesScale() ? QStringLiteral("One scale for all panels: a colour means the same value in each")
                                     : QStringLiteral("The scale of this panel only: other panels have their own"));
  set(colouring.title(panel), colouring.scale(panel));
}

void Legend::show(const OverlayLegend& legend) {
  setVisible(true);
  setToolTip(legend.toolTip);
  set(legend.title, legend.scale);
}

void Legend::set(const QString& title, const ColourScale& scale) {
  if (title != title_ || scale != scale_) {
    title_ = title;
    scale_ = scale;
    setAccessibleName(QStringLiteral("%1, from %2 to %3").arg(title_, lowest(), highest()));
    update();
  }
}

QString Legend::lowest() const { return scale_.known() ? legendNumber(scale_.lowest) : QString(); }
QString Legend::highest() const { return scale_.known() ? legendNumber(scale_.highest) : QString(); }

void Legend::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setPen(palette().color(QPalette::WindowText));
  draw(painter);
}

void Legend::draw(QPainter& painter) const {
  QRect line(legendMargin, 0, width() - 2 * legendMargin, fontMetrics().height());
  painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter,
                   fontMetrics().elidedText(title(), Qt::ElideRight, line.width()));
  line.translate(0, fontMetrics().height() + 2);
  if (!scale_.known()) {
    return;
  }
  if (scale_.threshold >= 0) {
    drawNeutral(painter, line);
  }
  if (!showsOne()) {
    drawMap(painter, line);
  } else if (scale_.threshold < 0) {
    painter.fillRect(barIn(line, barHeight), colour_map::at(0));
    line.setLeft(line.left() + barHeight + gap);
    drawText(painter, line, QStringLiteral("%1 everywhere").arg(lowest()));
  }
}

/// Draws the colour of values at or below the threshold.
void Legend::drawNeutral(QPainter& painter, QRect& line) const {
  painter.fillRect(barIn(line, barHeight), colour_map::neutral);
  line.setLeft(line.left() + barHeight + gap);
  const QString bound = (scale_.diverging ? QStringLiteral("within ±%1") : QStringLiteral("up to %1"))
                            .arg(legendNumber(scale_.threshold));
  drawText(painter, line, showsOne() ? bound + QStringLiteral(", everywhere") : bound);
  line.setLeft(line.left() + gap);
}

void Legend::drawMap(QPainter& painter, QRect line) const {
  if (scale_.threshold < 0 || scale_.diverging) {
    drawText(painter, line, lowest());
  }
  const int width = std::min(widestBar, line.width() - gap - painter.fontMetrics().horizontalAdvance(highest()));
  if (width <= 0) {
    return;
  }
  const QRect map = barIn(line, width);
  QLinearGradient gradient(map.topLeft(), map.topRight());
  const auto& stops = colour_map::stopsOf(scale_);
  constexpr int steps = int(std::tuple_size_v<colour_map::Stops>) - 1;
  for (int i = 0; i <= steps; ++i) {
    const double share = double(i) / steps;
    gradient.setColorAt(share, colour_map::at(share, stops));
  }
  painter.fillRect(map, gradient);
  line.setLeft(map.right() + gap);
  drawText(painter, line, highest());
}

}  // namespace chainmail
