#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <span>

#include "chainmail/deformer.h"

namespace chainmail::python {

/// Returns a trace as rows: element, sponsor or -1, and 1 if it moved.
pybind11::array_t<std::int64_t> rows_of(std::span<const api::TraceStep> trace);

}  // namespace chainmail::python
