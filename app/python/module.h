#pragma once

#include <pybind11/pybind11.h>

#include <type_traits>

#include "python/object.h"

namespace chainmail::python {

namespace py = pybind11;

// Each of these functions adds the classes and functions of its source to the module.
void add_values(py::module_& module);
void add_mesh(py::module_& module);
void add_body(py::module_& module);
void add_deformer(py::module_& module);
void add_measure(py::module_& module);
void add_reports(py::module_& module);

/// Makes a function of an object a method that marks the object as used. Further arguments come from Python.
template <class... Arguments, class Function>
auto used(Function function) {
  return [function](Object& object, Arguments... arguments) {
    const UseObject use(object);
    return function(object, arguments...);
  };
}

}  // namespace chainmail::python
