#pragma once

#include <span>
#include <vector>

#include "measure/time_spread.h"
#include "report/run/cases.h"

namespace chainmail::report {

/// A drag as a method of elasticity carries it out: the handle is first moved to where it rests. Everything is prepared
/// in that move, so that no other move of the drag has a part of it.
RecordedMoves with_preparing_move(const Mesh& mesh, RecordedMoves moves);

/// The times of one drag (ms).
struct DragTimes {
  double preparing = 0;         // of the preparing move
  double first = 0, later = 0;  // of the first move, and of a later one on average
  double after_cut = 0;         // of the last move, where a cut goes before it
};
/// Splits the times of a drag's moves, in their order. No time counts twice.
DragTimes split(std::span<const double> ms, bool has_preparing_move, bool has_cut);

/// The times of a drag over its repetitions.
class RepeatedDrag {
 public:
  void add(const DragTimes& times) { runs_.push_back(times); }
  TimeSpread spread(double DragTimes::*of) const;

 private:
  std::vector<DragTimes> runs_;
};

}  // namespace chainmail::report
