#include "python/pickling.h"

#include <algorithm>
#include <utility>

#include "api/access.h"
#include "python/arrays.h"

namespace chainmail::python {
namespace {

constexpr const char* module_name = "chainmail._core";
constexpr const char* meshes_name = "_meshes";  // in the module

[[noreturn]] void* refuse_memory(std::size_t /*size*/) {
  throw py::type_error("the object is not initialised: call its class, not __new__");
}

/// Returns the objects that stand for meshes in pickles, by the address of the mesh. They are forgotten when nobody
/// else has them.
py::object meshes() { return py::module_::import(module_name).attr(meshes_name); }

py::object key_of(const api::Mesh& mesh) {
  return py::int_(reinterpret_cast<std::uintptr_t>(api::Access::pointer(mesh).get()));
}

}  // namespace

void set_reduction(const py::object& type, const std::function<py::object(const py::object&)>& reduce) {
  const auto in_any_protocol = [reduce](const py::object& self, int /*protocol*/) { return reduce(self); };
  type.attr("__reduce__") = py::cpp_function(reduce, py::name("__reduce__"), py::is_method(type));
  type.attr("__reduce_ex__") = py::cpp_function(in_any_protocol, py::name("__reduce_ex__"), py::is_method(type));
}

void refuse_pickling(const py::object& type, const std::string& problem, const std::string& remedy) {
  const auto name = type.attr("__name__").cast<std::string>();
  set_reduction(type, [name, problem, remedy](const py::object& /*self*/) -> py::object {
    throw api::Error(name, problem, remedy);
  });
}

void refuse_uninitialised(const py::module_& module) {
  for (const auto& [name, value] : module.attr("__dict__").cast<py::dict>()) {
    if (PyType_Check(value.ptr()) == 0) {
      continue;
    }
    if (auto* info = py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(value.ptr())); info != nullptr) {
      info->operator_new = &refuse_memory;
    }
  }
}

void add_pickled_functions(const py::module_& module) {
  py::set capsules;
  for (const auto& [name, value] : module.attr("__dict__").cast<py::dict>()) {
    if (PyCFunction_Check(value.ptr()) != 0) {
      capsules.add(value.attr("__self__"));
    }
  }
  const py::module_ registry = py::module_::import("copyreg");
  const py::object type = py::reinterpret_borrow<py::object>(reinterpret_cast<PyObject*>(&PyCapsule_Type));
  const py::object others = registry.attr("dispatch_table").attr("get")(type);
  const auto reduce = [capsules, others](const py::object& capsule) -> py::object {
    if (capsules.contains(capsule)) {
      return py::make_tuple(py::module_::import("importlib").attr("import_module"), py::make_tuple(module_name));
    }
    if (others.is_none()) {
      throw py::type_error("cannot pickle 'PyCapsule' object");
    }
    return others(capsule);
  };
  registry.attr("pickle")(type, py::cpp_function(reduce));
}

py::object shared_mesh(const api::Mesh& mesh) {
  const py::object found = meshes().attr("get")(key_of(mesh));
  return found.is_none() ? shared_mesh(py::cast(mesh)) : found;
}

py::object shared_mesh(const py::object& mesh) {
  return meshes().attr("setdefault")(key_of(mesh.cast<const api::Mesh&>()), mesh);
}

void add_pickled_meshes(py::module_& module) {
  module.attr(meshes_name) = py::module_::import("weakref").attr("WeakValueDictionary")();
}

StateFields::StateFields(const char* class_name, const py::object& state)
    : where_(std::string("state of a ") + class_name) {
  if (!py::isinstance<py::dict>(state)) {
    throw api::Error(where_, "it is not a dictionary", "pickle the object again");
  }
  parts_ = state;
}

py::object StateFields::object(const char* name) const {
  if (!parts_.contains(name)) {
    refuse(name);
  }
  return parts_[name];
}

void StateFields::refuse(const char* name) const {
  throw api::Error(where_, "its part '" + std::string(name) + "' is missing or damaged", "pickle the object again");
}

template <class Number>
std::optional<std::vector<Number>> StateFields::unpacked(const char* name) const {
  const py::object part = object(name);
  if (PyBytes_Check(part.ptr()) == 0) {
    return std::nullopt;
  }
  const auto size = std::size_t(PyBytes_GET_SIZE(part.ptr()));
  if (size % sizeof(Number) != 0) {
    refuse(name);
  }
  std::vector<Number> numbers(size / sizeof(Number));
  std::copy_n(PyBytes_AS_STRING(part.ptr()), size, reinterpret_cast<char*>(numbers.data()));
  return numbers;
}

std::vector<std::uint32_t> StateFields::ids(const char* name) const {
  auto numbers = unpacked<std::uint32_t>(name);
  return numbers ? std::move(*numbers) : ids_of(object(name), name);
}

std::vector<double> StateFields::reals(const char* name) const {
  auto numbers = unpacked<double>(name);
  return numbers ? std::move(*numbers) : flat_reals_of(object(name), name);
}

}  // namespace chainmail::python
