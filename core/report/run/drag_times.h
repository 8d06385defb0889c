#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "measure/pass_times.h"
#include "report/run/cases.h"

namespace chainmail::report {

/// Returns the drag with an added first move of the handle to its rest position. A method of elasticity does all its
/// preparation in that move, so that the times of the other moves contain none of it.
RecordedMoves with_preparing_move(const Mesh& mesh, RecordedMoves moves);

/// Keeps every n-th of the moves before a cut, the last one of them included, so that about `count` are left.
void keep_moves(std::vector<Command>& commands, std::size_t count);

/// The times of one drag (ms).
struct DragTimes {
  double preparing = 0;         // time of the added first move
  double first = 0, later = 0;  // time of the first real move, and mean time of the later moves
  double after_cut = 0;         // time of the last move, if a cut precedes it
  double mean = 0;              // over all moves but the added one
};
/// Splits the times of the moves of a drag (ms, in their order). No time counts twice.
DragTimes split(std::span<const double> ms, bool has_preparing_move, bool has_cut);

/// The times of a drag over its repetitions.
class RepeatedDrag {
 public:
  /// Adds the times of a repetition, and those of all its moves (ms). All repetitions have as many moves.
  void add(const DragTimes& times, std::vector<double> moves) {
    runs_.push_back(times);
    moves_.push_back(std::move(moves));
  }
  void clear() { *this = {}; }
  TimeSpread spread(double DragTimes::*of) const;
  /// Returns the time of the slowest move: each move counts with its median over the repetitions. None without a
  /// repetition. The added move does not count.
  std::optional<double> slowest_move(bool has_preparing_move) const;

 private:
  std::vector<DragTimes> runs_;
  std::vector<std::vector<double>> moves_;
};

}  // namespace chainmail::report
