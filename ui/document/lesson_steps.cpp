#include "document/lesson_steps.h"

#include <algorithm>
#include <array>
#include <utility>

namespace chainmail {
namespace {

constexpr std::array windowNames{&LessonStep::colour, &LessonStep::show, &LessonStep::dock, &LessonStep::tool};

}  // namespace

std::size_t stepAt(const Lesson& lesson, std::size_t position) {
  const auto& steps = lesson.steps;
  std::size_t step = 0;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    step = steps[i].until <= position && steps[i].until > steps[step].until ? i : step;
  }
  return step;
}

std::size_t insertStep(Lesson& lesson, LessonStep step, std::size_t present) {
  auto& steps = lesson.steps;
  const auto later = std::ranges::upper_bound(steps, step.until, {}, &LessonStep::until);
  std::size_t at = std::size_t(later - steps.begin());
  if (present < at && steps[present].until == step.until) {
    at = present + 1;
  }
  steps.insert(steps.begin() + std::ptrdiff_t(at), std::move(step));
  return at;
}

void removeStep(Lesson& lesson, std::size_t step) {
  auto& steps = lesson.steps;
  if (step + 1 < steps.size()) {
    LessonStep& next = steps[step + 1];
    if (next.algorithms.empty()) {
      next.algorithms = steps[step].algorithms;
    }
    for (const auto name : windowNames) {
      if ((next.*name).empty()) {
        next.*name = steps[step].*name;
      }
    }
  }
  steps.erase(steps.begin() + std::ptrdiff_t(step));
}

void exchangeCaptions(Lesson& lesson, std::size_t one, std::size_t other) {
  LessonStep &first = lesson.steps[one], &second = lesson.steps[other];
  std::swap(first.title, second.title);
  std::swap(first.text, second.text);
  for (const auto name : windowNames) {
    std::swap(first.*name, second.*name);
  }
}

}  // namespace chainmail
