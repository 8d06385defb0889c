#include "docks/frame_rate/rate_curve.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace chainmail {
namespace {

// Figures further apart (s, beside the pass that lies between) are of two stretches.
constexpr double stretchEnds = 1;

/// The lowest and the highest of a piece of time, as they came.
class Piece {
 public:
  bool holds(std::int64_t number) const { return number_ == number; }
  void begin(std::int64_t number, QPointF point) {
    number_ = number;
    lowest_ = highest_ = point;
  }
  void add(QPointF point) {
    lowest_ = point.y() < lowest_.y() ? point : lowest_;
    highest_ = point.y() > highest_.y() ? point : highest_;
  }
  void appendTo(QPolygonF& line) const {
    const bool rises = lowest_.x() <= highest_.x();
    line << (rises ? lowest_ : highest_);
    if (lowest_ != highest_) {
      line << (rises ? highest_ : lowest_);
    }
  }

 private:
  std::int64_t number_ = 0;
  QPointF lowest_, highest_;
};

/// Draws a line through points, or through the extremes of pieces of time of some length (s; 0: through all).
class Line {
 public:
  explicit Line(double length) : length_(length) {}

  void add(QPointF point) {
    if (length_ == 0) {
      lines_.back() << point;
      return;
    }
    const auto number = std::int64_t(std::floor(point.x() / length_));
    if (open_ && piece_.holds(number)) {
      piece_.add(point);
      return;
    }
    close();
    piece_.begin(number, point);
    open_ = true;
  }

  void breakOff() {
    close();
    if (!lines_.back().empty()) {
      lines_.emplace_back();
    }
  }

  std::vector<QPolygonF> take() {
    close();
    if (lines_.back().empty()) {
      lines_.pop_back();
    }
    return std::move(lines_);
  }

 private:
  void close() {
    if (open_) {
      piece_.appendTo(lines_.back());
      open_ = false;
    }
  }

  double length_;
  bool open_ = false;
  Piece piece_;
  std::vector<QPolygonF> lines_{1};
};

}  // namespace

std::vector<QPolygonF> curveOf(std::span<const RateSample> samples, const RateQuantity& quantity, double from,
                               double to, std::size_t points) {
  // A piece gives two points at most, and one more begins before the first whole one.
  const double pieces = std::max(1.0, double(points / 2) - 1);
  const double length = samples.size() > points ? (to - from) / pieces : 0;
  const double gap = std::max(stretchEnds, length);  // no piece has two stretches
  Line line(length);
  std::optional<double> last;
  for (const RateSample& sample : samples) {
    const double value = quantity.of(sample);
    if (std::isnan(value) || sample.time > to) {
      continue;
    }
    const double pass = std::isnan(sample.ms) ? 0 : sample.ms / 1000;
    if (last && sample.time - *last > gap + pass) {
      line.breakOff();
    }
    last = sample.time;
    line.add({sample.time, value});
  }
  return line.take();
}

}  // namespace chainmail
