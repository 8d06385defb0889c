#pragma once

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <array>

#include "document/stepped_drag.h"

namespace chainmail {

/// A target in numbers, and the way there in steps: what a drag does, exactly.
class ElementMove : public QWidget {
  Q_OBJECT

 public:
  explicit ElementMove(Document& document);

  /// Which element moves, if any.
  void setElement(std::optional<ElementId> element);

 private:
  void arrange();
  void adapt();
  void go();
  /// The three numbers; empty where one of them is none.
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
