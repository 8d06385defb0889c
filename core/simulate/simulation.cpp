#include "simulate/simulation.h"

#include <algorithm>
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
constexpr LinkId links_per_slice = 20'000;

}  // namespace

Simulation::Simulation(MeshPointer mesh, Algorithm algorithm, Precision precision)
    : mesh_(std::move(mesh)),
      algorithm_(algorithm),
      precision_(precision),
      solver_(make_solver(mesh_, algorithm, precision)),
      changed_(mesh_->element_count()),
      away_(mesh_->element_count()),
      unkept_(mesh_->element_count()) {
  changed_.insert_all();
  statistics_.algorithm = algorithm;
}

void Simulation::set_progress(const Progress& progress) {
  progress_ = progress;
  solver_->set_progress(progress);
}

void Simulation::apply(const Command& command) {
  measure_.reset();
  std::visit([this](const auto& one) { carry_out(one); }, command);
}

void Simulation::pass(ElementId element, const Point& target) {
  time_pass([&] { return solver_->move(element, target, trace_); });
  last_moved_ = element;
  valid_ = algorithm_ == Algorithm::exact;
  for (const auto& moved : {std::span<const ElementId>(&element, 1), solver_->moved()}) {
    mark(moved);
    wake(moved);
  }
}

template <class Move>
void Simulation::time_pass(Move move) {
  const auto start = Clock::now();
  try {
    statistics_.last_pass = move();
  } catch (const std::bad_alloc&) {
    mark_all();  // it may have ended in the middle
    throw;
  }
  const auto end = Clock::now();
  statistics_.last_pass_ms = std::chrono::duration<double, std::milli>(end - start).count();
  times_.add(end, statistics_.last_pass_ms);
  ++statistics_.passes;
  statistics_.remark = solver_->remark();
}

void Simulation::carry_out(const commands::MoveControlPoint& command) {
  if (algorithm_ != Algorithm::free_form) {
    return;  // the others have none
  }
  time_pass([&] { return solver_->move_control_point(command.point, command.target); });
  valid_ = false;
  mark(solver_->moved());
}

std::span<const double> Simulation::control_points() {
  try {
    return solver_->control_points();
  } catch (const Error&) {
    return {};  // the next move says why
  }
}

void Simulation::mark(std::span<const ElementId> moved) {
  changed_.insert(moved);
  away_.insert(moved);
  unkept_.insert(moved);
}

void Simulation::mark_all() {
  changed_.insert_all();
  away_.insert_all();
  unkept_.insert_all();
}

bool Simulation::step() {
  if (!statistics_.relaxing) {
    return false;
  }
  measure_.reset();
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

void Simulation::relax(int count, double step) {
  if (count == 0 || elastic_method(algorithm_)) {
    return;  // a static answer is where it should be
  }
  measure_.reset();
  if (last_moved_) {
    solver_->wake(std::span(&*last_moved_, 1));
    solver_->wake(solver_->moved());
  }
  for (int i = 0; i < count && sweep(step, progress_.part(double(i) / count, double(i + 1) / count)) > 0; ++i) {
  }
}

/// One sweep, in slices between which it may be given up. Returns the number of elements that it visited.
std::uint64_t Simulation::sweep(double step, const Progress& progress) {
  std::uint64_t visited = 0;
  while (true) {
    progress.report(std::min(1.0, double(visited) / mesh_->element_count()));
    const RelaxationResult slice = solver_->relax(step, elements_per_slice, grabbed_);
    mark(solver_->relaxed());
    visited += slice.visited;
    if (slice.sweep_ended) {
      return visited;
    }
  }
}

void Simulation::refresh_statistics(bool whole_mesh) {
  if (whole_mesh) {
    while (measure()) {
    }
    return;
  }
  statistics_.last_second = times_.summary(Clock::now());
  statistics_.violation_of_whole_mesh = false;
  if (last_moved_) {
    statistics_.violation = touched_.measure(*mesh_, *softness_, solver_->cuts(), solver_->positions(),
                                             {std::span(&*last_moved_, 1), solver_->moved()});
  } else {
    statistics_.violation = {};
  }
}

bool Simulation::measure() {
  if (!measure_) {
    measure_.emplace();
  }
  if (measure_->go_on(*mesh_, *softness_, solver_->cuts(), solver_->positions(), links_per_slice)) {
    return true;
  }
  statistics_.last_second = times_.summary(Clock::now());
  statistics_.violation = measure_->result();
  statistics_.violation_of_whole_mesh = true;
  valid_ = statistics_.violation.fraction == 0;
  measure_.reset();
  return false;
}

void Simulation::check_element(ElementId element) const {
  if (element >= mesh_->element_count()) {
    throw Error("element " + std::to_string(element), "there is no such element",
                "use an id below " + std::to_string(mesh_->element_count()));
  }
}

void Simulation::check_links(std::span<const LinkId> links) const {
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
  solver_->set_elastic(elastic_);
  solver_->set_progress(progress_);
  softness_ = std::make_shared<const Softness>();  // as every solver begins
  algorithm_ = statistics_.algorithm = algorithm;
  mesh_ = std::move(mesh);
  away_ = changed_ = unkept_ = ElementBlocks(mesh_->element_count());
  last_kept_ = {};
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
  statistics_.remark.clear();
  times_.clear();
}

void Simulation::wake(std::span<const ElementId> elements) {
  if (relaxation_on_ && !elastic_method(algorithm_)) {
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

}  // namespace chainmail
