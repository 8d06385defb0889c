#include "common/number_field.h"

#include <QGridLayout>
#include <QRegularExpression>
#include <QSignalBlocker>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "common/icons.h"
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

NumberField::NumberField(const QString& label) : label_(label) {
  QLocale own;
  own.setNumberOptions(QLocale::OmitGroupSeparator | QLocale::RejectGroupSeparator);
  setLocale(own);
}

std::optional<double> NumberField::read(const QString& text) const {
  static const QRegularExpression thousands(QStringLiteral(R"(,\d{3}$)"));
  QString number = text.trimmed();
  if (number.startsWith(prefix().trimmed())) {
    number = number.mid(prefix().trimmed().size()).trimmed();
  }
  if (number.endsWith(suffix().trimmed())) {
    number = number.chopped(suffix().trimmed().size()).trimmed();
  }
  if (!thousands.match(number).hasMatch()) {
    number.replace(QLatin1Char(','), QLatin1Char('.'));
  }
  bool ok = false;
  const double value = locale().toDouble(number, &ok);
  return ok ? std::optional(value) : std::nullopt;
}

QValidator::State NumberField::validate(QString& text, int& /*at*/) const {
  if (const auto value = read(text)) {
    return *value >= minimum() && *value <= maximum() ? QValidator::Acceptable : QValidator::Intermediate;
  }
  static const QRegularExpression begun(QStringLiteral(R"(^\s*[-+]?[\d.,]*([eE][-+]?\d*)?\s*$)"));
  return begun.match(text).hasMatch() ? QValidator::Intermediate : QValidator::Invalid;
}

double NumberField::valueFromText(const QString& text) const { return read(text).value_or(value()); }

/// Called when the input ends with a text that is not a number of the range. The former value stays.
void NumberField::fixup(QString& text) const {
  if (text.contains(QLatin1Char(',')) && !read(text)) {
    QToolTip::showText(mapToGlobal(rect().bottomLeft()),
                       QStringLiteral("%1 %2 could mean two numbers: use a decimal point. The value stays %3.")
                           .arg(label_, text.trimmed(), textFromValue(value())));
  } else if (const auto typed = read(text)) {
    const bool over = *typed > maximum();
    QToolTip::showText(mapToGlobal(rect().bottomLeft()),
                       QStringLiteral("%1 %2 is too %3: the %4 is %5. The value stays %6.")
                           .arg(label_, text.trimmed(), over ? QStringLiteral("large") : QStringLiteral("small"),
                                over ? QStringLiteral("largest") : QStringLiteral("smallest"),
                                locale().toString(over ? maximum() : minimum(), 'f', QLocale::FloatingPointShortest),
                                textFromValue(value())));
  }
}

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
