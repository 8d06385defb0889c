// Counts the iterations to the material from several starts (see README.md): bench_warm_start. The counts are the same
// in each run.

#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "equilibrium/equilibrium_solver.h"
#include "report/run/preparing.h"
#include "report/run/suite_experiments.h"
#include "report/table/contestant.h"
#include "simulate/simulation.h"
#include "solver/algorithms.h"

namespace chainmail::bench {
namespace {

constexpr double close_enough = 0.01;  // distance from the minimum, over its way from rest
constexpr int most_iterations = 300;

/// One drag of an object, move by move, with the minimum after each move.
class WarmStarts {
 public:
  WarmStarts(const report::Case& object, const report::RecordedMoves& drag)
      : object_(object),
        mesh_(*object.mesh),
        handle_(report::grabbed_by(drag)),
        open_(report::softness_of({.algorithm = Algorithm::exact, .equilibrium = true, .open_regions = true},
                                  object.softness)),
        linear_(make_elastic(Algorithm::linear_fem, report::elastic_problem(object))),
        minimum_(mesh_.rest) {
    for (const auto& [name, algorithm] :
         {std::pair{"pass of Natural Queue", Algorithm::natural_queue}, std::pair{"pass of Exact", Algorithm::exact}}) {
      auto simulation = std::make_unique<Simulation>(object.mesh, algorithm, Precision::double_precision);
      simulation->apply(commands::SetElastic{object.elastic});
      simulation->apply(commands::Pin{object.pins});
      simulation->apply(commands::Grab{handle_});
      passes_[name] = std::move(simulation);
    }
  }

  void move(const commands::Drag& drag) {
    std::map<std::string, std::vector<double>> starts{{"rest", mesh_.rest}, {"last frame", minimum_}};
    for (const auto& [name, simulation] : passes_) {
      simulation->apply(commands::SetSoftness{object_.softness});
      simulation->apply(drag);
      starts[name] = positions_of(*simulation);
      simulation->apply(commands::SetSoftness{open_});
      simulation->apply(commands::Relax{3000, 1, RelaxationScheme::equilibrium, 1e-7});
      minimum_ = positions_of(*simulation);
    }
    starts["linear FEM"] = linear_answer();
    for (const auto& [name, start] : starts) {
      counts_[name].push_back(iterations_from(start));
    }
  }

  void print() const {
    for (const auto& [name, counts] : counts_) {
      double later = 0;
      for (std::size_t i = 1; i < counts.size(); ++i) {
        later += counts[i] / double(counts.size() - 1);
      }
      std::printf("  %-22s first move %3d", name.c_str(), counts.front());
      std::printf(counts.size() > 1 ? "   later moves %5.1f\n" : "\n", later);
    }
  }

 private:
  std::vector<double> positions_of(const Simulation& simulation) const {
    std::vector<double> positions(mesh_.rest.size());
    simulation.body().copy_positions(positions);
    return positions;
  }

  /// The linear answer with each element of the handle where the minimum has it.
  std::vector<double> linear_answer() {
    const auto n = std::size_t(mesh_.space_dimension);
    ElasticHandle handle{handle_, {}, std::vector<double>(handle_.size() * n, 0.0)};
    for (const ElementId element : handle_) {
      for (std::size_t k = element * n; k < (element + 1) * n; ++k) {
        handle.displacements.push_back(minimum_[k] - mesh_.rest[k]);
      }
    }
    linear_->hold(handle);
    linear_->move(ElasticMotion::by(std::vector<double>(n, 0.0)));
    std::vector<double> answer = mesh_.rest;
    for (std::size_t i = 0; i < answer.size(); ++i) {
      answer[i] += linear_->displacements()[i];
    }
    return answer;
  }

  int iterations_from(std::vector<double> start) const {
    const auto n = std::size_t(mesh_.space_dimension);
    for (const ElementId element : handle_) {
      std::copy_n(minimum_.begin() + std::ptrdiff_t(element * n), n, start.begin() + std::ptrdiff_t(element * n));
    }
    Body body(object_.mesh, Precision::double_precision);
    body.set_softness(open_);
    body.set_elastic(object_.elastic);
    body.pin(object_.pins);
    body.set_positions(start);
    const auto solver = EquilibriumSolver::make(mesh_.space_dimension);
    int count = 0;
    while (count < most_iterations && distance(start) >= close_enough) {
      solver->iterate(body, handle_);
      body.copy_positions(start);
      ++count;
    }
    return count;
  }

  double distance(const std::vector<double>& positions) const {
    double apart = 0, way = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      apart += std::pow(positions[i] - minimum_[i], 2);
      way += std::pow(minimum_[i] - mesh_.rest[i], 2);
    }
    return std::sqrt(apart / way);
  }

  const report::Case& object_;
  const Mesh& mesh_;
  std::vector<ElementId> handle_;
  Softness open_;  // of the material, with regions that do not bind
  std::unique_ptr<ElasticSolver> linear_;
  std::vector<double> minimum_;  // after the last move
  std::map<std::string, std::unique_ptr<Simulation>> passes_;
  std::map<std::string, std::vector<int>> counts_;
};

void run(const report::SuiteExperiment& experiment) {
  const report::Case object = experiment.cases({}).front();
  for (const report::RecordedMoves& drag : object.drags) {
    WarmStarts starts(object, drag);
    for (const Command& command : drag.commands) {
      if (const auto* move = std::get_if<commands::Drag>(&command)) {
        starts.move(*move);
      }
    }
    std::printf("%s, %s:\n", std::string(experiment.name).c_str(), drag.name.c_str());
    starts.print();
  }
}

}  // namespace
}  // namespace chainmail::bench

int main() {
  for (const auto& experiment : chainmail::report::suite_experiments()) {
    if (experiment.kind == chainmail::report::SuiteKind::time_to_error && !experiment.needs_organ()) {
      chainmail::bench::run(experiment);
    }
  }
}
