#pragma once

#include <functional>
#include <vector>

namespace chainmail {

/// How a least value is looked for: everywhere within the bounds (DIRECT-L, Gablonsky and Kelley 2001), or about a
/// point (Sbplx, after Rowan 1990). Neither needs derivatives, which a propagation has none of.
enum class Search { everywhere, about_a_point };

struct Optimum {
  std::vector<double> at;
  double value = 0;
};

/// The least value of a function within bounds, as far as so many evaluations find it: the same each time. `start` lies
/// within the bounds, and counts where the search is about a point. What the function throws comes through.
Optimum find_optimum(Search search, const std::vector<double>& low, const std::vector<double>& high,
                     const std::vector<double>& start, int evaluations,
                     const std::function<double(const std::vector<double>&)>& value);

}  // namespace chainmail
