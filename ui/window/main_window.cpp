#include "window/main_window.h"

#include <QActionGroup>
#include <QCloseEvent>
#include <QDockWidget>
#include <QFileInfo>
#include <QMenuBar>
#include <QMimeData>
#include <QScreen>
#include <QSettings>
#include <QStatusBar>
#include <QVBoxLayout>
#include <algorithm>

#include "common/icons.h"
#include "io/file_actions.h"
#include "io/recovery_bar.h"
#include "io/sessions.h"
#include "io/sheet_bar.h"
#include "io/sheets.h"
#include "io/volume_bar.h"
#include "io/volumes.h"
#include "panels/colour_selector.h"
#include "panels/panel.h"
#include "tools/element_readout.h"
#include "tools/filling.h"
#include "tools/pin_bar.h"
#include "tools/pin_layers.h"
#include "window/axis_views.h"
#include "window/camera_actions.h"
#include "window/help_menu.h"
#include "window/job_bar.h"
#include "window/menus.h"
#include "window/message_bar.h"
#include "window/undo_actions.h"
#include "window/window_look.h"

namespace chainmail {
namespace {

// To be raised when the docks change, so that an older layout is not restored over them.
constexpr int layoutVersion = 5;
constexpr int toldMilliseconds = 4000;
constexpr std::chrono::milliseconds patience(500);  // for the last move of the hand when the window closes
// Of the room that the two share: the values of selected links are seen whole where a screen has 900 pixels.
const QList<int> stiffnessAndRate{400, 270};

}  // namespace

MainWindow::MainWindow(MeshPointer mesh, const QString& name)
    : document_(std::move(mesh), name),
      colouring_(document_),
      propagation_(document_),
      propagationOverlay_(propagation_),
      regions_(document_),
      controlPoints_(document_),
      dragTool_(document_, controlPoints_),
      cutTool_(document_),
      pinTool_(document_),
      measurement_(document_),
      measureTool_(document_, measurement_),
      selectTool_(document_),
      undoActions_(new UndoActions(document_, *this)),
      sessions_(new Sessions(
          document_, jobs_,
          {[this] { return lookOf(*this); }, [this](const std::string& look) { takeLook(*this, look); },
           [this](QObject& context, const std::function<void()>& changed) { followLook(*this, context, changed); }},
          this)),
      files_(new FileActions(*this, document_, jobs_, *sessions_)),
      cameraActions_(new CameraActions(this)),
      messages_(new MessageBar),
      area_(new PanelArea(document_, colouring_)),
      pinLayers_(new PinLayers(document_, this)),
      pinBar_(new PinBar(document_, *pinLayers_)),
      filling_(new Filling(document_, jobs_)),
      help_(new HelpMenu(*this, document_)),
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
  column->addWidget(&files_->sheets().bar());
  column->addWidget(&files_->volumes().bar());
  column->addWidget(filling_);
  column->addWidget(pinBar_);
  column->addWidget(area_, 1);
  column->addWidget(&help_->hints());
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
  area_->addOverlay(controlPoints_);
  connect(&controlPoints_, &ControlPoints::changed, area_, &PanelArea::refresh);
  connect(&measurement_, &Measurement::changed, area_, &PanelArea::refresh);
  connect(&regions_, &ValidRegions::changed, area_, &PanelArea::refresh);
  connect(area_, &PanelArea::failed, messages_, &MessageBar::say);
  const auto attach = [this](Panel* panel) { cameraActions_->attach(panel->view()); };
  std::ranges::for_each(area_->panels(), attach);
  connect(area_, &PanelArea::added, this, attach);
  connect(files_, &FileActions::failed, messages_, &MessageBar::say);
  connect(files_, &FileActions::told, messages_, &MessageBar::note);
  connect(&jobs_, &Jobs::failed, messages_, &MessageBar::say);
  connect(files_, &FileActions::saved, this, [this](const QString& path) {
    messages_->clear();
    tell(QStringLiteral("Saved %1").arg(path));
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
  hide();  // the docks tell of it while those who listen are there
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
  connect(pinBar_, &PinBar::byHandChosen, findChild<QAction*>(QStringLiteral("toolPin")), &QAction::trigger);
}

void MainWindow::activate(Tool& tool) {
  if (tool_ != nullptr) {
    tool_->cancel();
  }
  tool_ = &tool;
  area_->setTool(tool);
  readout_->setHint(tool.hint());
}

void MainWindow::openFile(const QString& path, bool first) { files_->openPath(path, first); }

void MainWindow::welcome() { help_->welcome(); }

void MainWindow::tell(const QString& sentence) { statusBar()->showMessage(sentence, toldMilliseconds); }

void MainWindow::showTitle() {
  const QString file = QFileInfo(document_.sessionFile()).fileName();
  setWindowTitle(QStringLiteral("%1[*] – ChainMail workbench").arg(file.isEmpty() ? document_.name() : file));
}

QByteArray MainWindow::savedLayout() const { return saveState(layoutVersion); }

void MainWindow::takeLayout(const QByteArray& layout) {
  // Qt shows the tabs of docks one by one; a layout that answers at once takes some away meanwhile, and Qt crashes.
  this->layout()->setEnabled(false);
  restoreState(layout, layoutVersion);
  this->layout()->setEnabled(true);
  this->layout()->activate();
}

void MainWindow::restoreLayout() {
  resize(QSize(1600, 900).boundedTo(screen()->availableSize()));
  const QSettings settings;
  resizeDocks({findChild<QDockWidget*>(QStringLiteral("stiffnessDock")),
               findChild<QDockWidget*>(QStringLiteral("frameRateDock"))},
              stiffnessAndRate, Qt::Vertical);
  resizeDocks({findChild<QDockWidget*>(QStringLiteral("meshDock"))}, {1}, Qt::Horizontal);  // as narrow as it can be
  restoreGeometry(settings.value(QStringLiteral("geometry")).toByteArray());
  takeLayout(settings.value(QStringLiteral("layout")).toByteArray());
}

void MainWindow::closeEvent(QCloseEvent* event) {
  jobs_.close();
  document_.abandonMoves(patience);
  sessions_->keep();
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
