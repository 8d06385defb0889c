#include "io/file_actions.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QLocale>
#include <QSettings>
#include <utility>

#include "common/actions.h"
#include "common/as_path.h"
#include "common/text.h"
#include "drawing/camera.h"
#include "drawing/mesh_levels.h"
#include "files/mesh/mesh_formats.h"
#include "io/mesh_repair.h"
#include "io/picture_file.h"
#include "io/questions.h"
#include "io/samples.h"
#include "io/sessions.h"
#include "io/unsaved_work.h"
#include "io/volumes.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr int recentFiles = 8;

QString endings(FormatUse use) { return QString::fromStdString(mesh_endings(use)); }

QString recentKey() { return QStringLiteral("recentFiles"); }

QString asText(std::string_view text) { return QString::fromUtf8(text.data(), qsizetype(text.size())); }

QStringList endingsOf(const MeshFormat& format) { return asText(format.endings).split(QLatin1Char(' ')); }

/// Returns one filter per format for a save dialog. Formats without positions need a lattice.
QStringList saveFilters(FormatUse use, bool lattice = false) {
  QStringList filters;
  for (const MeshFormat& format : mesh_formats()) {
    if (format.allows(use) && (format.holds_positions || lattice)) {
      filters << QStringLiteral("%1 (*%2)").arg(asText(format.name), endingsOf(format).first());
    }
  }
  return filters;
}

/// Returns one filter for all files that can be opened.
QString openFilter() {
  QString endings = QLatin1Char('*') + asText(session_ending);
  for (const MeshFormat& format : mesh_formats()) {
    if (format.reads()) {
      endings += QStringLiteral(" *") + endingsOf(format).join(QStringLiteral(" *"));
    }
  }
  for (const std::string_view ending : picture_endings) {
    endings += QStringLiteral(" *") + asText(ending);
  }
  return QStringLiteral("Sessions, meshes and pictures (%1);;All files (*)").arg(endings);
}

/// Describes an opened object: its size, extents and flaws.
QString openingReport(const QString& name, const OpenedMesh& opened, std::size_t parts) {
  const Mesh& mesh = *opened.mesh;
  QStringList counts{counted(mesh.element_count(), QStringLiteral("element")),
                     counted(mesh.link_count(), QStringLiteral("link"))};
  if (!mesh.triangles.empty()) {
    counts << counted(mesh.triangles.size(), QStringLiteral("triangle"));
  }
  if (!mesh.tetrahedra.empty()) {
    counts << QStringLiteral("%L1 tetrahedra").arg(mesh.tetrahedra.size());
  }
  if (!mesh.hexahedra.empty()) {
    counts << QStringLiteral("%L1 hexahedra").arg(mesh.hexahedra.size());
  }
  counts << counted(parts, QStringLiteral("part"));
  QStringList extents;
  for (int k = 0; k < mesh.space_dimension; ++k) {
    extents << QLocale().toString((mesh.box[1] - mesh.box[0])[mesh.axes[k]], 'g', 4);
  }
  QString report = QStringLiteral("%1: %2, %3 units")
                       .arg(name, counts.join(QStringLiteral(", ")), extents.join(QStringLiteral(" × ")));
  if (mesh.space_dimension == 3 && usuallyZUp(name)) {
    report += QStringLiteral(". The z axis points up, which is a guess: see the View menu");
  }
  MeshFlaws shownFlaws = opened.flaws;
  shownFlaws.coincident = 0;  // the bar of repairs names duplicates
  if (const std::string flaws = in_words(shownFlaws); !flaws.empty()) {
    report += QStringLiteral(". ") + text(flaws);
  }
  return report;
}

}  // namespace

FileActions::FileActions(QWidget& window, Document& document, Jobs& jobs, Sessions& sessions)
    : QObject(&window),
      window_(window),
      document_(document),
      jobs_(jobs),
      sessions_(sessions),
      volumes_(new Volumes(document, jobs)),
      repair_(new MeshRepair(document, jobs, this)) {
  connect(volumes_, &Volumes::opened, this, &FileActions::remember);
  connect(&sessions_, &Sessions::failed, this, &FileActions::failed);
  connect(&sessions_, &Sessions::recovered, this, &FileActions::recovered);
  connect(&sessions_, &Sessions::noted, this, &FileActions::noted);
  connect(&sessions_, &Sessions::opened, this, &FileActions::remember);
  connect(&sessions_, &Sessions::saved, this, [this](const QString& path) {
    remember(path);
    emit saved(path);
  });
}

void FileActions::fill(Actions& actions) {
  const QString all =
      QStringLiteral("mesh, cuts, pins, softness, positions of all panels, recorded moves, cameras and layout");
  actions.add(
      "File",
      {{"openFile", "&Open…|Open", "open", QKeySequence::Open,
        QStringLiteral(
            "Replaces the object with a session (.chainmail), a mesh or volume (%1) or a picture (.png .jpg)")
            .arg(endings(FormatUse::read)),
        [this] { open(); }},
       {"recent", "Open &recent", "history"},
       {},
       {"saveSession", "&Save session|Save", "save", QKeySequence::Save, "Saves everything in one file: " + all,
        [this] { saveSession(); }},
       {"saveSessionAs", "Save session &as…", "save", "Ctrl+Shift+S", "Saves everything in another file: " + all,
        [this] { saveSessionAs(); }},
       {},
       {"saveFile", "Save &mesh at rest…", "mesh", "Ctrl+M",
        QStringLiteral("Saves only the object at rest, without cut links, as %1").arg(endings(FormatUse::write)),
        [this] { save(); }},
       {"saveShape", "Save &deformed mesh", "shape"},
       {"takeBackWork", "&Take back discarded work", "", "",
        "Offers unsaved work again that was discarded since this window opened",
        [this] { sessions_.recoveryBar().takeBack(); },
        When([this] { return sessions_.recoveryBar().hasDiscarded(); })}});
  for (int panel = 0; panel < Document::maxPanels; ++panel) {
    actions.add("saveShape",
                {{"saveShape" + panelName(panel), QStringLiteral("Panel &%1…").arg(panelName(panel)), "shape", "",
                  "Saves the positions of this panel in mesh units as " + endings(FormatUse::write_positions),
                  [this, panel] { saveShape(panel); },
                  Appears([this, panel] { return Appearance{.visible = panel < document_.panels()}; })}});
  }
  connect(&sessions_.recoveryBar(), &RecoveryBar::changed, &actions, &Actions::refresh);
  recent_ = &actions.menu("recent");
  fillRecent();
}

void FileActions::saveSession() {
  const QString path = document_.files().session();
  OverwriteAnswer answer = path.isEmpty() ? OverwriteAnswer::saveAs : OverwriteAnswer::overwrite;
  if (!path.isEmpty() && sessions_.isChangedOutside(path)) {
    answer = askBeforeOverwriting(window_, path);
  }
  if (answer == OverwriteAnswer::overwrite) {
    sessions_.savePath(path);
  } else if (answer == OverwriteAnswer::saveAs) {
    saveSessionAs();
  }
}

bool FileActions::saveSessionAs() {
  const QString path = askWhere(
      window_, QStringLiteral("Save session"), {QStringLiteral("Sessions (*.chainmail)")},
      asFileName(document_.files().session().isEmpty() ? document_.name() : shownName(document_.files().session())));
  if (!path.isEmpty()) {
    sessions_.savePath(path);
  }
  return !path.isEmpty();
}

void FileActions::saveShape(int panel) {
  const QString path = askWhere(window_, QStringLiteral("Save deformed mesh"), saveFilters(FormatUse::write_positions),
                                QStringLiteral("%1-deformed-%2").arg(asFileName(document_.name()), panelName(panel)));
  if (!path.isEmpty()) {
    saveShapePath(panel, path);
  }
}

void FileActions::open() {
  const QString path = QFileDialog::getOpenFileName(&window_, QStringLiteral("Open session, mesh or picture"),
                                                    startFolder(), openFilter());
  if (!path.isEmpty()) {
    openPath(path);
  }
}

void FileActions::openPath(const QString& path, edits::Opening opening, bool asks) {
  const auto read = [this, path, opening, asks](const Progress& progress) -> Jobs::Finish {
    InputFile input = open_file(asPath(path));
    switch (input.kind) {
      case FileKind::session:
        return sessions_.read(std::move(input.file), path, opening, progress);
      case FileKind::picture:
        return readPicture(std::move(input.file), path, opening, progress);
      case FileKind::volume:
        return volumes_->read(std::move(input), path, opening, asks, progress);
      case FileKind::mesh:
        break;
    }
    return readMesh(std::move(input), path, opening, progress);
  };
  jobs_.start(Jobs::Kind::load, QStringLiteral("Opening %1").arg(shownName(path)),
              [this, path, read](const Progress& progress) -> Jobs::Finish {
                const auto state = stateOf(path);  // before it is read
                return [this, path, state, show = read(progress)] {
                  show();
                  sessions_.know(path, state);
                };
              });
}

/// Opens a picture as a sheet.
Jobs::Finish FileActions::readPicture(RegularFile file, const QString& path, edits::Opening opening,
                                      const Progress& progress) {
  const MeshPointer sheet = readSheet(std::move(file), elementsAcross, progress.part(0, 0.9));
  prepareLevels(sheet, progress.part(0.9, 1));
  return [this, path, opening, sheet] {
    edits::replaceMesh(document_, sheet, shownName(path), QStringLiteral("open %1").arg(shownName(path)), opening);
    remember(path);
  };
}

Jobs::Finish FileActions::readMesh(InputFile input, const QString& path, edits::Opening opening,
                                   const Progress& progress) {
  const OpenedMesh opened = open_mesh(std::move(input), {}, progress.part(0, 0.8));
  const Defects defects = find_defects(*opened.mesh, progress.part(0.8, 0.9));
  prepareLevels(opened.mesh, progress.part(0.9, 1));
  return [this, opened, defects, path, opening] {
    const QString name = shownName(path);
    repair_->remember(opened.mesh, defects);
    edits::replaceMesh(document_, opened.mesh, name, QStringLiteral("open %1").arg(name), opening);
    remember(path);
    if (!isSample(path)) {
      emit noted(openingReport(name, opened, document_.parts()));
    }
  };
}

void FileActions::save() {
  const QString path =
      askWhere(window_, QStringLiteral("Save mesh at rest"),
               saveFilters(FormatUse::write, document_.mesh()->lattice.has_value()), asFileName(document_.name()));
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
  if (const Frame* frame = document_.solvers().frame(panel)) {
    write(path, std::make_shared<const Frame>(*frame));
  }
}

/// Writes the object in its current state, even if it changes during writing. If `shape` is null, writes the rest
/// positions.
void FileActions::write(const QString& path, const std::shared_ptr<const Frame>& shape) {
  jobs_.start(
      Jobs::Kind::save, QStringLiteral("Saving %1").arg(shownName(path)),
      [this, path, mesh = document_.mesh(), cuts = document_.cuts(), softness = document_.wholeSoftness(),
       shape](const Progress& progress) -> Jobs::Finish {
        save_mesh(asPath(path), {*mesh, cuts, shape ? shape->view() : rest_positions(*mesh), *softness}, progress);
        const QString lost = QString::fromStdString(lost_in(mesh_format(asPath(path), FormatUse::write), *mesh));
        return [this, path, lost, state = stateOf(path)] {
          sessions_.know(path, state);
          remember(path);
          emit saved(path);
          if (!lost.isEmpty()) {
            emit noted(lost);
          }
        };
      });
}

void FileActions::fillRecent() {
  recent_->clear();
  for (const QString& kept : QSettings().value(recentKey()).toStringList()) {
    const QString path = pathOfKept(kept);
    const QString shown = menuText(shownPath(path));
    recent_->addAction(QStringLiteral("&%1 %2").arg(recent_->actions().size() + 1).arg(shown), this,
                       [this, path] { openPath(path); });
  }
  recent_->setEnabled(!recent_->isEmpty());
}

/// Adds a file to the recent files. Samples are not added: the gallery lists them.
void FileActions::remember(const QString& path) {
  if (isSample(path)) {
    return;
  }
  QSettings settings;
  const QString absolute = QFileInfo(path).absoluteFilePath();
  QStringList recent = settings.value(recentKey()).toStringList();
  recent.removeAll(keptPath(absolute));
  recent.prepend(keptPath(absolute));
  settings.setValue(recentKey(), recent.mid(0, recentFiles));
  fillRecent();
}

QString FileActions::startFolder() const {
  const QStringList recent = QSettings().value(recentKey()).toStringList();
  return recent.isEmpty() ? QDir::currentPath() : QFileInfo(pathOfKept(recent.first())).absolutePath();
}

}  // namespace chainmail
