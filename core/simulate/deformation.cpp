#include "simulate/deformation.h"

#include <chrono>
#include <cmath>
#include <utility>

#include "equilibrium/link_energy.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr std::uint64_t max_traced = 50'000'000;  // rows, which are in memory until they are written

/// Returns the position at a share of the way. std::lerp ends exactly at the target, and does not overflow.
Point between(const Point& from, const Point& to, double share) {
  return {std::lerp(from.x(), to.x(), share), std::lerp(from.y(), to.y(), share), std::lerp(from.z(), to.z(), share)};
}

}  // namespace

Deformation::Deformation(MeshPointer mesh, Algorithm algorithm, Precision precision, EachPass each)
    : simulation_(std::move(mesh), algorithm, precision), each_(std::move(each)) {}

void Deformation::apply(const Command& command) {
  if (const auto* drag = std::get_if<commands::Drag>(&command)) {
    pass(*drag);
    return;
  }
  simulation_.apply(command);
  if (std::holds_alternative<commands::Grab>(command)) {
    handle_ = {Point::Zero(), {}, true};
  }
}

void Deformation::move(ElementId element, const Point& target, std::uint32_t steps) {
  check_element(simulation_.mesh(), element);
  const Point start = point_of(simulation_.mesh(), simulation_.body().positions(), element);
  apply(commands::Grab{element});
  for (std::uint32_t step = 1; step <= steps; ++step) {
    pass({between(start, target, double(step) / steps)});
  }
  apply(commands::Release{});
}

void Deformation::move_handle(const Point& by, const Rotation& rotation, std::uint32_t steps) {
  const commands::Drag from = handle_;
  for (std::uint32_t step = 1; step <= steps; ++step) {
    const double share = double(step) / steps;
    pass({between(from.target, from.target + by, share),
          composed(from.rotation, {rotation.axis, share * rotation.degrees}), true});
  }
}

void Deformation::pass(const commands::Drag& drag) {
  Trace trace;
  simulation_.set_trace(each_.traced ? &trace : nullptr);
  simulation_.apply(drag);
  simulation_.set_trace(nullptr);
  const Statistics& statistics = simulation_.statistics();
  const Handle& held = *simulation_.last_handle();
  const auto elements = held.elements();
  const Point grabbed_at = held.grabbed().pivot;
  handle_ = {drag.relative ? drag.target : Point(drag.target - grabbed_at), drag.rotation, true};
  passes_.push_back({{elements.begin(), elements.end()},
                     drag.relative ? Point(grabbed_at + drag.target) : drag.target,
                     drag.rotation,
                     statistics.last_pass.checked,
                     statistics.last_pass.moved,
                     statistics.last_pass_ms});
  if (statistics.last_pass.stopped) {
    passes_.back().stopped_at =
        held.has_one() ? point_of(simulation_.mesh(), simulation_.body().positions(), elements[0]) : held.pose().pivot;
  }
  passes_.back().remark = statistics.remark;
  if (each_.traced) {
    traced_ += trace.size();
    if (traced_ > max_traced) {
      throw Error("trace", "it has more than " + std::to_string(max_traced) + " rows",
                  "use fewer steps, or a smaller object");
    }
    traces_.push_back(std::move(trace));
  }
  const auto& how = simulation_.relaxation();
  const auto start = PassTimes::Clock::now();
  simulation_.relax(each_.relax, {how.step, how.scheme, each_.relax_until, how.local});
  passes_.back().relaxation_ms = std::chrono::duration<double, std::milli>(PassTimes::Clock::now() - start).count();
  each_.on_end();
}

DeformSummary Deformation::summary() {
  const Mesh& mesh = simulation_.mesh();
  const Body& body = simulation_.body();
  simulation_.measure_all();
  const Statistics& statistics = simulation_.statistics();
  const auto positions = body.positions();
  std::optional<DeformSummary::Local> local;
  if (statistics.estimate) {
    local = {*statistics.estimate, statistics.nodes};
  }
  return {statistics.algorithm,
          mesh.element_count(),
          mesh.link_count(),
          passes_,
          statistics.violation,
          elastic_energy(mesh, body.softness(), body.cuts(), positions, body.elastic()),
          measure_displacement(mesh, positions),
          volume_change(mesh, positions, body.cuts()),
          inverted_cells(mesh, positions),
          largest_principal_stretch(mesh, positions),
          info(simulation_.relaxation().scheme).sweeps ? std::nullopt : simulation_.certificate(),
          cell_figures(mesh, body.cuts(), positions),
          local};
}

}  // namespace chainmail
