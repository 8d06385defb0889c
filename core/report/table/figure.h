#pragma once

#include <span>
#include <string>
#include <string_view>

#include "measure/physical_error.h"
#include "measure/violation.h"

namespace chainmail::report {

/// How a figure is written for people.
enum class FigureFormat { number, count, percent, signed_percent, yes_no };
/// What stands for the figures of several drags.
enum class OverDrags { mean, worst };

/// A figure that reports show. It is described once: files, tables, plots and pages follow this.
struct Figure {
  std::string_view key;             // in JSON and CSV
  std::string_view group, heading;  // in tables: the heading of a group, and its own
  std::string_view unit;            // empty: none
  std::string_view definition;      // for readers; empty: the heading says it. See definition_of
  FigureFormat format = FigureFormat::number;
  OverDrags over_drags = OverDrags::mean;
  double quoted = 0;  // stands for {} in the definition
};

/// All figures, in the order of columns.
namespace figures {

inline constexpr std::string_view rest_lengths = "rest lengths", mean_lengths = "mean rest lengths", ratio = "ratio";
inline constexpr auto worst = OverDrags::worst;

// Times.
inline constexpr Figure ms_per_move{"ms_per_move", "time", "per move", "ms",
                                    "a pass and the relaxation that follows it, as a mean over the moves of a drag"};
inline constexpr Figure worst_move_ms{
    "worst_move_ms", "time", "slowest move", "ms", "each move counts with its median", FigureFormat::number, worst};
inline constexpr Figure first_ms{"first_ms", "time", "first move", "ms",
                                 "the first move of a drag, after all preparation"};
inline constexpr Figure later_ms{"later_ms", "time", "later move", "ms",
                                 "the mean of the moves after the first, without the one after a cut"};
inline constexpr Figure fresh_ms{"fresh_grab_ms", "time", "fresh grab", "ms", "a grab and its first move"};
inline constexpr Figure after_cut_ms{"after_cut_ms", "time", "after a cut", "ms",
                                     "the move after a cut in the middle of a drag, with all preparation that it "
                                     "repeats"};
inline constexpr Figure factorize_ms{"factorize_ms", "prepare", "factorize", "ms",
                                     "once for an object, its pins and its cuts"};
inline constexpr Figure grab_ms{"grab_ms", "prepare", "grab", "ms", "once for each handle"};
inline constexpr Figure prepare_ms{"prepare_ms", "prepare", "both", "ms", ""};
inline constexpr Figure iterations{"iterations",
                                   "effort",
                                   "iterations per move",
                                   "",
                                   "the least with which the answer is close to the contestant's own limit",
                                   FigureFormat::count,
                                   worst};
inline constexpr Figure checked{"checked_per_move", "effort", "checked per move", "elements", "the mean over moves"};
inline constexpr Figure moved{"moved_per_move", "effort", "moved per move", "elements",
                              "the mean over moves, without the handle"};
inline constexpr Figure bytes{
    "bytes", "effort", "memory", "bytes", "of the solver after its first drag, without the mesh", FigureFormat::count};

// Errors against physics.
inline constexpr Figure relative{"relative", "relative error", "as it is", ratio,
                                 "the RMS distance from the reference at the end of a drag, over the RMS displacement "
                                 "of the reference: an object that does not move has about 1"};
inline constexpr Figure relative_turned{"relative_turned", "relative error", "turned by 45°", ratio,
                                        "the error of the same drag on the object turned about the origin: equal for a "
                                        "method that does not depend on the axes"};
inline constexpr Figure reference_change{"reference_change", "relative error", "r of the reference", ratio,
                                         "the change of the reference by its last refinement: a smaller error says no "
                                         "more than that"};
inline constexpr Figure error_rms{"error_rms",
                                  "error over the handle's displacement",
                                  "RMS",
                                  ratio,
                                  "over all elements: small where most of the object moves little, also if nothing "
                                  "moves",
                                  FigureFormat::percent};
inline constexpr Figure error_max{
    "error_max", "error over the handle's displacement", "largest", ratio, "", FigureFormat::percent, worst};
inline constexpr Figure moving_rms{"moving_rms",
                                   "error over the handle's displacement",
                                   "RMS, what moves",
                                   ratio,
                                   "over the elements that the reference displaces by more than {} of the handle's "
                                   "displacement",
                                   FigureFormat::percent,
                                   OverDrags::mean,
                                   counts_as_moving};
inline constexpr Figure moving_max{
    "moving_max", "error over the handle's displacement", "largest, what moves", ratio, "", FigureFormat::percent,
    worst};
inline constexpr Figure moving_elements{
    "moving_elements", "error over the handle's displacement", "what moves", "elements", "", FigureFormat::count};

// Violations, and distances from other answers.
inline constexpr Figure violation_max{
    "violation_max",      "violation", "largest", rest_lengths, "the distance of a link from its valid region",
    FigureFormat::number, worst};
inline constexpr Figure violation_rms{"violation_rms",      "violation", "RMS", rest_lengths, "",
                                      FigureFormat::number, worst};
inline constexpr Figure violation_fraction{
    "violation_fraction",  "violation", "links",           "share", "the share of links with a violation above {}",
    FigureFormat::percent, worst,       counts_as_violated};
inline constexpr Figure exact_distance_max{"exact_distance_max",
                                           "distance to Exact",
                                           "largest",
                                           mean_lengths,
                                           "from the positions of Exact ChainMail in double, on the same moves without "
                                           "relaxation. Relaxation moves elements away from Exact: then the violation "
                                           "shows the quality",
                                           FigureFormat::number,
                                           worst};
inline constexpr Figure exact_distance_rms{
    "exact_distance_rms", "distance to Exact", "RMS", mean_lengths, "", FigureFormat::number, worst};
inline constexpr Figure energy_over_exact{"energy_over_exact", "energy", "over Exact's", ratio, ""};
inline constexpr Figure equilibrium_distance_max{
    "equilibrium_distance_max",        "distance to the equilibrium", "largest", mean_lengths,
    "from the end of full relaxation", FigureFormat::number,          worst};
inline constexpr Figure equilibrium_distance_rms{
    "equilibrium_distance_rms", "distance to the equilibrium", "RMS", mean_lengths, "", FigureFormat::number, worst};
inline constexpr Figure float_double_max{"float_double_max",
                                         "float to double",
                                         "largest",
                                         mean_lengths,
                                         "between the contestant in both precisions",
                                         FigureFormat::number,
                                         worst};
inline constexpr Figure float_double_rms{
    "float_double_rms", "float to double", "RMS", mean_lengths, "", FigureFormat::number, worst};
inline constexpr Figure largest_over_handle{"largest_over_handle",
                                            "farthest",
                                            "over the handle's",
                                            ratio,
                                            "the largest displacement: above 1, an element moved further than the "
                                            "handle",
                                            FigureFormat::number,
                                            worst};

// Shape.
inline constexpr Figure hausdorff{"hausdorff",
                                  "shape",
                                  "Hausdorff distance",
                                  mean_lengths,
                                  "the largest distance from a point of one surface to the nearest point of the other, "
                                  "between the answer and the reference",
                                  FigureFormat::number,
                                  worst};
inline constexpr Figure volume_change{"volume_change",
                                      "shape",
                                      "volume change",
                                      ratio,
                                      "of the cells, or of what the faces enclose; in a plane of the area",
                                      FigureFormat::signed_percent,
                                      worst};
inline constexpr Figure inverted_cells{"inverted_cells",    "shape", "inverted", "cells", "turned inside out",
                                       FigureFormat::count, worst};
inline constexpr Figure stretch{"largest_stretch",
                                "shape",
                                "largest stretch",
                                ratio,
                                "the largest factor by which any direction in a cell is lengthened",
                                FigureFormat::number,
                                worst};
inline constexpr Figure residual{"residual", "equilibrium", "residual", ratio, "", FigureFormat::number, worst};
inline constexpr Figure binds{"regions_bind",
                              "equilibrium",
                              "regions bind",
                              "",
                              "no: ChainMail's valid regions had no part in the answer, it is that of the energy",
                              FigureFormat::yes_no,
                              worst};

// Objects that are turned.
inline constexpr Figure turned_45_max{"turned_45_max", "turned by 45°", "largest difference", mean_lengths,
                                      "of the answer on the turned object, turned back"};
inline constexpr Figure turned_45_relative{"turned_45_relative", "turned by 45°", "relative", ratio,
                                           "RMS of the difference over RMS of the displacements"};
inline constexpr Figure turned_90_max{"turned_90_max", "turned by 90°", "largest difference", mean_lengths, ""};
inline constexpr Figure turned_90_relative{"turned_90_relative", "turned by 90°", "relative", ratio, ""};

// Ramps.
inline constexpr Figure passes{"passes", "passes", "measured", "", "", FigureFormat::count};
inline constexpr Figure median_ms{"median_ms", "passes", "median", "ms", ""};
inline constexpr Figure p99_ms{"p99_ms", "passes", "99th percentile", "ms", ""};
inline constexpr Figure mean_moved{"mean_moved", "passes", "moved", "elements", "the mean over passes"};
inline constexpr Figure repeated{"repeated",
                                 "passes",
                                 "repeated",
                                 "",
                                 "the first attempt exceeded the budget, and these are the figures of the second one",
                                 FigureFormat::yes_no};
inline constexpr Figure real_time{"real_time", "passes", "in real time", "", "", FigureFormat::yes_no};

}  // namespace figures

/// All figures, in the order of columns.
std::span<const Figure* const> every_figure();
/// Returns null if there is no figure with this key.
const Figure* find_figure(std::string_view key);
/// Returns the definition of a figure with the number that it quotes.
std::string definition_of(const Figure& figure);
/// Returns the unit of a figure behind a heading: ` (ms)`; empty for what cells write with their unit.
std::string in_brackets(const Figure& figure);
/// Returns the heading of a figure's group with its unit: `time (ms)`.
std::string group_with_unit(const Figure& figure);

}  // namespace chainmail::report
