#pragma once

#include <cstddef>

#include "solver/algorithms.h"

namespace chainmail::report {

using Look = AlgorithmLook;

/// Returns the index of an algorithm's look.
std::size_t look_of(Algorithm algorithm);
/// Returns the look with this index. After the last one they repeat.
const Look& look_at(std::size_t index);

}  // namespace chainmail::report
