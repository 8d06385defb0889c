#pragma once

#include <QString>
#include <string_view>

namespace chainmail {

/// A text of the core, for the window.
inline QString text(std::string_view view) { return QString::fromUtf8(view.data(), qsizetype(view.size())); }

/// '1 link', '2 links'.
inline QString counted(std::size_t count, const QString& noun) {
  return QStringLiteral("%L1 %2").arg(count).arg(count == 1 ? noun : noun + QLatin1Char('s'));
}

/// 'cut 1 link', 'cut 2 links'.
inline QString counted(const QString& verb, std::size_t count, const QString& noun) {
  return QStringLiteral("%1 %2").arg(verb, counted(count, noun));
}

}  // namespace chainmail
