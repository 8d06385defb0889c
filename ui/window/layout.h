#pragma once

#include <QJsonObject>
#include <QList>
#include <QRect>
#include <QStringList>
#include <vector>

class QMainWindow;

namespace chainmail {

inline constexpr QSize roomOfFrame(40, 80);  // pixels, more than the frame of a window manager takes

/// Where a dock is.
struct DockPlace {
  QString id = {};  // its object name
  Qt::DockWidgetArea area = Qt::LeftDockWidgetArea;
  bool floating = false, visible = false;
  QString tabs = {};     // id of the first dock of its tabs; empty if it shares its place with no other dock
  bool front = false;    // on top of its tabs
  QSize size = {};       // pixels; 0: not known
  QPoint position = {};  // on the screen, if it floats

  bool operator==(const DockPlace&) const = default;
};

/// Where a window and its docks are: what settings and sessions keep of it.
struct Layout {
  QRect window = {};  // without its frame; null: not known
  bool maximized = false, toolBar = true;
  /// In the order of the docks along their areas. Docks that share a place as tabs are in the order of the tabs.
  std::vector<DockPlace> docks = {};

  bool operator==(const Layout&) const = default;
};

/// Returns the layout as JSON. The keys are "window" ([x, y, width, height]), "maximized", "toolBar" and "docks", an
/// array of objects with the keys "id", "area" (left, right, top, bottom), "floating", "visible", "tabs", "front",
/// "size" ([width, height]) and "position" ([x, y]).
QJsonObject toJson(const Layout& layout);

/// Reads a layout, which may come from a file of someone else: a value that is missing, wrong or out of range is
/// ignored. A dock has the first entry that names it. `ids` are those of the docks that exist.
Layout layoutFrom(const QJsonObject& json, QStringList ids);

/// Returns a rectangle on the screen that shows most of it, and no larger than that screen.
QRect onScreen(const QRect& rect, const QList<QRect>& screens);

/// Returns the layout with the window and the floating docks on one of the screens each, and no larger than it.
Layout fitted(Layout layout, const QList<QRect>& screens);

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
