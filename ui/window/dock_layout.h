#pragma once

#include "window/layout.h"

class QMainWindow;

namespace chainmail {

/// Returns where a window and its docks are. Qt does not say of hidden docks which tabs they had: those of `before`.
Layout layoutOf(const QMainWindow& window, const Layout& before);

/// Moves, shows and hides the docks that a layout names, onto the screens that there are. A size counts in the
/// proportion of the window's size to that in the layout, unless the window is larger.
void moveDocks(QMainWindow& window, Layout layout);

/// Puts the docks of an edge behind tabs, edge by edge and at last all, until the window is no larger than its screen:
/// a larger screen may have shown more of them at once.
void gatherDocks(QMainWindow& window);

/// Returns the parts of the screens that windows may use.
QList<QRect> availableScreens();

}  // namespace chainmail
