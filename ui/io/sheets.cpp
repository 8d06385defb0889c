#include "io/sheets.h"

#include <QDir>
#include <QFileInfo>
#include <QSettings>

#include "common/as_path.h"
#include "common/ask_where.h"
#include "common/panel_names.h"
#include "document/edits.h"
#include "drawing/prepared_levels.h"
#include "files/mesh/warp.h"
#include "io/picture_file.h"
#include "io/sheet_bar.h"
#include "mesh/error.h"
#include "mesh/sheet.h"

namespace chainmail {
namespace {}  // namespace

Sheets::Sheets(QWidget& window, Document& document, Jobs& jobs)
    : QObject(&window), window_(window), document_(document), jobs_(jobs), bar_(new SheetBar) {
  connect(bar_, &AskBar::agreed, this, [this] { open(asked_, bar_->across(), first_); });
}

void Sheets::fill(QMenu& menu) {
  menu_ = menu.addMenu(QStringLiteral("Save &warped picture"));
  menu_->menuAction()->setObjectName(QStringLiteral("warpedPictureMenu"));
  for (int panel = 0; panel < Document::maxPanels; ++panel) {
    auto* action = menu_->addAction(QStringLiteral("Panel &%1…").arg(panelName(panel)));
    action->setObjectName(QStringLiteral("saveWarped%1").arg(panelName(panel)));
    action->setStatusTip(
        QStringLiteral("Saves the picture as warped in this panel, one pixel per mesh unit, as PNG or JPEG"));
    connect(action, &QAction::triggered, this, [this, panel] { save(panel); });
    const auto adaptToPanels = [this, action, panel] { action->setVisible(panel < document_.panels()); };
    connect(&document_, &Document::panelsChanged, action, adaptToPanels);
    adaptToPanels();
  }
  menu_->addSeparator();
  ownFrame_ = menu_->addAction(QStringLiteral("Crop to the picture's &frame"));
  ownFrame_->setObjectName(QStringLiteral("warpOwnFrame"));
  ownFrame_->setStatusTip(QStringLiteral("On: saves as many pixels as the picture has. Off: saves the whole sheet"));
  ownFrame_->setCheckable(true);
  connect(&document_, &Document::meshChanged, this, &Sheets::adapt);
  adapt();
}

void Sheets::adapt() {
  const bool sheet = is_sheet(*document_.mesh());
  menu_->setEnabled(sheet);
  menu_->menuAction()->setStatusTip(
      sheet ? QStringLiteral("Saves the picture as warped in a panel")
            : QStringLiteral("Not available: this object has no picture. Open a PNG or JPEG first"));
  for (QAction* action : menu_->actions()) {
    action->setEnabled(sheet);
  }
}

/// Even the header is read in the background: the file may be on a slow drive.
void Sheets::openPath(const QString& path, bool first) {
  bar_->hide();
  const QString name = shownName(path);
  jobs_.start(Jobs::Kind::load, QStringLiteral("Opening %1").arg(name),
              [this, path, name, first](const Progress&) -> Jobs::Finish {
                return [this, path, name, first, size = pictureSize(path)] {
                  asked_ = path;
                  first_ = first;
                  bar_->ask(name, size);
                };
              });
}

void Sheets::open(const QString& path, int across, bool first) {
  const QString name = shownName(path);
  jobs_.start(Jobs::Kind::load, QStringLiteral("Opening %1").arg(name),
              [this, path, name, across, first](const Progress& progress) -> Jobs::Finish {
                const MeshPointer sheet = make_sheet(readPictureFile(path, progress.part(0, 0.7)),
                                                     std::uint32_t(across), progress.part(0.7, 0.9));
                prepareLevels(sheet, progress.part(0.9, 1));
                return [this, path, name, first, sheet] {
                  edits::replaceMesh(document_, sheet, name, QStringLiteral("open %1").arg(name),
                                     first ? edits::Opening::first : edits::Opening::next);
                  emit opened(path);
                };
              });
}

void Sheets::save(int panel) {
  const QString path = askWhere(window_, QStringLiteral("Save warped picture"),
                                {QStringLiteral("PNG picture (*.png)"), QStringLiteral("JPEG picture (*.jpg)")},
                                asFileName(document_.name()) + QStringLiteral("-warped"));
  if (!path.isEmpty()) {
    saveWarpedPath(panel, path);
  }
}

/// Saves the sheet in its current state, even if it changes before the picture is written.
void Sheets::saveWarpedPath(int panel, const QString& path) {
  const Frame* frame = document_.solvers().frame(panel);
  if (frame == nullptr || !is_sheet(*frame->mesh)) {
    emit failed(path + QStringLiteral(": the object has no picture; open a PNG or JPEG first"));
    return;
  }
  jobs_.start(Jobs::Kind::save, QStringLiteral("Saving %1").arg(shownName(path)),
              [this, path, shape = std::make_shared<const Frame>(*frame), cuts = document_.cuts(),
               own = ownFrame_->isChecked()](const Progress& progress) -> Jobs::Finish {
                const Mesh& sheet = *shape->mesh;
                const PictureFrame about = own ? own_frame(sheet) : frame_about(sheet, cuts, shape->view());
                writePictureFile(path, warped(sheet, cuts, shape->view(), about, progress.part(0, 0.5)),
                                 progress.part(0.5, 1));
                return [this, path] { emit saved(path); };
              });
}

}  // namespace chainmail
