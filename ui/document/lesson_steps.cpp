#include "document/lesson_steps.h"

namespace chainmail {

std::size_t stepAt(const Lesson& lesson, std::size_t position) {
  const auto& steps = lesson.steps;
  std::size_t step = 0;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    step = steps[i].until <= position && steps[i].until > steps[step].until ? i : step;
  }
  return step;
}

}  // namespace chainmail
