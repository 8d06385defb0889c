#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report/table/growth.h"
#include "report/table/results.h"

namespace chainmail::report {

/// Which drags of an object count.
enum class Drags { all, uncut, cut };

/// The rows of one contestant as one row.
struct Joined {
  Row row;        // without a drag; the first refusal, if there is one
  int drags = 0;  // number of drags with figures
  int of = 0;     // number of drags

  bool is_complete() const { return drags == of && of > 0; }
};
/// Joins rows of one contestant: each figure is the mean, or the worst, as it says, and spreads are means. A figure
/// that some rows lack is that of the others.
Joined joined(std::span<const Row* const> rows);

/// Returns the rows of an object that `wanted` accepts.
std::vector<const Row*> rows_of(const Results& results, std::size_t object,
                                const std::function<bool(const Row&)>& wanted = {});
/// Returns the contestants of an object, in the order of its rows.
std::vector<Contestant> contestants_in(const Results& results, std::size_t object);
/// Returns the figures of a contestant over some drags of an object. `name` keeps only the drags with this name.
Joined joined(const Results& results, std::size_t object, const Contestant& contestant, Drags which,
              const std::string& name = {});
/// Returns the figures that rows of an object have, in the order of columns.
std::vector<const Figure*> figures_in(const Results& results, std::optional<std::size_t> object = {});

/// A time and the error that belongs to it.
struct SpeedAgainstError {
  std::string_view what, file;  // for readers, and of the plot without its ending
  const Figure* ms;
  bool (*counts)(const DragInfo& drag, bool has_single_moves);
};
/// All, in the order of reports. A later move contains no preparation; a fresh grab and a move after a cut contain all
/// of theirs. Where a drag of one move exists, a fresh grab is that one.
std::span<const SpeedAgainstError> speeds_against_error();

/// A contestant with its mean time and error over the drags that count.
struct Standing {
  Contestant contestant;
  double error = 0;                   // relative
  std::optional<double> change = {};  // of the references by the last refinement
  std::optional<TimeSpread> ms = {};
  bool is_complete = false;  // has figures of all drags

  /// The error that counts: not less than the change of the reference.
  double counted_error() const { return std::max(error, change.value_or(0)); }
  /// True if it has figures of all drags, and is neither an object that does not move nor neo-Hookean FEM, which most
  /// references converge from.
  bool may_win() const;
};
/// `drag` keeps only the drags with this name.
std::vector<Standing> standings(const Results& results, std::size_t object, const SpeedAgainstError& speed,
                                const std::string& drag = {});
/// Returns the contestants that no other one beats: none is at least as fast and as close, and better in one of both
/// (Pareto's rule). From the fastest to the closest. Only those that may win take part. Errors below the change of the
/// reference are as close as each other.
std::vector<const Standing*> front(const std::vector<Standing>& all);
/// Returns the contestants with the least error: several, if the change of the reference is not less than theirs.
std::vector<const Standing*> closest(const std::vector<Standing>& all);

/// True if contestants of an object differ in their iterations, so that they are points of curves of error over time.
bool has_curves(const Results& results, std::size_t object);
/// Relative errors for which reports say when a contestant has at most this error.
inline constexpr std::array errors_reached{0.5, 0.3, 0.2, 0.1};
/// Returns the shortest time (ms) with which a point of a curve has at most this error, or none.
std::optional<double> shortest_ms(const std::vector<Standing>& all, const Contestant& curve, double error);
/// Returns the least error of a curve, or none.
std::optional<double> least_error(const std::vector<Standing>& all, const Contestant& curve);

/// Returns the names of the series, in the order of objects.
std::vector<std::string> series_in(const Results& results);
/// A contestant over the objects of a series.
struct SeriesPoint {
  std::size_t object;
  Joined figures;
};
std::vector<SeriesPoint> points_of(const Results& results, const std::string& series, const Contestant& contestant);
/// Returns the contestants of a series, in the order of its rows.
std::vector<Contestant> contestants_in(const Results& results, const std::string& series);
/// Returns the growth of a time over the objects of a series.
std::optional<Growth> growth_of(const std::vector<SeriesPoint>& points, const Results& results, const Figure& ms);
/// Returns the observed order of convergence of the relative error.
std::optional<double> order_of(const std::vector<SeriesPoint>& points);

/// Returns sentences that say who is closest on each object, and who is on the fronts of speed against error.
std::vector<std::string> findings(const Results& results);

}  // namespace chainmail::report
