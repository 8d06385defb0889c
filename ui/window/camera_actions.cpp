#include "window/camera_actions.h"

#include <QApplication>

#include "common/icons.h"

namespace chainmail {
namespace {

constexpr double turn = 25, shift = 40;  // pixels of a mouse's travel
constexpr double zoomStep = 1.2;         // as of a notch of the wheel

struct Direction {
  const char* name;
  const char* icon;
  Qt::Key key;
  QPointF way;
};
constexpr std::array directions{
    Direction{"Left", "left", Qt::Key_Left, {-1, 0}}, Direction{"Right", "right", Qt::Key_Right, {1, 0}},
    Direction{"Up", "up", Qt::Key_Up, {0, -1}}, Direction{"Down", "down", Qt::Key_Down, {0, 1}}};

}  // namespace

CameraActions::CameraActions(QObject* parent) : QObject(parent) {
  for (const Direction& one : directions) {
    const QString way = QString::fromLatin1(one.name).toLower();
    add(("turn" + QByteArray(one.name)).constData(), QStringLiteral("Turn %1").arg(way), one.icon, {one.key},
        QStringLiteral("Turns an object in space by 10° to the %1; shifts one in a plane").arg(way),
        [way = one.way](View& view) { view.camera()->spatial() ? view.orbit(way * turn) : view.pan(way * shift); });
  }
  for (const Direction& one : directions) {
    const QString way = QString::fromLatin1(one.name).toLower();
    add(("shift" + QByteArray(one.name)).constData(), QStringLiteral("Shift %1").arg(way), one.icon,
        {Qt::SHIFT | one.key}, QStringLiteral("Shifts the object in the view by 40 pixels to the %1").arg(way),
        [way = one.way](View& view) { view.pan(way * shift); });
  }
  add("zoomIn", QStringLiteral("Zoom &in"), "zoomIn", {Qt::Key_Plus, Qt::Key_Equal},
      QStringLiteral("Shows the object larger, by a fifth"), [](View& view) { view.zoom(zoomStep); });
  add("zoomOut", QStringLiteral("Zoom &out"), "zoomOut", {Qt::Key_Minus},
      QStringLiteral("Shows the object smaller, by a fifth"), [](View& view) { view.zoom(1 / zoomStep); });
}

void CameraActions::add(const char* name, const QString& text, const char* iconName, const QList<QKeySequence>& keys,
                        const QString& tip, const std::function<void(View&)>& act) {
  auto* action = new QAction(icon(iconName), text, this);
  action->setObjectName(QLatin1String(name));
  action->setShortcuts(keys);
  action->setShortcutContext(Qt::WidgetShortcut);  // elsewhere these keys are those of lists and fields
  action->setStatusTip(tip);
  connect(action, &QAction::triggered, this, [this, act] {
    if (View* at = view()) {
      act(*at);
    }
  });
  actions_.push_back(action);
}

void CameraActions::fill(QMenu& menu) const {
  auto* own = menu.addMenu(icon("fit"), QStringLiteral("&Move the camera"));
  own->addActions({actions_.begin(), actions_.end()});
}

void CameraActions::attach(View& view) {
  views_.push_back(&view);
  view.addActions({actions_.begin(), actions_.end()});
  connect(&view, &QObject::destroyed, this, [this, gone = &view] { std::erase(views_, gone); });
}

View* CameraActions::view() const {
  auto* focused = qobject_cast<View*>(QApplication::focusWidget());
  return focused != nullptr || views_.empty() ? focused : views_.front();
}

}  // namespace chainmail
