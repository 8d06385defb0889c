#include "report/page/front.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace chainmail::report {

double counted_error(const SuiteMean& mean, const SpeedAgainstError& measure) {
  return std::max(*(mean.*measure.error), (mean.*measure.change).value_or(0));
}

std::vector<const SuiteMean*> front(const std::vector<SuiteMean>& means, const SpeedAgainstError& measure) {
  std::vector<const SuiteMean*> all, winners;
  for (const SuiteMean& mean : means) {
    if (may_win(mean) && mean.*measure.ms && mean.*measure.error) {
      all.push_back(&mean);
    }
  }
  std::ranges::stable_sort(
      all, {}, [&](const SuiteMean* one) { return std::tuple(*(one->*measure.ms), counted_error(*one, measure)); });
  double closest = std::numeric_limits<double>::infinity();
  for (const SuiteMean* one : all) {
    const double error = counted_error(*one, measure);
    const bool ties = !winners.empty() && *(winners.back()->*measure.ms) == *(one->*measure.ms) && error == closest;
    if (error < closest || ties) {
      winners.push_back(one);
      closest = error;
    }
  }
  return winners;
}

}  // namespace chainmail::report
