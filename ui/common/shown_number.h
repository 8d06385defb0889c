#pragma once

#include <QLocale>
#include <QString>
#include <cmath>

namespace chainmail {

/// Returns a number as QLocale::toString() does; ∞ for an infinite one, and – for what is not a number.
inline QString shownNumber(double number, char format, int digits) {
  return std::isnan(number)   ? QStringLiteral("–")
         : std::isinf(number) ? (number < 0 ? QStringLiteral("−∞") : QStringLiteral("∞"))
                              : QLocale().toString(number, format, digits);
}

}  // namespace chainmail
