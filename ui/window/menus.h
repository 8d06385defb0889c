#pragma once

class QMenuBar;

namespace chainmail {

/// Completes menus once all actions are in them: adds icons, and a mnemonic for every item, unique in its menu, so that
/// Alt and letters reach all items. Icons and mnemonics that are already set stay.
void completeMenus(const QMenuBar& bar);

}  // namespace chainmail
