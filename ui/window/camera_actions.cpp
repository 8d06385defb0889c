#include "window/camera_actions.h"

#include <QApplication>
#include <QSignalBlocker>
#include <algorithm>
#include <array>

#include "common/icons.h"
#include "document/document.h"
#include "panels/panel.h"
#include "panels/panel_area.h"

namespace chainmail {
namespace {

constexpr double turnPixels = 25, panPixels = 40;  // mouse travel per key press
constexpr double zoomStep = 1.2;                   // zoom factor of one wheel step

struct Direction {
  const char* name;
  const char* icon;
  Qt::Key key;
  QPointF way;
};
constexpr std::array directions{
    Direction{"Left", "left", Qt::Key_Left, {-1, 0}}, Direction{"Right", "right", Qt::Key_Right, {1, 0}},
    Direction{"Up", "up", Qt::Key_Up, {0, -1}}, Direction{"Down", "down", Qt::Key_Down, {0, 1}}};

struct AxisView {
  const char* name;
  QKeyCombination key;
  int axis;
  bool positive;
};
// The key is the axis of the view; Shift looks from its negative end.
constexpr std::array axisViews{
    AxisView{"viewFront", Qt::Key_Z, 2, true}, AxisView{"viewBack", Qt::SHIFT | Qt::Key_Z, 2, false},
    AxisView{"viewRight", Qt::Key_X, 0, true}, AxisView{"viewLeft", Qt::SHIFT | Qt::Key_X, 0, false},
    AxisView{"viewTop", Qt::Key_Y, 1, true},   AxisView{"viewBottom", Qt::SHIFT | Qt::Key_Y, 1, false},
};

/// Returns the side of the object at this end of an axis.
QString sideAt(const AxisView& view, Camera::Up up) {
  const bool zUp = up == Camera::Up::z;
  if (view.axis == 0) {
    return view.positive ? QStringLiteral("right") : QStringLiteral("left");
  }
  if ((view.axis == 2) == zUp) {
    return view.positive ? QStringLiteral("top") : QStringLiteral("bottom");
  }
  return view.positive != zUp ? QStringLiteral("front") : QStringLiteral("back");
}

QString endOf(const AxisView& view) {
  return (view.positive ? QStringLiteral("+") : QStringLiteral("−")) + QStringLiteral("xyz")[view.axis];
}

}  // namespace

CameraActions::CameraActions(QObject* parent, const Document& document, PanelArea& area)
    : QObject(parent), document_(document), area_(area) {
  makeMoves();
  const auto attachTo = [this](Panel* panel) { attach(*panel); };
  std::ranges::for_each(area.panels(), attachTo);
  connect(&area, &PanelArea::added, this, attachTo);
  connect(&document, &Document::meshChanged, this, &CameraActions::adapt);
}

void CameraActions::makeMoves() {
  for (const Direction& one : directions) {
    const QString way = QString::fromLatin1(one.name).toLower();
    add(("turn" + QByteArray(one.name)).constData(), QStringLiteral("Turn %1").arg(way), one.icon, {one.key},
        QStringLiteral("Turns a 3D object by 10°, or pans a 2D object by 40 pixels: %1").arg(way),
        [way = one.way](View& view) {
          view.camera()->spatial() ? view.orbit(way * turnPixels) : view.pan(way * panPixels);
        });
  }
  for (const Direction& one : directions) {
    const QString way = QString::fromLatin1(one.name).toLower();
    add(("shift" + QByteArray(one.name)).constData(), QStringLiteral("Pan %1").arg(way), one.icon,
        {Qt::SHIFT | one.key}, QStringLiteral("Moves the object in the view by 40 pixels: %1").arg(way),
        [way = one.way](View& view) { view.pan(way * panPixels); });
  }
  add("zoomIn", QStringLiteral("Zoom &in"), "zoomIn", {Qt::Key_Plus, Qt::Key_Equal},
      QStringLiteral("Shows the object larger by a factor of 1.2"), [](View& view) { view.zoom(zoomStep); });
  add("zoomOut", QStringLiteral("Zoom &out"), "zoomOut", {Qt::Key_Minus},
      QStringLiteral("Shows the object smaller by a factor of 1.2"), [](View& view) { view.zoom(1 / zoomStep); });
}

void CameraActions::add(const char* name, const QString& text, const char* iconName, const QList<QKeySequence>& keys,
                        const QString& tip, const std::function<void(View&)>& act) {
  auto* action = new QAction(icon(iconName), text, this);
  action->setObjectName(QLatin1String(name));
  action->setShortcuts(keys);
  action->setShortcutContext(Qt::WidgetShortcut);  // because lists and fields use the same keys
  action->setStatusTip(tip);
  connect(action, &QAction::triggered, this, [this, act] {
    if (View* view = focusedView()) {
      act(*view);
    }
  });
  moves_.push_back(action);
}

void CameraActions::attach(Panel& panel) { panel.view().addActions({moves_.begin(), moves_.end()}); }

View* CameraActions::focusedView() const {
  auto* focused = qobject_cast<View*>(QApplication::focusWidget());
  return focused != nullptr ? focused : &area_.panels().front()->view();
}

void CameraActions::fillMoves(QMenu& menu) const {
  auto* moves = menu.addMenu(icon("fit"), QStringLiteral("&Move camera"));
  moves->addActions({moves_.begin(), moves_.end()});
}

void CameraActions::fillSides(QMenu& menu) {
  auto* from = menu.addMenu(QStringLiteral("Look &from"));
  from->setIcon(icon("axes"));
  from->setToolTipsVisible(true);
  for (const AxisView& side : axisViews) {
    auto* action = from->addAction(QString(), this, [this, side] {
      for (Panel* panel : area_.panels()) {
        panel->view().lookFromAxis(side.axis, side.positive);
      }
    });
    action->setObjectName(QLatin1String(side.name));
    action->setShortcut(QKeySequence(side.key));
    action->setStatusTip(QStringLiteral("All panels show the object from %1").arg(endOf(side)));
    sides_.push_back(action);
  }
  addUp(*from);
  addProjection(menu);
  adapt();
}

void CameraActions::addUp(QMenu& menu) {
  upZ_ = menu.addAction(QStringLiteral("&Z axis points up"));
  upZ_->setObjectName(QStringLiteral("upZ"));
  upZ_->setCheckable(true);
  upZ_->setStatusTip(QStringLiteral("Turns the views so that the z axis points up; otherwise, the y axis does"));
  connect(upZ_, &QAction::toggled, this, [this](bool on) { area_.setUp(on ? Camera::Up::z : Camera::Up::y); });
  connect(&menu, &QMenu::aboutToShow, this, &CameraActions::adapt);
  sides_.push_back(upZ_);
}

void CameraActions::addProjection(QMenu& menu) {
  auto* parallel = menu.addAction(QStringLiteral("Parallel pro&jection"));
  parallel->setObjectName(QStringLiteral("parallelRays"));
  parallel->setCheckable(true);
  parallel->setShortcut(Qt::SHIFT | Qt::Key_F);
  parallel->setStatusTip(QStringLiteral("Turns perspective off: equal lengths look equal at any distance"));
  connect(parallel, &QAction::toggled, this, [this](bool on) {
    for (Panel* panel : area_.panels()) {
      panel->view().setParallel(on);
    }
  });
  sides_.push_back(parallel);
}

void CameraActions::adapt() {
  const bool spatial = document_.mesh()->space_dimension == 3;
  const QSignalBlocker quiet(upZ_);
  upZ_->setChecked(area_.up() == Camera::Up::z);
  for (std::size_t i = 0; i < axisViews.size(); ++i) {
    sides_[i]->setText(QStringLiteral("From %1 (%2)").arg(endOf(axisViews[i]), sideAt(axisViews[i], area_.up())));
  }
  for (QAction* action : sides_) {
    action->setEnabled(spatial);
    action->setToolTip(spatial ? action->statusTip()
                               : QStringLiteral("Not available: this object is in 2D and has only one view"));
  }
}

}  // namespace chainmail
