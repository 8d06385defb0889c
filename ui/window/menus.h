#pragma once

#include <QMenu>

class QMenuBar;

namespace chainmail {

/// Completes menus after all actions are added: adds icons, and a mnemonic for every item, unique in its menu, so that
/// all items can be reached with Alt and letters. Keeps icons and mnemonics that are already set.
void completeMenus(const QMenuBar& bar);

/// Adds the choice of theme, dark or light, to a menu.
void addThemes(QMenu& menu);

}  // namespace chainmail
