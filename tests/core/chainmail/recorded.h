#pragma once

#include <algorithm>
#include <set>
#include <vector>

#include "body/region.h"
#include "chainmail/recorded_pass.h"
#include "core/support.h"
#include "mesh/error.h"
#include "simulate/pass_recorder.h"

namespace chainmail::test {

/// A simulation with its recorder, as the window runs it.
struct Recorded {
  Recorded(const MeshPointer& mesh, Algorithm algorithm) : simulation(mesh, algorithm, Precision::single_precision) {
    recorder.set_on(true);
  }

  /// Returns false if the command was refused.
  bool apply(const Command& command) {
    bool done = true;
    recorder.begin(command, simulation);
    try {
      simulation.apply(command);
    } catch (const Error&) {
      done = false;
    }
    recorder.end(simulation);
    return done;
  }
  /// Records, as when a frame is handed over.
  void publish() {
    recorder.note_changes(simulation);
    simulation.forget_changes();
  }
  std::unique_ptr<RecordedPass> drag(ElementId element, const Point& to) {
    apply(commands::Grab{element});
    apply(commands::Drag{to});
    return recorder.last(0);
  }

  Simulation simulation;
  PassRecorder recorder;
};

/// Shows the states of a pass, one after another.
struct Player {
  explicit Player(const RecordedPass& of) : pass(of), positions(of.before) {
    for (std::size_t i = 0; i < pass.handle.size(); ++i) {
      place(pass.handle[i], pass.handle_after(i));
    }
  }
  void take(std::size_t row) { place(pass.trace[row].element, pass.position_after(row)); }
  void place(ElementId element, std::span<const float> at) {
    std::ranges::copy(at, positions.begin() + element * pass.mesh->space_dimension);
  }
  float at(ElementId element, int k) const { return positions[std::size_t{element} * pass.mesh->space_dimension + k]; }

  const RecordedPass& pass;
  std::vector<float> positions;
};

inline std::vector<float> played(const RecordedPass& pass) {
  Player player(pass);
  for (std::size_t row = 0; row < pass.trace.size(); ++row) {
    player.take(row);
  }
  return player.positions;
}

inline bool updated_once(const RecordedPass& pass) {
  std::set<ElementId> updated(pass.handle.begin(), pass.handle.end());
  return std::ranges::all_of(pass.trace, [&](const TraceRow& row) { return updated.insert(row.element).second; });
}

inline bool stays(const RecordedPass& pass, std::size_t row) {
  return std::ranges::equal(pass.position_before(pass.trace[row].element), pass.position_after(row));
}

/// Returns the coordinate of the element of a row after its update, computed from the position of its sponsor at that
/// step. In three dimensions, the other two axes are summed in their order.
inline float clamped_by_hand(const Player& player, std::size_t row, int k) {
  const Mesh& mesh = *player.pass.mesh;
  const auto [element, sponsor, moved] = player.pass.trace[row];
  double along[3]{};
  for (int j = 0, next = 1; j < mesh.space_dimension; ++j) {
    along[j == k ? 0 : next++] = mesh.rest[std::size_t{element} * mesh.space_dimension + j] -
                                 mesh.rest[std::size_t{sponsor} * mesh.space_dimension + j];
  }
  const auto& softness = player.pass.conditions->softness->of(*find_link(mesh, element, sponsor));
  const auto region = valid_region<float, 3>(along, softness);
  const float low = player.at(sponsor, k) + region.low[0], high = player.at(sponsor, k) + region.high[0];
  return std::min(std::max(player.at(element, k), low), high);
}

/// Returns true if at every step the next waiting candidate that will not be dropped is the next one of the trace.
inline bool leads_through(const RecordedPass& pass, const WaitingHistory& history) {
  std::set<ElementId> updated(pass.conditions->pins.begin(), pass.conditions->pins.end());
  updated.insert(pass.handle.begin(), pass.handle.end());
  for (std::size_t step = 0; step < pass.trace.size(); ++step) {
    const auto waiting = history.at(step);
    const auto next = std::ranges::find_if(
        waiting, [&](std::uint32_t i) { return !updated.contains(history.candidates()[i].element); });
    if (next == waiting.end() || history.candidates()[*next].element != pass.trace[step].element ||
        history.candidates()[*next].sponsor != pass.trace[step].sponsor) {
      return false;
    }
    updated.insert(pass.trace[step].element);
  }
  return history.at(pass.trace.size()).empty();
}

}  // namespace chainmail::test
