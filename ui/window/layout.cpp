#include "window/layout.h"

#include <QJsonArray>
#include <algorithm>
#include <array>
#include <optional>

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

}  // namespace chainmail
