#include "python/pickling.h"

#include <algorithm>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "chainmail/error.h"
#include "python/arrays.h"

namespace chainmail::python {
namespace {

constexpr const char* module_name = "chainmail._core";

[[noreturn]] void* refuse_memory(std::size_t /*size*/) {
  throw py::type_error("the object is not initialised: call its class, not __new__");
}

// An array is bytes: one that says what its numbers are, then theirs.
constexpr char ids_mark = 'I', reals_mark = 'd';

template <class Number>
py::bytes bytes_of(char mark, const std::vector<Number>& numbers) {
  const std::size_t size = numbers.size() * sizeof(Number);
  auto bytes = py::reinterpret_steal<py::bytes>(PyBytes_FromStringAndSize(nullptr, py::ssize_t(1 + size)));
  if (!bytes) {
    throw py::error_already_set();
  }
  char* const out = PyBytes_AS_STRING(bytes.ptr());
  *out = mark;
  std::copy_n(reinterpret_cast<const char*>(numbers.data()), size, out + 1);
  return bytes;
}

template <class Number>
std::optional<api::StateValue> unpacked(std::string_view bytes) {
  if (bytes.size() % sizeof(Number) != 0) {
    return std::nullopt;
  }
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::ranges::copy(bytes, reinterpret_cast<char*>(numbers.data()));
  return numbers;
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

/// Returns a part of a dictionary as a value of a state; nothing if no state has such a value.
std::optional<api::StateValue> value_of(py::handle part) {
  PyObject* const object = part.ptr();
  if (PyLong_Check(object) != 0) {
    const auto whole = whole_of(part);
    return whole ? std::optional<api::StateValue>(*whole) : std::nullopt;
  }
  if (PyFloat_Check(object) != 0) {
    return PyFloat_AS_DOUBLE(object);
  }
  if (PyUnicode_Check(object) != 0) {
    return text_of(part);
  }
  if (PyBytes_Check(object) != 0) {
    const std::string_view bytes(PyBytes_AS_STRING(object), std::size_t(PyBytes_GET_SIZE(object)));
    return bytes.starts_with(ids_mark)     ? unpacked<std::uint32_t>(bytes.substr(1))
           : bytes.starts_with(reals_mark) ? unpacked<double>(bytes.substr(1))
                                           : std::nullopt;
  }
  return std::nullopt;
}

constexpr const char* state_of_mesh = "state of a mesh";

py::object parts_of(const api::Mesh& mesh) {
  const auto in_python = [](const auto& value) -> py::object {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, std::vector<std::uint32_t>>) {
      return bytes_of(ids_mark, value);
    } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
      return bytes_of(reals_mark, value);
    } else {
      return py::cast(value);
    }
  };
  py::dict parts;
  for (const auto& [name, value] : api::save(mesh)) {
    parts[py::str(name)] = std::visit(in_python, value);
  }
  return parts;
}

/// Makes a mesh of a dictionary that may come from outside.
api::Mesh unpickled_mesh(const py::object& parts) {
  if (!py::isinstance<py::dict>(parts)) {
    throw api::Error(state_of_mesh, "it is not a dictionary", "pickle the mesh again");
  }
  api::State state;
  for (const auto& [key, part] : parts.cast<py::dict>()) {
    const auto name = py::isinstance<py::str>(key) ? text_of(key) : std::nullopt;
    auto value = name ? value_of(part) : std::nullopt;
    if (!value) {
      throw api::Error(state_of_mesh, "one of its parts is damaged", "pickle the mesh again");
    }
    state[*name] = std::move(*value);
  }
  return api::load_mesh(std::move(state));
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

void add_mesh_pickling(py::class_<api::Mesh>& mesh) {
  add_pickling(mesh, &parts_of, &unpickled_mesh);
  mesh.def("__copy__", [](const py::object& self) { return self; });  // it does not change
  mesh.def(
      "__deepcopy__", [](const py::object& self, const py::object& /*memo*/) { return self; }, py::arg("memo"));
}

}  // namespace chainmail::python
