#include "window/layout.h"

#include <QDockWidget>
#include <QGuiApplication>
#include <QJsonArray>
#include <QLayout>
#include <QMainWindow>
#include <QScopeGuard>
#include <QScreen>
#include <QTabBar>
#include <QToolBar>
#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace chainmail {
namespace {

constexpr int smallest = 60, largest = 10'000, farthest = 100'000;  // pixels
constexpr QMargins frame(20, 50, 20, 30);                           // pixels, more than that of a window manager

struct AreaName {
  Qt::DockWidgetArea area;
  const char* name;
};
constexpr std::array areaNames{AreaName{Qt::LeftDockWidgetArea, "left"}, AreaName{Qt::RightDockWidgetArea, "right"},
                               AreaName{Qt::TopDockWidgetArea, "top"}, AreaName{Qt::BottomDockWidgetArea, "bottom"}};

QJsonObject toJson(const DockPlace& place) {
  const auto area = std::ranges::find(areaNames, place.area, &AreaName::area);
  QJsonObject json{{QStringLiteral("id"), place.id},
                   {QStringLiteral("area"), QLatin1String(area->name)},
                   {QStringLiteral("floating"), place.floating},
                   {QStringLiteral("visible"), place.visible}};
  if (!place.tabs.isEmpty()) {
    json[QStringLiteral("tabs")] = place.tabs;
    json[QStringLiteral("front")] = place.front;
  }
  if (!place.size.isEmpty()) {
    json[QStringLiteral("size")] = QJsonArray{place.size.width(), place.size.height()};
  }
  if (place.floating) {
    json[QStringLiteral("position")] = QJsonArray{place.position.x(), place.position.y()};
  }
  return json;
}

/// Returns two whole numbers within limits from a place in an array, or nothing.
std::optional<QPoint> pairAt(const QJsonArray& array, int at, int least, int most) {
  if (!array.at(at).isDouble() || !array.at(at + 1).isDouble()) {
    return std::nullopt;
  }
  const auto bounded = [&](int which) {
    return int(std::clamp(array.at(which).toDouble(), double(least), double(most)));
  };
  return QPoint(bounded(at), bounded(at + 1));
}

QSize sizeAt(const QJsonArray& array, int at) {
  const QPoint size = pairAt(array, at, smallest, largest).value_or(QPoint());
  return {size.x(), size.y()};
}

std::optional<DockPlace> placeFrom(const QJsonObject& json) {
  const QString name = json[QStringLiteral("area")].toString();
  const auto area =
      std::ranges::find_if(areaNames, [&](const AreaName& one) { return name == QLatin1String(one.name); });
  if (area == areaNames.end()) {
    return std::nullopt;
  }
  return DockPlace{
      .id = json[QStringLiteral("id")].toString(),
      .area = area->area,
      .floating = json[QStringLiteral("floating")].toBool(),
      .visible = json[QStringLiteral("visible")].toBool(),
      .tabs = json[QStringLiteral("tabs")].toString(),
      .front = json[QStringLiteral("front")].toBool(),
      .size = sizeAt(json[QStringLiteral("size")].toArray(), 0),
      .position = pairAt(json[QStringLiteral("position")].toArray(), 0, -farthest, farthest).value_or(QPoint())};
}

QRect within(const QRect& rect, const QRect& screen) {
  const QSize size = rect.size().boundedTo(screen.size());
  const QPoint last = screen.bottomRight() - QPoint(size.width(), size.height()) + QPoint(1, 1);
  return {{std::clamp(rect.x(), screen.x(), last.x()), std::clamp(rect.y(), screen.y(), last.y())}, size};
}

/// Returns the screen that shows most of the rectangle; the first if none shows any of it.
QRect screenOf(const QRect& rect, const QList<QRect>& screens) {
  return *std::ranges::max_element(screens, {}, [&](const QRect& screen) {
    const QRect shared = rect & screen;
    return qint64(shared.width()) * shared.height();
  });
}

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

DockPlace placeOf(const QMainWindow& window, const QDockWidget& dock, Qt::DockWidgetArea area, const Tabs& tabs) {
  return {.id = dock.objectName(),
          .area = area,
          .floating = dock.isFloating(),
          .visible = !dock.isHidden(),
          .tabs = tabs.size() > 1 ? tabs.first()->objectName() : QString(),
          .front = tabs.size() > 1 && isFront(window, dock),
          .size = dock.size(),
          .position = dock.isFloating() ? dock.pos() : QPoint()};
}

/// Completes what Qt does not know of a hidden dock.
void complete(DockPlace& place, const Layout& before) {
  const auto known = std::ranges::find(before.docks, place.id, &DockPlace::id);
  if (place.visible || known == before.docks.end()) {
    return;
  }
  if (!place.floating) {
    place.size = known->size;
  }
  if (place.tabs.isEmpty() && place.area == known->area) {
    place.tabs = known->tabs;
  }
}

void letFloat(QDockWidget& dock, const DockPlace& place) {
  dock.setFloating(true);
  if (!place.size.isEmpty()) {
    dock.setGeometry({place.position, place.size});
  }
}

using Places = std::vector<std::pair<QDockWidget*, DockPlace>>;

void placeAll(QMainWindow& window, const Places& places) {
  for (const auto& [dock, place] : places) {
    dock->setFloating(false);  // first: a dock that was removed stays floating
    window.removeDockWidget(dock);
  }
  std::map<QString, QDockWidget*> firsts;  // of tabs, by their names
  for (const auto& [dock, place] : places) {
    const auto [first, isNew] = firsts.try_emplace(place.tabs, dock);
    if (isNew || place.tabs.isEmpty()) {
      window.addDockWidget(place.area, dock);
    } else {
      window.tabifyDockWidget(first->second, dock);
    }
  }
  for (const auto& [dock, place] : places) {
    dock->setVisible(place.visible);
    if (place.floating) {
      letFloat(*dock, place);
    }
  }
}

/// Gives the docks that are seen their sizes.
void resizeAll(QMainWindow& window, const Places& places, const QRect& before) {
  const auto scaled = [](int size, int now, int then) { return then > now ? int(qint64(size) * now / then) : size; };
  QList<QDockWidget*> wide, tall;
  QList<int> widths, heights;
  for (const auto& [dock, place] : places) {
    const bool seen = place.visible && !place.floating && (place.tabs.isEmpty() || place.front);
    if (seen && place.size.width() > 0) {
      wide << dock;
      widths << scaled(place.size.width(), window.width(), before.width());
    }
    if (seen && place.size.height() > 0) {
      tall << dock;
      heights << scaled(place.size.height(), window.height(), before.height());
    }
  }
  window.resizeDocks(wide, widths, Qt::Horizontal);
  window.resizeDocks(tall, heights, Qt::Vertical);
}

constexpr std::array areas{Qt::LeftDockWidgetArea, Qt::RightDockWidgetArea, Qt::TopDockWidgetArea,
                           Qt::BottomDockWidgetArea};

bool fitsItsScreen(const QMainWindow& window) {
  const QSize frame = window.frameGeometry().size() - window.size();  // empty until the window manager has drawn it
  const QSize least = window.minimumSizeHint() + (frame.isNull() && !window.isMaximized() ? roomOfFrame : frame);
  return least.boundedTo(window.screen()->availableSize()) == least;
}

}  // namespace

QJsonObject toJson(const Layout& layout) {
  const QRect& at = layout.window;
  QJsonArray docks;
  for (const DockPlace& place : layout.docks) {
    docks << toJson(place);
  }
  return {{QStringLiteral("window"), QJsonArray{at.x(), at.y(), at.width(), at.height()}},
          {QStringLiteral("maximized"), layout.maximized},
          {QStringLiteral("toolBar"), layout.toolBar},
          {QStringLiteral("docks"), docks}};
}

Layout layoutFrom(const QJsonObject& json, QStringList ids) {
  Layout layout{.maximized = json[QStringLiteral("maximized")].toBool(),
                .toolBar = json[QStringLiteral("toolBar")].toBool(true)};
  const QJsonArray window = json[QStringLiteral("window")].toArray();
  if (const auto at = pairAt(window, 0, -farthest, farthest); at && !sizeAt(window, 2).isEmpty()) {
    layout.window = {*at, sizeAt(window, 2)};
  }
  for (const auto& entry : json[QStringLiteral("docks")].toArray()) {
    if (ids.isEmpty()) {
      break;  // a file may have millions of entries
    }
    if (auto place = placeFrom(entry.toObject()); place && ids.removeOne(place->id)) {
      layout.docks.push_back(*std::move(place));
    }
  }
  return layout;
}

QRect onScreen(const QRect& rect, const QList<QRect>& screens) {
  return screens.isEmpty() ? rect : within(rect, screenOf(rect, screens));
}

Layout fitted(Layout layout, const QList<QRect>& screens) {
  if (screens.isEmpty()) {
    return layout;
  }
  if (const QRect screen = screenOf(layout.window, screens);
      !layout.window.isNull() && !screen.contains(layout.window)) {
    layout.window = within(layout.window, screen.marginsRemoved(frame));
  }
  for (DockPlace& place : layout.docks) {
    if (const QRect at(place.position, place.size); place.floating && !place.size.isEmpty()) {
      const QRect there = onScreen(at, screens);
      place.position = there.topLeft();
      place.size = there.size();
    }
  }
  return layout;
}

QList<QRect> availableScreens() {
  QList<QRect> available;
  for (const QScreen* screen : QGuiApplication::screens()) {
    available << screen->availableGeometry();
  }
  return available;
}

Layout layoutOf(const QMainWindow& window, const Layout& before) {
  Layout layout{.window = window.geometry(),
                .maximized = window.isMaximized(),
                .toolBar = !window.findChild<QToolBar*>(QString(), Qt::FindDirectChildrenOnly)->isHidden()};
  for (const Qt::DockWidgetArea area : areas) {
    for (const Tabs& tabs : docksIn(window, area)) {
      for (const QDockWidget* dock : tabs) {
        layout.docks.push_back(placeOf(window, *dock, area, tabs));
        complete(layout.docks.back(), before);
      }
    }
  }
  return layout;
}

void moveDocks(QMainWindow& window, Layout layout) {
  layout = fitted(std::move(layout), availableScreens());
  Places places;
  for (const DockPlace& place : layout.docks) {
    places.emplace_back(window.findChild<QDockWidget*>(place.id, Qt::FindDirectChildrenOnly), place);
  }
  {
    // A layout that reacts to each dock alone moves the others several times.
    window.layout()->setEnabled(false);
    const auto enable = qScopeGuard([&window] {
      window.layout()->setEnabled(true);
      window.layout()->activate();
    });
    placeAll(window, places);
    if (window.isVisible()) {  // else widgets ask for more room than they need
      gatherDocks(window);
    }
  }
  resizeAll(window, places, layout.window);
  for (const auto& [dock, place] : places) {
    if (place.front && place.visible) {
      dock->raise();
    }
    if (place.floating && !place.size.isEmpty()) {  // its content may need more room than it had
      dock->move(onScreen(dock->geometry(), availableScreens()).topLeft());
    }
  }
}

void gatherDocks(QMainWindow& window) {
  const auto gather = [&window](const auto& isChosen) {
    QDockWidget* first = nullptr;
    for (QDockWidget* dock : docksOf(window)) {
      if (dock->isHidden() || dock->isFloating() || !isChosen(dock)) {
        continue;
      }
      if (first != nullptr) {
        window.tabifyDockWidget(first, dock);
      }
      first = first != nullptr ? first : dock;
    }
    window.layout()->invalidate();
  };
  for (auto area = areas.rbegin(); area != areas.rend() && !fitsItsScreen(window); ++area) {
    gather([&](QDockWidget* dock) { return window.dockWidgetArea(dock) == *area; });
  }
  if (!fitsItsScreen(window)) {
    gather([](QDockWidget* /*dock*/) { return true; });
  }
}

}  // namespace chainmail
