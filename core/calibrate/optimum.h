#pragma once

#include <functional>
#include <vector>

namespace chainmail {

/// Search method: everywhere within the bounds (DIRECT-L, Gablonsky and Kelley 2001), or near a point (Sbplx, after
/// Rowan 1990). Neither needs derivatives; the error of ChainMail has none.
enum class Search { everywhere, about_a_point };

struct Optimum {
  std::vector<double> at;
  double value = 0;
};

/// Returns the smallest value of a function that this many evaluations find within the bounds. The result is the same
/// in each run. `start` must be within the bounds; only the search near a point uses it. Exceptions of the function
/// reach the caller.
Optimum find_optimum(Search search, const std::vector<double>& low, const std::vector<double>& high,
                     const std::vector<double>& start, int evaluations,
                     const std::function<double(const std::vector<double>&)>& value);

}  // namespace chainmail
