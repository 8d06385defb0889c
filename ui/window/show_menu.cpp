#include "window/show_menu.h"

#include <QSettings>
#include <algorithm>
#include <array>

#include "common/actions.h"
#include "drawing/object_drawing.h"

namespace chainmail {
namespace {

struct Choice {
  const char* name;
  const char* action;
  const char* text;
  const char* key;
  const char* tip;
  bool faces, links;
};
constexpr std::array choices{
    Choice{"links", "showLinks", "&Links", "1", "All links of the object, without faces", false, true},
    Choice{"surface", "showSurface", "&Surface", "2",
           "Only the faces (of a volume: its outside), and links that are coloured by a value", true, false},
    Choice{"both", "showSurfaceAndLinks", "Surface &and links", "3",
           "The faces (of a volume: its outside) and the links on them", true, true}};

bool hasFaces(const Mesh& mesh) { return !mesh.triangles.empty() || mesh.has_cells(); }

QString settingsKey(const Mesh& mesh) {
  return ObjectDrawing::showsPicture(mesh) ? QStringLiteral("showOfPictures") : QStringLiteral("show");
}

}  // namespace

ShowMenu::ShowMenu(const Document& document, QObject* parent) : QObject(parent), document_(document) {
  connect(&document, &Document::meshChanged, this, &ShowMenu::changed);
}

void ShowMenu::fill(Actions& actions) {
  std::vector<ActionRow> rows;
  for (const Choice& one : choices) {
    const QString name = one.name;
    const bool isLinks = !one.faces;
    rows.emplace_back(
        one.action, one.text, "", one.key, one.tip, [this, name] { choose(name); },
        IsOn([this, name, isLinks] { return hasFaces(*document_.mesh()) ? chosen() == name : isLinks; }),
        When([this, isLinks] {
          return isLinks || hasFaces(*document_.mesh()) ? QString() : "Not available: this object has no faces";
        }));
  }
  actions.add("View", {{"show", "S&how", "mesh"}});
  actions.add("show", rows);
  connect(this, &ShowMenu::changed, &actions, &Actions::refresh);
  emit changed();
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
  return names().contains(remembered) ? remembered : otherwise;
}

void ShowMenu::choose(const QString& name) {
  if (names().contains(name)) {
    QSettings().setValue(settingsKey(*document_.mesh()), name);
    shown_.erase(settingsKey(*document_.mesh()));
    emit changed();
  }
}

void ShowMenu::show(const QString& name) {
  if (names().contains(name)) {
    shown_[settingsKey(*document_.mesh())] = name;
    emit changed();
  }
}

void ShowMenu::forgetShown() {
  shown_.clear();
  emit changed();
}

DrawOptions ShowMenu::drawOptions() const {
  if (!hasFaces(*document_.mesh())) {
    return {};
  }
  const QString name = chosen();
  const Choice& one = *std::ranges::find_if(choices, [&](const Choice& it) { return name == QLatin1String(it.name); });
  return {one.faces, one.links};
}

}  // namespace chainmail
