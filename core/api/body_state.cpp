#include "api/body_state.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace chainmail::api {
namespace {

void check_reach(const inner::Body::Reach& reach) {
  for (const double one : {reach.since_rest, reach.since_check}) {
    if (!(one >= 0 && std::isfinite(one))) {
      throw Error("body", "the size of its moves is not a finite number", "use the state of a body");
    }
  }
}

}  // namespace

ElementBlocks every_block(const inner::Mesh& mesh) {
  ElementBlocks all(mesh.element_count());
  all.insert_all();
  return all;
}

inner::Snapshot snapshot_of(const inner::Body& body) {
  return body.is_at_rest() ? body.snapshot(ElementBlocks(body.mesh().element_count()))
                           : body.snapshot(every_block(body.mesh()));
}

BodyState state_of(const Body& body) {
  const auto& impl = Access::impl(body);
  inner::Body& from = impl.solver->body();
  return {.precision = from.precision(),
          .works_in_axes = from.works_in_axes(),
          .stores_displacements = from.stores_displacements(),
          .softness = from.shared_softness(),
          .elastic = from.elastic(),
          .cuts = from.cuts().links(),
          .pins = {from.pins().begin(), from.pins().end()},
          .positions = snapshot_of(from),
          .reach = from.reach(),
          .handle = impl.handle,
          .is_held = impl.is_held};
}

Body body_of(const Mesh& mesh, const BodyState& state) {
  Body result(mesh, state.precision == inner::Precision::single_precision ? Precision::single_precision
                                                                          : Precision::double_precision);
  auto& impl = Access::impl(result);
  inner::Body& body = impl.body();
  body.work_in_axes(state.works_in_axes);
  body.store_displacements(state.stores_displacements);
  body.set_softness(state.softness);
  body.set_elastic(state.elastic);
  body.cut(state.cuts);
  body.pin(state.pins);
  if (!state.positions.is_at_rest()) {
    body.restore(state.positions, every_block(body.mesh()));
  }
  body.reach() = state.reach;
  impl.handle = state.handle;
  impl.is_held = state.is_held;
  return result;
}

void check(const BodyState& state, const inner::Mesh& mesh) {
  guarded([&] {
    inner::check(state.softness->global);
    for (const auto& [link, softness] : state.softness->links) {
      inner::check_links(mesh, std::span(&link, 1));
      inner::check(softness);
    }
    inner::check(state.softness->axes, mesh);
    inner::check(state.elastic);
    inner::check_links(mesh, state.cuts);
    for (const auto* elements : {&state.pins, &state.handle}) {
      check_ids(mesh, *elements);
    }
    inner::check(state.positions, mesh, state.precision);
    inner::check(state.positions.axes, mesh);
  });
  check_reach(state.reach);
  if (std::ranges::adjacent_find(state.handle, std::greater_equal()) != state.handle.end()) {
    throw Error("body", "the elements of its handle are not ascending", "use the state of a body");
  }
}

}  // namespace chainmail::api
