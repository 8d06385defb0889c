#include "report/run/peer.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/cuts.h"
#include "mesh/error.h"
#include "report/run/contest.h"
#include "report/run/suite_experiments.h"

namespace chainmail::report {
namespace {

// A prescribed element may be so far from its place (mean rest lengths): solvers compute in float too.
constexpr double allowed_off = 1e-3;

/// Returns the coordinates of points on the axes that exist.
std::vector<double> on_axes(const Mesh& mesh, const std::vector<Point>& points) {
  std::vector<double> all;
  for (const Point& point : points) {
    for (int k = 0; k < mesh.space_dimension; ++k) {
      all.push_back(point[mesh.axes[std::size_t(k)]]);
    }
  }
  return all;
}

ReferenceSolution reference_of(const PeerCase& object) {
  const Mesh& mesh = *object.mesh;
  ReferenceSolution reference;
  reference.displacements = on_axes(mesh, object.reference);
  std::ranges::transform(reference.displacements, mesh.rest, reference.displacements.begin(), std::minus());
  for (const ElementId element : object.handle) {
    const Point way = object.reference[element] - mesh.rest_position(element);
    reference.handle_displacement = std::max(reference.handle_displacement, way.norm());
  }
  reference.prescribed = object.pins;
  reference.prescribed.insert(reference.prescribed.end(), object.handle.begin(), object.handle.end());
  reference.only_free = true;
  return reference;
}

void check_place(const PeerCase& object, const PeerAnswer& answer, ElementId element, const Point& place,
                 const std::string& what) {
  const double off = (answer.positions[element] - place).norm();
  if (!(off <= allowed_off * object.mesh->mean_link_length)) {
    throw Error(answer.solver, "element " + std::to_string(element) + " of the " + what + " is not at its place",
                "write the positions after the last move, with the " + what + " where the case has them");
  }
}

void check(const PeerCase& object, const PeerAnswer& answer) {
  if (answer.case_name != object.name) {
    throw Error(answer.solver, "it answers another case, " + answer.case_name.substr(0, 60),
                "judge it with the file of that case");
  }
  if (answer.positions.size() != object.mesh->element_count()) {
    throw Error(answer.solver,
                "it has positions of " + std::to_string(answer.positions.size()) + " elements, the case has " +
                    std::to_string(object.mesh->element_count()),
                "write one position for each element, in the order of the case");
  }
  if (!answer.moves_ms.empty() && answer.moves_ms.size() != object.moves.size()) {
    throw Error(answer.solver,
                "it has times of " + std::to_string(answer.moves_ms.size()) + " moves, the case has " +
                    std::to_string(object.moves.size()),
                "write the time of each move, or none");
  }
  for (const ElementId pin : object.pins) {
    check_place(object, answer, pin, object.mesh->rest_position(pin), "pins");
  }
  for (std::size_t i = 0; i < object.handle.size(); ++i) {
    check_place(object, answer, object.handle[i], object.moves.back()[i], "handle");
  }
}

Row row_of(const PeerCase& object, const PeerAnswer& answer) {
  check(object, answer);
  const Mesh& mesh = *object.mesh;
  const std::vector<double> positions = on_axes(mesh, answer.positions), reference = on_axes(mesh, object.reference);
  Row row{.drag = 0, .contestant = {.solver = answer.solver}};
  const PhysicalError error = measure_physical_error(mesh, view_of(mesh, positions), reference_of(object));
  if (!std::isfinite(error.relative)) {
    throw Error(answer.solver, "its error is not a number: positions are too large, or nothing moves in the case",
                "check the positions of the answer and of the case");
  }
  add_error(row, error);
  row.set(figures::reference_change, object.reference_change);
  add_shape(row, mesh, Softness(), Cuts(object.mesh), view_of(mesh, positions), view_of(mesh, reference));
  row.set(figures::factorize_ms, answer.factorize_ms);
  row.set(figures::grab_ms, answer.grab_ms);
  if (const auto& ms = answer.moves_ms; !ms.empty()) {
    row.set(figures::first_ms, ms.front());
    if (ms.size() > 1) {
      row.set(figures::later_ms, std::accumulate(ms.begin() + 1, ms.end(), 0.0) / double(ms.size() - 1));
    }
  }
  return row;
}

}  // namespace

PeerCase peer_case(const Case& object, const RecordedMoves& drag, const DragReference& reference) {
  const Mesh& mesh = *object.mesh;
  PeerCase one{object.name + "-" + drag.name,
               drag.description,
               object.mesh,
               object.pins,
               grabbed_by(drag),
               {},
               {},
               {},
               std::nullopt};
  one.elastic = object.elastic;
  one.elastic.law = object.law;
  std::ranges::sort(one.pins);
  const Point middle = middle_of(mesh, one.handle);
  for (std::size_t i = 0; i < drag.commands.size(); ++i) {
    if (std::holds_alternative<commands::Drag>(drag.commands[i])) {
      RecordedMoves so_far = drag;
      so_far.commands.erase(so_far.commands.begin() + std::ptrdiff_t(i) + 1, so_far.commands.end());
      const RigidMotion motion = motion_at_end(mesh, so_far);
      std::vector<Point>& places = one.moves.emplace_back();
      for (const ElementId element : one.handle) {
        const Point rest = mesh.rest_position(element);
        places.push_back(rest + motion.of(rest - middle));
      }
    }
  }
  const auto n = std::size_t(mesh.space_dimension);
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    Point at = mesh.rest_position(e);
    for (std::size_t k = 0; k < n; ++k) {
      at[mesh.axes[k]] += reference.solution.displacements[e * n + k];
    }
    one.reference.push_back(at);
  }
  one.reference_change = reference.change();
  return one;
}

std::vector<PeerCase> peer_cases_of_suite(const SampleOrgans& organs) {
  std::vector<PeerCase> cases;
  for (const SuiteExperiment& one : suite_experiments()) {
    if (one.kind == SuiteKind::time_to_error && !one.only_named && (organs.fine != nullptr || !one.needs_organ())) {
      const Case object = one.cases(organs).front();
      const RecordedMoves& drag = object.drags.front();
      cases.push_back(peer_case(object, drag, DragReferences(object, reference_of(one)).at_end(drag)));
    }
  }
  return cases;
}

Results judge(const PeerCase& object, const std::vector<PeerAnswer>& answers) {
  Results results{.kind = ReportKind::judge};
  results.objects.push_back({.name = object.name,
                             .description = object.description,
                             .elements = object.mesh->element_count(),
                             .links = object.mesh->link_count(),
                             .pins = object.pins.size(),
                             .drags = {{.name = "answer", .moves = int(object.moves.size())}}});
  for (const PeerAnswer& answer : answers) {
    results.rows.push_back(row_of(object, answer));
  }
  return results;
}

}  // namespace chainmail::report
