#include "docks/size_test/size_test_choices.h"

#include <QFormLayout>
#include <QLabel>

namespace chainmail {

SizeTestChoices::SizeTestChoices()
    : first_(new QSpinBox),
      growth_(new QComboBox),
      largest_(new QSpinBox),
      budget_(new QDoubleSpinBox),
      drags_(new QSpinBox) {
  const SizeTestOptions standard;
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
  add(QStringLiteral("Begin with"), first_, "sizeTestFirst", QStringLiteral("Elements along a side of the first grid"));
  first_->setRange(4, 1000);
  first_->setValue(int(standard.first));
  add(QStringLiteral("Grow"), growth_, "sizeTestGrowth", QStringLiteral("How much larger each grid is than the last"));
  growth_->addItem(QStringLiteral("a tenth a side"), 0.0);
  growth_->setItemData(0, QStringLiteral("As 'chainmail ramp' does; takes longest"), Qt::ToolTipRole);
  growth_->addItem(QStringLiteral("twice the elements"), standard.growth);
  growth_->addItem(QStringLiteral("four times the elements"), 2.0);
  growth_->setCurrentIndex(1);
  add(QStringLiteral("Up to"), largest_, "sizeTestLargest",
      QStringLiteral("No grid beyond so many elements; drawing a million takes a good machine"));
  largest_->setRange(16, 4'000'000);
  largest_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  largest_->setGroupSeparatorShown(true);
  largest_->setValue(int(standard.largest));
  add(QStringLiteral("Real time"), budget_, "sizeTestBudget",
      QStringLiteral("A pass must take no longer than this, but for the slowest hundredth (ms); a frame at 60 a "
                     "second is 16.667"));
  budget_->setPrefix(QStringLiteral("≤ "));
  budget_->setSuffix(QStringLiteral(" ms"));
  budget_->setDecimals(3);
  budget_->setRange(0.001, 1000);
  budget_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  budget_->setValue(1000 * standard.budget);
  add(QStringLiteral("Drags"), drags_, "sizeTestDrags",
      QStringLiteral("At each size, of 30 moves each, beside one to warm up: half a second each, and "
                     "fewer where drawing is slow, so that a size takes no longer than about 8 s"));
  drags_->setRange(1, 20);
  drags_->setValue(standard.drags);
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
