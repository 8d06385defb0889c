#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QSpinBox>
#include <QWidget>

#include "docks/size_test/size_test.h"

namespace chainmail {

/// Choices for a size test: first size, growth, largest size, limit of real time, and drags.
class SizeTestChoices : public QWidget {
  Q_OBJECT

 public:
  SizeTestChoices();
  /// Returns the chosen options. The caller sets the softness.
  SizeTestOptions options() const;

 private:
  QSpinBox* first_;
  QComboBox* growth_;
  QSpinBox* largest_;
  QDoubleSpinBox* budget_;
  QSpinBox* drags_;
};

}  // namespace chainmail
