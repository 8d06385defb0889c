#include "report/run/preparing.h"

#include <algorithm>
#include <chrono>

#include "mesh/error.h"
#include "report/run/clocks.h"
#include "report/run/runner.h"
#include "solver/algorithms.h"

namespace chainmail::report {
namespace {

constexpr int max_preparations = 15;

/// Returns the handle of the first drag that grabs an element, about its middle.
ElasticHandle elastic_handle(const Case& object, ElementId handle) {
  const Mesh& mesh = *object.mesh;
  const auto drag = std::ranges::find(object.drags, handle, handle_of);
  std::vector<ElementId> elements = drag == object.drags.end() ? std::vector{handle} : grabbed_by(*drag);
  const auto n = static_cast<std::size_t>(mesh.space_dimension);
  if (elements.size() == 1) {
    return ElasticHandle::of(elements.front());
  }
  std::vector<double> middle(n, 0.0), arms;
  for (const ElementId e : elements) {
    for (std::size_t k = 0; k < n; ++k) {
      arms.push_back(mesh.rest[e * n + k]);
      middle[k] += arms.back() / double(elements.size());
    }
  }
  for (std::size_t i = 0; i < arms.size(); ++i) {
    arms[i] -= middle[i % n];
  }
  return {std::move(elements), std::vector<double>(arms.size(), 0.0), arms};
}

/// Returns the grab of the first drag that grabs an element, with the first move.
RecordedMoves first_move_of(const Case& object, ElementId handle) {
  RecordedMoves moves = *std::ranges::find(object.drags, handle, handle_of);
  const auto drag = std::ranges::find_if(
      moves.commands, [](const Command& one) { return std::holds_alternative<commands::Drag>(one); });
  moves.commands.erase(drag == moves.commands.end() ? drag : drag + 1, moves.commands.end());
  return moves;
}

/// Returns a short drag of an element that is neither pinned nor the first one of a drag.
RecordedMoves short_drag_of_another(const Case& object) {
  const std::vector<ElementId> handles = handles_of(object);
  ElementId element = 0;
  const auto is_taken = [&](ElementId one) {
    return std::ranges::count(handles, one) + std::ranges::count(object.pins, one) > 0;
  };
  while (element + 1 < object.mesh->element_count() && is_taken(element)) {
    ++element;
  }
  constexpr double by = 0.01;  // mean rest lengths
  const Point to = object.mesh->rest_position(element) + by * object.mesh->mean_link_length * Point::UnitX();
  return {"another", "", {commands::Grab{{element}}, commands::Drag{to}}};
}

}  // namespace

PreparingTimes::PreparingTimes(const Case& object, Algorithm method, double seconds, const Clocks& clocks) {
  const ElasticProblem problem = elastic_problem(object);
  const std::vector<ElementId> handles = handles_of(object);
  const double start = clocks.wall();
  for (int repetition = 0; repetition == 0 || (repetition < max_preparations && clocks.wall() - start < seconds);
       ++repetition) {
    std::unique_ptr<ElasticSolver> solver;
    factorize_.push_back(1e3 * seconds_of(clocks, [&] { solver = make_elastic(method, problem); }));
    for (const ElementId handle : handles) {
      try {
        const auto hold = [&] { solver->hold(elastic_handle(object, handle)); };
        const double ms = 1e3 * seconds_of(clocks, hold);
        grab_[handle].push_back(ms);
      } catch (const Error&) {
        grab_.erase(handle);  // the drag itself reports the reason
      }
    }
  }
}

PreparingTimes::PreparingTimes(const Case& object, Algorithm algorithm, bool equilibrium, double seconds,
                               const RunOptions& options) {
  const Clocks& clocks = options.clocks;
  const Relaxing one_iteration(0, equilibrium, 1);
  const RecordedMoves other = short_drag_of_another(object);
  const double start = clocks.wall();
  for (int repetition = 0; repetition == 0 || (repetition < max_preparations && clocks.wall() - start < seconds);
       ++repetition) {
    std::unique_ptr<Runner> runner;
    const auto run = [&](const RecordedMoves& moves) { return runner->run(moves, one_iteration); };
    const double first = seconds_of(clocks, [&] {
      runner = std::make_unique<Runner>(object, algorithm, options.precision, options);
      run(other);
    });
    for (const ElementId handle : handles_of(object)) {
      const RecordedMoves moves = first_move_of(object, handle);
      const Runner::Run fresh = run(moves), again = run(moves);
      grab_[handle].push_back(std::max(0.0, fresh.grab_ms + fresh.ms.front() - again.ms.front()));
    }
    const double later = seconds_of(clocks, [&] { run(other); });
    factorize_.push_back(1e3 * std::max(0.0, first - later));
  }
}

Preparation PreparingTimes::of(ElementId handle) const {
  const auto found = grab_.find(handle);
  return {spread_of(factorize_), found == grab_.end() ? TimeSpread() : spread_of(found->second)};
}

ElasticProblem elastic_problem(const Case& object, const std::vector<LinkId>& cut) {
  ElasticProblem problem{object.mesh, Cuts(object.mesh), object.pins, {}, object.elastic};
  std::ranges::sort(problem.pins);
  problem.pinned.resize(object.pins.size() * static_cast<std::size_t>(object.mesh->space_dimension));
  for (const LinkId link : cut) {
    problem.cuts.cut(link);
  }
  return problem;
}

ElasticProblem reference_problem(const Case& object, const std::vector<LinkId>& cut) {
  ElasticProblem problem = elastic_problem(object, cut);
  problem.options.law = object.law;
  return problem;
}

std::vector<ElementId> handles_of(const Case& object) {
  std::vector<ElementId> handles;
  for (const RecordedMoves& moves : object.drags) {
    if (const ElementId handle = handle_of(moves); std::ranges::find(handles, handle) == handles.end()) {
      handles.push_back(handle);
    }
  }
  return handles;
}

ElementId handle_of(const RecordedMoves& moves) { return moves.centre ? *moves.centre : grabbed_by(moves).front(); }

std::vector<ElementId> grabbed_by(const RecordedMoves& moves) {
  for (const Command& command : moves.commands) {
    if (const auto* grab = std::get_if<commands::Grab>(&command)) {
      return grab->elements;
    }
  }
  return {0};
}

std::vector<LinkId> cuts_of(const RecordedMoves& moves) {
  std::vector<LinkId> links;
  for (const Command& command : moves.commands) {
    if (const auto* cut = std::get_if<commands::Cut>(&command)) {
      links.insert(links.end(), cut->links.begin(), cut->links.end());
    }
  }
  return links;
}

}  // namespace chainmail::report
