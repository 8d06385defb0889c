#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QSpinBox>
#include <QWidget>

#include "docks/size_test/size_test.h"

namespace chainmail {

/// Where a size test begins, how it grows, where it ends at the latest, and what real time is.
class SizeTestChoices : public QWidget {
  Q_OBJECT

 public:
  SizeTestChoices();
  /// As chosen; the softness is the caller's.
  SizeTestOptions options() const;

 private:
  QSpinBox* first_;
  QComboBox* growth_;
  QSpinBox* largest_;
  QDoubleSpinBox* budget_;
  QSpinBox* drags_;
};

}  // namespace chainmail
