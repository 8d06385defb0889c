#pragma once

#include <pybind11/pybind11.h>

namespace chainmail::python {

namespace py = pybind11;

// Each of these functions adds the classes and functions of its source to the module.
void add_values(py::module_& module);
void add_mesh(py::module_& module);
void add_body(py::module_& module);
void add_deformer(py::module_& module);
void add_measure(py::module_& module);
void add_reports(py::module_& module);

}  // namespace chainmail::python
