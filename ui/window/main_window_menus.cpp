// The main window's named actions, in its menus and its tool bar.

#include <QActionGroup>
#include <QApplication>
#include <QLabel>
#include <QMenuBar>
#include <QToolBar>

#include "io/file_actions.h"
#include "io/picture_actions.h"
#include "panels/colour_selector.h"
#include "tools/filling.h"
#include "tools/pin_layers.h"
#include "window/axis_views.h"
#include "window/camera_actions.h"
#include "window/help_menu.h"
#include "window/main_window.h"
#include "window/message_bar.h"
#include "window/panel_actions.h"
#include "window/show_menu.h"
#include "window/theme_menu.h"
#include "window/undo_actions.h"

namespace chainmail {

void MainWindow::makeMenus() {
  auto* file = menuBar()->addMenu(QStringLiteral("&File"));
  files_->fill(*file);
  file->addSeparator();
  makePictures(*file);
  file->addSeparator();
  auto* quit = file->addAction(QStringLiteral("&Quit"), QKeySequence::Quit, this, &QWidget::close);
  quit->setObjectName(QStringLiteral("quit"));
  quit->setStatusTip(
      QStringLiteral("Closes the window; its layout is remembered, and what is unsaved is offered at the next start"));
  fillEditMenu(*menuBar()->addMenu(QStringLiteral("&Edit")));
  fillObjectMenu(*menuBar()->addMenu(QStringLiteral("&Object")));
  fillViewMenu(*menuBar()->addMenu(QStringLiteral("&View")));
  makeToolBar();
}

void MainWindow::makePictures(QMenu& menu) {
  auto* pictures = new PictureActions(*this, document_, *area_, jobs_);
  pictures->fill(menu);
  connect(pictures, &PictureActions::failed, messages_, &MessageBar::say);
  connect(pictures, &PictureActions::told, this, &MainWindow::tell);
  connect(pictures, &PictureActions::saved, files_, &FileActions::saved);
}

void MainWindow::fillEditMenu(QMenu& menu) {
  menu.setObjectName(QStringLiteral("editMenu"));
  undoActions_->fill(menu);
  menu.addSeparator();
  menu.addActions(toolActions_->actions());
  auto* giveUp = menu.addAction(QStringLiteral("&Give up"), Qt::Key_Escape, this, &MainWindow::giveUp);
  giveUp->setObjectName(QStringLiteral("giveUp"));
  giveUp->setStatusTip(QStringLiteral("Gives up a stroke, a drag, a job or the selection, and dismisses the message"));
}

void MainWindow::giveUp() {
  // The key that closes a field's list arrives here too: it must not cost the selection.
  if (auto* field = qobject_cast<QComboBox*>(QApplication::focusWidget())) {
    field->clearFocus();
    tool_->cancel();
  } else if (jobs_.running() && !tool_->busy()) {
    jobs_.cancel();
  } else {
    tool_->escape();
    measurement_.clear();
  }
  messages_->dismiss();
  help_->dismissHints();
  area_->refresh();
}

void MainWindow::fillObjectMenu(QMenu& menu) {
  menu.setObjectName(QStringLiteral("objectMenu"));
  auto* object = menu.addAction(QStringLiteral("Reset &object"), this, [this] { document_.resetObject(); });
  object->setObjectName(QStringLiteral("resetObject"));
  object->setShortcut(Qt::Key_R);
  object->setStatusTip(QStringLiteral("Every element back to its rest position; cuts, pins and stiffness stay"));
  auto* stiffness = menu.addAction(QStringLiteral("Reset &stiffness"), this, [this] { document_.resetSoftness(); });
  stiffness->setObjectName(QStringLiteral("resetStiffness"));
  stiffness->setStatusTip(QStringLiteral(
      "Compression, stretch and shear of all links back to their defaults, also where links have their own"));
  auto* unpin =
      menu.addAction(QStringLiteral("&Unpin all"), this, [this] { document_.setPinned(document_.pins(), false); });
  unpin->setObjectName(QStringLiteral("unpinAll"));
  unpin->setStatusTip(QStringLiteral("Every pinned element may move again"));
  menu.addMenu(&pinLayers_->menu());
  filling_->fill(menu);
  const auto adapt = [this, unpin] { unpin->setEnabled(!document_.pins().empty()); };
  connect(&document_, &Document::pinsChanged, unpin, adapt);
  connect(&document_, &Document::meshChanged, unpin, adapt);
  adapt();
}

void MainWindow::fillViewMenu(QMenu& menu) {
  menu.setObjectName(QStringLiteral("viewMenu"));
  auto* fit = menu.addAction(QStringLiteral("Reset &view (fit)"), area_, &PanelArea::fit);
  fit->setObjectName(QStringLiteral("fitView"));
  fit->setShortcut(Qt::Key_F);
  fit->setStatusTip(QStringLiteral("All of the object at rest in every view, from the side it began with"));
  cameraActions_->fill(menu);
  panelActions_ = new PanelActions(*area_, document_, colouring_);
  panelActions_->fill(menu);
  regions_.fill(menu);
  axisViews_->fill(menu);
  auto* show = new ShowMenu(document_, this);
  connect(show, &ShowMenu::changed, area_, [this, show] { area_->setLook(show->look()); });
  show->fill(menu);
  menu.addMenu(QStringLiteral("&Colour by"))->addActions(colourBy_->menuActions());
  menu.addSeparator();
  (new ThemeMenu(this))->fill(menu);
}

void MainWindow::makeToolBar() {
  auto* bar = addToolBar(QStringLiteral("Main"));
  bar->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  bar->setObjectName(QStringLiteral("mainToolBar"));
  bar->setMovable(false);
  const auto add = [this, bar](const char* name) { bar->addAction(findChild<QAction*>(QLatin1String(name))); };
  add("openFile");
  add("saveSession");
  bar->addSeparator();
  undoActions_->fill(*bar);
  bar->addSeparator();
  for (const char* name : {"resetObject", "unpinAll", "fitView"}) {
    add(name);
  }
  bar->addSeparator();
  bar->addWidget(new QLabel(QStringLiteral(" Linked ")));
  bar->addActions(area_->links().actions());
  bar->addSeparator();
  bar->addWidget(new QLabel(QStringLiteral(" Colour by ")));
  bar->addWidget(colourBy_);
  panelActions_->fill(*bar);
}

}  // namespace chainmail
