#include "report/run/drag_reference.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/error.h"
#include "report/run/preparing.h"
#include "solver/algorithms.h"

namespace chainmail::report {
namespace {

void check_pins_and_cuts(const std::string& name, bool has_pins, bool has_cuts) {
  if (!has_pins) {
    throw Error(name, "nothing pins it, so physics has no solution", "pin a side, the boundary, or elements");
  }
  if (has_cuts) {
    throw Error(name, "it is cut, and the reference is for an object that is whole at rest", "undo the cuts");
  }
}

ReferenceSolver solver_of(const Case& object, const std::vector<LinkId>& cut) {
  try {
    return ReferenceSolver(reference_problem(object, cut));
  } catch (const Error& error) {
    throw error.at(object.name);
  }
}

void add_axes(std::vector<double>& to, const Mesh& mesh, const Point& displacement) {
  for (int k = 0; k < mesh.space_dimension; ++k) {
    to.push_back(displacement[mesh.axes[std::size_t(k)]]);
  }
}

/// Returns the displacements of the handle's elements at the end of a drag.
std::vector<double> displacements_of_handle(const Mesh& mesh, const RecordedMoves& moves) {
  const std::vector<ElementId> handle = grabbed_by(moves);
  const RigidMotion motion = motion_at_end(mesh, moves);
  const Point middle = middle_of(mesh, handle);
  std::vector<double> displacements;
  for (const ElementId element : handle) {
    add_axes(displacements, mesh, motion.of(mesh.rest_position(element) - middle));
  }
  return displacements;
}

/// The pins and the handle are where the drag has them: theory may differ from that by small terms.
ReferenceSolution closed_form_of(const Case& object, const RecordedMoves& moves) {
  const Mesh& mesh = *object.mesh;
  const auto n = std::size_t(mesh.space_dimension);
  const std::vector<ElementId> handle = grabbed_by(moves);
  const std::vector<double> of_handle = displacements_of_handle(mesh, moves);
  ReferenceSolution solution;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    add_axes(solution.displacements, mesh, moves.closed_form(mesh.rest_position(e)));
  }
  for (const ElementId pin : object.pins) {
    std::fill_n(solution.displacements.begin() + std::ptrdiff_t(pin * n), n, 0.0);
  }
  for (std::size_t i = 0; i < handle.size(); ++i) {
    const auto from = of_handle.begin() + std::ptrdiff_t(i * n);
    std::copy_n(from, n, solution.displacements.begin() + std::ptrdiff_t(handle[i] * n));
    const double square = std::inner_product(from, from + std::ptrdiff_t(n), from, 0.0);
    solution.handle_displacement = std::max(solution.handle_displacement, std::sqrt(square));
  }
  solution.prescribed = object.pins;
  solution.prescribed.insert(solution.prescribed.end(), handle.begin(), handle.end());
  solution.only_free = true;
  return solution;
}

}  // namespace

void check_reference(const std::string& name, const Mesh& mesh, bool has_pins, bool has_cuts) {
  check_pins_and_cuts(name, has_pins, has_cuts);
  try {
    chainmail::check(Algorithm::neo_hookean, mesh);
  } catch (const Error& error) {
    throw error.at(name);
  }
}

RigidMotion motion_at_end(const Mesh& mesh, const RecordedMoves& moves) {
  RigidMotion motion;
  for (const Command& command : moves.commands) {
    if (const auto* drag = std::get_if<commands::Drag>(&command)) {
      const Point from = drag->relative ? Point(Point::Zero()) : middle_of(mesh, grabbed_by(moves));
      motion = {turn_of(drag->rotation.vector()), drag->target - from};
    }
  }
  return motion;
}

DragReferences::DragReferences(const Case& object, const std::optional<ConvergingOptions>& refine)
    : object_(object), refine_(refine) {
  check_pins_and_cuts(object.name, !object.pins.empty(), !object.cuts.empty());
  if (!refine_ || !refine_->every_level) {
    solver_.emplace(solver_of(object, {}));  // refuses at once what has no solution
  }
}

DragReference DragReferences::at_end(const RecordedMoves& moves) {
  if (moves.closed_form) {
    return {closed_form_of(object_, moves), std::nullopt, true};
  }
  const Mesh& mesh = *object_.mesh;
  const std::vector<ElementId> handle = grabbed_by(moves);
  const std::vector<LinkId> cut = cuts_of(moves);
  if (refine_ && (handle.size() > 1 || moves.radius > 0)) {
    if (cut.empty() && !refined_) {
      refined_.emplace(reference_problem(object_), *refine_);
    }
    const RigidMotion motion = motion_at_end(mesh, moves);
    const ConvergedReference found =
        cut.empty() ? refined_->at(handle, motion)
                    : ConvergingReference(reference_problem(object_, cut), *refine_).at(handle, motion);
    return {found.solution, found};
  }
  std::optional<ReferenceSolver> with_cut;
  if (!cut.empty()) {
    with_cut.emplace(solver_of(object_, cut));
  } else if (!solver_) {
    solver_.emplace(solver_of(object_, {}));
  }
  return {(with_cut ? *with_cut : *solver_).at(handle, displacements_of_handle(mesh, moves))};
}

}  // namespace chainmail::report
