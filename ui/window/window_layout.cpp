#include "window/window_layout.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <algorithm>
#include <cmath>

#include "common/as_path.h"
#include "common/text.h"
#include "docks/section_dock.h"
#include "panels/colour_choices.h"
#include "panels/panel.h"
#include "panels/panel_area.h"
#include "window/docks.h"
#include "window/main_window.h"
#include "window/show_menu.h"

namespace chainmail {
namespace {

QJsonObject toJson(const Camera::Pose& pose, const FrameSpace& space) {
  const Point centre = space.out_of({pose.centre.x(), pose.centre.y(), pose.centre.z()});
  return {{QStringLiteral("centre"), QJsonArray{centre.x(), centre.y(), centre.z()}},
          {QStringLiteral("height"), pose.height * space.unit()},
          {QStringLiteral("yaw"), pose.yaw},
          {QStringLiteral("pitch"), pose.pitch},
          {QStringLiteral("parallel"), pose.parallel},
          {QStringLiteral("framed"), pose.framed},
          {QStringLiteral("up"), pose.up == Camera::Up::z ? QStringLiteral("z") : QStringLiteral("y")}};
}

/// Returns the pose in the JSON. Missing values stay as in `present`, and so do coordinates of the centre that are
/// infinite as float. JSON has no NaN. An angle counts modulo a whole turn: the sine of a huge one is noise.
Camera::Pose poseOf(const QJsonObject& json, const Camera::Pose& present, const FrameSpace& space) {
  const auto number = [&](const char* key, double otherwise) { return json[QLatin1String(key)].toDouble(otherwise); };
  const QString up = json[QStringLiteral("up")].toString();
  Camera::Pose pose{present.centre,
                    number("height", present.height * space.unit()) / space.unit(),
                    std::remainder(number("yaw", present.yaw), 360),
                    std::clamp(number("pitch", present.pitch), -90.0, 90.0),
                    json[QStringLiteral("parallel")].toBool(present.parallel),
                    json[QStringLiteral("framed")].toBool(),
                    up == QLatin1String("z")   ? Camera::Up::z
                    : up == QLatin1String("y") ? Camera::Up::y
                                               : present.up};
  const QJsonArray centre = json[QStringLiteral("centre")].toArray();
  if (centre.size() == 3) {
    const Point before = space.out_of({pose.centre.x(), pose.centre.y(), pose.centre.z()});
    const Point at(centre[0].toDouble(before.x()), centre[1].toDouble(before.y()), centre[2].toDouble(before.z()));
    const QVector3D there = asVector(space.into(at));
    for (int k = 0; k < 3; ++k) {
      pose.centre[k] = std::isfinite(there[k]) ? there[k] : pose.centre[k];
    }
  }
  return pose;
}

/// Fits the object once the panels show the positions that follow, unless the user does something before.
void fitWhenShown(MainWindow& window) {
  auto* wait = new QObject(&window);
  Document& document = window.document();
  const auto fit = [&window, wait] {
    if (window.document().solvers().settled()) {
      if (window.area().fits()) {
        window.area().fit();
      }
      wait->deleteLater();
    }
  };
  QObject::connect(&document.solvers(), &PanelSolvers::frameReady, wait, fit);
  QObject::connect(&document.solvers(), &PanelSolvers::becameIdle, wait, fit);
  QObject::connect(&document.undoStack(), &QUndoStack::indexChanged, wait, &QObject::deleteLater);
}

void takeCameras(MainWindow& window, const QJsonObject& layout) {
  PanelLinks& links = window.area().links();
  links.setCameras(layout[QStringLiteral("linked")].toBool(links.cameras()));
  const QJsonArray cameras = layout[QStringLiteral("cameras")].toArray();
  for (int panel = 0; panel < std::min(int(cameras.size()), window.document().panels()); ++panel) {
    View& view = window.panel(panel).view();
    view.camera()->setPose(poseOf(cameras[panel].toObject(), view.camera()->pose(), view.space()));
    if (view.camera()->framed()) {
      view.frame(view.outline(false));  // the window of the saved layout may have had another size
    }
    emit view.cameraChanged();
    view.update();
  }
  if (window.area().fits()) {
    fitWhenShown(window);
  }
}

void takeColours(MainWindow& window, const QString& name) {
  const auto found =
      std::find_if(colourModes().begin(), colourModes().end(), [&](const auto& one) { return name == text(one.name); });
  if (found != colourModes().end()) {
    window.colouring().setMode(found->mode);
  }
}

/// Says what a session of an older workbench shows that this one no longer has.
void noteWhatLeft(MainWindow& window, const QJsonArray& docks) {
  const auto showsSizeTest = [](const QJsonValue& dock) {
    return dock[QStringLiteral("id")] == QStringLiteral("sizeTestDock") && dock[QStringLiteral("visible")].toBool();
  };
  if (std::any_of(docks.begin(), docks.end(), showsSizeTest)) {
    emit window.document().noticed(
        QStringLiteral("The session shows the dock Size test, which has left the window: use chainmail ramp"));
  }
}

}  // namespace

std::string layoutOf(MainWindow& window) {
  QJsonArray cameras;
  for (int panel = 0; panel < window.document().panels(); ++panel) {
    const View& view = window.panel(panel).view();
    cameras << toJson(view.camera()->pose(), view.space());
  }
  QJsonObject layout = toJson(window.arrangement());
  layout[QStringLiteral("cameras")] = cameras;
  layout[QStringLiteral("linked")] = window.area().links().cameras();
  layout[QStringLiteral("colour")] = text(info(window.colouring().mode()).name);
  layout[QStringLiteral("colourRange")] = window.colourRange().toJson();
  layout[QStringLiteral("show")] = window.showMenu().chosen();
  layout[QStringLiteral("section")] = window.docks().get<SectionDock>().toJson();
  layout[QStringLiteral("file")] = keptPath(window.document().files().session());
  return QJsonDocument(layout).toJson(QJsonDocument::Compact).toStdString();
}

void applyLayout(MainWindow& window, const std::string& json) {
  const QJsonObject layout = QJsonDocument::fromJson(QByteArray::fromStdString(json)).object();
  window.takeDocks(layout);
  noteWhatLeft(window, layout[QStringLiteral("docks")].toArray());
  window.showMenu().show(layout[QStringLiteral("show")].toString());
  window.docks().get<SectionDock>().take(layout[QStringLiteral("section")].toObject());
  takeColours(window, layout[QStringLiteral("colour")].toString());
  window.colourRange().take(layout[QStringLiteral("colourRange")].toObject());
  takeCameras(window, layout);
}

void followLayout(MainWindow& window, QObject& context, const std::function<void()>& changed) {
  const auto followPanel = [&context, changed](Panel* panel) {
    QObject::connect(&panel->view(), &View::cameraChanged, &context, changed);
  };
  PanelArea& area = window.area();
  std::ranges::for_each(area.panels(), followPanel);
  QObject::connect(&area, &PanelArea::added, &context, followPanel);
  QObject::connect(&window.document(), &Document::panelsChanged, &context, changed);
  QObject::connect(&window.colouring(), &Colouring::modeChanged, &context, changed);
  QObject::connect(&area.links(), &PanelLinks::camerasLinked, &context, changed);
  QObject::connect(&window.showMenu(), &ShowMenu::changed, &context, changed);
  QObject::connect(&window.docks().get<SectionDock>(), &SectionDock::changed, &context, changed);
  for (const QDockWidget* dock : window.docks().all()) {
    QObject::connect(dock, &QDockWidget::visibilityChanged, &context, changed);
    QObject::connect(dock, &QDockWidget::topLevelChanged, &context, changed);
    QObject::connect(dock, &QDockWidget::dockLocationChanged, &context, changed);
  }
}

}  // namespace chainmail
