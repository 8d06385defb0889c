#include "report/table/growth.h"

#include <algorithm>
#include <cmath>

namespace chainmail::report {

double percentile(std::vector<double> values, double share) {
  const double rank = std::ceil(share * double(values.size()));
  const auto position = values.begin() + std::max(static_cast<std::ptrdiff_t>(rank) - 1, std::ptrdiff_t{0});
  std::nth_element(values.begin(), position, values.end());
  return *position;
}

std::optional<Growth> growth_of(std::span<const SizedTime> times, double from) {
  constexpr int min_sizes = 3;
  std::vector<SizedTime> logarithms;
  Growth growth;
  SizedTime mean;
  for (const auto& [elements, ms] : times) {
    if (elements >= from && ms > 0) {
      growth.from = logarithms.empty() ? elements : std::min(growth.from, elements);
      growth.to = std::max(growth.to, elements);
      logarithms.push_back({std::log(elements), std::log(ms)});
      mean.elements += logarithms.back().elements;
      mean.ms += logarithms.back().ms;
    }
  }
  growth.sizes = static_cast<int>(logarithms.size());
  if (growth.sizes < min_sizes) {
    return std::nullopt;
  }
  mean.elements /= growth.sizes;
  mean.ms /= growth.sizes;
  double together = 0, squares = 0;
  for (const auto& [elements, ms] : logarithms) {
    together += (elements - mean.elements) * (ms - mean.ms);
    squares += (elements - mean.elements) * (elements - mean.elements);
  }
  if (!(squares > 0)) {
    return std::nullopt;
  }
  growth.power = together / squares;
  return growth;
}

}  // namespace chainmail::report
