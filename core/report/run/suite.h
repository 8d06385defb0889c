#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "report/run/machine.h"
#include "report/run/physics.h"
#include "report/run/suite_experiments.h"

namespace chainmail::report {

/// Figures of a contestant in one drag, or the reason why there are none. A figure that is not defined is none.
struct SuiteRow {
  std::string drag;
  std::uint64_t handle = 0;           // an element of the handle
  bool has_cut = false;               // a cut precedes the last move
  std::string contestant, algorithm;  // label for readers; name in files
  std::string refusal;                // empty if there are figures
  std::optional<double> relative = {}, relative_turned = {};
  std::optional<double> reference_change = {};  // by the last refinement: errors below it say no more than that
  std::optional<double> hausdorff = {}, volume_change = {}, inverted_cells = {}, stretch = {}, violation = {};
  std::optional<double> factorize_ms = {}, grab_ms = {}, first_ms = {}, later_ms = {}, after_cut_ms = {};
  std::optional<double> bytes = {};
  std::optional<double> iterations = {};            // per move: the least to its own limit
  std::optional<double> residual = {}, binds = {};  // binds: 1 if valid regions change the equilibrium, 0 if not
};

/// One figure of a row: its key in files, and its heading in tables.
struct SuiteFigure {
  std::string_view key, group, heading;
  std::optional<double> SuiteRow::*value;
};
/// All figures of a row. Files, pages and the reader follow this table.
inline constexpr std::array suite_figures{
    SuiteFigure{"relative", "relative error (ratio)", "as it is", &SuiteRow::relative},
    SuiteFigure{"relative_turned", "relative error (ratio)", "turned by 45°", &SuiteRow::relative_turned},
    SuiteFigure{"reference_change", "relative error (ratio)", "r of the reference", &SuiteRow::reference_change},
    SuiteFigure{"factorize_ms", "prepare (ms)", "factorize", &SuiteRow::factorize_ms},
    SuiteFigure{"grab_ms", "prepare (ms)", "grab", &SuiteRow::grab_ms},
    SuiteFigure{"first_ms", "move (ms)", "first", &SuiteRow::first_ms},
    SuiteFigure{"later_ms", "move (ms)", "later", &SuiteRow::later_ms},
    SuiteFigure{"after_cut_ms", "move (ms)", "after cut", &SuiteRow::after_cut_ms},
    SuiteFigure{"bytes", "memory", "bytes", &SuiteRow::bytes},
    SuiteFigure{"iterations", "own limit", "iterations per move", &SuiteRow::iterations},
    SuiteFigure{"residual", "equilibrium", "residual (ratio)", &SuiteRow::residual},
    SuiteFigure{"binds", "equilibrium", "regions bind", &SuiteRow::binds},
    SuiteFigure{"hausdorff", "shape", "Hausdorff (rest lengths)", &SuiteRow::hausdorff},
    SuiteFigure{"volume_change", "shape", "volume change (ratio)", &SuiteRow::volume_change},
    SuiteFigure{"inverted_cells", "shape", "inverted cells", &SuiteRow::inverted_cells},
    SuiteFigure{"stretch", "shape", "stretch (ratio)", &SuiteRow::stretch},
    SuiteFigure{"violation", "shape", "violation (rest lengths)", &SuiteRow::violation},
};

/// Relative errors of a contestant on finer and finer meshes of one problem.
struct SuiteOrder {
  struct Size {
    std::uint64_t elements = 0;
    double relative = 0;
  };
  std::string contestant, algorithm, refusal;
  std::vector<Size> sizes;
  std::optional<double> order;  // observed: by the last two meshes, of which the finer one has half the mesh width
};

/// Times and errors of a contestant with one number of iterations or sweeps per move. What was not measured is none.
struct SuitePoint {
  std::uint64_t iterations = 0;                        // or sweeps, per move; 0: the contestant has no such number
  std::optional<double> relative = {}, later_ms = {};  // of a drag of many moves
  std::optional<double> fresh_relative = {}, fresh_ms = {};    // of one move from rest to the same end, with the grab
  std::optional<double> cut_relative = {}, after_cut_ms = {};  // of a drag with a cut
};

/// An error of a point and the time that belongs to it: keys in files, names of readers.
struct SuitePointFigures {
  std::string_view error_key, ms_key, heading, drag;
  std::optional<double> SuitePoint::*error, SuitePoint::*ms;
};
/// All, in the order of the drags of an experiment that measures times to an error; the last drag is not in all of
/// them.
inline constexpr std::array suite_point_figures{
    SuitePointFigures{"relative", "ms_per_move", "ms per later move, at most", "bend", &SuitePoint::relative,
                      &SuitePoint::later_ms},
    SuitePointFigures{"fresh_relative", "fresh_grab_ms", "ms from a fresh grab, at most", "fresh grab",
                      &SuitePoint::fresh_relative, &SuitePoint::fresh_ms},
    SuitePointFigures{"cut_relative", "after_cut_ms", "ms after a cut, at most", "cut", &SuitePoint::cut_relative,
                      &SuitePoint::after_cut_ms},
};

/// A contestant with all numbers of iterations or sweeps per move that it may use, in rising order: a curve of error
/// over time.
struct SuiteTime {
  std::string contestant, algorithm, refusal;
  std::optional<double> factorize_ms;
  std::vector<SuitePoint> curve;
};

/// Relative errors for which the suite says when a contestant has at most this error.
inline constexpr std::array suite_errors{0.5, 0.3, 0.2, 0.1};
/// Returns the shortest time of a point with at most this error, or none.
std::optional<double> shortest_ms(const SuiteTime& time, const SuitePointFigures& of, double error);
/// Returns the least error of all points, or none.
std::optional<double> least_error(const SuiteTime& time);

/// The result of one experiment.
struct SuiteResult {
  std::string name, description;
  std::string reference;                // what the errors are measured against
  std::vector<Convergence> references;  // of the drags whose reference is on refined cells, in their order
  std::uint64_t elements = 0, links = 0, pins = 0;
  double seconds = 0;  // duration of the experiment
  std::vector<std::string> notes;
  std::vector<SuiteRow> rows;
  std::vector<SuiteOrder> orders;
  std::vector<SuiteTime> times;
};

/// A run of the suite, or of a part of it, on one machine.
struct SuiteRun {
  Origin origin;
  std::string shard;  // such as 1/4
  std::vector<std::string> experiments;
};

struct Suite {
  std::vector<SuiteRun> runs;
  std::vector<SuiteResult> results;  // in the order of the experiments
  bool stopped = false;              // true: contains only the finished experiments
};

struct SuiteOptions {
  std::vector<Algorithm> algorithms;  // empty: all
  std::optional<int> repetitions;     // of each drag; none: as many as fit
  double seconds = 1;                 // for the repetitions of one drag with all contestants
  Calibrator calibrate;               // empty: no contestant is calibrated
  SampleOrgans organs;
};

/// A part of the suite: number `index` of `count`, from 1. Together, the parts have every experiment once.
struct Shard {
  int index = 1, count = 1;
};

/// Runs experiments of the suite by their names, in turns on the calling thread. Throws Error for a name that does not
/// exist.
Suite run_suite(const std::vector<std::string>& names, const SuiteOptions& options, const Progress& progress = {});

/// Returns the names of all experiments, in their order.
std::vector<std::string> all_suite_names();
/// Returns the names of those that run if none is named.
std::vector<std::string> suite_names();
/// Returns every count-th of the names, from the index-th on. Long and short experiments follow each other, so that all
/// parts take about as long.
std::vector<std::string> part_of(const std::vector<std::string>& names, const Shard& shard);

/// Joins the results of several runs. Throws Error if an experiment occurs twice.
Suite merged(const std::vector<Suite>& parts);
/// Returns the names of the experiments that a suite lacks, without those that take part only where they are named.
std::vector<std::string> missing_from(const Suite& suite);

}  // namespace chainmail::report
