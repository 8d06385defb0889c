#include "main_window.h"

#include <QActionGroup>
#include <QCloseEvent>
#include <QFileInfo>
#include <QMenuBar>
#include <QMimeData>
#include <QScreen>
#include <QSettings>
#include <QStatusBar>
#include <QVBoxLayout>
#include <algorithm>

#include "axis_views.h"
#include "camera_actions.h"
#include "colour_selector.h"
#include "colours.h"
#include "element_dock.h"
#include "element_readout.h"
#include "file_actions.h"
#include "frame_rate_dock.h"
#include "help_menu.h"
#include "icons.h"
#include "job_bar.h"
#include "menus.h"
#include "mesh_dock.h"
#include "message_bar.h"
#include "panel.h"
#include "propagation_dock.h"
#include "recovery_bar.h"
#include "relaxation_dock.h"
#include "replay_dock.h"
#include "report_dock.h"
#include "sessions.h"
#include "size_test_dock.h"
#include "stiffness_dock.h"
#include "tools_dock.h"
#include "undo_actions.h"

namespace chainmail {
namespace {

// To be raised when the docks change, so that an older layout is not restored over them.
constexpr int layoutVersion = 3;
constexpr int savedMilliseconds = 4000;

}  // namespace

MainWindow::MainWindow(MeshPointer mesh, const QString& name)
    : document_(std::move(mesh), name),
      colouring_(document_),
      propagation_(document_),
      propagationOverlay_(propagation_),
      regions_(document_),
      dragTool_(document_),
      cutTool_(document_),
      pinTool_(document_),
      measurement_(document_),
      measureTool_(document_, measurement_),
      selectTool_(document_),
      undoActions_(new UndoActions(document_, *this)),
      sessions_(new Sessions(*this, jobs_)),
      files_(new FileActions(*this, document_, jobs_, *sessions_)),
      cameraActions_(new CameraActions(this)),
      messages_(new MessageBar),
      area_(new PanelArea(document_, colouring_)),
      help_(new HelpMenu(*this, document_, *area_)),
      toolActions_(new QActionGroup(this)),
      colourBy_(new ColourSelector(colouring_)),
      axisViews_(new AxisViews(this, document_, *area_)),
      readout_(new ElementReadout(document_, measurement_, [this] { return area_->links().pointed(); })) {
  setAcceptDrops(true);
  setDockOptions(AnimatedDocks | AllowTabbedDocks | AllowNestedDocks);
  auto* central = new QWidget;
  auto* column = new QVBoxLayout(central);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(&sessions_->recoveryBar());
  column->addWidget(messages_);
  column->addWidget(area_, 1);
  setCentralWidget(central);
  statusBar()->addWidget(readout_, 1);
  statusBar()->addPermanentWidget(new JobBar(jobs_));

  listen();
  makeTools();
  makeMenus();
  makeDocks();
  help_->fill(*menuBar()->addMenu(QStringLiteral("&Help")));
  completeMenus(*this);
  help_->shortcuts().adopt();
  showTitle();
  restoreLayout();
  activate(dragTool_);
  area_->panels().front()->view().setFocus();
}

void MainWindow::listen() {
  connect(&document_, &Document::refused, messages_, &MessageBar::warn);
  connect(&document_, &Document::noticed, messages_, &MessageBar::note);
  area_->addOverlay(propagationOverlay_);
  area_->addOverlay(regions_);
  area_->addOverlay(measurement_);
  connect(&measurement_, &Measurement::changed, area_, &PanelArea::refresh);
  connect(&regions_, &ValidRegions::changed, area_, &PanelArea::refresh);
  connect(area_, &PanelArea::failed, messages_, &MessageBar::say);
  const auto attach = [this](Panel* panel) { cameraActions_->attach(panel->view()); };
  std::ranges::for_each(area_->panels(), attach);
  connect(area_, &PanelArea::added, this, attach);
  connect(files_, &FileActions::failed, messages_, &MessageBar::say);
  connect(&jobs_, &Jobs::failed, messages_, &MessageBar::say);
  connect(files_, &FileActions::saved, this, [this](const QString& path) {
    messages_->clear();
    statusBar()->showMessage(QStringLiteral("Saved %1").arg(path), savedMilliseconds);
  });
  connect(&document_, &Document::meshChanged, messages_, &MessageBar::clear);
  connect(&document_, &Document::meshChanged, this, &MainWindow::showTitle);
  connect(&document_, &Document::sessionFileChanged, this, &MainWindow::showTitle);
  connect(&document_.undoStack(), &QUndoStack::cleanChanged, this, [this](bool clean) { setWindowModified(!clean); });
  // What a tool has begun may not fit the object after an edit, an undo or a redo.
  connect(&document_.undoStack(), &QUndoStack::indexChanged, this, [this] {
    if (tool_ != nullptr) {
      tool_->cancel();
    }
  });
}

MainWindow::~MainWindow() {
  if (QWidget* field = focusWidget()) {
    field->clearFocus();  // what was typed last is taken while there is a document
  }
  sessions_->close();
  // The panels look at the document until they are gone.
  delete takeCentralWidget();
}

void MainWindow::makeTools() {
  const auto add = [this](Tool& tool, const QIcon& icon, const QKeySequence& key) {
    auto* action = toolActions_->addAction(icon, tool.name());
    action->setObjectName(QStringLiteral("tool") + tool.name());
    action->setCheckable(true);
    action->setShortcut(key);
    action->setToolTip(QStringLiteral("%1 (%2)").arg(tool.name(), key.toString()));
    action->setStatusTip(tool.hint());
    connect(action, &QAction::triggered, this, [this, &tool] { activate(tool); });
  };
  add(dragTool_, icon("drag"), Qt::Key_D);
  add(cutTool_, icon("cut"), Qt::Key_K);
  add(pinTool_, icon("pin"), Qt::Key_P);
  add(measureTool_, icon("measure"), Qt::Key_M);
  add(selectTool_, icon("select"), Qt::Key_S);
  toolActions_->actions().first()->setChecked(true);
}

void MainWindow::activate(Tool& tool) {
  if (tool_ != nullptr) {
    tool_->cancel();
  }
  tool_ = &tool;
  area_->setTool(tool);
  readout_->setHint(tool.hint());
}

void MainWindow::makeDocks() {
  auto* meshDock = new MeshDock(document_, jobs_);
  connect(meshDock, &MeshDock::openRequested, files_, &FileActions::open);
  connect(meshDock, &MeshDock::saveRequested, files_, &FileActions::save);
  addDockWidget(Qt::LeftDockWidgetArea, new ToolsDock(*toolActions_, selectTool_, *toolActions_->actions().last()));
  addDockWidget(Qt::LeftDockWidgetArea, meshDock);
  makeStiffnessDock();
  addDockWidget(Qt::RightDockWidgetArea, new RelaxationDock(document_));
  makeFrameRateDock();
  makeReportDock();
  makeSizeTestDock();
  makePropagationDock();
  makeReplayDock();
  auto* history = new HistoryDock(document_);
  addDockWidget(Qt::LeftDockWidgetArea, history);
  history->hide();
  auto* element = new ElementDock(document_);
  addDockWidget(Qt::LeftDockWidgetArea, element);  // the other column is full
  element->hide();
  element->fill(*findChild<QMenu*>(QStringLiteral("viewMenu")));
  auto* menu = menuBar()->addMenu(QStringLiteral("&Docks"));
  for (QDockWidget* dock : findChildren<QDockWidget*>()) {
    menu->addAction(dock->toggleViewAction());
  }
}

void MainWindow::makeStiffnessDock() {
  auto* dock = new StiffnessDock(document_);
  addDockWidget(Qt::RightDockWidgetArea, dock);
  findChild<QMenu*>(QStringLiteral("objectMenu"))->addMenu(&dock->presets().menu());
  connect(&dock->presets(), &PresetRow::failed, messages_, &MessageBar::say);
  connect(&dock->presets(), &PresetRow::told, this,
          [this](const QString& sentence) { statusBar()->showMessage(sentence, savedMilliseconds); });
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
  addDockWidget(Qt::LeftDockWidgetArea, dock);
  dock->hide();
  dock->fill(*findChild<QMenu*>(QStringLiteral("viewMenu")));
}

/// Under the panels, and out of sight until it is asked for.
void MainWindow::makeReplayDock() {
  auto* dock = new ReplayDock(document_, *area_);
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
      inSight.push_back({panel, document_.algorithm(panel), colours::ofPanel(panel)});
    }
    return inSight;
  });
  connect(dock, &SizeTestDock::failed, messages_, &MessageBar::say);
  connect(dock, &SizeTestDock::saved, files_, &FileActions::saved);
  addDockWidget(Qt::BottomDockWidgetArea, dock);
  tabifyDockWidget(findChild<QDockWidget*>(QStringLiteral("reportDock")), dock);
  dock->hide();
  QAction* show = dock->toggleViewAction();
  connect(show, &QAction::triggered, dock, &QWidget::raise);  // in front of the report
  show->setIcon(icon("grow"));
  show->setObjectName(QStringLiteral("showSizeTest"));
  show->setText(QStringLiteral("&Size test: until real time is lost"));
  show->setShortcut(Qt::SHIFT | Qt::Key_E);
  show->setStatusTip(QStringLiteral("Grids grow under a scripted hand until each panel has lost real time"));
  findChild<QMenu*>(QStringLiteral("viewMenu"))->addAction(show);
}

void MainWindow::openFile(const QString& path, bool first) { files_->openPath(path, first); }

void MainWindow::welcome() { help_->welcome(); }

void MainWindow::showTitle() {
  const QString file = QFileInfo(document_.sessionFile()).fileName();
  setWindowTitle(QStringLiteral("%1[*] – ChainMail workbench").arg(file.isEmpty() ? document_.name() : file));
}

QByteArray MainWindow::savedLayout() const { return saveState(layoutVersion); }

void MainWindow::takeLayout(const QByteArray& layout) { restoreState(layout, layoutVersion); }

void MainWindow::restoreLayout() {
  resize(QSize(1600, 900).boundedTo(screen()->availableSize()));
  const QSettings settings;
  restoreGeometry(settings.value(QStringLiteral("geometry")).toByteArray());
  takeLayout(settings.value(QStringLiteral("layout")).toByteArray());
}

void MainWindow::closeEvent(QCloseEvent* event) {
  jobs_.close();
  sessions_->close();
  QSettings settings;
  settings.setValue(QStringLiteral("geometry"), saveGeometry());
  settings.setValue(QStringLiteral("layout"), savedLayout());
  QMainWindow::closeEvent(event);
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) {
    event->acceptProposedAction();
  }
}

void MainWindow::dropEvent(QDropEvent* event) {
  for (const QUrl& url : event->mimeData()->urls().first(std::min<qsizetype>(1, event->mimeData()->urls().size()))) {
    openFile(url.toLocalFile());
  }
}

}  // namespace chainmail
