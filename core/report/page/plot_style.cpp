#include "report/page/plot_style.h"

#include <algorithm>

namespace chainmail::report {

std::size_t style_of(Algorithm algorithm) {
  const auto all = every_algorithm();
  return static_cast<std::size_t>(std::ranges::find(all, algorithm, &AlgorithmInfo::algorithm) - all.begin());
}

const PlotStyle& style_at(std::size_t index) {
  const auto all = every_algorithm();
  return all[index % all.size()].style;
}

}  // namespace chainmail::report
