#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "chainmail/body.h"
#include "chainmail/job.h"
#include "chainmail/types.h"

namespace chainmail::api {

/// Options of a ramp.
struct RampOptions {
  std::vector<std::string> methods = {};              ///< Names of methods of the ChainMail family. Empty: all of them.
  std::uint64_t seed = 1;                             ///< Random seed of the drags.
  double budget = 1.0 / 60;                           ///< Time limit of a pass (s), above 0.
  std::uint64_t largest = 1'000'000;                  ///< Largest number of elements of a grid: 16 to 20 million.
  int drags = 10;                                     ///< Number of drags at each size, at least 1.
  int moves = 30;                                     ///< Number of moves of each drag, at least 1.
  Precision precision = Precision::single_precision;  ///< Precision of the methods.
  LinkSoftness softness = {};                         ///< Softness of all links.
};

/// The figures of one method on one grid.
struct RampSize {
  std::uint32_t width = 0;     ///< Number of elements along each side of the square grid.
  std::uint64_t elements = 0;  ///< Number of elements.
  std::uint64_t links = 0;     ///< Number of links.
  std::string method = {};     ///< Name of the method.
  int passes = 0;              ///< Number of passes.
  double median_ms = 0;        ///< Median time of a pass (ms).
  double p99_ms = 0;           ///< 99th percentile of the times (ms).
  double mean_moved = 0;       ///< Mean number of elements that a pass moved.
  bool repeated = false;       ///< True: the first attempt exceeded the budget, and these are figures of the second.
  bool real_time = false;      ///< True if the 99th percentile is within the budget.
};

/// The result of one method.
struct RampMethod {
  std::string method = {};                     ///< Name of the method.
  std::optional<std::uint32_t> largest_width;  ///< Width of the largest grid in real time, if any.
  bool lost = false;                           ///< True: the next size was too slow. False: there was no next size.
  std::optional<double> growth_exponent;       ///< Power of the number of elements with which the median grows.
};

/// The result of a ramp.
struct Ramp {
  std::vector<RampSize> sizes = {};      ///< In the order of the sizes.
  std::vector<RampMethod> methods = {};  ///< In the order of the methods.
  double seconds = 0;                    ///< Time of the whole ramp (s).
};

/// Finds the largest square grid on which each method runs in real time (Dean 2004, chapter 6): grids grow from 4 x 4
/// elements, and at each size all methods make the same drags. A method leaves when the 99th percentile of its passes
/// exceeds the budget in two attempts. The job receives the share of the largest grid that is done. Throws Error for a
/// method that is unknown or not of the ChainMail family and for an option out of its range; and Cancelled.
Ramp ramp(const RampOptions& options = {}, const Job& job = {});

}  // namespace chainmail::api
