#include "report/run/drag_times.h"

#include <algorithm>
#include <numeric>

namespace chainmail::report {

RecordedMoves with_preparing_move(const Mesh& mesh, RecordedMoves moves) {
  const auto grab = std::ranges::find_if(
      moves.commands, [](const Command& command) { return std::holds_alternative<commands::Grab>(command); });
  if (grab != moves.commands.end()) {
    const auto& handle = std::get<commands::Grab>(*grab).elements;
    const auto no_motion = commands::Drag{Point::Zero(), {}, true};
    moves.commands.insert(grab + 1,
                          handle.size() == 1 ? commands::Drag{mesh.rest_position(handle.front())} : no_motion);
  }
  return moves;
}

void keep_moves(std::vector<Command>& commands, std::size_t count) {
  const auto is_move = [](const Command& command) { return std::holds_alternative<commands::Drag>(command); };
  const auto cut = std::ranges::find_if(
      commands, [](const Command& command) { return std::holds_alternative<commands::Cut>(command); });
  auto left = std::size_t(std::count_if(commands.begin(), cut, is_move));
  const std::size_t every = std::max<std::size_t>(1, left / count);
  std::vector<Command> kept;
  for (auto one = commands.begin(); one != commands.end(); ++one) {
    if (one >= cut || !is_move(*one) || --left % every == 0) {
      kept.push_back(std::move(*one));
    }
  }
  commands = std::move(kept);
}

DragTimes split(std::span<const double> ms, bool has_preparing_move, bool has_cut) {
  DragTimes times;
  const auto take_first = [&](double& time) {
    time = ms.empty() ? 0 : ms.front();
    ms = ms.subspan(std::min<std::size_t>(1, ms.size()));
  };
  if (has_preparing_move) {
    take_first(times.preparing);
  }
  if (!ms.empty()) {
    times.mean = std::accumulate(ms.begin(), ms.end(), 0.0) / double(ms.size());
  }
  if (has_cut && !ms.empty()) {
    times.after_cut = ms.back();
    ms = ms.first(ms.size() - 1);
  }
  take_first(times.first);
  if (!ms.empty()) {
    times.later = std::accumulate(ms.begin(), ms.end(), 0.0) / double(ms.size());
  }
  return times;
}

TimeSpread RepeatedDrag::spread(double DragTimes::*of) const {
  std::vector<double> all(runs_.size());
  std::ranges::transform(runs_, all.begin(), of);
  return spread_of(std::move(all));
}

std::optional<double> RepeatedDrag::slowest_move(bool has_preparing_move) const {
  std::optional<double> slowest;
  for (std::size_t move = has_preparing_move ? 1 : 0; !moves_.empty() && move < moves_.front().size(); ++move) {
    std::vector<double> of_move;
    for (const auto& run : moves_) {
      of_move.push_back(run[move]);
    }
    slowest = std::max(slowest.value_or(0), spread_of(std::move(of_move)).median);
  }
  return slowest;
}

}  // namespace chainmail::report
