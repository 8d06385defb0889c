#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chainmail/mesh.h"

namespace chainmail::python {

namespace py = pybind11;

/// Sets the function that reduces objects of a class to what pickle writes. What Python does without it knows only
/// protocols from 2 on; in others, and if it is called directly, pybind11 ends the process.
void set_reduction(const py::object& type, const std::function<py::object(const py::object&)>& reduce);

/// Makes the objects of a class known to pickle, in all protocols, and to copy. `get` returns the state of an object,
/// from which `set` makes it again. A state may come from outside: `set` checks it.
template <class Class, class Get, class Set>
void add_pickling(Class& type, Get get, Set set) {
  type.def(py::pickle(std::move(get), std::move(set)));
  set_reduction(type, [](const py::object& self) -> py::object {
    return py::make_tuple(py::module_::import("copyreg").attr("__newobj__"), py::make_tuple(py::type::of(self)),
                          self.attr("__getstate__")());
  });
}

/// The same for objects that cannot be pickled: `problem` and `remedy` are the parts of the error.
void refuse_pickling(const py::object& type, const std::string& problem, const std::string& remedy);

/// Call this when the module has all its classes. X.__new__(X) makes an object that no constructor has seen; pybind11
/// would let its methods read memory that nobody has written. They raise TypeError instead.
void refuse_uninitialised(const py::module_& module);

/// Call this when the module has all its functions: makes them known to pickle, by their names, so that processes of a
/// pool can call them. pybind11 keeps a capsule in each, at which pickle would stop.
void add_pickled_functions(const py::module_& module);

/// Adds to the module what shared_mesh() needs.
void add_pickled_meshes(py::module_& module);

/// Returns a mesh as the one object of Python that stands for it in pickles: the mesh of a body, of its handles and of
/// its snapshots is still the same after they were pickled together.
py::object shared_mesh(const api::Mesh& mesh);
/// The same for an object that stands for its mesh if no other one does.
py::object shared_mesh(const py::object& mesh);

/// Returns the bytes of numbers, as a part of a state. An array of NumPy would not do: NumPy trusts what is pickled of
/// it, and a damaged one ends the process.
template <class Numbers>
py::bytes bytes_of(const Numbers& numbers) {
  const auto* const data = reinterpret_cast<const char*>(numbers.data());
  const auto size = py::ssize_t(numbers.size() * sizeof(*numbers.data()));
  auto bytes = py::reinterpret_steal<py::bytes>(PyBytes_FromStringAndSize(data, size));
  if (!bytes) {
    throw py::error_already_set();
  }
  return bytes;
}

/// The parts of a state. Throws Error, with the name of the class, if one is missing or of another type.
class StateFields {
 public:
  StateFields(const char* class_name, const py::object& state);

  py::object object(const char* name) const;
  template <class Value>
  Value get(const char* name) const {
    try {
      return object(name).cast<Value>();
    } catch (const py::cast_error&) {
      refuse(name);
    } catch (const py::reference_cast_error&) {  // from None
      refuse(name);
    }
  }
  /// Return numbers: those that bytes_of() took, or those of an array of any shape.
  std::vector<std::uint32_t> ids(const char* name) const;
  std::vector<double> reals(const char* name) const;
  [[noreturn]] void refuse(const char* name) const;

  const std::string& where() const { return where_; }

 private:
  template <class Number>
  std::optional<std::vector<Number>> unpacked(const char* name) const;

  std::string where_;
  py::dict parts_;
};

}  // namespace chainmail::python
