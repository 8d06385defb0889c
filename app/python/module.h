#pragma once

#include <pybind11/pybind11.h>

#include "python/object.h"

namespace chainmail::python {

namespace py = pybind11;

/// The Python class of Object.
using BodyClass = py::class_<Object, ObjectPointer>;

// Each of these functions adds the classes and functions of its source to the module.
void add_types(py::module_& module);
void add_mesh(py::module_& module);
void add_body(py::module_& module);
void add_softness(BodyClass& body);
void add_position_view(BodyClass& body);
void add_mesh_file(py::module_& module);
void add_handle(py::module_& module);
void add_method(py::module_& module);
void add_deformer(py::module_& module);
void add_measure(py::module_& module);
void add_compare(py::module_& module);
void add_calibrate(py::module_& module);
void add_ramp(py::module_& module);

}  // namespace chainmail::python
