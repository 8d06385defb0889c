#include "python/object.h"

namespace chainmail::python {
namespace {

const MeshPointer& checked(const MeshObject& mesh, Precision precision) {
  check(precision, *mesh.mesh);
  return mesh.mesh;
}

/// Some methods store displacements or turned coordinates, which a view would show instead of positions.
bool keeps_storage(const AlgorithmInfo& next, const Body& now) {
  const bool works_in_axes = next.family() == Family::chainmail;
  return stores_displacements(next, now) == now.stores_displacements() &&
         (works_in_axes == now.works_in_axes() || !now.softness().axes.is_turned());
}

}  // namespace

Object::Object(MeshObjectPointer mesh, Precision precision)
    : Busy("body"), mesh_(std::move(mesh)), deformer_(checked(*mesh_, precision), Algorithm::natural_queue, precision) {
  Softness softness = standard_softness();
  softness.links = mesh_->softness;
  body().set_softness(softness);
  deformer_.set_progress(job_);
}

Object::Object(const Object& other) : Busy("body"), mesh_(other.mesh_), deformer_(other.deformer_.copy()) {
  deformer_.set_progress(job_);
}

void Object::check_no_views(const char* before) const {
  if (views_ > 0) {
    throw Error("body", "a view of its positions is in use",
                std::string("delete the view or replace it by positions(), then ") + before);
  }
}

void Object::attach(Algorithm method) {
  if (is_attached_) {
    throw Error("body", "it has a deformer already", "use that one and its set_method(), or a copy of the body");
  }
  set_method(method);
  set_tracing(false);
  trace_.clear();
  is_attached_ = true;
}

void Object::set_method(Algorithm method) {
  check(method, mesh());
  if (!keeps_storage(info(method), body())) {
    check_no_views("change the method");
  }
  deformer_.set_algorithm(method);
}

void Object::split(const SplitPointer& split) {
  const MeshPointer mesh = split->after();
  check(method(), *mesh);
  check_no_views("split");
  const ObjectState file{split->before(), {}, {}, std::make_shared<Softness>(Softness{{}, mesh_->softness})};
  auto after =
      std::make_shared<MeshObject>(MeshObject{mesh, object_after(*split, file).softness->links, mesh_->remark});
  deformer_.split(split, body().snapshot());
  mesh_ = std::move(after);
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
