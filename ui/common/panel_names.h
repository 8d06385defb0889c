#pragma once

#include <QChar>
#include <QString>

namespace chainmail {

/// Returns the name of a panel, which is numbered from 0: A, B, C, …
inline QString panelName(int panel) { return QChar(u'A' + panel); }

}  // namespace chainmail
