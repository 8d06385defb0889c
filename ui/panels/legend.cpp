#include "panels/legend.h"

#include <QEvent>
#include <QLinearGradient>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/text.h"
#include "drawing/colour_map.h"

namespace chainmail {
namespace {

constexpr int legendMargin = 8;  // pixels, the same as in the other lines of a panel
constexpr int topMargin = 3;
constexpr int gap = 6;  // pixels between the bar and its numbers
constexpr int barHeight = 10;
constexpr int widestBar = 360;
constexpr int tickLength = 2;
constexpr double mostSteps = 6;  // of round values on a linear scale

QString legendNumber(float value) { return shownNumber(double(value), 'g', 3); }

/// Draws a text at the left of a line and removes its width from the line.
void drawText(QPainter& painter, QRect& line, const QString& text) {
  painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter, text);
  line.setLeft(line.left() + painter.fontMetrics().horizontalAdvance(text) + gap);
}

/// Returns the powers of ten of a logarithmic scale, or multiples of 1, 2 or 5 times such a power; the centre of a
/// diverging scale first.
std::vector<double> roundValues(const ColourScale& scale) {
  std::vector<double> values;
  const double lowest = double(scale.lowest), highest = double(scale.highest);
  if (scale.diverging) {
    values.push_back(double(scale.centre));
  }
  if (!std::isfinite(lowest) || !std::isfinite(highest)) {
    return values;
  }
  if (scale.logarithmic) {
    const int last = int(std::floor(std::log10(highest)));
    for (int power = int(std::ceil(std::log10(lowest))); power <= last; ++power) {
      values.push_back(std::pow(10, power));
    }
    return values;
  }
  const double least = (highest - lowest) / mostSteps;
  if (!(least > 0)) {
    return values;
  }
  const double power = std::pow(10, std::floor(std::log10(least)));
  const double step = power * (least <= power ? 1 : least <= 2 * power ? 2 : least <= 5 * power ? 5 : 10);
  for (double k = std::ceil(lowest / step), end = k + 2 * mostSteps; k * step <= highest && k < end; ++k) {
    values.push_back(k * step);
  }
  return values;
}

QRect barIn(QRect line, int width) {
  const int height = std::max(barHeight, line.height() / 2);  // texts are large in the lecture mode
  return {line.left(), line.center().y() - height / 2, width, height};
}

}  // namespace

Legend::Legend() { fit(); }

/// Three lines of text: title, map, and numbers.
int Legend::wholeHeight() const { return topMargin + 3 * fontMetrics().height() + 6; }

void Legend::fit() {
  setFixedHeight(part_ == Part::title ? topMargin + fontMetrics().height() + 3 : wholeHeight());
  setVisible(wanted_ && part_ != Part::nothing);
}

void Legend::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::FontChange) {
    fit();
  }
}

void Legend::follow(const Colouring& colouring, int panel) {
  wanted_ = colouring.mode() != ColourMode::plain;
  shared_ = colouring.sharesScale();
  ofOverlay_ = false;
  const ColourModeInfo& mode = info(colouring.mode());
  QString help = text(mode.definition) + QLatin1Char('\n');
  help += shared_ ? QStringLiteral("One scale for all panels: a colour means the same value in each.")
                  : QStringLiteral("The scale of this panel only: other panels have their own.");
  if (colouring.scale(panel).threshold >= 0) {
    help += QStringLiteral("\nLinks outside the grey range are thicker, and over the others.");
  }
  help += QStringLiteral(
      "\nIn space, each corner of a face has the value of the one of its links that is furthest from rest.");
  setToolTip(help);
  set(colouring.title(panel), colouring.scale(panel));
  fit();
}

void Legend::show(const OverlayLegend& legend) {
  wanted_ = shared_ = ofOverlay_ = true;
  setToolTip(legend.toolTip);
  set(legend.title, legend.scale);
  fit();
}

void Legend::take(const Legend& other, const QString& title) {
  wanted_ = other.wanted_;
  shared_ = true;
  setToolTip(other.toolTip());
  set(title, other.scale_);
  fit();
}

void Legend::setPart(Part part) {
  part_ = part;
  fit();
}

bool Legend::sharesScaleWith(const Legend& other) const {
  return wanted_ && other.wanted_ && shared_ && other.shared_ && ofOverlay_ == other.ofOverlay_;
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
  QRect line(legendMargin, topMargin, width() - 2 * legendMargin, fontMetrics().height());
  const QString fitting =
      wholeParts(title(), [&](const QString& text) { return fontMetrics().horizontalAdvance(text) <= line.width(); });
  painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter,
                   fontMetrics().elidedText(fitting.isEmpty() ? title() : fitting, Qt::ElideRight, line.width()));
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
  const QString number = legendNumber(scale_.threshold);
  const QString bound = !scale_.diverging    ? QStringLiteral("up to %1").arg(number)
                        : scale_.centre == 0 ? QStringLiteral("within ±%1").arg(number)
                                             : QStringLiteral("%1 ± %2").arg(legendNumber(scale_.centre), number);
  drawText(painter, line, showsOne() ? bound + QStringLiteral(", everywhere") : bound);
  line.setLeft(line.left() + gap);
}

std::vector<Legend::Tick> Legend::ticks(int width) const {
  std::vector<Tick> ticks{{0, lowest()}, {1, highest()}};
  const auto extent = [&](const Tick& tick) {
    const double half = fontMetrics().horizontalAdvance(tick.number) / 2.0, at = tick.share * width;
    const double left = std::clamp(at - half, 0.0, std::max(0.0, width - 2 * half));
    return std::pair(left, left + 2 * half);
  };
  for (const double value : roundValues(scale_)) {
    const Tick tick{colour_map::shareOf(float(value), scale_), legendNumber(float(value))};
    const auto [left, right] = extent(tick);
    if (std::ranges::all_of(ticks, [&, left = left, right = right](const Tick& other) {
          return right + gap <= extent(other).first || extent(other).second + gap <= left;
        })) {
      ticks.push_back(tick);
    }
  }
  std::ranges::sort(ticks, {}, &Tick::share);
  return ticks;
}

/// Draws the map, and values below it. If even the numbers at its ends do not fit below it, the map is wider.
void Legend::drawMap(QPainter& painter, QRect line) const {
  const QFontMetrics metrics = fontMetrics();
  const int ends = metrics.horizontalAdvance(lowest()) + gap + metrics.horizontalAdvance(highest());
  const int width = std::clamp(line.width(), ends, std::max(ends, widestBar));
  const QRect map = barIn(line, width);
  QLinearGradient gradient(map.topLeft(), map.topRight());
  const auto& stops = colour_map::stopsOf(scale_);
  constexpr int steps = int(std::tuple_size_v<colour_map::Stops>) - 1;
  for (int i = 0; i <= steps; ++i) {
    const double share = double(i) / steps;
    gradient.setColorAt(share, colour_map::at(share, stops));
  }
  painter.fillRect(map, gradient);
  for (const Tick& tick : ticks(width)) {
    const int at = map.left() + int(std::lround(tick.share * (width - 1)));
    painter.drawLine(at, map.bottom() - tickLength, at, map.bottom() + tickLength);
    const int wide = metrics.horizontalAdvance(tick.number);
    const int left = std::clamp(at - wide / 2, map.left(), std::max(map.left(), map.right() - wide));
    painter.drawText(QRect(left, line.bottom(), wide + 1, metrics.height()), Qt::AlignLeft | Qt::AlignVCenter,
                     tick.number);
  }
}

}  // namespace chainmail
