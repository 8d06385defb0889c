#pragma once

#include <QChar>
#include <QString>

namespace chainmail {

/// Returns the name of a panel: A, B, C, … Panels are numbered from 0.
inline QString panelName(int panel) { return QChar(u'A' + panel); }

}  // namespace chainmail
