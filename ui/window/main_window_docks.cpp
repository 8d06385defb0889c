// The main window's docks.

#include <QActionGroup>
#include <QMenuBar>

#include "common/colours.h"
#include "common/icons.h"
#include "docks/element_dock.h"
#include "docks/frame_rate/frame_rate_dock.h"
#include "docks/mesh_dock.h"
#include "docks/physics_dock.h"
#include "docks/propagation/propagation_dock.h"
#include "docks/relaxation_dock.h"
#include "docks/replay/replay_dock.h"
#include "docks/report/report_dock.h"
#include "docks/section_dock.h"
#include "docks/size_test/size_test_dock.h"
#include "docks/stiffness_dock.h"
#include "docks/tools_dock.h"
#include "io/file_actions.h"
#include "panels/panel.h"
#include "window/main_window.h"
#include "window/message_bar.h"
#include "window/undo_actions.h"

namespace chainmail {

void MainWindow::makeDocks() {
  auto* meshDock = new MeshDock(document_, jobs_);
  connect(meshDock, &MeshDock::openRequested, files_, &FileActions::open);
  connect(meshDock, &MeshDock::saveRequested, files_, &FileActions::save);
  connect(meshDock, &MeshDock::sampleRequested, files_, &FileActions::openSample);
  auto* tools = new ToolsDock(*toolActions_, document_, cutTool_, selectTool_);
  addDockWidget(Qt::LeftDockWidgetArea, tools);
  tools->fill(*findChild<QMenu*>(QStringLiteral("editMenu")));
  addDockWidget(Qt::LeftDockWidgetArea, meshDock);
  makeStiffnessDock();
  makePhysicsDock();
  addDockWidget(Qt::RightDockWidgetArea, new RelaxationDock(document_));
  makeFrameRateDock();
  makeReportDock();
  makeSizeTestDock();
  makePropagationDock();
  makeReplayDock();
  makeSectionDock();
  auto* element = new ElementDock(document_);
  shareRoom(*meshDock, *element);
  shareRoom(*meshDock, *new HistoryDock(document_));
  element->fill(*findChild<QMenu*>(QStringLiteral("viewMenu")));
  auto* menu = menuBar()->addMenu(QStringLiteral("&Docks"));
  for (QDockWidget* dock : findChildren<QDockWidget*>()) {
    menu->addAction(dock->toggleViewAction());
  }
}

/// Where another dock is, out of sight until it is asked for: then it is in front. Asked for while it is behind, it
/// comes to the front as well, and only then goes.
void MainWindow::shareRoom(QDockWidget& other, QDockWidget& dock) {
  addDockWidget(dockWidgetArea(&other), &dock);
  tabifyDockWidget(&other, &dock);
  dock.hide();
  const auto behind = std::make_shared<bool>(false);
  connect(&dock, &QDockWidget::visibilityChanged, &dock,
          [&dock, behind](bool seen) { *behind = !seen && (*behind || !dock.isHidden()); });
  connect(dock.toggleViewAction(), &QAction::triggered, &dock, [&dock, behind](bool shown) {
    if (shown || *behind) {
      dock.show();
      dock.raise();
    }
  });
}

void MainWindow::makeStiffnessDock() {
  auto* dock = new StiffnessDock(document_);
  addDockWidget(Qt::RightDockWidgetArea, dock);
  findChild<QMenu*>(QStringLiteral("objectMenu"))->addMenu(&dock->presets().menu());
  connect(&dock->presets(), &PresetRow::failed, messages_, &MessageBar::say);
  connect(&dock->presets(), &PresetRow::told, this, &MainWindow::tell);
}

/// In the place of the stiffness, and out of sight until it is asked for.
void MainWindow::makePhysicsDock() {
  auto* dock = new PhysicsDock(document_, *pinLayers_, jobs_);
  auto* stiffness = findChild<QDockWidget*>(QStringLiteral("stiffnessDock"));
  shareRoom(*stiffness, *dock);
  connect(dock, &PhysicsDock::presetRequested, stiffness, [this, stiffness] {
    stiffness->show();
    stiffness->raise();
    findChild<QAction*>(QStringLiteral("savePreset"))->trigger();
  });
  QAction* show = dock->toggleViewAction();
  show->setObjectName(QStringLiteral("showPhysics"));
  show->setShortcut(Qt::Key_J);
  show->setStatusTip(
      QStringLiteral("Material, pins and control points of the methods that ChainMail is compared with"));
}

void MainWindow::makeFrameRateDock() {
  auto* dock = new FrameRateDock(document_, area_->panels());
  addDockWidget(Qt::RightDockWidgetArea, dock);
  findChild<QMenu*>(QStringLiteral("viewMenu"))->addMenu(&dock->menu());
  connect(dock, &FrameRateDock::failed, messages_, &MessageBar::say);
  connect(dock, &FrameRateDock::saved, files_, &FileActions::saved);
}

/// Beside the panels, and out of sight until it is asked for.
void MainWindow::makePropagationDock() {
  auto* dock = new PropagationDock(document_, propagation_, propagationOverlay_);
  connect(dock, &PropagationDock::changed, area_, &PanelArea::refresh);
  shareRoom(*findChild<QDockWidget*>(QStringLiteral("meshDock")), *dock);
  dock->fill(*findChild<QMenu*>(QStringLiteral("viewMenu")));
}

/// Under the panels, and out of sight until it is asked for.
void MainWindow::makeReplayDock() {
  auto* dock = new ReplayDock(document_, *area_, jobs_);
  connect(dock, &ReplayDock::failed, messages_, &MessageBar::say);
  connect(dock, &ReplayDock::saved, files_, &FileActions::saved);
  addDockWidget(Qt::BottomDockWidgetArea, dock);
  dock->hide();
  QAction* show = dock->toggleViewAction();
  show->setObjectName(QStringLiteral("showReplay"));
  show->setShortcut(QKeySequence(QStringLiteral("Ctrl+R")));
  show->setStatusTip(QStringLiteral("What was done to the object: gone back and forth in, played, saved, filmed"));
  findChild<QMenu*>(QStringLiteral("objectMenu"))->addMenu(&dock->menu());
}

/// Under the panels, and out of sight until there is a section.
void MainWindow::makeSectionDock() {
  auto* dock = new SectionDock(document_);
  addDockWidget(Qt::BottomDockWidgetArea, dock);
  dock->hide();
  dock->fill(*findChild<QMenu*>(QStringLiteral("showMenu")));
  connect(dock, &SectionDock::changed, area_, [this, dock] { area_->setSection(dock->plane()); });
}

/// Under the panels, and out of sight until it is asked for.
void MainWindow::makeReportDock() {
  auto* dock = new ReportDock(document_);
  connect(dock, &ReportDock::failed, messages_, &MessageBar::say);
  connect(dock, &ReportDock::saved, files_, &FileActions::saved);
  setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);  // that column is the taller one
  addDockWidget(Qt::BottomDockWidgetArea, dock);
  dock->hide();
  QAction* show = dock->toggleViewAction();
  show->setObjectName(QStringLiteral("showReport"));
  show->setText(QStringLiteral("&Report: speed against error"));
  show->setShortcut(Qt::Key_E);
  show->setStatusTip(QStringLiteral("Time per move and errors of the algorithms on this object"));
  findChild<QMenu*>(QStringLiteral("viewMenu"))->addAction(show);
}

void MainWindow::makeSizeTestDock() {
  auto* dock = new SizeTestDock(*this, document_, *area_, [this] {
    std::vector<SizeTestContestant> inSight;
    for (const int panel : area_->inSight()) {
      if (!elastic_method(document_.algorithm(panel))) {  // those are in no race against a frame's time
        inSight.push_back({panel, document_.algorithm(panel), colours::ofPanel(panel)});
      }
    }
    return inSight;
  });
  connect(dock, &SizeTestDock::failed, messages_, &MessageBar::say);
  connect(dock, &SizeTestDock::saved, files_, &FileActions::saved);
  addDockWidget(Qt::BottomDockWidgetArea, dock);
  shareRoom(*findChild<QDockWidget*>(QStringLiteral("reportDock")), *dock);
  QAction* show = dock->toggleViewAction();
  show->setIcon(icon("grow"));
  show->setObjectName(QStringLiteral("showSizeTest"));
  show->setText(QStringLiteral("&Size test: until real time is lost"));
  show->setShortcut(Qt::SHIFT | Qt::Key_E);
  show->setStatusTip(QStringLiteral("Grids grow under a scripted hand until each panel has lost real time"));
  findChild<QMenu*>(QStringLiteral("viewMenu"))->addAction(show);
}

}  // namespace chainmail
