#include "common/number_field.h"

#include <QRegularExpression>
#include <QToolTip>

namespace chainmail {

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

}  // namespace chainmail
