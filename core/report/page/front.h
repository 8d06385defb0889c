#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "report/page/suite_table.h"

namespace chainmail::report {

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
