#include "window/show_menu.h"

#include <QActionGroup>
#include <QSettings>
#include <algorithm>
#include <array>

#include "common/icons.h"
#include "drawing/object_drawing.h"

namespace chainmail {
namespace {

struct Choice {
  const char* name;
  const char* action;
  const char* text;
  Qt::Key key;
  const char* tip;
  DrawOptions options;
};
constexpr std::array choices{
    Choice{"links", "showLinks", "&Links", Qt::Key_1, "All links of the object, without faces", {false, true}},
    Choice{"surface",
           "showSurface",
           "&Surface",
           Qt::Key_2,
           "Only the faces (of a volume: its outside), and links that are coloured by a value",
           {true, false}},
    Choice{"both",
           "showSurfaceAndLinks",
           "Surface &and links",
           Qt::Key_3,
           "The faces (of a volume: its outside) and the links on them",
           {true, true}}};

bool hasFaces(const Mesh& mesh) { return !mesh.triangles.empty() || mesh.has_cells(); }

QString settingsKey(const Mesh& mesh) {
  return ObjectDrawing::showsPicture(mesh) ? QStringLiteral("showOfPictures") : QStringLiteral("show");
}

}  // namespace

ShowMenu::ShowMenu(const Document& document, QObject* parent) : QObject(parent), document_(document) {
  connect(&document, &Document::meshChanged, this, &ShowMenu::adapt);
}

void ShowMenu::fill(QMenu& menu) {
  menu_ = menu.addMenu(icon("mesh"), QStringLiteral("S&how"));
  menu_->setToolTipsVisible(true);
  auto* group = new QActionGroup(this);
  for (const Choice& one : choices) {
    auto* action = group->addAction(QString::fromUtf8(one.text));
    action->setObjectName(QLatin1String(one.action));
    action->setCheckable(true);
    action->setShortcut(one.key);
    action->setStatusTip(QString::fromUtf8(one.tip));
    const QString name = QLatin1String(one.name);
    connect(action, &QAction::triggered, this, [this, name] { choose(name); });
    menu_->addAction(action);
    actions_[name] = action;
  }
  adapt();
}

QStringList ShowMenu::names() {
  QStringList names;
  for (const Choice& one : choices) {
    names << QLatin1String(one.name);
  }
  return names;
}

QString ShowMenu::chosen() const {
  const Mesh& mesh = *document_.mesh();
  if (const auto shown = shown_.find(settingsKey(mesh)); shown != shown_.end()) {
    return shown->second;
  }
  const QString otherwise = ObjectDrawing::showsPicture(mesh) ? QStringLiteral("surface") : QStringLiteral("both");
  const QString remembered = QSettings().value(settingsKey(mesh), otherwise).toString();
  return actions_.count(remembered) != 0 ? remembered : otherwise;
}

void ShowMenu::choose(const QString& name) {
  if (actions_.count(name) != 0) {
    QSettings().setValue(settingsKey(*document_.mesh()), name);
    shown_.erase(settingsKey(*document_.mesh()));
    adapt();
  }
}

void ShowMenu::show(const QString& name) {
  if (actions_.count(name) != 0) {
    shown_[settingsKey(*document_.mesh())] = name;
    adapt();
  }
}

void ShowMenu::forgetShown() {
  shown_.clear();
  adapt();
}

DrawOptions ShowMenu::drawOptions() const {
  if (!hasFaces(*document_.mesh())) {
    return {};
  }
  const QString name = chosen();
  return std::ranges::find_if(choices, [&](const Choice& one) { return name == QLatin1String(one.name); })->options;
}

void ShowMenu::adapt() {
  const bool faces = hasFaces(*document_.mesh());
  for (const auto& [name, action] : actions_) {
    const bool possible = faces || name == QLatin1String("links");
    action->setEnabled(possible);
    action->setToolTip(possible ? action->statusTip() : QStringLiteral("Not available: this object has no faces"));
  }
  actions_.at(faces ? chosen() : QStringLiteral("links"))->setChecked(true);
  emit changed();
}

}  // namespace chainmail
