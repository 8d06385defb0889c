#pragma once

#include <QString>
#include <string_view>

namespace chainmail {

/// A text of the core, for the window.
inline QString text(std::string_view view) { return QString::fromUtf8(view.data(), qsizetype(view.size())); }

/// 'cut 1 link', 'cut 2 links'.
inline QString counted(const QString& verb, std::size_t count, const QString& noun) {
  return QStringLiteral("%1 %L2 %3").arg(verb).arg(count).arg(count == 1 ? noun : noun + QLatin1Char('s'));
}

}  // namespace chainmail
