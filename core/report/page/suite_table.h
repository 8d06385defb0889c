#pragma once

#include <array>
#include <optional>
#include <ostream>
#include <string_view>
#include <vector>

#include "report/page/figure_table.h"
#include "report/run/peer.h"
#include "report/run/suite.h"

namespace chainmail::report {

/// The mean figures of a contestant over the drags of an experiment that are not cut. Turned copies exist for some of
/// the drags only, so their mean has its own number of drags.
struct SuiteMean {
  std::string contestant, algorithm, refusal;  // a refusal of one of the drags
  int drags = 0;                               // number of drags with figures
  int of = 0;                                  // number of drags
  std::optional<double> relative, relative_turned, later_ms, after_cut_ms;
  std::optional<double> fresh_ms;               // a grab and its first move
  std::optional<double> relative_of_fresh;      // error of a fresh grab; that of the drags, where no move is alone
  std::optional<double> relative_of_cut;        // error of the drags that are cut
  std::optional<double> change, change_of_cut;  // of their references by the last refinement
};
std::vector<SuiteMean> means_of(const SuiteResult& result);
/// The points of a contestant's curve of error over time: each as a contestant of its own, with its number of
/// iterations in its name.
std::vector<SuiteMean> points_of(const SuiteResult& result, const SuiteTime& time);
/// The means and the points of an experiment.
std::vector<SuiteMean> compared_in(const SuiteResult& result);
/// Returns true if a contestant has figures of all drags, and is neither an object that does not move nor neo-Hookean
/// FEM, which most references converge from.
bool may_win(const SuiteMean& mean);

/// The summary: the mean relative error of each contestant in each experiment with drags. The best error of each column
/// has a star.
FigureTable suite_summary(const Suite& suite);
/// The shortest times with which a contestant has at most each error, of one experiment.
FigureTable time_table(const SuiteResult& result);
/// The errors on finer and finer meshes, with the observed order.
FigureTable order_table(const SuiteResult& result);
/// All figures of one experiment with drags.
FigureTable suite_table(const SuiteResult& result);

/// The head of the table of other solvers' answers to a case, and the figures of an answer.
FigureTable peer_table(const PeerCase& object);
FigureTable::Row peer_row(const PeerCase& object, const PeerAnswer& answer);
/// Returns sentences that say who is closest in each experiment, and who is on the fronts of speed against error.
std::vector<std::string> suite_findings(const Suite& suite);

/// Writes findings, the summary, times and orders as text.
void write_text(std::ostream& out, const Suite& suite);

/// A time and an error of contestants, which belong together.
struct SpeedAgainstError {
  std::string_view what, file;  // for readers, and of the plot without its ending
  std::optional<double> SuiteMean::*ms, SuiteMean::*error, SuiteMean::*change;
};
/// All, in the order of reports. A later move contains no preparation; a fresh grab and a move after a cut contain all
/// of theirs.
inline constexpr std::array speeds_against_error{
    SpeedAgainstError{"later move", "overview", &SuiteMean::later_ms, &SuiteMean::relative, &SuiteMean::change},
    SpeedAgainstError{"fresh grab", "fresh-grab", &SuiteMean::fresh_ms, &SuiteMean::relative_of_fresh,
                      &SuiteMean::change},
    SpeedAgainstError{"move after a cut", "after-cut", &SuiteMean::after_cut_ms, &SuiteMean::relative_of_cut,
                      &SuiteMean::change_of_cut},
};

/// Returns the error that counts: not less than the change of the reference.
double counted_error(const SuiteMean& mean, const SpeedAgainstError& measure);

/// Returns the contestants that no other one beats: none is at least as fast and as close, and better in one of both
/// (Pareto's rule). From the fastest to the closest. Only those that may win take part. Errors below the change of the
/// reference are as close as each other.
std::vector<const SuiteMean*> front(const std::vector<SuiteMean>& means, const SpeedAgainstError& measure);

}  // namespace chainmail::report
