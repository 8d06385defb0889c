#pragma once

#include <string>
#include <vector>

#include "report/page/figure_table.h"
#include "report/table/growth.h"
#include "report/table/results.h"

namespace chainmail::report {

/// Where a table is shown: a terminal has no room for all figures and their spreads.
enum class Medium { page, terminal };

/// Describes an object: its size, its reference, its drags, and notes.
std::string about(const Results& results, std::size_t object);
/// Returns a figure as text: `0.12`, `below 0.01`, `+3%`; `-` if there is none.
std::string cell_of(const Figure& figure, const Row& row);

/// The figures that a reader needs first, in their order: those of the main table in a terminal.
std::vector<const Figure*> first_figures(ReportKind kind);

/// The relative error of each contestant on each object. The closest has a star.
FigureTable summary_table(const Results& results);
/// The main figures of the contestants on one object, as means or worst over its drags.
FigureTable object_table(const Results& results, std::size_t object, Medium medium);
/// All figures of one object, drag by drag.
FigureTable detail_table(const Results& results, std::size_t object);
/// The shortest times with which a contestant has at most each error, of an object with curves.
FigureTable time_table(const Results& results, std::size_t object);
/// The errors on finer and finer meshes, with the observed order.
FigureTable order_table(const Results& results, const std::string& series);
/// The largest object of each contestant, and the growth of its time.
FigureTable growth_table(const Results& results, const std::string& series);
/// By how much answers differ on turned objects.
FigureTable turned_table(const Results& results);

/// What became of an algorithm in a ramp.
struct RampVerdict {
  Algorithm algorithm;
  std::optional<std::size_t> largest = {};  // object: the largest grid in real time
  bool lost = false;                        // true: the next size was too slow; false: there was no next size
  std::optional<Growth> growth = {};        // of the median
};
std::vector<RampVerdict> ramp_verdicts(const Results& results);
/// The largest grid in real time of each algorithm, and all sizes.
FigureTable ramp_table(const Results& results);
FigureTable ramp_sizes(const Results& results);

}  // namespace chainmail::report
