#pragma once

#include <QTest>
#include <vector>

#include "document/document.h"

namespace chainmail {

constexpr int longest_wait = 60'000;  // milliseconds: the sanitizers are slow, and so is a busy machine

/// Waits until all solvers have carried out all commands, relaxation sleeps, and the last frames have arrived.
inline bool has_settled(Document& document) {
  return QTest::qWaitFor(
      [&document] {
        bool relaxing = false;
        for (int panel = 0; panel < document.panels(); ++panel) {
          const Frame* frame = document.solvers().frame(panel);
          relaxing = relaxing || frame == nullptr || frame->statistics.relaxing;
        }
        return !relaxing && document.solvers().settled();
      },
      longest_wait);
}

inline Point position_of(Document& document, int panel, ElementId element) {
  const auto& all = document.solvers().frame(panel)->positions;
  const std::size_t dimension = all.size() / document.mesh()->element_count();
  Point at = Point::Zero();
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    at[Eigen::Index(axis)] = double(all[element * dimension + axis]);
  }
  return at;
}

/// Returns the coordinates of the object in all panels.
inline std::vector<std::vector<float>> shapes_of(Document& document) {
  std::vector<std::vector<float>> shapes;
  for (int panel = 0; panel < document.panels(); ++panel) {
    shapes.push_back(document.solvers().frame(panel)->positions);
  }
  return shapes;
}

/// Moves an element in several steps from where the first panel has it, and waits for the solvers after each.
inline bool drag_and_hold(Document& document, ElementId element, const Point& by) {
  const Point from = position_of(document, 0, element);
  document.handle().grab(element);
  bool settled = true;
  for (int step = 1; step <= 5; ++step) {
    document.handle().drag(from + step / 5.0 * by);
    settled = settled && has_settled(document);
  }
  return settled;
}

inline bool drag_and_release(Document& document, ElementId element, const Point& by) {
  const bool settled = drag_and_hold(document, element, by);
  document.handle().release();
  return settled && has_settled(document);
}

}  // namespace chainmail
