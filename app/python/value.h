#pragma once

#include <functional>
#include <string>
#include <type_traits>
#include <utility>

#include "python/arguments.h"
#include "python/pickling.h"

namespace chainmail::python {

/// A part of a value object of Python: its name, its member of the C++ struct, and its docstring.
template <class At>
struct Part {
  const char* name;
  At at;  // a pointer to the member
  std::string help;
};
template <class At>
Part(const char*, At, std::string) -> Part<At>;

/// Returns a part as Python has it: a vector is a tuple.
template <class Type>
py::object to_python(const Type& part) {
  if constexpr (std::is_same_v<Type, Point>) {
    return tuple_of(part);
  } else {
    return py::cast(part);
  }
}

/// Sets a part to what Python has. Throws what a constructor throws for it.
template <class Type>
void from_python(Type& part, const py::object& given, const char* name) {
  if constexpr (std::is_same_v<Type, Point>) {
    part = vector_of(given, name);
  } else {
    part = given.cast<Type>();
  }
}

/// Adds the parts as properties that cannot be set, and makes the objects known to pickle and copy.
template <class Value, class... At>
void add_parts(py::class_<Value>& type, const Part<At>&... parts) {
  const auto add = [&]<class One>(const Part<One>& part) {
    type.def_property_readonly(
        part.name, [at = part.at](Value& one) { return to_python(std::invoke(at, one)); }, part.help.c_str());
  };
  (add(parts), ...);
  add_pickling(
      type, [parts...](Value& one) { return py::make_tuple(to_python(std::invoke(parts.at, one))...); },
      [parts...](const py::tuple& state) {
        Value one;
        std::size_t i = 0;
        (from_python(std::invoke(parts.at, one), state[i++], parts.name), ...);
        return one;
      });
}

/// Returns `Rotation(axis=(0.0, 0.0, 1.0), degrees=30.0)`.
template <class Value>
std::string words_of(const py::dict& parts) {
  std::string text;
  for (const auto& [name, part] : parts) {
    text += (text.empty() ? "" : ", ") + std::string(py::str(name)) + "=" + std::string(py::repr(part));
  }
  return std::string(py::str(py::type::of<Value>().attr("__name__"))) + "(" + text + ")";
}
template <class Value, class... At>
std::string words_of(Value& one, const Part<At>&... parts) {
  return words_of<Value>(py::dict((py::arg(parts.name) = to_python(std::invoke(parts.at, one)))...));
}

}  // namespace chainmail::python
