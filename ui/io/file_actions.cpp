#include "io/file_actions.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QSettings>
#include <QToolBar>
#include <filesystem>

#include "common/as_path.h"
#include "common/ask_where.h"
#include "common/panel_names.h"
#include "files/mesh/open_mesh.h"
#include "files/session/session.h"
#include "io/mesh_filters.h"
#include "io/opening_report.h"
#include "io/picture_file.h"
#include "io/samples.h"
#include "io/sessions.h"
#include "io/sheet_bar.h"
#include "io/sheets.h"
#include "io/volumes.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr int recentFiles = 8;

QString endings(FormatUse use) { return QString::fromStdString(mesh_endings(use)); }

QString recentKey() { return QStringLiteral("recentFiles"); }

}  // namespace

FileActions::FileActions(QWidget& window, Document& document, Jobs& jobs, Sessions& sessions)
    : QObject(&window),
      window_(window),
      document_(document),
      jobs_(jobs),
      sessions_(sessions),
      sheets_(new Sheets(window, document, jobs)),
      volumes_(new Volumes(document, jobs)) {
  connect(volumes_, &Volumes::opened, this, &FileActions::remember);
  connect(sheets_, &Sheets::failed, this, &FileActions::failed);
  connect(sheets_, &Sheets::opened, this, &FileActions::remember);
  connect(sheets_, &Sheets::saved, this, &FileActions::saved);
  connect(&sessions_, &Sessions::failed, this, &FileActions::failed);
  connect(&sessions_, &Sessions::opened, this, &FileActions::remember);
  connect(&sessions_, &Sessions::saved, this, [this](const QString& path) {
    remember(path);
    emit saved(path);
  });
}

void FileActions::fill(QMenu& menu) {
  open_ = menu.addAction(QStringLiteral("&Open…"), QKeySequence::Open, this, &FileActions::open);
  open_->setObjectName(QStringLiteral("openFile"));
  open_->setIconText(QStringLiteral("Open"));
  open_->setStatusTip(
      QStringLiteral("A session (.chainmail), a mesh or volume (%1) or a picture (.png .jpg), in place of the "
                     "present object")
          .arg(endings(FormatUse::read)));
  recent_ = menu.addMenu(QStringLiteral("Open &recent"));
  menu.addSeparator();
  addSaveActions(menu);
  addShapeActions(menu);
  sheets_->fill(menu);
  fillRecent();
}

void FileActions::fill(QToolBar& bar) const { bar.addActions({open_, save_}); }

void FileActions::addSaveActions(QMenu& menu) {
  const auto add = [&menu, this](const char* name, const QString& text, const QKeySequence& key,
                                 void (FileActions::*act)(), const QString& help) {
    auto* action = menu.addAction(text, key, this, act);
    action->setObjectName(QLatin1String(name));
    action->setStatusTip(help);
    return action;
  };
  const QString all = QStringLiteral("mesh, cuts, pins, stiffness, positions of every panel, cameras and layout");
  save_ = add("saveSession", QStringLiteral("&Save session"), QKeySequence::Save, &FileActions::saveSession,
      QStringLiteral("All there is in one file: ") + all);
  save_->setIconText(QStringLiteral("Save"));
  add("saveSessionAs", QStringLiteral("Save session &as…"), Qt::CTRL | Qt::SHIFT | Qt::Key_S,
      &FileActions::saveSessionAs, QStringLiteral("The same into another file: ") + all);
  menu.addSeparator();
  add("saveFile", QStringLiteral("Save &mesh at rest…"), Qt::CTRL | Qt::Key_M, &FileActions::save,
      QStringLiteral("The object at rest alone, without its cut links, as %1").arg(endings(FormatUse::write)));
}

void FileActions::saveSession() {
  if (document_.sessionFile().isEmpty()) {
    saveSessionAs();
  } else {
    sessions_.savePath(document_.sessionFile());
  }
}

void FileActions::saveSessionAs() {
  const QString path =
      askWhere(window_, QStringLiteral("Save session"), {QStringLiteral("Sessions (*.chainmail)")}, startFolder());
  if (!path.isEmpty()) {
    sessions_.savePath(path);
  }
}

void FileActions::addShapeActions(QMenu& menu) {
  auto* shapes = menu.addMenu(QStringLiteral("Save &deformed mesh"));
  for (int panel = 0; panel < Document::mostPanels; ++panel) {
    auto* action = shapes->addAction(QStringLiteral("Panel &%1…").arg(panelName(panel)));
    connect(action, &QAction::triggered, this, [this, panel] {
      const QString path = askWhere(window_, QStringLiteral("Save deformed mesh"),
                                    saveFilters(FormatUse::write_positions), startFolder());
      if (!path.isEmpty()) {
        saveShapePath(panel, path);
      }
    });
    action->setObjectName(QStringLiteral("saveShape%1").arg(panelName(panel)));
    action->setStatusTip(QStringLiteral("Every element where this panel shows it, in mesh units, as %1")
                             .arg(endings(FormatUse::write_positions)));
    const auto adapt = [this, action, panel] { action->setVisible(panel < document_.panels()); };
    connect(&document_, &Document::panelsChanged, action, adapt);
    adapt();
  }
}

void FileActions::open() {
  const QString path = QFileDialog::getOpenFileName(&window_, QStringLiteral("Open session, mesh or picture"),
                                                    startFolder(), openFilter());
  if (!path.isEmpty()) {
    openPath(path);
  }
}

void FileActions::openPath(const QString& path, bool first) {
  if (is_session(asPath(path))) {
    sessions_.openPath(path, first);
    return;
  }
  if (isPicture(path)) {
    sheets_->openPath(path, first);
    return;
  }
  read(path, first, true);
}

void FileActions::openSample(const QString& path) {
  if (isPicture(path)) {
    sheets_->open(path, SheetBar::standardAcross);
  } else if (is_session(asPath(path))) {
    sessions_.openPath(path, false);
  } else {
    read(path, false, false);
  }
}

/// A mesh or a volume, of which it may be asked how.
void FileActions::read(const QString& path, bool first, bool ask) {
  jobs_.start(Jobs::Kind::load, QStringLiteral("Opening %1").arg(QFileInfo(path).fileName()),
              [this, path, first, ask](const Progress& progress) -> Jobs::Finish {
                if (is_volume(asPath(path))) {
                  return ask ? volumes_->read(path, first, progress) : volumes_->readAsOffered(path, progress);
                }
                const OpenedMesh opened = open_mesh(asPath(path), {}, progress);
                return [this, opened, path, first] { show(opened, path, first); };
              });
}

void FileActions::show(const OpenedMesh& opened, const QString& path, bool first) {
  const QString name = QFileInfo(path).fileName();
  document_.replaceMesh(opened.mesh, name, QStringLiteral("open %1").arg(name));
  if (first) {
    document_.undoStack().clear();
  }
  remember(path);
  if (!isSample(path)) {
    emit noted(openingReport(name, opened, document_.parts()));
  }
}

void FileActions::save() {
  const QString path = askWhere(window_, QStringLiteral("Save mesh at rest"),
                                saveFilters(FormatUse::write, document_.mesh()->lattice.has_value()), startFolder());
  if (!path.isEmpty()) {
    savePath(path);
  }
}

void FileActions::savePath(const QString& path) { write(path, nullptr); }

void FileActions::saveShapePath(int panel, const QString& path) {
  try {
    mesh_format(asPath(path), FormatUse::write_positions);
  } catch (const Error& error) {
    emit failed(QString::fromUtf8(error.what()));
    return;
  }
  if (const Frame* frame = document_.frame(panel)) {
    write(path, std::make_shared<const Frame>(*frame));
  }
}

/// Writes the object as it is now, whatever becomes of it meanwhile; without a shape, at rest.
void FileActions::write(const QString& path, const std::shared_ptr<const Frame>& shape) {
  jobs_.start(
      Jobs::Kind::save, QStringLiteral("Saving %1").arg(QFileInfo(path).fileName()),
      [this, path, mesh = document_.mesh(), cuts = document_.cuts(), softness = document_.wholeSoftness(),
       shape](const Progress& progress) -> Jobs::Finish {
        save_mesh(asPath(path), {*mesh, cuts, shape ? shape->view() : rest_positions(*mesh), *softness}, progress);
        return [this, path] {
          remember(path);
          emit saved(path);
        };
      });
}

void FileActions::fillRecent() {
  recent_->clear();
  for (const QString& path : QSettings().value(recentKey()).toStringList()) {
    const QString shown = QDir::toNativeSeparators(path).replace(QLatin1Char('&'), QLatin1String("&&"));
    recent_->addAction(QStringLiteral("&%1 %2").arg(recent_->actions().size() + 1).arg(shown), this,
                       [this, path] { openPath(path); });
  }
  recent_->setEnabled(!recent_->isEmpty());
}

/// Samples have their gallery, and their folder is no place for others.
void FileActions::remember(const QString& path) {
  if (isSample(path)) {
    return;
  }
  QSettings settings;
  const QString absolute = QFileInfo(path).absoluteFilePath();
  QStringList recent = settings.value(recentKey()).toStringList();
  recent.removeAll(absolute);
  recent.prepend(absolute);
  settings.setValue(recentKey(), recent.mid(0, recentFiles));
  fillRecent();
}

QString FileActions::startFolder() const {
  const QStringList recent = QSettings().value(recentKey()).toStringList();
  return recent.isEmpty() ? QDir::currentPath() : QFileInfo(recent.first()).absolutePath();
}

}  // namespace chainmail
