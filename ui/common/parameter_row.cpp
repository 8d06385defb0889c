#include "common/parameter_row.h"

#include <QGridLayout>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>

#include "common/icons.h"
#include "common/number_field.h"
#include "common/text.h"

namespace chainmail {
namespace {

constexpr int sliderSteps = 1000;
constexpr double largestInField = 1e6;
constexpr int gesturePauseMilliseconds = 700;

/// Returns a new gesture number. Numbers are unique in the program, so that two rows never share one.
int nextGesture() {
  static int last = 0;
  return ++last;
}

}  // namespace

ParameterRow::ParameterRow(const Parameter& parameter, const QString& prefix)
    : parameter_(parameter),
      label_(new QLabel(text(parameter.label))),
      slider_(new QSlider(Qt::Horizontal)),
      spin_(new NumberField(text(parameter.label))),
      reset_(new QToolButton) {
  describe(prefix);
  slider_->setRange(0, sliderSteps);
  slider_->setPageStep(sliderSteps / 20);
  spin_->setKeyboardTracking(false);
  spin_->setDecimals(parameter.decimals);
  // The range ends one digit inside a limit that is itself not accepted: nearer numbers would be shown as that limit.
  const double digit = std::pow(10, -parameter.decimals);
  const double least = parameter.lowest > 0 ? std::max(parameter.lowest, digit) : parameter.lowest;
  const double most = std::floor(std::min(parameter.highest, largestInField) / digit) * digit;
  spin_->setRange(least, most);
  spin_->setSingleStep(parameter.step);
  spin_->setStepType(parameter.highest > 1000 ? QAbstractSpinBox::AdaptiveDecimalStepType
                                              : QAbstractSpinBox::DefaultStepType);
  spin_->setFixedWidth(88);
  reset_->setIcon(icon("reset"));
  reset_->setAutoRaise(true);
  show(parameter.default_value);

  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(6);
  grid->setVerticalSpacing(2);
  grid->addWidget(label_, 0, 0);
  grid->addWidget(spin_, 0, 1);
  grid->addWidget(reset_, 0, 2);
  grid->addWidget(slider_, 1, 0, 1, 3);
  grid->setColumnStretch(0, 1);

  connect(slider_, &QSlider::sliderPressed, this, [this] { gesture_ = nextGesture(); });
  connect(slider_, &QSlider::valueChanged, this, [this](int at) {
    announce(parameter_.lowest + (parameter_.slider_highest - parameter_.lowest) * at / sliderSteps);
  });
  connect(spin_, &QDoubleSpinBox::valueChanged, this, &ParameterRow::announce);
  connect(spin_, &QDoubleSpinBox::editingFinished, spin_, &QWidget::clearFocus);  // so that shortcuts work again
  connect(reset_, &QToolButton::clicked, this, [this] { announce(parameter_.default_value); });
}

/// Sets object names, names for screen readers, and tooltips.
void ParameterRow::describe(const QString& prefix) {
  const QString name = prefix + text(parameter_.name), label = text(parameter_.label);
  help_ = QStringLiteral("%1 (%2): %3").arg(label, text(parameter_.unit), text(parameter_.help));
  slider_->setObjectName(name + QStringLiteral("Slider"));
  slider_->setAccessibleName(label);
  spin_->setObjectName(name + QStringLiteral("Spin"));
  label_->setBuddy(spin_);
  reset_->setObjectName(name + QStringLiteral("Reset"));
  reset_->setToolTip(QStringLiteral("Resets to the default, %1").arg(parameter_.default_value));
  reset_->setAccessibleName(QStringLiteral("Reset %1").arg(label));
  disable({});
}

void ParameterRow::disable(const QString& why) {
  setEnabled(why.isEmpty());
  for (QWidget* widget : std::initializer_list<QWidget*>{label_, slider_, spin_}) {
    widget->setToolTip(why.isEmpty() ? help_ : why);
  }
}

void ParameterRow::show(double value) {
  const QSignalBlocker blockSlider(slider_);
  const QSignalBlocker blockSpin(spin_);
  spin_->setValue(value);
  if (!slider_->isSliderDown()) {
    slider_->setValue(toSlider(value));
  }
  reset_->setEnabled(spin_->value() != parameter_.default_value);
}

int ParameterRow::toSlider(double value) const {
  const double share = (value - parameter_.lowest) / (parameter_.slider_highest - parameter_.lowest);
  return int(std::lround(std::clamp(share, 0.0, 1.0) * sliderSteps));
}

void ParameterRow::announce(double value) {
  if (!slider_->isSliderDown() && (!sinceChange_.isValid() || sinceChange_.elapsed() > gesturePauseMilliseconds)) {
    gesture_ = nextGesture();
  }
  sinceChange_.start();
  show(value);
  emit changed(spin_->value(), gesture_);
}

}  // namespace chainmail
