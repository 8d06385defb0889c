#include "docks/size_test/size_test_choices.h"

#include <QFormLayout>
#include <QLabel>

#include "common/number_field.h"

namespace chainmail {

SizeTestChoices::SizeTestChoices()
    : first_(new QSpinBox),
      growth_(new QComboBox),
      largest_(new QSpinBox),
      budget_(new NumberField(QStringLiteral("Limit"))),
      drags_(new QSpinBox) {
  const SizeTestOptions defaults;
  auto* form = new QFormLayout(this);
  form->setContentsMargins(0, 0, 0, 0);
  form->setVerticalSpacing(4);
  const auto add = [form](const QString& label, QWidget* field, const char* name, const QString& help) {
    field->setObjectName(QLatin1String(name));
    field->setAccessibleName(label);
    field->setToolTip(help);
    form->addRow(label, field);
    form->labelForField(field)->setToolTip(help);
    if (auto* spin = qobject_cast<QAbstractSpinBox*>(field)) {
      spin->setKeyboardTracking(false);
      connect(spin, &QAbstractSpinBox::editingFinished, spin, &QWidget::clearFocus);  // shortcuts work again
    }
  };
  add(QStringLiteral("First size"), first_, "sizeTestFirst", QStringLiteral("Elements along a side of the first grid"));
  first_->setRange(4, 1000);
  first_->setValue(int(defaults.first));
  add(QStringLiteral("Growth"), growth_, "sizeTestGrowth", QStringLiteral("Growth from one grid to the next"));
  growth_->addItem(QStringLiteral("10 % more per side"), 0.0);
  growth_->setItemData(0, QStringLiteral("As in 'chainmail ramp'; takes the longest time"), Qt::ToolTipRole);
  growth_->addItem(QStringLiteral("2 × elements"), defaults.growth);
  growth_->addItem(QStringLiteral("4 × elements"), 2.0);
  growth_->setCurrentIndex(1);
  add(QStringLiteral("Largest size"), largest_, "sizeTestLargest",
      QStringLiteral("Largest number of elements of a grid; drawing a million needs a fast machine"));
  largest_->setRange(16, 4'000'000);
  largest_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  largest_->setGroupSeparatorShown(true);
  largest_->setValue(int(defaults.largest));
  add(QStringLiteral("Real time"), budget_, "sizeTestBudget",
      QStringLiteral("Limit for the 99th percentile of the pass times (ms). 60 frames per second leave 16.667 ms"));
  budget_->setPrefix(QStringLiteral("≤ "));
  budget_->setSuffix(QStringLiteral(" ms"));
  budget_->setDecimals(3);
  budget_->setRange(0.001, 1000);
  budget_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  budget_->setValue(1000 * defaults.budget);
  add(QStringLiteral("Drags"), drags_, "sizeTestDrags",
      QStringLiteral("Number of drags at each size, plus one to warm up. A drag has 30 moves and takes 0.5 s. If "
                     "drawing is slow, fewer drags run, so that a size takes at most about 8 s"));
  drags_->setRange(1, 20);
  drags_->setValue(defaults.drags);
}

SizeTestOptions SizeTestChoices::options() const {
  SizeTestOptions options;
  options.first = std::uint32_t(first_->value());
  options.growth = growth_->currentData().toDouble();
  options.largest = std::uint64_t(largest_->value());
  options.budget = budget_->value() / 1000;
  options.drags = drags_->value();
  return options;
}

}  // namespace chainmail
