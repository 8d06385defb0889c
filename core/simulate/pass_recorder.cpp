#include "simulate/pass_recorder.h"

#include <algorithm>
#include <new>
#include <variant>

namespace chainmail {
namespace {

/// Returns true if a command may be a pass and changes no positions outside the pass. (A change of algorithm may round
/// all positions.)
bool may_be_pass(const Command& command) {
  return std::holds_alternative<commands::Drag>(command) || std::holds_alternative<commands::SetSoftness>(command);
}

/// Returns true if a command may change cuts, pins or softness.
bool changes_conditions(const Command& command) {
  return !std::holds_alternative<commands::Grab>(command) && !std::holds_alternative<commands::Drag>(command) &&
         !std::holds_alternative<commands::Release>(command);
}

}  // namespace

void PassRecorder::set_on(bool on) {
  const std::lock_guard lock(mutex_);
  on_ = on;
  if (!on) {
    record_ = {};
    is_whole_ = false;
  }
}

std::unique_ptr<RecordedPass> PassRecorder::last(std::uint64_t seen) const {
  const std::lock_guard lock(mutex_);
  return is_whole_ && record_.number != seen ? std::make_unique<RecordedPass>(record_) : nullptr;
}

void PassRecorder::begin(const Command& command, Simulation& simulation) {
  runs_ = on_ && may_be_pass(command);
  passes_ = simulation.statistics().passes;
  if (std::holds_alternative<commands::Grab>(command)) {
    in_drag_ = 0;
  }
  trace_.clear();
  simulation.set_trace(runs_ ? &trace_ : nullptr);
  if (changes_conditions(command)) {
    conditions_.reset();
  }
  if (!runs_) {
    return;
  }
  const std::lock_guard lock(mutex_);
  is_whole_ = false;
  try {
    follow(simulation);
  } catch (const std::bad_alloc&) {
    give_up(simulation);
  }
}

/// Records nothing of this pass: it must not fail because there is no memory for its record.
void PassRecorder::give_up(Simulation& simulation) {
  runs_ = false;
  record_ = {};
  simulation.set_trace(nullptr);
}

/// Copies the changes since the last pass began.
void PassRecorder::follow(const Simulation& simulation) {
  if (record_.mesh != simulation.mesh_pointer()) {
    record_.before.resize(simulation.mesh().rest.size());
    pending_ = ElementBlocks(simulation.mesh().element_count());
    record_.mesh = simulation.mesh_pointer();
    space_ = FrameSpace(*record_.mesh);
    conditions_.reset();
    copy(simulation, 0, record_.mesh->element_count());
    return;
  }
  pending_.insert(simulation.changed());
  pending_.for_each_run([&](ElementId first, ElementId end) { copy(simulation, first, end); });
  pending_.clear();
}

void PassRecorder::copy(const Simulation& simulation, ElementId first, ElementId end) {
  const auto coordinates = static_cast<std::size_t>(record_.mesh->space_dimension);
  space_.copy_about_origin(simulation.body(), first,
                           std::span(record_.before).subspan(coordinates * first, coordinates * (end - first)));
}

void PassRecorder::end(Simulation& simulation) {
  simulation.set_trace(nullptr);
  if (simulation.statistics().passes == passes_ || simulation.last_handle() == nullptr) {
    return;
  }
  ++in_drag_;
  if (!runs_) {
    return;
  }
  try {
    finish(simulation);
  } catch (const std::bad_alloc&) {
    // The record stays unfinished, so nobody reads it.
  }
}

void PassRecorder::finish(const Simulation& simulation) {
  if (!conditions_) {
    const auto pins = simulation.body().pins();
    conditions_ = std::make_shared<const PassConditions>(
        PassConditions{simulation.body().cuts(), {pins.begin(), pins.end()}, simulation.body().shared_softness()});
  }
  const std::lock_guard lock(mutex_);
  if (on_ && record_.mesh == simulation.mesh_pointer()) {  // otherwise recording was turned off in the meantime
    write(simulation);
    is_whole_ = true;
  }
}

void PassRecorder::write(const Simulation& simulation) {
  record_.algorithm = simulation.statistics().algorithm;
  record_.number = simulation.statistics().passes;
  record_.in_drag = in_drag_;
  const auto handle = simulation.last_handle()->elements();
  record_.handle.assign(handle.begin(), handle.end());
  record_.conditions = conditions_;
  std::swap(record_.trace, trace_);
  const auto coordinates = static_cast<std::size_t>(record_.mesh->space_dimension);
  record_.after.resize(coordinates * (handle.size() + record_.trace.size()));
  auto after = std::span(record_.after);
  const auto copy_next = [&](ElementId element) {
    space_.copy_about_origin(simulation.body(), element, after.first(coordinates));
    after = after.subspan(coordinates);
  };
  std::ranges::for_each(handle, copy_next);
  std::ranges::for_each(record_.trace, copy_next, &TraceRow::element);
}

void PassRecorder::note_changes(const Simulation& simulation) {
  if (on_ && pending_.block_count() == simulation.changed().block_count()) {
    pending_.insert(simulation.changed());
  }
}

}  // namespace chainmail
