#pragma once

#include <cstddef>

#include "solver/algorithms.h"

namespace chainmail::report {

/// Returns the index of an algorithm's style.
std::size_t style_of(Algorithm algorithm);
/// Returns the style with this index. After the last one they repeat.
const PlotStyle& style_at(std::size_t index);

}  // namespace chainmail::report
