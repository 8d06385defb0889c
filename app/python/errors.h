#pragma once

#include <pybind11/pybind11.h>

namespace chainmail::python {

/// Makes the exceptions of the C++ interface those of the module: api::Error becomes chainmail.Error, api::Cancelled
/// becomes chainmail.Cancelled.
void translate_errors();

}  // namespace chainmail::python
