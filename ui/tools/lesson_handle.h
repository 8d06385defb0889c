#pragma once

#include "document/lesson_player.h"
#include "panels/overlay.h"

namespace chainmail {

/// Marks the handles that a lesson has dragged, as the Drag tool marks its handle.
class LessonHandle : public Overlay {
 public:
  explicit LessonHandle(const LessonPlayer& player) : player_(player) {}

  void draw(const Canvas& canvas) override;

 private:
  const LessonPlayer& player_;
};

}  // namespace chainmail
