#pragma once

class QMainWindow;

namespace chainmail {

/// Gives the actions of a window what they need beside each other, once all are there: the docks' own a name and an
/// effect, named ones their icons, and every item of a menu a letter of its own, so that all can be reached by Alt.
/// What was given before stays.
void completeMenus(QMainWindow& window);

}  // namespace chainmail
