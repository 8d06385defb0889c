// States that a simulation keeps, for undo and for going back and forth in what was recorded.

#include <algorithm>
#include <iterator>
#include <string>

#include "mesh/error.h"
#include "simulate/simulation.h"

namespace chainmail {

void Simulation::carry_out(const commands::KeepState& command) { kept_[command.state] = current_state(); }

void Simulation::carry_out(const commands::RestoreState& command) { take_state(kept(command.state)); }

void Simulation::carry_out(const commands::DropState& command) { kept_.erase(command.state); }

void Simulation::carry_out(const commands::Place& command) {
  check(*command.placement, *mesh_, precision_);
  solver_->place(*command.placement, away_);
  changed_.insert(away_);
  unkept_.insert(away_);
  away_.clear();
  const auto& runs = command.placement->runs;
  for (std::size_t i = 0; i < runs.size(); i += 2) {
    away_.insert_run(runs[i], runs[i + 1]);
  }
  changed_.insert(away_);
  unkept_.insert(away_);
  valid_ = runs.empty();
  forget_passes();
  grabbed_.reset();
  last_moved_.reset();
  fall_asleep();
}

Simulation::State& Simulation::kept(commands::StateId state) {
  const auto found = kept_.find(state);
  if (found == kept_.end()) {
    throw Error("state " + std::to_string(state), "no such state is kept", "keep it first");
  }
  return found->second;
}

Handover Simulation::hand_over() { return {current_state(), kept_, relaxation(), elastic_, grabbed_, last_moved_}; }

void Simulation::take(const Handover& handover, Algorithm algorithm) {
  measure_.reset();
  algorithm_ = algorithm;
  elastic_ = handover.elastic;
  take_mesh(handover.object.mesh);
  take_state(handover.object);
  kept_ = handover.kept;
  carry_out(handover.relaxation);
  grabbed_ = handover.grabbed;
  last_moved_ = handover.last_moved;
}

Simulation::State Simulation::current_state() {
  solver_->keep_positions(unkept_, away_, last_kept_);
  unkept_.clear();
  const auto pins = solver_->pins();
  return {mesh_, solver_->cuts().links(), {pins.begin(), pins.end()}, softness_, last_kept_, valid_};
}

void Simulation::take_state(const State& state) {
  if (state.mesh != mesh_) {
    take_mesh(state.mesh);
  }
  set_softness(state.softness);
  take_cuts(state.cuts);
  if (!std::ranges::equal(state.pins, solver_->pins())) {
    solver_->unpin(std::vector<ElementId>(solver_->pins().begin(), solver_->pins().end()));
    solver_->pin(state.pins);
  }
  take_positions(state.positions);
  valid_ = state.valid;
  forget_passes();
  grabbed_.reset();
  last_moved_.reset();
  fall_asleep();
}

void Simulation::take_cuts(const std::vector<LinkId>& cuts) {
  const std::vector<LinkId> present = solver_->cuts().links();
  std::vector<LinkId> excess, missing;
  std::ranges::set_difference(present, cuts, std::back_inserter(excess));
  std::ranges::set_difference(cuts, present, std::back_inserter(missing));
  // A method of elasticity prepares anew for other cuts: not where there are none.
  if (!excess.empty()) {
    solver_->uncut(excess);
  }
  if (!missing.empty()) {
    solver_->cut(missing);
  }
}

/// Blocks that both states share are as they were kept, unless a position of them has changed since.
void Simulation::take_positions(const PositionBlocks& positions) {
  last_kept_.blocks.resize(away_.block_count());
  away_.clear();
  for (std::size_t block = 0; block < away_.block_count(); ++block) {
    if (positions.blocks[block] != last_kept_.blocks[block]) {
      unkept_.insert_block(block);
    }
    if (positions.blocks[block] != nullptr) {
      away_.insert_block(block);
    }
  }
  solver_->restore(positions, unkept_);
  changed_.insert(unkept_);
  last_kept_ = positions;
  unkept_.clear();
  if (positions.from_rest != (algorithm_ == Algorithm::exact)) {
    unkept_ = away_;  // they are held otherwise now, and rounded
  }
}

}  // namespace chainmail
