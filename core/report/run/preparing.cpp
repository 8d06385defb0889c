#include "report/run/preparing.h"

#include <algorithm>
#include <chrono>

#include "mesh/error.h"
#include "report/run/clocks.h"

namespace chainmail::report {
namespace {

constexpr int max_preparations = 15;
constexpr double enough_preparing = 1;  // seconds

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

}  // namespace

PreparingTimes::PreparingTimes(const Case& object, ElasticMethod method, const Clocks& clocks) {
  const ElasticProblem problem = elastic_problem(object);
  const std::vector<ElementId> handles = handles_of(object);
  const double start = clocks.wall();
  for (int repetition = 0;
       repetition == 0 || (repetition < max_preparations && clocks.wall() - start < enough_preparing); ++repetition) {
    std::unique_ptr<ElasticSolver> solver;
    factorize_.push_back(1e3 * seconds_of(clocks, [&] { solver = make_elastic(method, problem); }));
    for (const ElementId handle : handles) {
      try {
        const double seconds = seconds_of(clocks, [&] { solver->hold(elastic_handle(object, handle)); });
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
