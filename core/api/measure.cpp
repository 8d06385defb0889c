#include "chainmail/measure.h"

#include <algorithm>

#include "api/access.h"
#include "equilibrium/link_energy.h"
#include "measure/distance.h"
#include "measure/physical_error.h"
#include "measure/violation.h"

namespace chainmail::api {
namespace {

constexpr double preparation_share = 0.3;  // of the time of a reference solution, roughly

PhysicalError error_of(const inner::PhysicalError& error) { return {error.relative, error.rms, error.max}; }

}  // namespace

Violation violation(const Body& body) {
  const inner::Body& impl = Access::body(body);
  const inner::Violation all = measure_violation(impl.mesh(), impl.softness(), impl.cuts(), impl.positions());
  return {all.max, all.rms, all.fraction, all.links};
}

double violation(const Body& body, LinkId link) {
  const inner::Body& impl = Access::body(body);
  check_link_ids(impl.mesh(), std::span(&link, 1));
  return link_violation(impl.mesh(), impl.softness(), impl.positions(), link);
}

Spread displacement(const Body& body) {
  const inner::Displacement all = measure_displacement(Access::body(body).mesh(), Access::body(body).positions());
  return {all.max, all.rms};
}

Spread distance(const Body& one, const Body& other) {
  if (one.mesh() != other.mesh()) {
    throw Error("distance", "the two objects have different meshes", "use two bodies of one mesh");
  }
  const Distance apart =
      measure_distance(Access::body(one).mesh(), Access::body(one).positions(), Access::body(other).positions());
  return {apart.max, apart.rms};
}

Spread distance(const Body& body, std::span<const double> positions) {
  const inner::Mesh& mesh = Access::body(body).mesh();
  const std::vector<double> coordinates =
      active_coordinates_of(mesh, positions, position_limit(inner::Precision::double_precision));
  const Distance apart =
      measure_distance(mesh, Access::body(body).positions(),
                       {coordinates.data(), sizeof(double) * static_cast<std::size_t>(mesh.space_dimension),
                        inner::Precision::double_precision});
  return {apart.max, apart.rms};
}

double elastic_energy(const Body& body) {
  const inner::Body& impl = Access::body(body);
  return inner::elastic_energy(impl.mesh(), impl.softness(), impl.cuts(), impl.positions(), impl.elastic());
}

std::vector<double> ReferenceSolution::positions() const {
  const inner::Mesh& mesh = *impl_->mesh;
  std::vector<double> coordinates = mesh.rest;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    coordinates[i] += impl_->reference.displacements[i];
  }
  return positions_of(mesh, {coordinates.data(), sizeof(double) * static_cast<std::size_t>(mesh.space_dimension),
                             inner::Precision::double_precision});
}

double ReferenceSolution::handle_displacement() const { return impl_->reference.handle_displacement; }

ReferenceSolution reference_solution(const Body& body, const std::vector<ElementId>& handle, const Job& job) {
  return guarded([&] {
    const inner::Body& impl = Access::body(body);
    const inner::Handle grabbed(impl, handle);  // checks the elements
    const std::vector<double> displacements = displacements_of(impl.mesh(), impl.positions(), grabbed.elements());
    if (std::ranges::all_of(displacements, [](double one) { return one == 0; })) {
      throw inner::Error("handle", "it is at rest, so there is nothing to compare with", "move it first");
    }
    const auto pins = impl.pins();
    if (pins.empty()) {
      throw inner::Error("pins", "nothing pins the object, so physics has no solution", "pin a side or some elements");
    }
    const Progress progress = Access::progress(job);
    ReferenceSolver solver({.mesh = impl.mesh_pointer(),
                            .cuts = impl.cuts(),
                            .pins = {pins.begin(), pins.end()},
                            .pinned = displacements_of(impl.mesh(), impl.positions(), pins),
                            .options = impl.elastic()},
                           progress.part(0, preparation_share));
    const std::vector<ElementId> elements(grabbed.elements().begin(), grabbed.elements().end());
    return Access::make<ReferenceSolution>(impl.mesh_pointer(),
                                           solver.at(elements, displacements, progress.part(preparation_share, 1)));
  });
}

PhysicalError physical_error(const Body& body, const ReferenceSolution& reference) {
  const auto& [mesh, solution] = Access::impl(reference);
  const inner::Body& impl = Access::body(body);
  if (mesh != impl.mesh_pointer()) {
    throw Error("reference solution", "it is of another mesh", "compute it for this object");
  }
  return error_of(measure_physical_error(*mesh, impl.positions(), solution));
}

PhysicalError physical_error_of_rest(const ReferenceSolution& reference) {
  const auto& [mesh, solution] = Access::impl(reference);
  return error_of(error_of_nothing_moving(*mesh, solution));
}

}  // namespace chainmail::api
