#pragma once

#include <QPointF>
#include <QPolygonF>
#include <limits>
#include <ostream>
#include <span>
#include <string_view>
#include <vector>

#include "simulate/simulation.h"

namespace chainmail {

/// What was read of a panel at a moment. What there was no figure for is not a number.
struct RateSample {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  double time = 0;                                  // s since the window began
  double painted = none;                            // frames of the view that reached the screen in the second before
  double ms = none;                                 // of the last pass, where there was one since the last sample
  double medianMs = none, worstMs = none;           // of the passes of the second before
  double violationMax = none, violationRms = none;  // rest lengths
  bool ofWholeMesh = false;                         // the violation; else of the links that the last pass touched
  Algorithm algorithm = Algorithm::natural_queue;

  /// What the algorithm alone could do: 1 over the median time of a pass.
  double passesPerSecond() const { return medianMs > 0 ? 1000 / medianMs : none; }
};

/// What can be plotted over time.
struct RateQuantity {
  std::string_view name, label, unit, help;
  double (*of)(const RateSample& sample);
};
std::span<const RateQuantity> rateQuantities();

/// What a panel did over the last minutes, in the order of time.
class RateHistory {
 public:
  /// What is older goes (s).
  static constexpr double kept = 600;

  void add(const RateSample& sample);
  void clear() { samples_.clear(); }
  const std::vector<RateSample>& samples() const { return samples_; }
  /// Those from a moment on, and the last one before it, where a line comes from.
  std::span<const RateSample> since(double time) const;

 private:
  std::vector<RateSample> samples_;
};

/// Returns the lines of a quantity over time (s, unit of the quantity), one for each period in which something
/// happened.
///
/// Where there are more samples than `points` (at least 2), only the lowest and the highest of each piece of time stay,
/// so that no spike is lost. The pieces are the same from call to call while `from` to `to` is as long.
std::vector<QPolygonF> curveOf(std::span<const RateSample> samples, const RateQuantity& quantity, double from,
                               double to, std::size_t points);

/// The samples of all panels by time, with all digits; empty where there is no figure.
void writeCsv(std::ostream& out, std::span<const RateHistory> panels);

}  // namespace chainmail
