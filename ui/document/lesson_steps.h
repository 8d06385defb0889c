#pragma once

#include <cstddef>

#include "files/session/lesson.h"

namespace chainmail {

/// Returns the first of the steps that end at or just before a position in the moves.
std::size_t stepAt(const Lesson& lesson, std::size_t position);

/// Adds a step to a lesson in the order of the positions, if possible just after `present`. Returns its index.
std::size_t insertStep(Lesson& lesson, LessonStep step, std::size_t present);
/// Removes a step. The step after it keeps what it shows, also what it has taken over from this one.
void removeStep(Lesson& lesson, std::size_t step);
/// Exchanges the captions of two steps, with the names of the window. Their positions in the moves stay, because they
/// must not fall.
void exchangeCaptions(Lesson& lesson, std::size_t one, std::size_t other);

}  // namespace chainmail
