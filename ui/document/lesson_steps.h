#pragma once

#include <cstddef>

#include "files/session/lesson.h"

namespace chainmail {

/// Returns the first of the steps that end at or just before a position in the moves.
std::size_t stepAt(const Lesson& lesson, std::size_t position);

}  // namespace chainmail
