#include "window/dock_layout.h"

#include <QDockWidget>
#include <QJsonObject>
#include <QLayout>
#include <QMainWindow>
#include <QScopeGuard>
#include <QScreen>
#include <QTabBar>
#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace chainmail {
namespace {

constexpr int smallestDock = 20, largestDock = 10'000, farthest = 100'000;  // pixels

struct AreaName {
  Qt::DockWidgetArea area;
  const char* name;
};
constexpr std::array areaNames{AreaName{Qt::LeftDockWidgetArea, "left"}, AreaName{Qt::RightDockWidgetArea, "right"},
                               AreaName{Qt::TopDockWidgetArea, "top"}, AreaName{Qt::BottomDockWidgetArea, "bottom"}};

/// Docks that share a place as tabs, in the order of the tabs. Most have one dock only.
using Tabs = QList<QDockWidget*>;

QList<QDockWidget*> docksOf(const QMainWindow& window) {
  return window.findChildren<QDockWidget*>(Qt::FindDirectChildrenOnly);
}

/// Returns the tab bar that shows the tab of a dock, and the tab's index in it; no bar if the dock has no tab.
std::pair<const QTabBar*, int> tabOf(const QMainWindow& window, const QDockWidget& dock) {
  for (const QTabBar* bar : window.findChildren<QTabBar*>(Qt::FindDirectChildrenOnly)) {
    for (int tab = 0; tab < bar->count(); ++tab) {
      if (bar->tabText(tab) == dock.windowTitle()) {
        return {bar, tab};
      }
    }
  }
  return {nullptr, 0};
}

/// Returns the docks that share the place of this one, with itself. Hidden docks have no tab and come last.
Tabs tabsOf(const QMainWindow& window, QDockWidget* dock) {
  Tabs tabs = window.tabifiedDockWidgets(dock);
  tabs << dock;
  const auto rank = [&window](const QDockWidget* one) {
    const auto [bar, tab] = tabOf(window, *one);
    return bar != nullptr ? tab : std::numeric_limits<int>::max();
  };
  std::ranges::stable_sort(tabs, {}, rank);
  return tabs;
}

bool isFront(const QMainWindow& window, const QDockWidget& dock) {
  const auto [bar, tab] = tabOf(window, dock);
  return bar != nullptr && bar->currentIndex() == tab;
}

/// Returns the dock of some tabs that can be seen, or null.
QDockWidget* seenOf(const QMainWindow& window, const Tabs& tabs) {
  for (QDockWidget* dock : tabs) {
    if (!dock->isHidden() && !dock->isFloating() && (tabs.size() == 1 || isFront(window, *dock))) {
      return dock;
    }
  }
  return nullptr;
}

/// Returns the docks of an area from its beginning to its end. Docks that are not seen have no place of their own
/// there, and stay where they are in the order of the window's children.
std::vector<Tabs> docksIn(const QMainWindow& window, Qt::DockWidgetArea area) {
  // Qt lists the tabs of visible docks only, so those come first.
  QList<QDockWidget*> docks = docksOf(window);
  std::stable_partition(docks.begin(), docks.end(), [](const QDockWidget* dock) { return !dock->isHidden(); });
  std::vector<Tabs> places;
  QList<QDockWidget*> taken;
  for (QDockWidget* dock : docks) {
    if (window.dockWidgetArea(dock) == area && !taken.contains(dock)) {
      places.push_back(tabsOf(window, dock));
      taken += places.back();
    }
  }
  std::vector<Tabs> seen;
  std::ranges::copy_if(places, std::back_inserter(seen),
                       [&](const Tabs& tabs) { return seenOf(window, tabs) != nullptr; });
  std::ranges::stable_sort(seen, {}, [&](const Tabs& tabs) {
    const QPoint at = seenOf(window, tabs)->pos();
    return std::pair(at.y(), at.x());
  });
  auto next = seen.begin();
  for (Tabs& tabs : places) {
    if (seenOf(window, tabs) != nullptr) {
      tabs = *next++;
    }
  }
  return places;
}

QJsonObject entryOf(const QMainWindow& window, const QDockWidget& dock, const char* area, const Tabs& tabs) {
  QJsonObject entry{{QStringLiteral("id"), dock.objectName()},
                    {QStringLiteral("area"), QLatin1String(area)},
                    {QStringLiteral("floating"), dock.isFloating()},
                    {QStringLiteral("visible"), !dock.isHidden()}};
  if (tabs.size() > 1) {
    entry[QStringLiteral("tabs")] = tabs.first()->objectName();
    entry[QStringLiteral("front")] = isFront(window, dock);
  }
  if (!dock.isHidden()) {
    entry[QStringLiteral("size")] = QJsonArray{dock.width(), dock.height()};
  }
  if (dock.isFloating()) {
    entry[QStringLiteral("position")] = QJsonArray{dock.x(), dock.y()};
  }
  return entry;
}

/// A checked entry.
struct Place {
  QDockWidget* dock;
  Qt::DockWidgetArea area;
  bool floating, visible, front;
  QString tabs;
  std::optional<QSize> size;
  std::optional<QPoint> position;
};

/// Returns two whole numbers within limits, or nothing.
std::optional<std::pair<int, int>> pairOf(const QJsonValue& json, int least, int most) {
  const QJsonArray array = json.toArray();
  if (array.size() != 2 || !array[0].isDouble() || !array[1].isDouble()) {
    return std::nullopt;
  }
  const auto bounded = [&](const QJsonValue& value) {
    return int(std::clamp(value.toDouble(), double(least), double(most)));
  };
  return std::pair(bounded(array[0]), bounded(array[1]));
}

std::optional<Place> viewPosition(const QJsonObject& entry, const QList<QDockWidget*>& docks) {
  const auto dock = std::ranges::find(docks, entry[QStringLiteral("id")].toString(), &QDockWidget::objectName);
  const auto area = std::ranges::find(areaNames, entry[QStringLiteral("area")].toString(),
                                      [](const AreaName& one) { return QLatin1String(one.name); });
  if (dock == docks.end() || area == areaNames.end()) {
    return std::nullopt;
  }
  Place place{*dock,
              area->area,
              entry[QStringLiteral("floating")].toBool(),
              entry[QStringLiteral("visible")].toBool(),
              entry[QStringLiteral("front")].toBool(),
              entry[QStringLiteral("tabs")].toString(),
              {},
              {}};
  if (const auto size = pairOf(entry[QStringLiteral("size")], smallestDock, largestDock)) {
    place.size = QSize(size->first, size->second);
  }
  if (const auto position = pairOf(entry[QStringLiteral("position")], -farthest, farthest)) {
    place.position = QPoint(position->first, position->second);
  }
  return place;
}

/// Returns the entries that name a dock and an area. Of two entries for one dock, the first counts.
std::vector<Place> placesOf(const QJsonArray& layout, QList<QDockWidget*> docks) {
  std::vector<Place> places;
  for (const auto& entry : layout) {
    if (docks.isEmpty()) {
      break;  // a file may have millions of entries
    }
    if (const auto place = viewPosition(entry.toObject(), docks)) {
      places.push_back(*place);
      docks.removeOne(place->dock);
    }
  }
  return places;
}

/// Moves a floating dock onto the screen.
void letFloat(const Place& place) {
  place.dock->setFloating(true);
  const QRect screen = place.dock->screen()->availableGeometry();
  place.dock->resize(place.size.value_or(place.dock->size()).boundedTo(screen.size()));
  const QPoint last = screen.bottomRight() - QPoint(place.dock->width(), place.dock->height()) + QPoint(1, 1);
  const QPoint wanted = place.position.value_or(screen.topLeft());
  place.dock->move(std::max(std::min(wanted.x(), last.x()), screen.left()),
                   std::max(std::min(wanted.y(), last.y()), screen.top()));
}

void dockAll(QMainWindow& window, const std::vector<Place>& places) {
  for (const Place& place : places) {
    place.dock->setFloating(false);  // first: a dock that was removed stays floating
    window.removeDockWidget(place.dock);
  }
  std::map<QString, QDockWidget*> firsts;  // of tabs, by their names
  for (const Place& place : places) {
    const auto [first, isNew] = firsts.try_emplace(place.tabs, place.dock);
    if (isNew || place.tabs.isEmpty()) {
      window.addDockWidget(place.area, place.dock);
    } else {
      window.tabifyDockWidget(first->second, place.dock);
    }
  }
  for (const Place& place : places) {
    place.dock->setVisible(place.visible);
    if (place.floating) {
      letFloat(place);
    }
  }
}

/// Gives the docks that are seen their sizes.
void resizeAll(QMainWindow& window, const std::vector<Place>& places) {
  QList<QDockWidget*> docks;
  QList<int> widths, heights;
  for (const Place& place : places) {
    if (place.visible && !place.floating && place.size && (place.tabs.isEmpty() || place.front)) {
      docks << place.dock;
      widths << place.size->width();
      heights << place.size->height();
    }
  }
  window.resizeDocks(docks, widths, Qt::Horizontal);
  window.resizeDocks(docks, heights, Qt::Vertical);
}

}  // namespace

QJsonArray dockLayout(const QMainWindow& window) {
  QJsonArray layout;
  for (const AreaName& one : areaNames) {
    for (const Tabs& tabs : docksIn(window, one.area)) {
      for (const QDockWidget* dock : tabs) {
        layout << entryOf(window, *dock, one.name, tabs);
      }
    }
  }
  return layout;
}

void applyDockLayout(QMainWindow& window, const QJsonArray& layout) {
  const std::vector<Place> places = placesOf(layout, docksOf(window));
  if (places.empty()) {
    return;
  }
  {
    // A layout that reacts to each dock alone moves the others several times.
    window.layout()->setEnabled(false);
    const auto enable = qScopeGuard([&window] {
      window.layout()->setEnabled(true);
      window.layout()->activate();
    });
    dockAll(window, places);
  }
  resizeAll(window, places);
  for (const Place& place : places) {
    if (place.front && place.visible) {
      place.dock->raise();
    }
  }
}

void skipLoneTabs(const QMainWindow& window) {
  for (QTabBar* bar : window.findChildren<QTabBar*>(Qt::FindDirectChildrenOnly)) {
    bar->setFocusPolicy(bar->count() > 1 ? Qt::TabFocus : Qt::NoFocus);
  }
}

}  // namespace chainmail
