#pragma once

#include <QJsonArray>

class QMainWindow;

namespace chainmail {

/// Returns where the docks of a window are, as JSON for a session: an object per dock, in the order of the docks along
/// their area. Docks that share a place as tabs follow each other in the order of their tabs. The keys are
///   "id"                             object name of the dock
///   "area"                           "left", "right", "top" or "bottom"
///   "floating", "visible", "front"   booleans; front: the dock is the one on top of its tabs
///   "tabs"                           id of the first dock of its tabs, if there are tabs
///   "size"                           width and height (pixels), if it is visible
///   "position"                       of a floating dock on the screen (pixels)
QJsonArray dockLayout(const QMainWindow& window);

/// Moves, shows and hides docks as in the JSON, which may come from a file of someone else: a value that is missing,
/// wrong or out of range is ignored, and a dock that the JSON does not name stays as it is. Floating docks are moved
/// onto the screen.
void applyDockLayout(QMainWindow& window, const QJsonArray& layout);

/// Keeps the focus from tab bars with a single tab, which Qt moves beyond the edge of the window but does not hide.
void skipLoneTabs(const QMainWindow& window);

}  // namespace chainmail
