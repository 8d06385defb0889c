#include "chainmail/deformer.h"

#include <algorithm>
#include <utility>

#include "api/access.h"
#include "mesh/parameters.h"

namespace chainmail::api {

static_assert(no_sponsor == no_element);
static_assert(RelaxOptions().step == parameters::relax_step.default_value);
static_assert(RelaxOptions().until == parameters::relax_until.default_value);

struct Deformer::Impl {
  Body body;
  Algorithm algorithm;
  Job job = {};
  bool is_tracing = false;
  Trace traced = {};
  std::vector<TraceStep> trace = {};

  inner::Deformer& solver() { return *Access::impl(body).solver; }
  const inner::Deformer& solver() const { return *Access::impl(body).solver; }
  void set_algorithm(Algorithm next) {
    solver().set_algorithm(next);
    algorithm = next;
  }
  template <class Move>
  MoveResult run(Move move);
};

template <class Move>
MoveResult Deformer::Impl::run(Move move) {
  traced.clear();
  trace.clear();
  solver().set_progress(Access::progress(job));
  const PassCount count = guarded([&] { return move(is_tracing ? &traced : nullptr); });
  for (const TraceRow& row : traced) {
    trace.push_back({row.element, row.sponsor, row.moved});
  }
  return {count.checked, count.moved, count.stopped, {}, solver().remark()};
}

Deformer::Deformer(Body body, std::string_view method) {
  const Algorithm algorithm = algorithm_of(method);
  guarded([&] { check(algorithm, *Access::pointer(body.mesh())); });
  impl_ = std::make_unique<Impl>(Impl{std::move(body), algorithm});
  guarded([&] { impl_->set_algorithm(algorithm); });
}

Deformer::Deformer(const Mesh& mesh, std::string_view method, Precision precision)
    : Deformer(Body(mesh, precision), method) {}

Deformer::Deformer(Deformer&& other) noexcept = default;
Deformer& Deformer::operator=(Deformer&& other) noexcept = default;
Deformer::~Deformer() = default;

Body& Deformer::body() { return impl_->body; }
const Body& Deformer::body() const { return impl_->body; }
std::string Deformer::method() const { return std::string(info(impl_->algorithm).offered_name()); }

void Deformer::set_method(std::string_view method) {
  const Algorithm algorithm = algorithm_of(method);
  guarded([&] { impl_->set_algorithm(algorithm); });
}

void Deformer::set_threads(int threads) {
  if (threads < 1) {
    throw Error("threads", "the number is below 1", "use a number from 1");
  }
  impl_->solver().set_threads(threads);
}

MoveResult Deformer::move(Handle& handle, const Pose& target) {
  auto& body = Access::impl(impl_->body);
  const inner::Mesh& mesh = body.body().mesh();
  auto& held = Access::impl(handle);
  if (!(held.mesh == body.mesh)) {
    throw Error("handle", "it is of another mesh", "grab elements of this object");
  }
  check_coordinates(mesh, "pivot", target.pivot, false);
  guarded([&] { check(rotation_of(target.rotation), mesh); });
  const inner::Pose pose{point_of(target.pivot), rotation_of(target.rotation).vector()};
  MoveResult result = impl_->run([&](Trace* trace) { return body.solver->move(held.handle, pose, trace); });
  result.reached = handle.pose();
  return result;
}

MoveResult Deformer::move(ElementId element, const Vector3& target) {
  auto& body = Access::impl(impl_->body);
  check_id(body.body().mesh(), element);
  check_coordinates(body.body().mesh(), "target", target, false);
  MoveResult result = impl_->run([&](Trace* trace) { return body.solver->move(element, point_of(target), trace); });
  result.reached.pivot = impl_->body.position(element);
  return result;
}

std::span<const ElementId> Deformer::moved() const { return impl_->solver().moved(); }

void Deformer::release() { impl_->solver().release(); }

int Deformer::relax(int sweeps, const RelaxOptions& options) {
  return guarded([&] {
    impl_->solver().set_progress(Access::progress(impl_->job));
    return impl_->solver().relax(sweeps, {options.step, scheme_of(options.scheme), options.until}).sweeps;
  });
}

EquilibriumCertificate Deformer::certificate() {
  return guarded([&] {
    const auto found = impl_->solver().certificate().value_or(inner::EquilibriumCertificate{});
    return EquilibriumCertificate{found.violation, found.residual, found.gap, found.binds, found.iterations};
  });
}

void Deformer::set_job(const Job& job) { impl_->job = job; }
void Deformer::set_tracing(bool on) { impl_->is_tracing = on; }
std::span<const TraceStep> Deformer::trace() const { return impl_->trace; }

std::vector<double> deform(const Mesh& mesh, std::string_view method, const std::vector<ElementId>& elements,
                           const Vector3& by) {
  Deformer deformer(mesh, method);
  Handle handle = deformer.grab(elements);
  check_coordinates(*Access::pointer(mesh), "displacement", by, true);
  deformer.move(handle, handle.after({by, {}}));
  return deformer.body().positions();
}

}  // namespace chainmail::api
