#pragma once

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <array>

#include "document/stepped_drag.h"

namespace chainmail {

/// Moves an element to a target in numbers, in steps along a straight line: an exact drag.
class ElementMove : public QWidget {
  Q_OBJECT

 public:
  explicit ElementMove(Document& document);

  /// Sets the element to move, if any.
  void setElement(std::optional<ElementId> element);

 private:
  void arrange();
  void adapt();
  void go();
  /// Returns the three typed numbers; empty if one of them is not a number.
  std::optional<Point> typed() const;
  bool relative() const { return how_->currentIndex() == 1; }

  Document& document_;
  SteppedDrag drag_;
  std::optional<ElementId> element_;
  QComboBox* how_;
  std::array<QLabel*, 3> names_{};
  std::array<QLineEdit*, 3> numbers_{};
  QSpinBox* steps_;
  QPushButton* go_;
};

}  // namespace chainmail
