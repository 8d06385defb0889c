#pragma once

#include <QString>
#include <string_view>

namespace chainmail {

/// Converts a text of core for the interface.
inline QString text(std::string_view view) { return QString::fromUtf8(view.data(), qsizetype(view.size())); }

/// Returns '1 link', '2 links'.
inline QString counted(std::size_t count, const QString& noun) {
  return QStringLiteral("%L1 %2").arg(count).arg(count == 1 ? noun : noun + QLatin1Char('s'));
}

/// Returns 'cut 1 link', 'cut 2 links'.
inline QString counted(const QString& verb, std::size_t count, const QString& noun) {
  return QStringLiteral("%1 %2").arg(verb, counted(count, noun));
}

}  // namespace chainmail
