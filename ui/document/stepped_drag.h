#pragma once

#include "document/document.h"

namespace chainmail {

/// Drags an element along a straight line in equal steps, with exact targets. Each step is one pass in every panel. A
/// drag with the mouse, an undo or another mesh ends it.
class SteppedDrag : public QObject {
  Q_OBJECT

 public:
  explicit SteppedDrag(Document& document);

  /// Starts a drag from one point to another (mesh units); the last step ends exactly at the target.
  void start(ElementId element, const Point& from, const Point& target, int steps);
  void stop();
  bool running() const { return running_; }
  int stepsDone() const { return done_; }
  int steps() const { return steps_; }

 signals:
  /// The drag has started, made a step, or ended.
  void changed();

 private:
  void step();

  Document& document_;
  ElementId element_ = 0;
  Point from_ = Point::Zero(), target_ = Point::Zero();
  int steps_ = 0, done_ = 0;
  bool running_ = false;
  bool shown_ = false;  // the first panel has shown a frame since the last step
};

}  // namespace chainmail
