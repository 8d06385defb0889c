#pragma once

#include <QChar>
#include <QLocale>
#include <QString>
#include <algorithm>
#include <cmath>
#include <string_view>

namespace chainmail {

/// Converts a text of core for the interface.
inline QString text(std::string_view view) { return QString::fromUtf8(view.data(), qsizetype(view.size())); }

/// Returns words with a capital at their beginning.
inline QString sentence(const QString& words) { return words.left(1).toUpper() + words.mid(1); }

/// Returns '1 link', '2 links'.
inline QString counted(std::size_t count, const QString& noun) {
  return QStringLiteral("%L1 %2").arg(count).arg(count == 1 ? noun : noun + QLatin1Char('s'));
}

/// Returns 'cut 1 link', 'cut 2 links'.
inline QString counted(const QString& verb, std::size_t count, const QString& noun) {
  return QStringLiteral("%1 %2").arg(verb, counted(count, noun));
}

/// Returns the first parts, which middle dots separate, that fit together, so that no number is cut.
template <class Fits>
QString wholeParts(QString parts, Fits fits) {
  while (!parts.isEmpty() && !fits(parts)) {
    parts = parts.left(std::max<qsizetype>(0, parts.lastIndexOf(QChar(0xb7)))).trimmed();
  }
  return parts;
}

/// Returns a time of `milliseconds` with three digits, in ms or, if it is short, in µs, or, if it is long, in s.
inline QString shownTime(double milliseconds) {
  if (milliseconds >= 1e4) {
    return QLocale().toString(milliseconds / 1000, 'g', milliseconds < 1e6 ? 3 : 6) + QStringLiteral(" s");
  }
  const bool isShort = milliseconds < 0.1;
  const double time = isShort ? 1000 * milliseconds : milliseconds;
  return QLocale().toString(time, time < 1000 ? 'g' : 'f', time < 1000 ? 3 : 0) +
         (isShort ? QStringLiteral(" µs") : QStringLiteral(" ms"));
}

/// Returns a rate per second, rounded to three digits: more would be noise.
inline QString shownRate(double perSecond) {
  const double digit = perSecond < 1000 ? 1 : std::pow(10, std::floor(std::log10(perSecond)) - 2);
  return perSecond < 100 ? QLocale().toString(perSecond, 'g', 3)
                         : QLocale().toString(digit * std::round(perSecond / digit), 'f', 0);
}

/// Returns the name of a panel: A, B, C, … Panels are numbered from 0.
inline QString panelName(int panel) { return QChar(u'A' + panel); }

/// Returns a number as QLocale::toString() does; ∞ for an infinite one, and – for what is not a number.
inline QString shownNumber(double number, char format, int digits) {
  return std::isnan(number)   ? QStringLiteral("–")
         : std::isinf(number) ? (number < 0 ? QStringLiteral("−∞") : QStringLiteral("∞"))
                              : QLocale().toString(number, format, digits);
}

}  // namespace chainmail
