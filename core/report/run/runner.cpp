#include "report/run/runner.h"

#include <algorithm>

#include "mesh/error.h"
#include "simulate/move_history.h"

namespace chainmail::report {
namespace {

template <class Item>
std::vector<Item> sorted(std::vector<Item> items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
  return items;
}

}  // namespace

void set_up(Simulation& simulation, const Case& object) {
  simulation.apply(commands::SetElastic{object.elastic});
  simulation.apply(commands::SetSoftness{object.softness});
  simulation.apply(commands::Cut{object.cuts});
  simulation.apply(commands::Pin{object.pins});
}

Runner::Runner(const Case& object, Algorithm algorithm, Precision precision, const RunOptions& options)
    : object_(object),
      cuts_(sorted(object.cuts)),
      pins_(sorted(object.pins)),
      relax_step_(options.relax_step),
      clocks_(options.clocks),
      simulation_(object.mesh, algorithm, precision) {
  simulation_.apply(commands::SetRelaxation{false, options.relax_step, options.scheme});
  simulation_.apply(commands::SetElastic{object.elastic});
}

void Runner::go_to_rest() {
  simulation_.apply(commands::Release{});
  simulation_.apply(commands::Reset{});
  if (simulation_.softness() != object_.softness) {
    simulation_.apply(commands::SetSoftness{object_.softness});
  }
  if (auto cut = simulation_.body().cuts().links(); cut != cuts_) {
    simulation_.apply(commands::Uncut{std::move(cut)});
    simulation_.apply(commands::Cut{cuts_});
  }
  if (const auto pinned = simulation_.body().pins(); !std::ranges::equal(pinned, pins_)) {
    simulation_.apply(commands::Unpin{{pinned.begin(), pinned.end()}});
    simulation_.apply(commands::Pin{pins_});
  }
  simulation_.apply(commands::Reset{});  // the changes above have activated elements for relaxation
  handle_.clear();
}

Runner::Run Runner::run(const RecordedMoves& moves, Relaxing relaxing, const Progress& progress, bool must_converge) {
  Run run;
  simulation_.set_progress(progress.quiet());
  try {
    go_to_rest();
    for (const Command& command : moves.commands) {
      progress.quiet().report(0);
      carry_out(command, relaxing, run);
      const Statistics& now = simulation_.statistics();
      if (must_converge && info(now.algorithm).elastic && !now.remark.empty()) {
        break;
      }
    }
  } catch (const Cancelled&) {
    run.stopped = true;
  }
  return run;
}

void Runner::relax(Relaxing relaxing) {
  if (relaxing.equilibrium) {
    simulation_.apply(commands::Relax{std::uint32_t(relaxing.iterations), relax_step_, RelaxationScheme::equilibrium,
                                      relaxing.until});
  } else {
    simulation_.relax(relaxing.sweeps, {relax_step_, simulation_.relaxation().scheme});
  }
}

void Runner::carry_out(const Command& command, Relaxing relaxing, Run& run) {
  using namespace commands;
  if (is_one_of<SetAlgorithm, SetRelaxation, SetElastic, KeepState, DropState, Relaxed>(command)) {
    return;  // every contestant relaxes in its own way
  }
  const double applying = 1e3 * seconds_of(clocks_, [&] { simulation_.apply(command); });
  if (const auto* grab = std::get_if<Grab>(&command)) {
    handle_ = grab->elements;
    run.grab_ms += applying;
  }
  if (!std::holds_alternative<Drag>(command)) {
    return;
  }
  double ms = std::min(applying, simulation_.statistics().last_pass_ms);
  if (!relaxing.is_none()) {
    ms += 1e3 * seconds_of(clocks_, [&] { relax(relaxing); });
  }
  run.ms.push_back(ms);
  run.checked += simulation_.statistics().last_pass.checked;
  run.moved += simulation_.statistics().last_pass.moved;
}

void check(const RecordedMoves& moves) {
  for (const Command& command : moves.commands) {
    if (is_one_of<commands::ReplaceMesh, commands::Split, commands::SetPositions, commands::RestoreState>(command)) {
      throw Error(moves.name, "these moves split or replace the object, or use undo",
                  "record moves of the object after the cut, or cut links only, and use no undo");
    }
  }
  if (count_moves(moves) == 0) {
    throw Error(moves.name, "it contains no move", "record a drag");
  }
}

int count_moves(const RecordedMoves& moves) { return static_cast<int>(count_drags(moves.commands)); }

}  // namespace chainmail::report
