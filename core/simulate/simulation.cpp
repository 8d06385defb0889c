#include "simulate/simulation.h"

#include <limits>
#include <new>
#include <string>
#include <utility>

#include "mesh/error.h"

namespace chainmail {
namespace {

using Clock = PassTimes::Clock;

// Relaxation sleeps when no step of a sweep exceeds this share of the mean rest length, or after this long.
constexpr double asleep_below = 1e-4;
constexpr auto relaxation_time = std::chrono::seconds(10);
// About 2 ms: a command never waits longer for a slice of relaxation to end.
constexpr std::uint64_t elements_per_slice = 20'000;

}  // namespace

Simulation::Simulation(MeshPointer mesh, Algorithm algorithm, Precision precision)
    : mesh_(std::move(mesh)),
      algorithm_(algorithm),
      precision_(precision),
      solver_(make_solver(mesh_, algorithm, precision)),
      changed_(mesh_->element_count()),
      away_(mesh_->element_count()) {
  changed_.insert_all();
  statistics_.algorithm = algorithm;
  refresh_statistics(true);
}

void Simulation::apply(const Command& command) {
  std::visit([this](const auto& one) { carry_out(one); }, command);
}

void Simulation::pass(ElementId element, const Point& target) {
  const auto start = Clock::now();
  try {
    statistics_.last_pass = solver_->move(element, target, trace_);
  } catch (const std::bad_alloc&) {
    mark_all();  // it may have ended in the middle
    throw;
  }
  const auto end = Clock::now();
  statistics_.last_pass_ms = std::chrono::duration<double, std::milli>(end - start).count();
  times_.add(end, statistics_.last_pass_ms);
  ++statistics_.passes;
  last_moved_ = element;
  valid_ = algorithm_ == Algorithm::exact;
  wake(std::span(&element, 1));
  wake(solver_->moved());
  mark(std::span(&element, 1));
  mark(solver_->moved());
}

void Simulation::mark(std::span<const ElementId> moved) {
  changed_.insert(moved);
  away_.insert(moved);
}

void Simulation::mark_all() {
  changed_.insert_all();
  away_.insert_all();
}

bool Simulation::step() {
  if (!statistics_.relaxing) {
    return false;
  }
  const auto slice = solver_->relax(relaxation_step_, elements_per_slice, grabbed_);
  mark(solver_->relaxed());
  if (slice.sweep_ended) {
    ++statistics_.sweeps;
    // What woke during the sweep has not been looked at yet.
    if (!woken_ && slice.largest_step <= asleep_below * mesh_->mean_link_length) {
      fall_asleep();
    }
    woken_ = false;
  }
  if (Clock::now() > relaxation_deadline_) {
    fall_asleep();
  }
  return statistics_.relaxing;
}

void Simulation::relax(int count, double step, const std::stop_token& stop) {
  if (count == 0) {
    return;
  }
  if (last_moved_) {
    solver_->wake(std::span(&*last_moved_, 1));
    solver_->wake(solver_->moved());
  }
  for (int i = 0; i < count && !stop.stop_requested(); ++i) {
    const auto sweep = solver_->relax(step, std::numeric_limits<std::uint64_t>::max(), grabbed_);
    mark(solver_->relaxed());
    if (sweep.visited == 0) {
      break;
    }
  }
}

void Simulation::refresh_statistics(bool whole_mesh) {
  statistics_.last_second = times_.summary(Clock::now());
  const auto position = solver_->positions();
  if (whole_mesh || !last_moved_) {
    statistics_.violation = measure_violation(*mesh_, softness_, solver_->cuts(), position);
    valid_ = statistics_.violation.fraction == 0;
  } else {
    std::vector<ElementId> touched(solver_->moved().begin(), solver_->moved().end());
    touched.push_back(*last_moved_);
    statistics_.violation = measure_violation(*mesh_, softness_, solver_->cuts(), position, touched);
  }
  statistics_.violation_of_whole_mesh = whole_mesh || !last_moved_;
}

void Simulation::check_element(ElementId element) const {
  if (element >= mesh_->element_count()) {
    throw Error("element " + std::to_string(element), "there is no such element",
                "use an id below " + std::to_string(mesh_->element_count()));
  }
}

void Simulation::check_links(const std::vector<LinkId>& links) const {
  for (const LinkId link : links) {
    if (link >= mesh_->link_count()) {
      throw Error("link " + std::to_string(link), "there is no such link",
                  "use a number below " + std::to_string(mesh_->link_count()));
    }
  }
}

void Simulation::take_mesh(MeshPointer mesh) {
  const Algorithm algorithm = fits(algorithm_, *mesh) ? algorithm_ : Algorithm::natural_queue;
  solver_ = make_solver(mesh, algorithm, precision_);  // may find no memory: nothing has changed yet
  solver_->set_relaxation(relaxation_scheme_);
  algorithm_ = statistics_.algorithm = algorithm;
  mesh_ = std::move(mesh);
  away_ = changed_ = ElementBlocks(mesh_->element_count());
  changed_.insert_all();
  grabbed_.reset();
  last_moved_.reset();
  valid_ = true;
  forget_passes();
  fall_asleep();
}

/// What passes did to another object, or by another algorithm, is nothing to show beside this one.
void Simulation::forget_passes() {
  statistics_.last_pass = {};
  statistics_.last_pass_ms = 0;
  times_ = {};
}

void Simulation::wake(std::span<const ElementId> elements) {
  if (relaxation_on_) {
    solver_->wake(elements);
    woken_ = true;
    relaxation_deadline_ = Clock::now() + relaxation_time;
    statistics_.relaxing = true;
    statistics_.sweeps = 0;
  }
}

void Simulation::wake_ends(const std::vector<LinkId>& links) {
  // Also where relaxation is off in idle time: sweeps may be asked for.
  for (const LinkId link : links) {
    solver_->wake(mesh_->links[link]);
  }
  wake({});
}

void Simulation::fall_asleep() {
  solver_->sleep();
  statistics_.relaxing = false;
}

Simulation::State Simulation::current_state() const {
  const auto pins = solver_->pins();
  return {mesh_,     solver_->cuts().links(),        {pins.begin(), pins.end()},
          softness_, solver_->keep_positions(away_), valid_};
}

}  // namespace chainmail
