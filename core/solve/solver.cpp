#include "solve/solver.h"

#include <new>
#include <string>
#include <utility>

#include "mesh/error.h"

namespace chainmail {

Solver::Solver(MeshPointer mesh, Algorithm algorithm, Precision precision)
    : body_((check(algorithm, *mesh), std::move(mesh)), precision), algorithm_(info(algorithm)) {
  body_.store_displacements(algorithm_.from_rest);
}

void Solver::set_algorithm(Algorithm algorithm) {
  check(algorithm, body_.mesh());
  if (algorithm == algorithm_.algorithm) {
    return;
  }
  body_.store_displacements(info(algorithm).from_rest);
  algorithm_ = info(algorithm);
  method_.reset();
}

Method& Solver::method() {
  if (!method_) {
    method_ = algorithm_.make(body_.precision(), body_.mesh().space_dimension);
  }
  return *method_;
}

/// Runs a pass. If memory runs out in the middle of it, the next pass uses nothing of it.
template <class Pass>
PassCount Solver::run(Pass pass) {
  try {
    const PassCount count = pass(method());
    body_.note_move();
    return count;
  } catch (const std::bad_alloc&) {
    body_.note_move();
    moved_.clear();
    method_.reset();
    throw;
  }
}

PassCount Solver::move(Handle& handle, const Pose& target, Trace* trace) {
  check_free(body_, handle.elements());
  HandleMove move{handle, target};
  const PassCount count = run([&](Method& method) { return method.move(body_, move, {moved_, trace, progress_}); });
  handle.set_pose(move.pose);
  return count;
}

PassCount Solver::move(ElementId element, const Point& target, Trace* trace) {
  if (!single_ || single_->elements()[0] != element) {
    single_.emplace(body_, std::vector<ElementId>{element});
  }
  return move(*single_, {target, Point::Zero()}, trace);
}

std::span<const double> Solver::control_points() {
  return algorithm_.has_control_points ? method().control_points(body_, progress_) : std::span<const double>();
}

PassCount Solver::move_control_point(std::size_t point, const Point& target) {
  if (point >= control_points().size() / static_cast<std::size_t>(body_.mesh().space_dimension)) {
    throw Error("control point " + std::to_string(point), "there is no such point",
                "choose free-form deformation, and one of its points");
  }
  return run([&](Method& method) {
    return method.move_control_point(body_, point, target, {moved_, nullptr, progress_});
  });
}

std::unique_ptr<Solver> make_solver(const MeshPointer& mesh, Algorithm algorithm, Precision precision) {
  return std::make_unique<Solver>(mesh, algorithm, precision);
}

}  // namespace chainmail
