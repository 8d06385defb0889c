#include "main_window.h"

#include <QActionGroup>
#include <QCloseEvent>
#include <QLabel>
#include <QMenuBar>
#include <QMimeData>
#include <QScreen>
#include <QSettings>
#include <QSplitter>
#include <QStatusBar>
#include <QToolBar>
#include <QVBoxLayout>

#include "colours.h"
#include "file_actions.h"
#include "frame_rate_dock.h"
#include "mesh_dock.h"
#include "message_bar.h"
#include "panel.h"
#include "relaxation_dock.h"
#include "stiffness_dock.h"
#include "tools_dock.h"

namespace chainmail {
namespace {

// To be raised when the docks change, so that an older layout is not restored over them.
constexpr int layoutVersion = 1;
constexpr int savedMilliseconds = 4000;

}  // namespace

MainWindow::MainWindow(MeshPointer mesh, const QString& name)
    : document_(std::move(mesh), name),
      dragTool_(document_),
      cutTool_(document_),
      files_(new FileActions(*this, document_)),
      messages_(new MessageBar),
      splitter_(new QSplitter),
      toolActions_(new QActionGroup(this)),
      hint_(new QLabel) {
  setAcceptDrops(true);
  setDockOptions(AnimatedDocks | AllowTabbedDocks | AllowNestedDocks);
  auto* central = new QWidget;
  auto* column = new QVBoxLayout(central);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(messages_);
  column->addWidget(splitter_, 1);
  setCentralWidget(central);
  hint_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  statusBar()->addWidget(hint_, 1);

  connect(&document_, &Document::refused, messages_, &MessageBar::say);
  connect(files_, &FileActions::failed, messages_, &MessageBar::say);
  connect(files_, &FileActions::saved, this, [this](const QString& path) {
    messages_->hide();
    statusBar()->showMessage(QStringLiteral("Saved %1").arg(path), savedMilliseconds);
  });
  connect(&document_, &Document::meshChanged, messages_, &QWidget::hide);
  connect(&document_, &Document::meshChanged, this, &MainWindow::showTitle);
  // What a tool has begun may not fit the object after an edit, an undo or a redo.
  connect(&document_.undoStack(), &QUndoStack::indexChanged, this, [this] {
    if (tool_ != nullptr) {
      tool_->cancel();
    }
  });
  makePanels();
  makeTools();
  makeMenus();
  makeDocks();
  showTitle();
  restoreLayout();
  activate(dragTool_);
}

MainWindow::~MainWindow() {
  // The panels look at the document until they are gone.
  delete takeCentralWidget();
}

void MainWindow::makePanels() {
  auto camera = std::make_shared<Camera>();
  const std::array colour{colours::left, colours::right};
  for (int i = 0; i < Document::panels; ++i) {
    panels_.push_back(new Panel(document_, i, camera, colour[std::size_t(i)]));
    splitter_->addWidget(panels_.back());
    connect(&panels_.back()->view(), &View::failed, messages_, &MessageBar::say);
    connect(&panels_.back()->view(), &View::cameraChanged, this, [this, i] {
      View& other = panels_[std::size_t(1 - i)]->view();
      if (other.camera() == panels_[std::size_t(i)]->view().camera()) {
        other.update();
      }
    });
  }
  splitter_->setChildrenCollapsible(false);
  splitter_->setHandleWidth(3);
}

void MainWindow::makeTools() {
  const auto add = [this](Tool& tool, const QKeySequence& key) {
    auto* action = toolActions_->addAction(tool.name());
    action->setObjectName(QStringLiteral("tool") + tool.name());
    action->setCheckable(true);
    action->setShortcut(key);
    action->setToolTip(QStringLiteral("%1 (%2)").arg(tool.name(), key.toString()));
    action->setStatusTip(tool.hint());
    connect(action, &QAction::triggered, this, [this, &tool] { activate(tool); });
  };
  add(dragTool_, Qt::Key_D);
  add(cutTool_, Qt::Key_K);
  toolActions_->actions().first()->setChecked(true);
}

void MainWindow::activate(Tool& tool) {
  if (tool_ != nullptr) {
    tool_->cancel();
  }
  tool_ = &tool;
  for (Panel* panel : panels_) {
    panel->view().setTool(&tool);
  }
  hint_->setText(tool.hint());
}

void MainWindow::makeDocks() {
  auto* meshDock = new MeshDock(document_);
  connect(meshDock, &MeshDock::openRequested, files_, &FileActions::open);
  connect(meshDock, &MeshDock::saveRequested, files_, &FileActions::save);
  connect(meshDock, &MeshDock::failed, messages_, &MessageBar::say);
  addDockWidget(Qt::LeftDockWidgetArea, new ToolsDock(*toolActions_));
  addDockWidget(Qt::LeftDockWidgetArea, meshDock);
  addDockWidget(Qt::RightDockWidgetArea, new StiffnessDock(document_));
  addDockWidget(Qt::RightDockWidgetArea, new RelaxationDock(document_));
  addDockWidget(Qt::RightDockWidgetArea, new FrameRateDock(document_, panels_, {colours::left, colours::right}));
  auto* menu = menuBar()->addMenu(QStringLiteral("&Docks"));
  for (QDockWidget* dock : findChildren<QDockWidget*>()) {
    menu->addAction(dock->toggleViewAction());
  }
}

void MainWindow::makeMenus() {
  auto* file = menuBar()->addMenu(QStringLiteral("&File"));
  files_->fill(*file);
  file->addSeparator();
  file->addAction(QStringLiteral("&Quit"), QKeySequence::Quit, this, &QWidget::close);

  auto* edit = menuBar()->addMenu(QStringLiteral("&Edit"));
  auto* undo = document_.undoStack().createUndoAction(this, QStringLiteral("&Undo"));
  auto* redo = document_.undoStack().createRedoAction(this, QStringLiteral("&Redo"));
  undo->setShortcut(QKeySequence::Undo);
  redo->setShortcut(QKeySequence::Redo);
  edit->addActions({undo, redo});
  edit->addSeparator();
  edit->addActions(toolActions_->actions());
  auto* giveUp = edit->addAction(QStringLiteral("&Give up stroke or drag"), this, [this] {
    tool_->cancel();
    messages_->hide();
    for (Panel* panel : panels_) {
      panel->view().update();
    }
  });
  giveUp->setShortcut(Qt::Key_Escape);
  makeObjectMenu();
  makeViewMenu();
}

void MainWindow::makeObjectMenu() {
  auto* menu = menuBar()->addMenu(QStringLiteral("&Object"));
  auto* object = menu->addAction(QStringLiteral("Reset &object"), this, [this] { document_.resetObject(); });
  object->setObjectName(QStringLiteral("resetObject"));
  object->setShortcut(Qt::Key_R);
  object->setStatusTip(QStringLiteral("Every element back to its rest position; cuts and stiffness stay"));
  auto* stiffness = menu->addAction(QStringLiteral("Reset &stiffness"), this,
                                    [this] { document_.setSoftness({}, QStringLiteral("reset stiffness")); });
  stiffness->setObjectName(QStringLiteral("resetStiffness"));
  stiffness->setStatusTip(QStringLiteral("Compression, stretch and shear back to their defaults"));
}

void MainWindow::makeViewMenu() {
  auto* menu = menuBar()->addMenu(QStringLiteral("&View"));
  auto* fit = menu->addAction(QStringLiteral("Reset &view (fit)"), this, [this] {
    for (Panel* panel : panels_) {
      panel->view().fit();
    }
  });
  fit->setObjectName(QStringLiteral("fitView"));
  fit->setShortcut(Qt::Key_F);
  linkCameras_ = menu->addAction(QStringLiteral("&Link cameras"));
  linkCameras_->setObjectName(QStringLiteral("linkCameras"));
  linkCameras_->setCheckable(true);
  linkCameras_->setChecked(true);
  linkCameras_->setStatusTip(QStringLiteral("Both panels look at the object from the same side"));
  connect(linkCameras_, &QAction::toggled, this, &MainWindow::linkCameras);

  auto* bar = addToolBar(QStringLiteral("Main"));
  bar->setObjectName(QStringLiteral("mainToolBar"));
  bar->setMovable(false);
  for (const char* name : {"openFile", "saveFile"}) {
    bar->addAction(findChild<QAction*>(QLatin1String(name)));
  }
  bar->addSeparator();
  auto* undo = document_.undoStack().createUndoAction(bar, QStringLiteral("Undo"));
  auto* redo = document_.undoStack().createRedoAction(bar, QStringLiteral("Redo"));
  // The names of the steps stand in the tool tips: the bar does not change its width with them.
  undo->setIconText(QStringLiteral("Undo"));
  redo->setIconText(QStringLiteral("Redo"));
  bar->addActions({undo, redo});
  bar->addSeparator();
  bar->addAction(findChild<QAction*>(QStringLiteral("resetObject")));
  bar->addAction(fit);
  bar->addAction(linkCameras_);
}

void MainWindow::linkCameras(bool linked) {
  auto camera = panels_[0]->view().camera();
  panels_[1]->view().setCamera(linked ? camera : std::make_shared<Camera>(*camera));
}

void MainWindow::openFile(const QString& path) { files_->openPath(path); }

void MainWindow::showTitle() { setWindowTitle(QStringLiteral("%1 – ChainMail workbench").arg(document_.name())); }

void MainWindow::restoreLayout() {
  resize(QSize(1600, 900).boundedTo(screen()->availableSize()));
  const QSettings settings;
  restoreGeometry(settings.value(QStringLiteral("geometry")).toByteArray());
  restoreState(settings.value(QStringLiteral("layout")).toByteArray(), layoutVersion);
}

void MainWindow::closeEvent(QCloseEvent* event) {
  QSettings settings;
  settings.setValue(QStringLiteral("geometry"), saveGeometry());
  settings.setValue(QStringLiteral("layout"), saveState(layoutVersion));
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
