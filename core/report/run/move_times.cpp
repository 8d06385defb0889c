#include "report/run/move_times.h"

#include <algorithm>
#include <numeric>

namespace chainmail::report {

TimeSpread MoveTimes::spread() const {
  std::vector<double> means;
  for (const auto& run : runs_) {
    means.push_back(std::accumulate(run.begin(), run.end(), 0.0) / double(run.size()));
  }
  return spread_of(std::move(means));
}

double MoveTimes::worst() const {
  double worst = 0;
  for (std::size_t move = 0; !runs_.empty() && move < runs_.front().size(); ++move) {
    std::vector<double> of_move;
    for (const auto& run : runs_) {
      of_move.push_back(run[move]);
    }
    worst = std::max(worst, spread_of(std::move(of_move)).median);
  }
  return worst;
}

}  // namespace chainmail::report
