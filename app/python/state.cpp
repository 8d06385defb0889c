// Objects as bytes, for another process: pickle, and with it Dask.
#include "chainmail/state.h"

#include <pybind11/stl.h>

#include <memory>
#include <utility>

#include "python/module.h"
#include "python/pickling.h"

namespace chainmail::python {
namespace {

// The mesh of an object is a part of its own: in a pickle of many objects, it is there once.
constexpr const char *mesh_part = "mesh", *body_part = "body", *method_part = "method";

py::object with_mesh(const api::State& state, const api::Mesh& mesh) {
  py::dict parts = dict_of(state);
  parts[mesh_part] = shared_mesh(mesh);
  return parts;
}

py::object parts_of_mesh(const api::Mesh& mesh) { return dict_of(api::save(mesh)); }

api::Mesh loaded_mesh(const py::object& parts) {
  return api::load_mesh(PickledParts("Mesh", parts).without(mesh_part));
}

py::object parts_of_body(Object& object) {
  const UseObject use(object);
  return with_mesh(api::save(object.body()), object.body().mesh());
}

ObjectPointer body_from(const py::object& from) {
  const PickledParts parts("Body", from);
  return std::make_shared<Object>(api::load_body(parts.get<api::Mesh>(mesh_part), parts.without(mesh_part)));
}

py::object parts_of_snapshot(const api::Snapshot& snapshot) { return with_mesh(api::save(snapshot), snapshot.mesh()); }

api::Snapshot snapshot_from(const py::object& from) {
  const PickledParts parts("Snapshot", from);
  return api::load_snapshot(parts.get<api::Mesh>(mesh_part), parts.without(mesh_part));
}

py::object parts_of_handle(HeldHandle& held) {
  const Use use(held.busy, "handle");
  return with_mesh(api::save(held.handle), held.handle.mesh());
}

std::shared_ptr<HeldHandle> handle_from(const py::object& from) {
  const PickledParts parts("Handle", from);
  return std::make_shared<HeldHandle>(api::load_handle(parts.get<api::Mesh>(mesh_part), parts.without(mesh_part)));
}

std::shared_ptr<HeldHandle> copied_handle(HeldHandle& held) {
  const Use use(held.busy, "handle");
  return std::make_shared<HeldHandle>(held.handle);
}

py::object parts_of_deformer(const Mover& mover) {
  const UseObject use(*mover.object());
  py::dict parts = dict_of(api::save(mover.object()->deformer()));
  parts[body_part] = mover.object();
  return parts;
}

std::unique_ptr<Mover> deformer_from(const py::object& from) {
  const PickledParts parts("Deformer", from);
  api::State state = parts.without(body_part);
  const auto body = parts.get<ObjectPointer>(body_part);
  if (body == nullptr) {
    parts.refuse(body_part);
  }
  api::check_deformer(body->body(), state);  // before the method changes how the body stores positions
  auto mover = std::make_unique<Mover>(body, parts.get<std::string>(method_part));
  api::load(mover->object()->deformer(), std::move(state));
  return mover;
}

}  // namespace

void add_mesh_state(py::class_<api::Mesh>& mesh) {
  add_pickling(mesh, &parts_of_mesh, &loaded_mesh);
  const py::object as_object = mesh.attr("__reduce__");
  set_reduction(mesh, [as_object](const py::object& self) -> py::object {
    const py::object shared = shared_mesh(self);
    // Another object stands for this mesh: copy.copy() returns that one, since a mesh does not change.
    return shared.is(self) ? as_object(self)
                           : py::make_tuple(py::module_::import("copy").attr("copy"), py::make_tuple(shared));
  });
  mesh.def("__copy__", [](const py::object& self) { return self; });
  mesh.def(
      "__deepcopy__", [](const py::object& self, const py::object& /*memo*/) { return self; }, py::arg("memo"));
}

void add_body_state(BodyClass& body, SnapshotClass& snapshot) {
  add_pickling(body, &parts_of_body, &body_from);
  add_pickling(snapshot, &parts_of_snapshot, &snapshot_from);
}

void add_handle_state(HandleClass& handle) {
  add_pickling(handle, &parts_of_handle, &handle_from);
  handle.def("__copy__", &copied_handle)
      .def(
          "__deepcopy__", [](HeldHandle& one, const py::object& /*memo*/) { return copied_handle(one); },
          py::arg("memo"));
}

void add_deformer_state(MoverClass& deformer) {
  add_pickling(deformer, &parts_of_deformer, &deformer_from);
  // A body has one deformer, so a copy has a copy of the body, too.
  const auto copy = [](const py::object& self) { return py::module_::import("copy").attr("deepcopy")(self); };
  deformer
      .def("copy", copy,
           "Returns an independent deformer of a copy of the body, which continues as this one would, bit for bit.\n\n"
           "Jobs are not copied. Raises Error for a method that a program has registered.")
      .def("__copy__", copy);
}

}  // namespace chainmail::python
