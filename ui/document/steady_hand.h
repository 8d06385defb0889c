#pragma once

#include <QTimer>

#include "document/document.h"

namespace chainmail {

/// Takes hold of an element and carries it along a straight line, as the mouse would but to the digit: each step is a
/// pass in every panel. The hand of another, an undo or another mesh ends it.
class SteadyHand : public QObject {
  Q_OBJECT

 public:
  explicit SteadyHand(Document& document);

  /// In mesh units; the last of the steps is the target itself.
  void carry(ElementId element, const Point& from, const Point& target, int steps);
  void stop();
  bool running() const { return timer_.isActive(); }
  int stepsDone() const { return done_; }
  int steps() const { return steps_; }

 signals:
  /// It has begun, made a step, or ended.
  void changed();

 private:
  void step();

  Document& document_;
  ElementId element_ = 0;
  Point from_ = Point::Zero(), target_ = Point::Zero();
  int steps_ = 0, done_ = 0;
  QTimer timer_;  // runs while an element is carried
};

}  // namespace chainmail
