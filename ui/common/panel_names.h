#pragma once

#include <QChar>
#include <QString>

namespace chainmail {

/// How a panel is called wherever it is spoken of, beside its colour: A, B, C … by its number from 0.
inline QString panelName(int panel) { return QChar(u'A' + panel); }

}  // namespace chainmail
