#include "python/object.h"

namespace chainmail::python {
namespace {

const MeshPointer& checked(const MeshObject& mesh, Precision precision) {
  check(precision, *mesh.mesh);
  return mesh.mesh;
}

}  // namespace

Object::Object(MeshObjectPointer mesh, Precision precision)
    : mesh_(std::move(mesh)), deformer_(checked(*mesh_, precision), Algorithm::natural_queue, precision) {
  Softness softness = standard_softness();
  softness.links = mesh_->softness;
  body().set_softness(softness);
  deformer_.set_progress(job_);
}

Object::Object(const Object& other) : mesh_(other.mesh_), deformer_(other.deformer_.copy()) {
  deformer_.set_progress(job_);
}

void Object::check_no_views(std::string_view before) const {
  if (views_ > 0) {
    throw Error("body", "a view of its positions is in use",
                "delete the view or replace it by positions(), then " + std::string(before));
  }
}

/// Some methods store displacements or turned coordinates, which a view would show instead of positions.
void Object::check_views(Algorithm algorithm) {
  const Body& now = deformer_.body();
  const AlgorithmInfo& next = info(algorithm);
  const bool works_in_axes = next.family() == Family::chainmail;
  const bool stays = stores_displacements(next, now) == now.stores_displacements() &&
                     (works_in_axes == now.works_in_axes() || !now.softness().axes.is_turned());
  if (!stays) {
    check_no_views("change the method");
  }
}

void Object::attach(std::string_view method) {
  if (is_attached_) {
    throw Error("body", "it has a deformer already", "use that one and its set_method(), or a copy of the body");
  }
  set_method(method);
  set_tracing(false);
  trace_.clear();
  is_attached_ = true;
}

void Object::set_method(std::string_view method) {
  const Algorithm algorithm = algorithm_of(method);
  check(algorithm, mesh());
  check_views(algorithm);
  deformer_.set_algorithm(algorithm);
}

void Object::set_job(const Progress& job) {
  job_ = job;
  deformer_.set_progress(job);
}

Trace* Object::new_trace() {
  trace_.clear();
  return is_tracing_ ? &trace_ : nullptr;
}

}  // namespace chainmail::python
