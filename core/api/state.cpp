#include "chainmail/state.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "api/access.h"
#include "api/body_state.h"
#include "api/state_fields.h"
#include "body/handle.h"
#ifdef CHAINMAIL_HAS_JSON  // the checks of a mesh are those of sessions
#include "files/session/flat_mesh.h"
#endif

namespace chainmail::api {
namespace {

constexpr std::array precision_names{"float", "double"};

std::vector<double> row_of(const Point& point) { return {point.x(), point.y(), point.z()}; }

Point point_from(StateFields& state, std::string_view name) {
  const auto [x, y, z] = state.row<3>(name);
  return {x, y, z};
}

std::string name_of(inner::Precision precision) {
  return precision_names[precision == inner::Precision::single_precision ? 0 : 1];
}

inner::Precision precision_from(StateFields& state) {
  const auto name_at = [](std::size_t i) { return std::string_view(precision_names[i]); };
  return state.word("precision", precision_names.size(), name_at) == 0 ? inner::Precision::single_precision
                                                                       : inner::Precision::double_precision;
}

/// Puts positions as runs of elements away from rest.
void put_positions(State& state, const inner::Snapshot& positions, const inner::Mesh& mesh) {
  PositionRuns runs = runs_of(positions, mesh);
  state["from_rest"] = runs.from_rest;
  state["runs"] = std::move(runs.runs);
  state["held"] = std::move(runs.held);
  state["axes_of_positions"] = row_of(runs.axes.rotation());
}

inner::Snapshot positions_from(StateFields& state, const inner::Mesh& mesh, inner::Precision precision) {
  const RegionAxes axes(AxesKind::given, point_from(state, "axes_of_positions"));
  inner::check(axes, mesh);
  return inner::snapshot_of(
      {state.flag("from_rest"), state.ids("runs"), state.reals("held"), axes.is_turned() ? axes : RegionAxes()}, mesh,
      precision);
}

void append(std::vector<double>& numbers, const inner::LinkSoftness& softness) {
  for (const inner::SoftnessNumber& one : inner::softness_numbers) {
    numbers.push_back(softness.*one.value);
  }
}

inner::LinkSoftness softness_at(std::span<const double> numbers) {
  inner::LinkSoftness softness;
  for (std::size_t i = 0; i < inner::softness_numbers.size(); ++i) {
    softness.*inner::softness_numbers[i].value = numbers[i];
  }
  return softness;
}

void put_own_softness(State& state, const OwnSoftness& softness) {
  std::vector<LinkId> links;
  std::vector<double> numbers;
  for (const auto& [link, own] : softness) {
    links.push_back(link);
    append(numbers, own);
  }
  state["own_links"] = std::move(links);
  state["own_softness"] = std::move(numbers);
}

OwnSoftness own_softness_from(StateFields& state, const inner::Mesh& mesh) {
  const std::vector<LinkId> links = state.ids("own_links");
  const std::vector<double> numbers = state.reals("own_softness");
  inner::check_links(mesh, links);
  std::vector<LinkId> ascending = links;
  std::ranges::sort(ascending);
  if (std::ranges::adjacent_find(ascending) != ascending.end()) {
    state.refuse("own_links");
  }
  const std::size_t columns = inner::softness_numbers.size();
  if (numbers.size() != links.size() * columns) {
    state.refuse("own_softness");
  }
  std::vector<OwnSoftness::Entry> entries;
  for (std::size_t i = 0; i < links.size(); ++i) {
    entries.emplace_back(links[i], softness_at(std::span(numbers).subspan(i * columns, columns)));
    inner::check(entries.back().second);
  }
  return own_softness_of(std::move(entries));
}

void put_softness(State& state, const Softness& softness) {
  std::vector<double> common;
  append(common, softness.global);
  state["softness"] = std::move(common);
  put_own_softness(state, softness.links);
  state["energy"] = std::string(info(softness.energy).name);
  state["axes"] = std::string(axes_kinds[std::size_t(softness.axes.kind())]);
  state["turned_by"] = row_of(softness.axes.rotation());
}

Softness softness_from(StateFields& state, const inner::Mesh& mesh) {
  const std::span<const inner::EnergyKindInfo> kinds = inner::energy_kinds();
  const auto energy =
      inner::EnergyKind(state.word("energy", kinds.size(), [kinds](std::size_t i) { return kinds[i].name; }));
  const auto kind =
      AxesKind(state.word("axes", axes_kinds.size(), [](std::size_t i) { return std::string_view(axes_kinds[i]); }));
  return {softness_at(state.row<inner::softness_numbers.size()>("softness")), own_softness_from(state, mesh), energy,
          kind == AxesKind::axes ? RegionAxes() : RegionAxes(kind, point_from(state, "turned_by"))};
}

void put_elastic(State& state, const ElasticOptions& elastic) {
  state["young"] = elastic.material.young;
  state["poisson"] = elastic.material.poisson;
  state["control_points"] = std::vector<std::uint32_t>(elastic.lattice.begin(), elastic.lattice.end());
  state["iterations"] = std::int64_t(elastic.iterations);
  state["law"] = name(elastic.law.kind);
  state["gent_limit"] = elastic.law.gent_limit;
  state["fung_exponent"] = elastic.law.fung_exponent;
  state["thickness"] = elastic.thickness;
}

ElasticOptions elastic_from(StateFields& state) {
  const std::vector<std::uint32_t> points = state.ids("control_points");
  if (points.size() != 3) {
    state.refuse("control_points");
  }
  const auto kind =
      state.word("law", inner::strain_laws.size(), [](std::size_t i) { return name(inner::strain_laws[i]); });
  return {{state.real("young"), state.real("poisson")},
          {points[0], points[1], points[2]},
          std::uint32_t(state.whole("iterations", 0, std::numeric_limits<std::uint32_t>::max())),
          {inner::strain_laws[kind], state.real("gent_limit"), state.real("fung_exponent")},
          state.real("thickness")};
}

BodyState body_state_from(StateFields& state, const inner::Mesh& mesh) {
  const inner::Precision precision = precision_from(state);
  const auto [since_rest, since_check] = state.row<2>("reach");
  return {.precision = precision,
          .works_in_axes = state.flag("works_in_axes"),
          .stores_displacements = state.flag("stores_displacements"),
          .softness = std::make_shared<const Softness>(softness_from(state, mesh)),
          .elastic = elastic_from(state),
          .cuts = state.ids("cuts"),
          .pins = state.ids("pins"),
          .positions = positions_from(state, mesh, precision),
          .reach = {since_rest, since_check},
          .handle = state.ids("handle"),
          .is_held = state.flag("is_held")};
}

/// Returns three numbers for each step: the element, its sponsor, and 1 if it moved.
std::vector<std::uint32_t> flat_trace(const std::vector<TraceStep>& trace) {
  std::vector<std::uint32_t> flat;
  for (const TraceStep& step : trace) {
    flat.insert(flat.end(), {step.element, step.sponsor, step.moved ? 1U : 0U});
  }
  return flat;
}

std::vector<TraceStep> trace_from(StateFields& state, ElementId element_count) {
  const std::vector<std::uint32_t> flat = state.ids("trace");
  if (flat.size() % 3 != 0) {
    state.refuse("trace");
  }
  std::vector<TraceStep> trace;
  for (std::size_t i = 0; i < flat.size(); i += 3) {
    if (flat[i] >= element_count || (flat[i + 1] >= element_count && flat[i + 1] != no_sponsor)) {
      state.refuse("trace");
    }
    trace.push_back({flat[i], flat[i + 1], flat[i + 2] != 0});
  }
  return trace;
}

DeformerState deformer_state_from(StateFields&& state, ElementId element_count) {
  const auto scheme_at = [](std::size_t i) { return inner::relaxation_schemes[i].name; };
  return {.method = state.text("method"),
          .is_tracing = state.flag("is_tracing"),
          .trace = trace_from(state, element_count),
          .memory = {
              .relaxation = inner::RelaxationScheme(state.word("scheme", inner::relaxation_schemes.size(), scheme_at)),
              .threads = int(state.whole("threads", 0, std::numeric_limits<int>::max())),
              .moved = state.ids("moved"),
              .pending = {state.ids("relaxes_now"), state.ids("relaxes_next"), state.flag("in_sweep"),
                          state.real("largest_step")},
              .is_awake = state.flag("is_awake"),
              .method = state.reals("memory")}};
}

}  // namespace

#ifdef CHAINMAIL_HAS_JSON

State save(const Mesh& mesh) {
  const auto& [pointer, softness, conversion, flaws, remark, flaw_words] = Access::impl(mesh);
  FlatMesh flat = flat_mesh_of(*pointer);
  State state;
  state["rest"] = std::move(flat.rest);
  state["first_entry"] = std::move(flat.first_entry);
  state["neighbours"] = std::move(flat.neighbours);
  state["triangles"] = std::move(flat.triangles);
  state["polygons"] = std::move(flat.polygons);
  state["tetrahedra"] = std::move(flat.tetrahedra);
  state["hexahedra"] = std::move(flat.hexahedra);
  state["lattice"] = flat.lattice ? std::vector<std::uint32_t>(flat.lattice->size.begin(), flat.lattice->size.end())
                                  : std::vector<std::uint32_t>();
  state["spacing"] = flat.lattice ? flat.lattice->spacing : 0.0;
  state["space_dimension"] = flat.space_dimension;
  put_own_softness(state, softness);
  state["remark"] = remark;
  return state;
}

Mesh load_mesh(State from) {
  StateFields state("mesh", std::move(from));
  FlatMesh flat{.rest = state.reals("rest"),
                .first_entry = state.ids("first_entry"),
                .neighbours = state.ids("neighbours"),
                .triangles = state.ids("triangles"),
                .polygons = state.ids("polygons"),
                .tetrahedra = state.ids("tetrahedra"),
                .hexahedra = state.ids("hexahedra"),
                .lattice = {},
                .space_dimension = state.whole("space_dimension", std::numeric_limits<std::int64_t>::min(),
                                               std::numeric_limits<std::int64_t>::max())};
  if (const std::vector<std::uint32_t> size = state.ids("lattice"); size.size() == 3) {
    flat.lattice = Lattice{{size[0], size[1], size[2]}, state.real("spacing")};
  } else if (!size.empty()) {
    state.refuse("lattice");
  }
  return guarded([&] {
    MeshPointer mesh = checked_mesh(std::move(flat), state.where());
    OwnSoftness softness = own_softness_from(state, *mesh);
    return Access::mesh(std::move(mesh), std::move(softness), state.text("remark"));
  });
}

#else

State save(const Mesh& /*mesh*/) { refuse_without("nlohmann/json", "state of a mesh"); }
Mesh load_mesh(State /*state*/) { refuse_without("nlohmann/json", "state of a mesh"); }

#endif

State save(const Body& body) {
  BodyState from = state_of(body);
  State state;
  state["precision"] = name_of(from.precision);
  state["works_in_axes"] = from.works_in_axes;
  state["stores_displacements"] = from.stores_displacements;
  put_softness(state, *from.softness);
  put_elastic(state, from.elastic);
  state["cuts"] = std::move(from.cuts);
  state["pins"] = std::move(from.pins);
  put_positions(state, from.positions, *Access::pointer(body.mesh()));
  state["reach"] = std::vector<double>{from.reach.since_rest, from.reach.since_check};
  state["handle"] = std::move(from.handle);
  state["is_held"] = from.is_held;
  return state;
}

Body load_body(const Mesh& mesh, State from) {
  return guarded([&] {
    StateFields state("body", std::move(from));
    const BodyState values = body_state_from(state, *Access::pointer(mesh));
    check(values, *Access::pointer(mesh));
    return body_of(mesh, values);
  });
}

State save(const Snapshot& snapshot) {
  const auto& [positions, mesh, precision] = Access::impl(snapshot);
  State state;
  state["precision"] = name_of(precision);
  put_positions(state, positions, *Access::pointer(mesh));
  return state;
}

Snapshot load_snapshot(const Mesh& mesh, State from) {
  StateFields state("snapshot", std::move(from));
  return guarded([&] {
    const inner::Precision precision = precision_from(state);
    return Access::make<Snapshot>(positions_from(state, *Access::pointer(mesh), precision), mesh, precision);
  });
}

State save(const Handle& handle) {
  HandleState from = Access::impl(handle).handle.state();
  std::vector<double> positions;
  for (const Point& position : from.positions) {
    positions.insert(positions.end(), position.begin(), position.end());
  }
  State state;
  state["elements"] = std::move(from.elements);
  state["positions"] = std::move(positions);
  state["pivot"] = row_of(from.pose.pivot);
  state["rotation"] = row_of(from.pose.rotation);
  return state;
}

Handle load_handle(const Mesh& mesh, State from) {
  StateFields state("handle", std::move(from));
  const std::vector<double> numbers = state.reals("positions");
  if (numbers.size() % 3 != 0) {
    state.refuse("positions");
  }
  HandleState values{state.ids("elements"), {}, {point_from(state, "pivot"), point_from(state, "rotation")}};
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    values.positions.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  }
  return guarded([&] { return Access::handle(inner::Handle(*Access::pointer(mesh), std::move(values)), mesh); });
}

State save(Deformer& deformer) {
  DeformerState from = hand_over(deformer);
  SolverMemory& memory = from.memory;
  State state;
  state["method"] = from.method;
  state["is_tracing"] = from.is_tracing;
  state["trace"] = flat_trace(from.trace);
  state["scheme"] = std::string(info(memory.relaxation).name);
  state["threads"] = std::int64_t(memory.threads);
  state["moved"] = std::move(memory.moved);
  state["relaxes_now"] = std::move(memory.pending.now);
  state["relaxes_next"] = std::move(memory.pending.next);
  state["in_sweep"] = memory.pending.in_sweep;
  state["largest_step"] = memory.pending.largest_step;
  state["is_awake"] = memory.is_awake;
  state["memory"] = std::move(memory.method);
  return state;
}

namespace {

/// As the copy constructor of the map, which in libstdc++ 12 ends the program if memory runs out within a value: its
/// variant forgets that it holds none yet.
State copy_of(const State& state) {
  State copy;
  for (const auto& [name, value] : state) {
    copy[name] = std::visit([](const auto& held) { return StateValue(held); }, value);
  }
  return copy;
}

}  // namespace

void check_deformer(const Body& body, const State& state) {
  const DeformerState values =
      deformer_state_from(StateFields("deformer", copy_of(state)), body.mesh().element_count());
  guarded([&] { inner::check(values.memory, Access::body(body)); });
}

void load(Deformer& deformer, State state) {
  const DeformerState values =
      deformer_state_from(StateFields("deformer", std::move(state)), deformer.body().mesh().element_count());
  if (values.method != deformer.method()) {
    throw Error("state of a deformer", "it is of the method '" + values.method.substr(0, 60) + "'",
                "load it into a deformer with that method");
  }
  take_over(deformer, values);
}

}  // namespace chainmail::api
