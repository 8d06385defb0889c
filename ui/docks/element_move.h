#pragma once

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <array>

#include "document/stepped_drag.h"

namespace chainmail {

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
