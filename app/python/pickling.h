#pragma once

#include <functional>
#include <string>
#include <utility>

#include "python/module.h"
#include "python/object.h"

namespace chainmail::python {

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

/// Makes meshes known to pickle, with bytes for their arrays: NumPy trusts what is pickled of its arrays, and a damaged
/// one ends the process.
void add_mesh_pickling(py::class_<MeshObject, MeshObjectPointer>& mesh);

}  // namespace chainmail::python
