#include "chainmail/simulation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "api/access.h"
#include "api/recorded_moves.h"
#include "chainmail/text.h"
#include "files/mesh/mesh_file.h"
#include "files/results/summary.h"
#include "files/results/trace_csv.h"
#include "measure/distance.h"
#include "measure/inverted_cells.h"
#include "measure/principal_stretch.h"
#include "measure/violation.h"
#include "measure/volume_change.h"
#include "simulate/simulation.h"
#ifdef CHAINMAIL_HAS_JSON
#include "equilibrium/link_energy.h"
#include "files/session/softness_csv.h"
#endif

namespace chainmail::api {

static_assert(usual_iterations == inner::equilibrium_iterations);

struct Simulation::Impl {
  Impl(const Body& body, Algorithm algorithm)
      : mesh(body.mesh()), simulation(Access::pointer(mesh), algorithm, precision_of(body.precision())) {}

  Mesh mesh;
  inner::Simulation simulation;
  int most_relaxation = 0;
  RelaxOptions relaxation = {};
  bool is_tracing = false;
  std::function<void()> watcher = {};
  commands::Drag handle = {};  // where the handle of many is, since it was grabbed
  std::vector<DeformSummary::Pass> passes = {};
  std::vector<Trace> traces = {};
  std::uint64_t traced = 0;  // rows of all traces
  static constexpr std::uint64_t most_traced = 50'000'000;

  void carry_out(const Command& command) {
    if (const auto* drag = std::get_if<commands::Drag>(&command)) {
      pass(*drag);
    } else {
      simulation.apply(command);
    }
    if (simulation.mesh_pointer() != Access::pointer(mesh)) {
      mesh = Access::mesh(simulation.mesh_pointer());
    }
  }
  void pass(const commands::Drag& drag);
  DeformSummary summary();
};

void Simulation::Impl::pass(const commands::Drag& drag) {
  Trace trace;
  simulation.set_trace(is_tracing ? &trace : nullptr);
  simulation.apply(drag);
  simulation.set_trace(nullptr);
  const Statistics& statistics = simulation.statistics();
  const inner::Handle& held = *simulation.last_handle();
  const auto elements = held.elements();
  passes.push_back({{elements.begin(), elements.end()},
                    drag.relative ? Point(held.grabbed().pivot + drag.target) : drag.target,
                    drag.rotation,
                    statistics.last_pass.checked,
                    statistics.last_pass.moved,
                    statistics.last_pass_ms});
  if (statistics.last_pass.stopped) {
    passes.back().stopped_at = held.has_one()
                                   ? inner::point_of(simulation.mesh(), simulation.body().positions(), elements[0])
                                   : held.pose().pivot;
  }
  passes.back().remark = statistics.remark;
  if (is_tracing) {
    traced += trace.size();
    if (traced > most_traced) {
      throw inner::Error("trace", "it has more than " + std::to_string(most_traced) + " rows",
                         "use fewer steps, or a smaller object");
    }
    traces.push_back(std::move(trace));
  }
  simulation.relax(most_relaxation, {relaxation.step, simulation.relaxation().scheme, relaxation.until});
  if (watcher) {
    watcher();
  }
}

DeformSummary Simulation::Impl::summary() {
  const inner::Mesh& object = simulation.mesh();
  const auto positions = simulation.body().positions();
  simulation.measure_all();
  const Statistics& statistics = simulation.statistics();
  return {std::string(info(statistics.algorithm).name),
          object.element_count(),
          object.link_count(),
          passes,
          statistics.violation,
          inner::elastic_energy(object, simulation.softness(), simulation.body().cuts(), positions,
                                simulation.body().elastic()),
          measure_displacement(object, positions),
          volume_change(object, positions),
          inverted_cells(object, positions),
          largest_principal_stretch(object, positions),
          info(simulation.relaxation().scheme).sweeps ? std::nullopt : simulation.certificate()};
}

namespace {

void write_pass(std::ostream& out, const DeformSummary::Pass& pass) {
  const auto point = [&out](const Point& at) { out << '(' << at.x() << ", " << at.y() << ", " << at.z() << ')'; };
  pass.handle.size() == 1 ? out << "element " << pass.handle.front() : out << pass.handle.size() << " elements";
  out << " to ";
  point(pass.target);
  if (pass.rotation.degrees != 0) {
    out << ", rotated by " << pass.rotation.degrees << " degrees about ";
    point(pass.rotation.axis);
  }
  out << ", " << pass.checked << " checked, " << pass.moved << " moved, " << pass.milliseconds << " ms";
  if (pass.stopped_at) {
    out << (pass.remark.empty() ? ", stopped by pins at " : ", stopped at ");
    point(*pass.stopped_at);
  }
  out << (pass.remark.empty() ? "" : ", ") << pass.remark << '\n';
}

void write_deformation(std::ostream& out, std::string_view method, const DeformSummary& summary) {
  out << method << " on " << summary.elements << " elements, " << summary.links << " links\n";
  for (std::size_t i = 0; i < summary.passes.size(); ++i) {
    out << "pass " << i << ": ";
    write_pass(out, summary.passes[i]);
  }
  out << "violation: max " << summary.violation.max << " rest lengths, RMS " << summary.violation.rms << ", "
      << 100 * summary.violation.fraction << "% of links\n";
  if (const auto& found = summary.equilibrium) {
    out << "equilibrium: residual " << found->residual << " after " << found->iterations << " iterations, ";
    if (found->gap) {
      out << "energy about " << 100 * *found->gap << "% above the least, ";
    }
    out << "largest violation " << found->violation << " rest lengths, valid regions "
        << (found->binds ? "bind" : "do not bind") << '\n';
  }
}

std::string passes_of(std::size_t count, std::size_t all) {
  return all == 1 ? "the pass" : std::to_string(count) + " of " + std::to_string(all) + " passes";
}

}  // namespace

Simulation::Simulation(const Body& body, std::string_view method) {
  const Algorithm algorithm = algorithm_of(method);
  const inner::Body& from = Access::body(body);
  impl_ = guarded([&] {
    check(algorithm, *Access::pointer(body.mesh()));
    auto made = std::make_unique<Impl>(body, algorithm);
    made->simulation.apply(commands::SetSoftness{from.softness()});
    made->simulation.apply(commands::SetElastic{from.elastic()});
    if (auto cuts = from.cuts().links(); !cuts.empty()) {
      made->simulation.apply(commands::Cut{std::move(cuts)});
    }
    if (!from.pins().empty()) {
      made->simulation.apply(commands::Pin{{from.pins().begin(), from.pins().end()}});
    }
    return made;
  });
}

Simulation::Simulation(Simulation&& other) noexcept = default;
Simulation& Simulation::operator=(Simulation&& other) noexcept = default;
Simulation::~Simulation() = default;

void Simulation::set_relaxation(int most, const RelaxOptions& options) {
  guarded([&] { impl_->simulation.apply(commands::SetRelaxation{false, options.step, scheme_of(options.scheme)}); });
  impl_->most_relaxation = most;
  impl_->relaxation = options;
}

void Simulation::set_tracing(bool on) { impl_->is_tracing = on; }
void Simulation::set_watcher(std::function<void()> watcher) { impl_->watcher = std::move(watcher); }
const Mesh& Simulation::mesh() const { return impl_->mesh; }

Vector3 Simulation::position(ElementId element) const {
  const inner::Mesh& mesh = impl_->simulation.mesh();
  check_id(mesh, element);
  return vector_of(inner::point_of(mesh, impl_->simulation.body().positions(), element));
}

void Simulation::replay(const RecordedMoves& moves) {
  guarded([&] {
    for (const Command& command : Access::impl(moves).moves.commands) {
      impl_->carry_out(command);
    }
  });
}

void Simulation::cut(ElementId a, ElementId b) {
  const auto link = impl_->mesh.find_link(a, b);
  if (!link) {
    throw Error("link " + std::to_string(a) + "-" + std::to_string(b), "these elements are not linked",
                "use the ids of the two ends of a link");
  }
  guarded([&] { impl_->simulation.apply(commands::Cut{{*link}}); });
}

void Simulation::pin(const std::vector<ElementId>& elements) {
  guarded([&] { impl_->simulation.apply(commands::Pin{elements}); });
}

void Simulation::grab(const std::vector<ElementId>& elements) {
  guarded([&] { impl_->simulation.apply(commands::Grab{elements}); });
  impl_->handle = {Point::Zero(), {}, true};
}

void Simulation::release() {
  guarded([&] { impl_->simulation.apply(commands::Release{}); });
}

void Simulation::move(ElementId element, const Vector3& target, std::uint32_t steps) {
  const Point start = point_of(position(element)), end = point_of(target);
  guarded([&] {
    impl_->simulation.apply(commands::Grab{element});
    for (std::uint32_t step = 1; step <= steps; ++step) {
      Point between;
      for (int k = 0; k < 3; ++k) {
        // std::lerp ends exactly at the target, and does not overflow.
        between[k] = std::lerp(start[k], end[k], double(step) / steps);
      }
      impl_->pass({between});
    }
    impl_->simulation.apply(commands::Release{});
  });
}

void Simulation::move_handle(const Motion& motion, std::uint32_t steps) {
  commands::Drag& handle = impl_->handle;
  const commands::Drag from = handle;
  const Point target = from.target + point_of(motion.by);
  guarded([&] {
    for (std::uint32_t step = 1; step <= steps; ++step) {
      const double share = double(step) / steps;
      for (int k = 0; k < 3; ++k) {
        handle.target[k] = std::lerp(from.target[k], target[k], share);
      }
      handle.rotation = composed(from.rotation, {point_of(motion.rotation.axis), share * motion.rotation.degrees});
      impl_->pass(handle);
    }
  });
}

std::string Simulation::text() const {
  const auto method = info(impl_->simulation.statistics().algorithm).offered_name();
  return written([&](std::ostream& out) { write_deformation(out, method, impl_->summary()); });
}

std::string Simulation::trace_csv() const {
  return written([&](std::ostream& out) { write_trace_csv(out, impl_->traces); });
}

std::vector<std::string> Simulation::notes() const {
  std::map<std::string, std::size_t> remarks;
  std::size_t stopped = 0;
  const DeformSummary::Pass* last = nullptr;
  for (const auto& pass : impl_->passes) {
    if (!pass.remark.empty()) {
      ++remarks[pass.remark];
    }
    if (pass.stopped_at) {
      ++stopped;
      last = &pass;
    }
  }
  const std::size_t all = impl_->passes.size();
  std::vector<std::string> notes;
  notes.reserve(remarks.size() + 1);
  for (const auto& [remark, count] : remarks) {
    notes.push_back(passes_of(count, all) + ": " + remark);
  }
  if (last != nullptr) {
    notes.push_back(passes_of(stopped, all) + " stopped before the target; the last at " +
                    in_words(vector_of(*last->stopped_at)) + " instead of " + in_words(vector_of(last->target)));
  }
  return notes;
}

void write_mesh(std::ostream& out, const std::filesystem::path& name, const Simulation& simulation) {
  const inner::Simulation& from = Access::impl(simulation).simulation;
  guarded([&] {
    const inner::MeshFormat& format = inner::mesh_format(name, FormatUse::write);
    check_holds(format, from.mesh(), name);
    inner::write_mesh(out, format, {from.mesh(), from.body().cuts(), from.body().positions(), from.softness()});
  });
}

#ifdef CHAINMAIL_HAS_JSON

std::string Simulation::json() const {
  return written([&](std::ostream& out) { write_json(out, impl_->summary()); });
}

void read_softness(const std::filesystem::path& path, Body& body) {
  guarded([&] {
    Softness softness = Access::body(body).softness();
    for (const auto& [link, own] : inner::read_softness(path, *Access::pointer(body.mesh()))) {
      softness.links.set(link, own);
    }
    Access::impl(body).set_softness(softness);
  });
}

#else

std::string Simulation::json() const { refuse_without("nlohmann/json", "simulation"); }
void read_softness(const std::filesystem::path& path, Body& /*body*/) {
  refuse_without("nlohmann/json", path.string());
}

#endif

}  // namespace chainmail::api
