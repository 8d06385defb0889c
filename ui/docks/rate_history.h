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

/// The figures of a panel at one time. A missing figure is NaN.
struct RateSample {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  double time = 0;                                  // s since the window was opened
  double painted = none;                            // frames that reached the screen in the last second
  double ms = none;                                 // of the last pass, if there was one since the last sample
  double medianMs = none, worstMs = none;           // of the passes of the last second
  double violationMax = none, violationRms = none;  // rest lengths
  double lag = none;                                // residual of relaxation to the equilibrium: see Statistics
  bool ofWholeMesh = false;                         // false if some of the links were not measured yet
  Algorithm algorithm = Algorithm::natural_queue;

  /// Returns the rate of the algorithm without drawing: 1 over the median time of a pass.
  double passesPerSecond() const { return medianMs > 0 ? 1000 / medianMs : none; }
};

/// A quantity that can be plotted over time.
struct RateQuantity {
  std::string_view name, label, unit, help;
  double (*of)(const RateSample& sample);
};
std::span<const RateQuantity> rateQuantities();

/// The samples of a panel over the last minutes, in order of time.
class RateHistory {
 public:
  /// Age at which samples are dropped (s).
  static constexpr double kept = 600;

  void add(const RateSample& sample);
  void clear() { samples_.clear(); }
  const std::vector<RateSample>& samples() const { return samples_; }
  /// Returns the samples from `time` (s) on, and the one before them, where the plotted line begins.
  std::span<const RateSample> since(double time) const;

 private:
  std::vector<RateSample> samples_;
};

/// Returns the lines of a quantity over time (s, unit of the quantity), one line for each period of activity.
///
/// If there are more than `points` samples (at least 2), only the lowest and the highest sample of each time interval
/// stay, so that no spike is lost. The intervals are the same from call to call while the difference of `to` and `from`
/// is the same.
std::vector<QPolygonF> curveOf(std::span<const RateSample> samples, const RateQuantity& quantity, double from,
                               double to, std::size_t points);

/// Writes the samples of all panels as CSV, sorted by time, with all digits. A missing figure is an empty field.
void writeCsv(std::ostream& out, std::span<const RateHistory> panels);

}  // namespace chainmail
