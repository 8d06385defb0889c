// Bodies and snapshots as bytes, for another process: pickle.
#include <pybind11/stl.h>

#include "api/state.h"
#include "python/arrays.h"
#include "python/module.h"
#include "python/own_softness.h"
#include "python/pickling.h"
#include "python/words.h"

namespace chainmail::python {
namespace {

using api::Access;

py::tuple tuple_of_point(const Point& point) { return py::make_tuple(point.x(), point.y(), point.z()); }

Point point_from(const StateFields& state, const char* name) {
  const auto [x, y, z] = state.get<std::array<double, 3>>(name);
  return {x, y, z};
}

/// Puts positions as runs of elements away from rest.
void put_positions(py::dict& state, const chainmail::Snapshot& positions, const chainmail::Mesh& mesh) {
  const PositionRuns runs = runs_of(positions, mesh);
  state["from_rest"] = runs.from_rest;
  state["runs"] = bytes_of(runs.runs);
  state["held"] = bytes_of(runs.held);
  state["frame"] = tuple_of_point(runs.axes.rotation());
}

chainmail::Snapshot positions_from(const StateFields& state, const chainmail::Mesh& mesh,
                                   chainmail::Precision precision) {
  const RegionAxes frame(AxesKind::given, point_from(state, "frame"));
  check(frame, mesh);
  return chainmail::snapshot_of(
      {state.get<bool>("from_rest"), state.ids("runs"), state.reals("held"), frame.is_turned() ? frame : RegionAxes()},
      mesh, precision);
}

void put_softness(py::dict& state, const Softness& softness) {
  std::vector<LinkId> links;
  std::vector<double> numbers;
  for (const auto& [link, own] : softness.links) {
    links.push_back(link);
    for (const SoftnessNumber& number : softness_numbers) {
      numbers.push_back(own.*number.value);
    }
  }
  state["softness"] = api::softness_of(softness.global);
  state["own_links"] = bytes_of(links);
  state["own_softness"] = bytes_of(numbers);
  state["energy"] = word_for(api::energy_of(softness.energy));
  state["axes"] = axes_kinds[std::size_t(softness.axes.kind())];
  state["turned_by"] = tuple_of_point(softness.axes.rotation());
}

OwnSoftness own_softness_from(const StateFields& state, const chainmail::Mesh& mesh) {
  const std::vector<LinkId> links = state.ids("own_links");
  const std::vector<double> numbers = state.reals("own_softness");
  check_links(mesh, links);
  if (numbers.size() != links.size() * softness_numbers.size()) {
    state.refuse("own_softness");
  }
  std::vector<std::pair<LinkId, chainmail::LinkSoftness>> entries;
  auto next = numbers.begin();
  for (const LinkId link : links) {
    auto& softness = entries.emplace_back(link, chainmail::LinkSoftness()).second;
    for (const SoftnessNumber& number : softness_numbers) {
      softness.*number.value = *next++;
    }
  }
  return grouped(std::move(entries));
}

Softness whole_softness_from(const StateFields& state, const chainmail::Mesh& mesh) {
  const std::vector<std::string_view> kinds(axes_kinds.begin(), axes_kinds.end());
  const auto kind = AxesKind(word_of("axes", state.get<std::string>("axes"), kinds));
  return {api::softness_of(state.get<api::LinkSoftness>("softness")), own_softness_from(state, mesh),
          api::energy_of(energy_of(state.get<std::string>("energy"))),
          kind == AxesKind::axes ? RegionAxes() : RegionAxes(kind, point_from(state, "turned_by"))};
}

py::object body_parts(Object& object) {
  const UseObject use(object);
  const api::Body& body = object.body();
  const api::BodyState from = api::state_of(body);
  py::dict state;
  state["mesh"] = shared_mesh(body.mesh());
  state["precision"] = word_for(body.precision());
  state["works_in_axes"] = from.works_in_axes;
  state["stores_displacements"] = from.stores_displacements;
  put_softness(state, *from.softness);
  state["elasticity"] = body.elasticity();
  state["cuts"] = bytes_of(from.cuts);
  state["pins"] = bytes_of(from.pins);
  put_positions(state, from.positions, *Access::pointer(body.mesh()));
  state["reach"] = py::make_tuple(from.reach.since_rest, from.reach.since_check);
  state["handle"] = bytes_of(from.handle);
  state["is_held"] = from.is_held;
  return state;
}

api::BodyState body_state_from(const StateFields& state, const chainmail::Mesh& mesh) {
  const auto elasticity = state.get<api::Elasticity>("elasticity");
  const auto [since_rest, since_check] = state.get<std::pair<double, double>>("reach");
  const auto precision = api::precision_of(precision_of(state.get<std::string>("precision")));
  return {.precision = precision,
          .works_in_axes = state.get<bool>("works_in_axes"),
          .stores_displacements = state.get<bool>("stores_displacements"),
          .softness = std::make_shared<const Softness>(whole_softness_from(state, mesh)),
          .elastic = {{elasticity.young, elasticity.poisson}, elasticity.control_points, elasticity.iterations},
          .cuts = state.ids("cuts"),
          .pins = state.ids("pins"),
          .positions = positions_from(state, mesh, precision),
          .reach = {since_rest, since_check},
          .handle = state.ids("handle"),
          .is_held = state.get<bool>("is_held")};
}

ObjectPointer body_from(const py::object& parts) {
  const StateFields fields("Body", parts);
  const auto mesh = fields.get<api::Mesh>("mesh");
  return api::guarded([&] {
    const api::BodyState state = body_state_from(fields, *Access::pointer(mesh));
    check(state, *Access::pointer(mesh));
    return std::make_shared<Object>(body_of(mesh, state));
  });
}

py::object snapshot_parts(const api::Snapshot& snapshot) {
  const auto& [positions, mesh, precision] = Access::impl(snapshot);
  py::dict state;
  state["mesh"] = shared_mesh(mesh);
  state["precision"] = precision_words[precision == chainmail::Precision::single_precision ? 0 : 1];
  put_positions(state, positions, *Access::pointer(mesh));
  return state;
}

api::Snapshot snapshot_from(const py::object& parts) {
  const StateFields fields("Snapshot", parts);
  const auto mesh = fields.get<api::Mesh>("mesh");
  const auto precision = api::precision_of(precision_of(fields.get<std::string>("precision")));
  return api::guarded([&] {
    return Access::make<api::Snapshot>(positions_from(fields, *Access::pointer(mesh), precision), mesh, precision);
  });
}

}  // namespace

void add_body_state(BodyClass& body, SnapshotClass& snapshot) {
  add_pickling(body, &body_parts, &body_from);
  add_pickling(snapshot, &snapshot_parts, &snapshot_from);
}

}  // namespace chainmail::python
