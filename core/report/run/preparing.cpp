#include "report/run/preparing.h"

#include <algorithm>
#include <chrono>

#include "mesh/error.h"
#include "report/run/clocks.h"

namespace chainmail::report {
namespace {

constexpr int most_preparations = 15;
constexpr double enough_preparing = 1;  // seconds

}  // namespace

PreparingTimes::PreparingTimes(const Case& object, ElasticMethod method) {
  const Clocks clocks = machine_clocks();
  const ElasticProblem problem = elastic_problem(object);
  const std::vector<ElementId> handles = handles_of(object);
  const double start = clocks.wall();
  for (int repetition = 0;
       repetition == 0 || (repetition < most_preparations && clocks.wall() - start < enough_preparing); ++repetition) {
    std::unique_ptr<ElasticSolver> solver;
    factorize_.push_back(1e3 * seconds_of(clocks, [&] { solver = make_elastic(method, problem); }));
    for (const ElementId handle : handles) {
      try {
        const double seconds = seconds_of(clocks, [&] { solver->hold(ElasticHandle::of(handle)); });
        grab_[handle].push_back(1e3 * seconds);
      } catch (const Error&) {
        grab_.erase(handle);  // the drag itself reports the reason
      }
    }
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
  problem.law = object.law;
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

ElementId handle_of(const RecordedMoves& moves) {
  for (const Command& command : moves.commands) {
    if (const auto* grab = std::get_if<commands::Grab>(&command)) {
      return grab->elements.front();
    }
  }
  return 0;
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
