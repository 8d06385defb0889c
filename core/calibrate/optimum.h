#pragma once

#include <functional>
#include <vector>

namespace chainmail {

/// Search method: everywhere within the bounds (DIRECT-L, Gablonsky and Kelley 2001), or about a point (Sbplx, after
/// Rowan 1990). Neither needs derivatives, which a propagation does not have.
enum class Search { everywhere, about_a_point };

struct Optimum {
  std::vector<double> at;
  double value = 0;
};

/// Returns the smallest value of a function within bounds that this many evaluations find: the same each time. `start`
/// must be within the bounds; only the search about a point uses it. Exceptions of the function are passed on.
Optimum find_optimum(Search search, const std::vector<double>& low, const std::vector<double>& high,
                     const std::vector<double>& start, int evaluations,
                     const std::function<double(const std::vector<double>&)>& value);

}  // namespace chainmail
