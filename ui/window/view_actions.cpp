#include "window/view_actions.h"

#include <QApplication>
#include <QToolBar>
#include <QToolButton>
#include <algorithm>
#include <array>

#include "common/actions.h"
#include "common/text.h"
#include "document/document.h"
#include "panels/panel.h"
#include "panels/panel_area.h"

namespace chainmail {
namespace {

constexpr double turnPixels = 25, panPixels = 40;  // mouse travel per key press
constexpr double zoomStep = 1.2;                   // zoom factor of one wheel step

struct Direction {
  const char* name;  // of its key, too
  const char* icon;
  QPointF way;
};
constexpr std::array directions{Direction{"Left", "left", {-1, 0}}, Direction{"Right", "right", {1, 0}},
                                Direction{"Up", "up", {0, -1}}, Direction{"Down", "down", {0, 1}}};

struct AxisView {
  const char* name;
  const char* key;
  int axis;
  bool positive;
};
// The key is the axis of the view; Shift looks from its negative end.
constexpr std::array axisViews{
    AxisView{"viewFront", "Z", 2, true}, AxisView{"viewBack", "Shift+Z", 2, false},
    AxisView{"viewRight", "X", 0, true}, AxisView{"viewLeft", "Shift+X", 0, false},
    AxisView{"viewTop", "Y", 1, true},   AxisView{"viewBottom", "Shift+Y", 1, false},
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

/// Adds the rows that each panel has.
void addActionsOfPanels(Actions& actions, const Document& document, PanelArea& area, Colouring& colouring) {
  std::vector<ActionRow> alone{{}}, reference;
  for (int panel = 0; panel < Document::maxPanels; ++panel) {
    const QString name = panelName(panel), number = QString::number(panel + 1);
    const Appears existing([&document, panel] { return Appearance{.visible = panel < document.panels()}; });
    const auto isSeen = [&area, panel] { return std::ranges::count(area.inSight(), panel) != 0; };
    actions.add(
        "panels",
        {{"showPanel" + name, "Show &" + name, "", "Ctrl+" + number,
          QStringLiteral("Shows panel %1. Hidden panels keep running. At least one panel stays visible").arg(name),
          [&area, panel](bool shown) { area.setShown(panel, shown); }, IsOn(isSeen), existing,
          When([&area, isSeen] { return !isSeen() || area.inSight().size() > 1; })}});  // the last visible panel stays
    alone.emplace_back(
        "showAlone" + name, "Show only " + name, "", "Alt+" + number,
        QStringLiteral("Show only panel %1, or all panels (or double-click the header of the panel)").arg(name),
        [&area, panel](bool on) { area.setAlone(on ? std::optional(panel) : std::nullopt); },
        IsOn([&area, panel] { return area.alone() == panel; }), existing);
    reference.emplace_back(
        "compareWith" + name, "Panel &" + name, "", "",
        QStringLiteral("Compares all other panels with panel %1 in colours of distance and difference").arg(name),
        [&colouring, panel] { colouring.setReference(panel); },
        IsOn([&colouring, panel] { return colouring.reference() == panel; }), existing, When([&colouring] {
          return comparesPanels(colouring.mode())
                     ? QString()
                     : "Not available: choose a distance or a difference in 'Colour by' first";
        }));
  }
  actions.add("panels", alone);
  actions.add("compareWith", reference);
}

}  // namespace

void addCameraMoves(Actions& actions, PanelArea& area) {
  const auto inFocused = [&area](auto act) {
    return [&area, act] {
      auto* focused = qobject_cast<View*>(QApplication::focusWidget());
      act(focused != nullptr ? *focused : area.panels().front()->view());
    };
  };
  std::vector<ActionRow> rows;
  for (const Direction& one : directions) {
    const QString name = one.name, way = name.toLower();
    rows.emplace_back("turn" + name, "Turn " + way, one.icon, one.name,
                      QStringLiteral("Turns a 3D object by 10°, or pans a 2D object by 40 pixels: %1").arg(way),
                      inFocused([way = one.way](View& view) {
                        view.camera()->spatial() ? view.orbit(way * turnPixels) : view.pan(way * panPixels);
                      }));
  }
  for (const Direction& one : directions) {
    const QString name = one.name, way = name.toLower();
    rows.emplace_back("shift" + name, "Pan " + way, one.icon, "Shift+" + name,
                      QStringLiteral("Moves the object in the view by 40 pixels: %1").arg(way),
                      inFocused([way = one.way](View& view) { view.pan(way * panPixels); }));
  }
  rows.emplace_back("zoomIn", "Zoom &in", "zoomIn", "+; =", "Shows the object larger by a factor of 1.2",
                    inFocused([](View& view) { view.zoom(zoomStep); }));
  rows.emplace_back("zoomOut", "Zoom &out", "zoomOut", "-", "Shows the object smaller by a factor of 1.2",
                    inFocused([](View& view) { view.zoom(1 / zoomStep); }));
  actions.add("View", {{"moveCamera", "&Move camera", "fit"}});
  actions.add("moveCamera", rows);
  const QList<QAction*> moves = actions.menu("moveCamera").actions();
  for (QAction* action : moves) {
    action->setShortcutContext(Qt::WidgetShortcut);  // because lists and fields use the same keys
  }
  const auto attachTo = [moves](Panel* panel) { panel->view().addActions(moves); };
  std::ranges::for_each(area.panels(), attachTo);
  QObject::connect(&area, &PanelArea::added, &actions, attachTo);
  actions.add("moveCamera",
              {{"fitRest", "Fit rest shape", "fit", "Home",
                "Shows the whole rest shape in every view, from the initial side", [&area] { area.fitRest(); }}});
}

void addSides(Actions& actions, const Document& document, PanelArea& area) {
  const When spatial([&document] {
    return document.mesh()->space_dimension == 3 ? QString()
                                                 : "Not available: this object is in 2D and has only one view";
  });
  std::vector<ActionRow> rows;
  rows.reserve(std::size(axisViews));
  for (const AxisView& side : axisViews) {
    rows.emplace_back(
        side.name, "From " + endOf(side), "", side.key, "All panels show the object from " + endOf(side),
        [&area, side] {
          for (Panel* panel : area.panels()) {
            panel->view().lookFromAxis(side.axis, side.positive);
          }
        },
        spatial, Appears([&area, side] {
          return Appearance{.text = QStringLiteral("From %1 (%2)").arg(endOf(side), sideAt(side, area.up()))};
        }));
  }
  rows.emplace_back(
      "upZ", "&Z axis points up", "", "", "Turns the views so that the z axis points up; otherwise, the y axis does",
      [&area](bool on) { area.setUp(on ? Camera::Up::z : Camera::Up::y); }, spatial,
      IsOn([&area] { return area.up() == Camera::Up::z; }));
  actions.add("View", {{"lookFrom", "Look &from", "axes"},
                       {"parallelRays", "Parallel pro&jection", "", "Shift+F",
                        "Turns perspective off: equal lengths look equal at any distance",
                        [&area](bool on) {
                          for (Panel* panel : area.panels()) {
                            panel->view().setParallel(on);
                          }
                        },
                        spatial, IsOn([&area] { return area.panels().front()->view().camera()->parallel(); })}});
  actions.add("lookFrom", rows);
}

void addPanelActions(Actions& actions, Document& document, PanelArea& area, Colouring& colouring) {
  actions.add("View", {{"panels", "&Panels", "panels"}, {"compareWith", "Co&mpare with", "difference"}});
  actions.add(
      "panels",
      {{"addPanel", "&Add panel", "plus", "N", "Adds a panel with the object as in panel A and another algorithm",
        [&document] { document.addPanel(); }, When([&document] {
          return document.panels() < Document::maxPanels ? QString()
                                                         : "Not available: the window shows at most four panels";
        })},
       {"removePanel", "&Remove panel", "close", "Shift+N", "",
        // Queued, because the panel deletes the button that was pressed.
        [&document] { QMetaObject::invokeMethod(&document, &Document::removePanel, Qt::QueuedConnection); },
        When([&document] {
          return document.panels() > Document::minPanels
                     ? QString()
                     : "Not available: the window keeps two panels. Hide one of them instead";
        }),
        Appears([&document] {
          return Appearance{
              .tip = QStringLiteral("Removes panel %1 and its results").arg(panelName(document.panels() - 1))};
        })},
       {"swapPanels", "S&wap panels", "swap", "W", "Moves each panel to the next position; two panels swap sides",
        [&area] { area.rotatePanels(); }},
       {"ghosts", "&Ghosts", "overlay", "G",
        "Shows the next panel's object over each panel's own, transparent and in that panel's colour. The button above "
        "a panel chooses another",
        [&area](bool on) { area.setGhosts(on); }, IsOn([&area] { return area.hasGhosts(); })},
       {}});
  addActionsOfPanels(actions, document, area, colouring);
  area.setHeadActions(actions.all({"addPanel", "removePanel"}));
}

void addCompared(QToolBar& bar, const Actions& actions, const PanelArea& area, Colouring& colouring) {
  QAction* compared = bar.addAction(QString());
  compared->setToolTip(QStringLiteral("Panel that all others are compared with"));
  auto* button = qobject_cast<QToolButton*>(bar.widgetForAction(compared));
  button->setMenu(&actions.menu("compareWith"));  // the action's own menu would give the View menu its text, too
  button->setPopupMode(QToolButton::InstantPopup);
  const auto adapt = [compared, &area, &colouring] {
    compared->setText(QStringLiteral("with %1").arg(panelName(colouring.reference())));
    compared->setVisible(comparesPanels(colouring.mode()) && area.panels().size() > 2);
  };
  QObject::connect(&area, &PanelArea::arranged, compared, adapt);
  QObject::connect(&colouring, &Colouring::modeChanged, compared, adapt);
  adapt();
}

}  // namespace chainmail
