#include <algorithm>
#include <string>
#include <utility>

#include "mesh/error.h"
#include "simulate/simulation.h"

// How each command is carried out.
namespace chainmail {

void Simulation::carry_out(const commands::Grab& command) {
  check_element(command.element);
  if (std::ranges::binary_search(solver_->pins(), command.element)) {
    throw Error("element " + std::to_string(command.element), "it is pinned and may not move",
                "unpin it, or take another element");
  }
  grabbed_ = command.element;
}

void Simulation::carry_out(const commands::Drag& command) {
  if (!grabbed_) {
    throw Error("drag", "no element is grabbed", "grab one first");
  }
  pass(*grabbed_, command.target);
}

void Simulation::carry_out(const commands::Release&) {
  if (grabbed_) {
    // It was held; now it may follow its neighbours, in idle time or in sweeps that are asked for.
    solver_->wake(std::span(&*grabbed_, 1));
    wake({});
  }
  grabbed_.reset();
  statistics_.last_pass.stopped = false;  // nothing pulls any more
}

void Simulation::carry_out(const commands::SetSoftness& command) {
  check(command.softness->global);
  for (const auto& [link, softness] : command.softness->links) {
    check_links(std::span(&link, 1));
    check(softness);
  }
  set_softness(command.softness);
  valid_ = false;
  if (!elastic_method(algorithm_)) {
    answer();  // the others do not look at it
  }
}

/// Softness that is the same leaves the regions of all links as they are.
void Simulation::set_softness(std::shared_ptr<const Softness> softness) {
  if (softness != softness_ && *softness != *softness_) {
    solver_->set_softness(*softness);
  }
  softness_ = std::move(softness);
}

/// Under load the object may now violate its links: a pass about the hand, or the element that was moved
/// last, answers what has changed at once, as far as its propagation reaches. From a valid state it moves
/// nothing.
void Simulation::answer() {
  if (!last_moved_) {
    return;  // it is at rest
  }
  const auto about = grabbed_ ? grabbed_ : last_moved_;
  if (std::ranges::binary_search(solver_->pins(), *about)) {
    return;
  }
  try {
    pass(*about, point_of(*mesh_, solver_->positions(), *about));
  } catch (const Error&) {
    // Pins that contradict each other now: what was set stands, and the next drag says so.
  }
}

void Simulation::carry_out(const commands::SetElastic& command) {
  check(command.options);
  if (command.options != elastic_) {
    elastic_ = command.options;
    solver_->set_elastic(elastic_);
    if (elastic_method(algorithm_)) {
      answer();
    }
  }
}

namespace {

void check_step(double step) {
  if (!(step > 0 && step <= 1)) {
    throw Error("relax-step", "it must lie above 0 and up to 1", "1 goes all the way to the mean");
  }
}

}  // namespace

void Simulation::carry_out(const commands::Relax& command) {
  check_step(command.step);
  solver_->set_relaxation(command.scheme);
  try {
    relax(static_cast<int>(command.sweeps), command.step);
  } catch (...) {  // cancelled, or out of memory
    solver_->set_relaxation(relaxation_scheme_);
    throw;
  }
  solver_->set_relaxation(relaxation_scheme_);
}

void Simulation::carry_out(const commands::SetRelaxation& command) {
  check_step(command.step);
  const bool was_on = std::exchange(relaxation_on_, command.on);
  relaxation_step_ = command.step;
  solver_->set_relaxation(relaxation_scheme_ = command.scheme);
  if (command.on && !was_on && !elastic_method(algorithm_)) {
    solver_->wake_all();
    wake({});
  } else if (!command.on) {
    fall_asleep();
  }
}

void Simulation::carry_out(const commands::SetAlgorithm& command) {
  solver_->set_algorithm(command.algorithm);
  const Algorithm before = std::exchange(algorithm_, command.algorithm);
  if (before == algorithm_) {
    return;
  }
  if ((before == Algorithm::exact || algorithm_ == Algorithm::exact) && !away_.empty()) {
    mark_all();  // Exact holds positions otherwise: the change rounds every one
  }
  statistics_.algorithm = algorithm_;
  forget_passes();
  if (elastic_method(algorithm_)) {
    fall_asleep();
  }
  if (algorithm_ == Algorithm::exact || elastic_method(algorithm_)) {
    answer();  // it holds every link, or is in balance, whatever state it takes over
  }
}

void Simulation::carry_out(const commands::Cut& command) {
  check_links(command.links);
  solver_->cut(command.links);
  wake_ends(command.links);
}

void Simulation::carry_out(const commands::Uncut& command) {
  check_links(command.links);
  solver_->uncut(command.links);
  valid_ = false;  // the ends may have gone apart
  wake_ends(command.links);
}

void Simulation::carry_out(const commands::Pin& command) {
  for (const ElementId element : command.elements) {
    check_element(element);
    if (element == grabbed_) {
      throw Error("element " + std::to_string(element), "it is in the hand", "let it go, then pin it");
    }
  }
  solver_->pin(command.elements);
}

void Simulation::carry_out(const commands::Unpin& command) {
  for (const ElementId element : command.elements) {
    check_element(element);
  }
  solver_->unpin(command.elements);
  solver_->wake(command.elements);
  wake({});
}

void Simulation::carry_out(const commands::Reset&) {
  solver_->reset(away_);
  changed_.insert(away_);
  unkept_.insert(away_);
  away_.clear();
  last_moved_.reset();
  forget_passes();
  valid_ = true;
  fall_asleep();
}

void Simulation::carry_out(const commands::ReplaceMesh& command) {
  if (!command.mesh) {
    throw Error("replace mesh", "no mesh is given", "give one");
  }
  auto softness = std::make_shared<const Softness>(Softness{softness_->global, {}});
  take_mesh(command.mesh);
  set_softness(std::move(softness));
}

}  // namespace chainmail
