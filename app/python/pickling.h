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
#include "chainmail/state.h"

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

/// Returns a state as a dictionary, with bytes for its arrays. An array of NumPy would not do: NumPy trusts what is
/// pickled of it, and a damaged one ends the process.
py::dict dict_of(const api::State& state);

/// A dictionary that may come from outside. `class_name` is the name of the object in errors.
class PickledParts {
 public:
  /// Throws Error if the object is no dictionary.
  PickledParts(const char* class_name, const py::object& parts);

  /// Returns the part that is an object of Python. Throws Error if it is missing or of another class.
  template <class Value>
  Value get(const char* name) const {
    try {
      if (parts_.contains(name)) {
        return parts_[name].cast<Value>();
      }
    } catch (const py::cast_error&) {            // refused below
    } catch (const py::reference_cast_error&) {  // from None
    }
    refuse(name);
  }
  /// Returns all parts but this one. Throws Error for one that is no value of a state.
  api::State without(const char* name) const;

  [[noreturn]] void refuse(const std::string& name) const;

 private:
  std::string where_;
  py::dict parts_;
};

}  // namespace chainmail::python
