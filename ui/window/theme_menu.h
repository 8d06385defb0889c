#pragma once

#include <QMenu>

namespace chainmail {

/// Adds the choice of theme, dark or light, to a menu.
void addThemes(QMenu& menu);

}  // namespace chainmail
