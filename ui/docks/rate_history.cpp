#include "docks/rate_history.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/text.h"
#include "report/table/format.h"

namespace chainmail {
namespace {

constexpr std::array quantities{
    RateQuantity{"passes", "Passes per second", "1/s", "1 over the median time of the passes of the last second",
                 [](const RateSample& one) { return one.passesPerSecond(); }},
    RateQuantity{"ms", "Time of a pass", "ms", "Time of each pass in the solver, without drawing",
                 [](const RateSample& one) { return one.ms; }},
    RateQuantity{"painted", "Painted frames per second", "1/s", "Frames that reached the screen in the last second",
                 [](const RateSample& one) { return one.painted; }},
    RateQuantity{"violation-max", "Violation, max", "rest lengths",
                 "Distance of the worst link of the object from its valid region",
                 [](const RateSample& one) { return one.violationMax; }},
    RateQuantity{"violation-rms", "Violation, RMS", "rest lengths", "Root mean square over the links of the object",
                 [](const RateSample& one) { return one.violationRms; }},
    RateQuantity{
        "lag", "Lag behind the equilibrium", "relative",
        "Estimated distance from the equilibrium while relaxation goes there, in the norm of the energy, relative "
        "to its root",
        [](const RateSample& one) { return one.lag; }}};

// A longer gap (s) between samples ends a line. The time of the next pass does not count.
constexpr double longestGap = 1;

/// The lowest and the highest point of a time interval.
class RatePiece {
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

/// Makes lines through all points (length 0), or through the extremes of intervals of a length (s).
class RateLines {
 public:
  explicit RateLines(double length) : length_(length) {}

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
  RatePiece piece_;
  std::vector<QPolygonF> lines_{1};
};

std::string digits(double number) { return std::isnan(number) ? std::string() : report::all_digits(number); }

void writeRow(std::ostream& out, std::size_t panel, const RateSample& one) {
  out << digits(one.time) << ',' << panelName(int(panel)).toStdString() << ',' << info(one.algorithm).name << ','
      << digits(one.painted) << ',' << digits(one.passesPerSecond()) << ',' << digits(one.ms) << ','
      << digits(one.medianMs) << ',' << digits(one.worstMs) << ',' << digits(one.violationMax) << ','
      << digits(one.violationRms) << ','
      << (std::isnan(one.violationMax) ? ""
          : one.ofWholeMesh            ? "all"
                                       : "part")
      << ',' << digits(one.lag) << '\n';
}

}  // namespace

std::span<const RateQuantity> rateQuantities() { return quantities; }

void RateHistory::add(const RateSample& sample) {
  const auto old = [&](const RateSample& one) { return one.time < sample.time - kept; };
  // Removes many samples at once, so that each sample is moved about once.
  if (samples_.size() > 1 && old(samples_[samples_.size() / 2])) {
    samples_.erase(samples_.begin(), std::ranges::partition_point(samples_, old));
  }
  samples_.push_back(sample);
}

std::span<const RateSample> RateHistory::since(double time) const {
  auto from = std::ranges::lower_bound(samples_, time, {}, &RateSample::time);
  if (from != samples_.begin()) {
    --from;
  }
  return {from, samples_.end()};
}

std::vector<QPolygonF> curveOf(std::span<const RateSample> samples, const RateQuantity& quantity, double from,
                               double to, std::size_t points) {
  // An interval gives at most two points, and one more interval begins before the first complete one.
  const std::size_t pairs = points / 2;
  const double pieces = std::max(1.0, double(pairs) - 1);
  const double length = samples.size() > points ? (to - from) / pieces : 0;
  const double gap = std::max(longestGap, length);  // so that no interval is part of two lines
  RateLines lines(length);
  std::optional<double> last;
  for (const RateSample& sample : samples) {
    const double value = quantity.of(sample);
    if (std::isnan(value) || sample.time > to) {
      continue;
    }
    const double pass = std::isnan(sample.ms) ? 0 : sample.ms / 1000;
    if (last && sample.time - *last > gap + pass) {
      lines.breakOff();
    }
    last = sample.time;
    lines.add({sample.time, value});
  }
  return lines.take();
}

void writeCsv(std::ostream& out, std::span<const RateHistory> panels) {
  out << "time_s,panel,algorithm,painted_per_s,passes_per_s,pass_ms,pass_median_ms,pass_worst_ms,violation_max,"
         "violation_rms,violation_of,lag\n";
  std::vector<std::size_t> next(panels.size(), 0);
  for (;;) {
    std::size_t first = panels.size();
    for (std::size_t panel = 0; panel < panels.size(); ++panel) {
      const auto& samples = panels[panel].samples();
      if (next[panel] < samples.size() &&
          (first == panels.size() || samples[next[panel]].time < panels[first].samples()[next[first]].time)) {
        first = panel;
      }
    }
    if (first == panels.size()) {
      return;
    }
    writeRow(out, first, panels[first].samples()[next[first]++]);
  }
}

}  // namespace chainmail
