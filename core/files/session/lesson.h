#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "solver/algorithms.h"

namespace chainmail {

/// One step of a lesson: what the reader sees, and how far the recorded moves are carried out.
struct LessonStep {
  std::string title;
  std::string text;
  /// Number of recorded moves, from rest, that are carried out at the end of the step. It never falls from one step to
  /// the next.
  std::size_t until = 0;
  /// One per panel, for this step and those after it; empty: those of the step before, or of the session.
  std::vector<Algorithm> algorithms;
  /// Number of candidates of the last pass that are carried out; the panels show the pass at this point.
  std::optional<std::uint32_t> candidate;
  // Names that only the window knows; empty: as before.
  std::string colour, show, dock, tool;

  bool operator==(const LessonStep&) const = default;
};

/// A caption track: the steps of a lesson over the recorded moves of a session.
struct Lesson {
  std::string title;
  std::vector<LessonStep> steps;  // empty: the session is no lesson

  bool operator==(const Lesson&) const = default;
};

inline constexpr std::size_t lesson_panels_least = 2;  // panels of the window
inline constexpr std::size_t lesson_panels_most = 4;

}  // namespace chainmail
