#pragma once

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <array>
#include <vector>

#include "document/document.h"

namespace chainmail {

/// Drags a handle along a straight line in equal steps, with exact targets. Each step is one pass in every panel. A
/// drag with the mouse, an undo or another mesh ends it.
class SteppedDrag : public QObject {
  Q_OBJECT

 public:
  explicit SteppedDrag(Document& document);

  /// Starts a drag from one point to another (mesh units); the last step ends exactly at the target.
  void start(ElementId element, const Point& from, const Point& target, int steps);
  /// Starts a drag of many elements by a way (mesh units) and a rotation about their pivot.
  void start(const std::vector<ElementId>& elements, const Point& by, const Rotation& rotation, int steps);
  void stop();
  bool running() const { return running_; }
  int stepsDone() const { return done_; }
  int steps() const { return steps_; }

 signals:
  /// The drag has started, made a step, or ended.
  void changed();

 private:
  void begin(const std::vector<ElementId>& elements, int steps);
  bool holds() const;
  void step();
  void drag();

  Document& document_;
  std::vector<ElementId> held_;                          // the elements that it has grabbed
  Point from_ = Point::Zero(), target_ = Point::Zero();  // positions of one element
  bool relative_ = false;                                // then the way and the rotation count instead
  Point by_ = Point::Zero();
  Rotation rotation_;
  int steps_ = 0, done_ = 0;
  bool running_ = false;
  bool shown_ = false;  // the first panel has shown a frame since the last step
};

/// Moves an element to a target in numbers, in steps along a straight line: an exact drag. Moves and rotates a handle
/// of many elements by numbers.
class ElementMove : public QWidget {
  Q_OBJECT

 public:
  explicit ElementMove(Document& document);

  /// Sets the elements to move, ascending.
  void setElements(const std::vector<ElementId>& elements);

 private:
  void arrange();
  QLineEdit* numberField(const char* name, const QString& accessible, double limit);
  void adapt();
  void showHow();
  void adaptRotation();
  void adaptButton();
  QString whyNot() const;
  void go();
  /// Returns the three typed numbers; empty if one of them is not a number.
  std::optional<Point> typed() const;
  /// Returns the typed rotation; empty if the angle is not a number in its range.
  std::optional<Rotation> typedRotation() const;
  bool hasMany() const { return elements_.size() > 1; }
  bool relative() const { return how_->currentIndex() == 1; }

  Document& document_;
  SteppedDrag drag_;
  std::vector<ElementId> elements_;
  int howForOne_ = 0;  // the choice of how_ for one element
  QComboBox* how_;
  std::array<QLabel*, 3> names_{};
  std::array<QLineEdit*, 3> numbers_{};
  QLabel* turn_;
  QComboBox* axis_;
  QLineEdit* degrees_;
  QSpinBox* steps_;
  QPushButton* go_;
};

}  // namespace chainmail
