#include "python/pickling.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "files/session/flat_mesh.h"
#include "python/arrays.h"

namespace chainmail::python {
namespace {

constexpr const char* module_name = "chainmail._core";

[[noreturn]] void* refuse_memory(std::size_t /*size*/) {
  throw py::type_error("the object is not initialised: call its class, not __new__");
}

constexpr const char* state_of_mesh = "state of a mesh";

[[noreturn]] void refuse_part(const std::string& name) {
  throw Error(state_of_mesh, "its part '" + name + "' is missing or damaged", "pickle the mesh again");
}

// An array is bytes: one that says what its numbers are, then theirs.
template <class Number>
constexpr char mark = std::is_same_v<Number, double> ? 'd' : 'I';

template <class Number>
py::bytes bytes_of(const std::vector<Number>& numbers) {
  const std::size_t size = numbers.size() * sizeof(Number);
  auto bytes = py::reinterpret_steal<py::bytes>(PyBytes_FromStringAndSize(nullptr, py::ssize_t(1 + size)));
  if (!bytes) {
    throw py::error_already_set();
  }
  char* const out = PyBytes_AS_STRING(bytes.ptr());
  *out = mark<Number>;
  std::copy_n(reinterpret_cast<const char*>(numbers.data()), size, out + 1);
  return bytes;
}

/// Returns a text; nothing if it is not valid Unicode.
std::optional<std::string> text_of(py::handle text) {
  Py_ssize_t size = 0;
  const char* const bytes = PyUnicode_AsUTF8AndSize(text.ptr(), &size);
  if (bytes == nullptr) {
    PyErr_Clear();
    return std::nullopt;
  }
  return std::string(bytes, std::size_t(size));
}

/// The parts of a state, which may come from outside. Each of these functions throws Error if the part is missing or
/// damaged.
class Parts {
 public:
  explicit Parts(const py::object& state) {
    if (!py::isinstance<py::dict>(state)) {
      throw Error(state_of_mesh, "it is not a dictionary", "pickle the mesh again");
    }
    parts_ = state.cast<py::dict>();
    for (const auto& [name, part] : parts_) {
      if (!py::isinstance<py::str>(name) || !text_of(name)) {
        throw Error(state_of_mesh, "one of its parts is damaged", "pickle the mesh again");
      }
    }
  }

  template <class Number>
  std::vector<Number> numbers(const char* name) const {
    const auto part = at<py::bytes>(name);
    const std::string_view bytes = part;
    if (!bytes.starts_with(mark<Number>) || (bytes.size() - 1) % sizeof(Number) != 0) {
      refuse_part(name);
    }
    std::vector<Number> numbers((bytes.size() - 1) / sizeof(Number));
    std::ranges::copy(bytes.substr(1), reinterpret_cast<char*>(numbers.data()));
    return numbers;
  }
  double real(const char* name) const { return at<py::float_>(name); }
  std::int64_t whole(const char* name) const { return value_of(name, whole_of(at<py::int_>(name))); }
  std::string text(const char* name) const { return value_of(name, text_of(at<py::str>(name))); }

 private:
  template <class Type>
  Type at(const char* name) const {
    if (!parts_.contains(name) || !py::isinstance<Type>(parts_[name])) {
      refuse_part(name);
    }
    return py::reinterpret_borrow<Type>(parts_[name]);
  }
  template <class Value>
  static Value value_of(const char* name, const std::optional<Value>& value) {
    if (!value) {
      refuse_part(name);
    }
    return *value;
  }

  py::dict parts_;
};

using Ids = std::vector<std::uint32_t>;
using Reals = std::vector<double>;

constexpr std::pair<const char*, Ids FlatMesh::*> arrays_of_ids[]{
    {"first_entry", &FlatMesh::first_entry}, {"neighbours", &FlatMesh::neighbours},
    {"triangles", &FlatMesh::triangles},     {"polygons", &FlatMesh::polygons},
    {"tetrahedra", &FlatMesh::tetrahedra},   {"hexahedra", &FlatMesh::hexahedra}};

py::object state_of(const MeshObject& mesh) {
  const FlatMesh flat = flat_mesh_of(*mesh.mesh);
  py::dict state;
  state["rest"] = bytes_of(flat.rest);
  for (const auto& [name, ids] : arrays_of_ids) {
    state[name] = bytes_of(flat.*ids);
  }
  state["lattice"] = bytes_of(flat.lattice ? Ids(flat.lattice->size.begin(), flat.lattice->size.end()) : Ids());
  state["spacing"] = flat.lattice ? flat.lattice->spacing : 0.0;
  state["space_dimension"] = flat.space_dimension;
  Ids links;
  Reals numbers;
  for (const auto& [link, own] : mesh.softness) {
    links.push_back(link);
    for (const SoftnessNumber& one : softness_numbers) {
      numbers.push_back(own.*one.value);
    }
  }
  state["own_links"] = bytes_of(links);
  state["own_softness"] = bytes_of(numbers);
  state["remark"] = mesh.remark;
  return state;
}

OwnSoftness softness_in(const Parts& parts, const Mesh& mesh) {
  const Ids links = parts.numbers<std::uint32_t>("own_links");
  const Reals numbers = parts.numbers<double>("own_softness");
  if (numbers.size() != links.size() * softness_numbers.size()) {
    refuse_part("own_softness");
  }
  std::vector<LinkSoftness> own(links.size());
  auto number = numbers.begin();
  for (LinkSoftness& softness : own) {
    for (const SoftnessNumber& one : softness_numbers) {
      softness.*one.value = *number++;
    }
  }
  Softness softness;
  set_own(softness, mesh, links, own);
  return softness.links;
}

/// Makes a mesh of a dictionary that may come from outside.
MeshObjectPointer unpickled_mesh(const py::object& state) {
  const Parts parts(state);
  FlatMesh flat;
  flat.rest = parts.numbers<double>("rest");
  for (const auto& [name, ids] : arrays_of_ids) {
    flat.*ids = parts.numbers<std::uint32_t>(name);
  }
  const double spacing = parts.real("spacing");
  if (const Ids size = parts.numbers<std::uint32_t>("lattice"); size.size() == 3) {
    flat.lattice = Lattice{{size[0], size[1], size[2]}, spacing};
  } else if (!size.empty()) {
    refuse_part("lattice");
  }
  flat.space_dimension = parts.whole("space_dimension");
  const MeshPointer mesh = checked_mesh(std::move(flat), state_of_mesh);
  return std::make_shared<MeshObject>(MeshObject{mesh, softness_in(parts, *mesh), parts.text("remark")});
}

}  // namespace

void set_reduction(const py::object& type, const std::function<py::object(const py::object&)>& reduce) {
  const auto in_any_protocol = [reduce](const py::object& self, int /*protocol*/) { return reduce(self); };
  type.attr("__reduce__") = py::cpp_function(reduce, py::name("__reduce__"), py::is_method(type));
  type.attr("__reduce_ex__") = py::cpp_function(in_any_protocol, py::name("__reduce_ex__"), py::is_method(type));
}

void refuse_pickling(const py::object& type, const std::string& problem, const std::string& remedy) {
  const auto name = type.attr("__name__").cast<std::string>();
  set_reduction(
      type, [name, problem, remedy](const py::object& /*self*/) -> py::object { throw Error(name, problem, remedy); });
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

void add_mesh_pickling(py::class_<MeshObject, MeshObjectPointer>& mesh) {
  add_pickling(mesh, &state_of, &unpickled_mesh);
  mesh.def("__copy__", [](const py::object& self) { return self; });  // it does not change
  mesh.def(
      "__deepcopy__", [](const py::object& self, const py::object& /*memo*/) { return self; }, py::arg("memo"));
}

}  // namespace chainmail::python
