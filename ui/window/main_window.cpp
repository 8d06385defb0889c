#include "window/main_window.h"

#include <QActionGroup>
#include <QApplication>
#include <QCloseEvent>
#include <QComboBox>
#include <QFileInfo>
#include <QJsonDocument>
#include <QLabel>
#include <QMenuBar>
#include <QMimeData>
#include <QScreen>
#include <QSettings>
#include <QStatusBar>
#include <QTimer>
#include <QToolBar>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "common/application.h"
#include "common/as_path.h"
#include "common/icons.h"
#include "common/text.h"
#include "docks/replay_dock.h"
#include "document/edits.h"
#include "files/text/text.h"
#include "io/file_actions.h"
#include "io/mesh_repair.h"
#include "io/picture_actions.h"
#include "io/questions.h"
#include "io/sessions.h"
#include "io/unsaved_work.h"
#include "io/volumes.h"
#include "panels/colour_choices.h"
#include "panels/panel.h"
#include "tools/element_readout.h"
#include "tools/filling.h"
#include "tools/pin_tool.h"
#include "window/bars.h"
#include "window/camera_actions.h"
#include "window/docks.h"
#include "window/help_menu.h"
#include "window/keys_page.h"
#include "window/layout.h"
#include "window/lecture_mode.h"
#include "window/lesson_bar.h"
#include "window/lessons.h"
#include "window/menus.h"
#include "window/panel_actions.h"
#include "window/show_menu.h"
#include "window/window_layout.h"

namespace chainmail {
namespace {

constexpr QSize usualSize(1600, 900);  // at the first start
const QString layoutKey = QStringLiteral("window");
constexpr int statusMilliseconds = 4000;
constexpr std::size_t longestUrl = 200;                     // bytes, in a message
constexpr std::chrono::milliseconds lastMovePatience(500);  // for the last move of the handle when the window closes

/// Shows the name of an undo step in the text of the menu item and in its tool tip. The text of the tool bar button
/// stays short, so that the tool bar keeps its width.
void showStep(QAction& action, const QString& verb, const QString& step) {
  action.setText(step.isEmpty() ? QStringLiteral("&%1").arg(verb) : QStringLiteral("&%1 %2").arg(verb, step));
  action.setIconText(verb);
  action.setToolTip(step.isEmpty() ? verb : QStringLiteral("%1: %2").arg(verb, step));
}

}  // namespace

MainWindow::MainWindow(MeshPointer mesh, const QString& name)
    : document_(std::move(mesh), name),
      colouring_(document_),
      propagation_(document_),
      propagationOverlay_(propagation_),
      regions_(document_),
      rotationRing_(document_),
      dragTool_(document_, grabBrush_, rotationRing_),
      cutTool_(document_),
      pinTool_(document_),
      measurement_(document_),
      measureTool_(document_, measurement_),
      selectTool_(document_),
      sessions_(new Sessions(
          document_, jobs_,
          {[this] { return layoutOf(*this); }, [this](const std::string& layout) { applyLayout(*this, layout); },
           [this](QObject& context, const std::function<void()>& changed) { followLayout(*this, context, changed); }},
          this)),
      files_(new FileActions(*this, document_, jobs_, *sessions_)),
      messages_(new MessageBar),
      area_(new PanelArea(document_, colouring_)),
      cameraActions_(new CameraActions(this, document_, *area_)),
      pinLayers_(new PinLayers(document_, this)),
      pinBar_(new PinBar(document_, *pinLayers_)),
      filling_(new Filling(document_, jobs_)),
      help_(new HelpMenu(*this, document_)),
      panelActions_(new PanelActions(*area_, document_, colouring_)),
      showMenu_(new ShowMenu(document_, this)),
      toolActions_(new QActionGroup(this)),
      lecture_(new LectureMode(*this, propagation_, *toolActions_)),
      lessons_(new Lessons(*this, propagation_, *sessions_)),
      colourBy_(new ColourSelector(colouring_)),
      colourRange_(new ColourRangeMenu(colouring_, this)),
      readout_(new ElementReadout(document_, measurement_, [this] { return area_->links().pointed(); })) {
  arrange();
  listen();
  listenToFiles();
  makeTools();
  makeUndo();
  makeMenus();
  makeDocks();
  auto* help = menuBar()->addMenu(QStringLiteral("&Help"));
  lessons_->fill(*help);
  help_->fill(*help);
  completeMenus(*menuBar());
  showKeysInToolTips(*this);
  showTitle();
  restoreLayout();
  activate(dragTool_);
  area_->panels().front()->view().setFocus();
}

MainWindow::~MainWindow() {
  if (QWidget* field = focusWidget()) {
    field->clearFocus();  // takes the last input while the document exists
  }
  sessions_->close();
  hide();  // while the receivers of the docks' signals exist
  // The panels use the document until they are deleted.
  delete takeCentralWidget();
}

void MainWindow::arrange() {
  setAcceptDrops(true);
  setDockOptions(AnimatedDocks | AllowTabbedDocks);  // a Layout does not describe nested docks
  auto* central = new QWidget;
  auto* column = new QVBoxLayout(central);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(&sessions_->recoveryBar());
  column->addWidget(&files_->volumes().bar());
  column->addWidget(&files_->repair().bar());
  column->addWidget(filling_);
  column->addWidget(pinBar_);
  column->addWidget(area_, 1);
  column->addWidget(&lessons_->bar());
  auto* bars = new BarsOverViews(*area_);
  bars->add(*messages_);
  setCentralWidget(central);
  statusBar()->addWidget(readout_, 1);
  statusBar()->addPermanentWidget(new JobBar(jobs_));
}

void MainWindow::listen() {
  connect(&document_, &Document::refused, messages_, &MessageBar::warn);
  connect(&document_, &Document::noticed, messages_, &MessageBar::note);
  if (const Application* application = Application::get()) {
    connect(application, &Application::failed, messages_, &MessageBar::say);
  }
  area_->addOverlay(propagationOverlay_);
  area_->addOverlay(regions_);
  area_->addOverlay(measurement_);
  area_->addOverlay(rotationRing_);
  connect(&rotationRing_, &RotationRing::changed, area_, &PanelArea::refresh);
  connect(&grabBrush_, &GrabBrush::changed, this, [this] { readout_->setHint(tool_->hint()); });
  connect(&measurement_, &Measurement::changed, area_, &PanelArea::refresh);
  connect(&regions_, &ValidRegions::changed, area_, &PanelArea::refresh);
  connect(area_, &PanelArea::overlayTitleChanged, this, [this] { colourBy_->showOverlay(area_->overlayTitle()); });
  connect(area_, &PanelArea::failed, messages_, &MessageBar::say);
  connect(area_, &PanelArea::pinWanted, this, [this] { pinLayers_->pin(pinLayers_->foot()); });
  connect(showMenu_, &ShowMenu::changed, area_, [this] { area_->setDrawOptions(showMenu_->drawOptions()); });
  connect(&document_, &Document::meshChanged, messages_, &MessageBar::clear);
  connect(&document_, &Document::meshChanged, this, &MainWindow::showTitle);
  connect(&document_.files(), &DocumentFiles::sessionChanged, this, &MainWindow::showTitle);
  connect(&document_.undoStack(), &QUndoStack::cleanChanged, this,
          [this] { setWindowModified(document_.isModified()); });
  // After an edit, undo or redo, an unfinished stroke of the tool may not fit the object.
  connect(&document_.undoStack(), &QUndoStack::indexChanged, this, [this] {
    if (tool_ != nullptr) {
      tool_->cancel();
    }
    setWindowModified(document_.isModified());
  });
}

void MainWindow::listenToFiles() {
  document_.setKeeper([this] {
    const bool mayGo = keepsWork(&Sessions::setAside);
    document_.solvers().goOn();
    return mayGo;
  });
  connect(&jobs_, &Jobs::failed, messages_, &MessageBar::say);
  connect(&jobs_, &Jobs::replaced, messages_, &MessageBar::note);
  connect(files_, &FileActions::failed, messages_, &MessageBar::say);
  connect(files_, &FileActions::noted, messages_, &MessageBar::note);
  connect(files_, &FileActions::recovered, messages_, &MessageBar::retract);
  connect(&jobs_, &Jobs::failed, this, [this] { closesWhenSaved_ = false; });
  connect(sessions_, &Sessions::saved, this, [this] {
    if (std::exchange(closesWhenSaved_, false)) {
      close();
    }
  });
  connect(files_, &FileActions::saved, this, [this](const QString& path) {
    messages_->clear();
    showStatus(QStringLiteral("Saved %1").arg(path));
  });
}

// Tools.

void MainWindow::makeTools() {
  addTool(dragTool_, "drag", Qt::Key_D);
  addTool(cutTool_, "cut", Qt::Key_K);
  const QAction* pin = addTool(pinTool_, "pin", Qt::Key_P);
  addTool(measureTool_, "measure", Qt::Key_M);
  addTool(selectTool_, "select", Qt::Key_S);
  toolActions_->actions().first()->setChecked(true);
  connect(pinBar_, &PinBar::byHandChosen, pin, &QAction::trigger);
}

QAction* MainWindow::addTool(Tool& tool, const char* iconName, const QKeySequence& key) {
  auto* action = toolActions_->addAction(icon(iconName), tool.name());
  action->setObjectName(QStringLiteral("tool") + tool.name());
  action->setCheckable(true);
  action->setShortcut(key);
  action->setToolTip(QStringLiteral("%1 (%2)").arg(tool.name(), key.toString()));
  action->setStatusTip(tool.hint());
  connect(action, &QAction::triggered, this, [this, &tool] { activate(tool); });
  return action;
}

void MainWindow::activate(Tool& tool) {
  if (tool_ != nullptr) {
    tool_->cancel();
    tool_->setActive(false);
  }
  tool_ = &tool;
  tool.setActive(true);
  area_->setTool(tool);
  readout_->setHint(tool.hint());
}

void MainWindow::cancelCurrent() {
  // Esc that closes the list of a combo box arrives here too: it must not clear the selection.
  if (auto* field = qobject_cast<QComboBox*>(QApplication::focusWidget())) {
    field->clearFocus();
    tool_->cancel();
  } else if (jobs_.running() && !tool_->busy()) {
    jobs_.cancel();
  } else if (lecture_->isOn() && !tool_->busy()) {
    lecture_->leave();
    return;
  } else {
    tool_->escape();
    measurement_.clear();
  }
  messages_->dismiss();
  area_->refresh();
}

// Menus and the tool bar.

/// Document::undo and Document::redo end an unfinished drag first.
void MainWindow::makeUndo() {
  const auto undoVerb = QStringLiteral("Undo"), redoVerb = QStringLiteral("Redo");
  undo_ = addUndo(undoVerb, "undo", QKeySequence::Undo, QStringLiteral("Undoes the last change"));
  redo_ = addUndo(redoVerb, "redo", QKeySequence::Redo, QStringLiteral("Repeats the change that was undone"));
  const QUndoStack& stack = document_.undoStack();
  connect(&stack, &QUndoStack::canUndoChanged, undo_, &QAction::setEnabled);
  connect(&stack, &QUndoStack::canRedoChanged, redo_, &QAction::setEnabled);
  connect(&stack, &QUndoStack::undoTextChanged, undo_,
          [this, undoVerb](const QString& step) { showStep(*undo_, undoVerb, step); });
  connect(&stack, &QUndoStack::redoTextChanged, redo_,
          [this, redoVerb](const QString& step) { showStep(*redo_, redoVerb, step); });
  connect(undo_, &QAction::triggered, &document_, &Document::undo);
  connect(redo_, &QAction::triggered, &document_, &Document::redo);
}

QAction* MainWindow::addUndo(const QString& verb, const char* name, QKeySequence::StandardKey key, const QString& tip) {
  auto* action = new QAction(this);
  action->setObjectName(QLatin1String(name));
  action->setIcon(icon(name));
  action->setShortcut(key);
  action->setStatusTip(tip);
  action->setEnabled(false);
  showStep(*action, verb, {});
  return action;
}

void MainWindow::makeMenus() {
  fillFileMenu(*menuBar()->addMenu(QStringLiteral("&File")));
  editMenu_ = menuBar()->addMenu(QStringLiteral("&Edit"));
  fillEditMenu(*editMenu_);
  objectMenu_ = menuBar()->addMenu(QStringLiteral("&Object"));
  fillObjectMenu(*objectMenu_);
  viewMenu_ = menuBar()->addMenu(QStringLiteral("&View"));
  fillViewMenu(*viewMenu_);
  makeToolBar();
}

void MainWindow::fillFileMenu(QMenu& menu) {
  files_->fill(menu);
  menu.addSeparator();
  auto* pictures = new PictureActions(*this, document_, *area_, jobs_);
  pictures->fill(menu);
  connect(pictures, &PictureActions::failed, messages_, &MessageBar::say);
  connect(pictures, &PictureActions::noted, this, &MainWindow::showStatus);
  connect(pictures, &PictureActions::saved, files_, &FileActions::saved);
  afterFilm_ = menu.addSeparator();
  auto* quit = menu.addAction(QStringLiteral("&Quit"), QKeySequence::Quit, this, &QWidget::close);
  quit->setObjectName(QStringLiteral("quit"));
  quit->setStatusTip(
      QStringLiteral("Closes the window. Layout and unsaved work are kept and offered at the next start"));
}

void MainWindow::fillEditMenu(QMenu& menu) {
  menu.addActions({undo_, redo_});
  menu.addSeparator();
  menu.addActions(toolActions_->actions());
  auto* cancel = menu.addAction(QStringLiteral("&Cancel"), Qt::Key_Escape, this, &MainWindow::cancelCurrent);
  cancel->setObjectName(QStringLiteral("giveUp"));
  cancel->setStatusTip(
      QStringLiteral("Cancels the current stroke, drag or job, or clears the brush or the selection; dismisses the "
                     "message"));
}

void MainWindow::fillObjectMenu(QMenu& menu) {
  resetObject_ = menu.addAction(QStringLiteral("Reset &object"), this, [this] { edits::resetObject(document_); });
  resetObject_->setObjectName(QStringLiteral("resetObject"));
  resetObject_->setShortcut(Qt::CTRL | Qt::Key_Backspace);  // R alone belongs to the brush of the Drag tool
  resetObject_->setStatusTip(
      QStringLiteral("Moves all elements to their rest positions; cuts, pins and softness stay"));
  auto* softness = menu.addAction(QStringLiteral("Reset &softness"), this, [this] { edits::resetSoftness(document_); });
  softness->setObjectName(QStringLiteral("resetStiffness"));
  softness->setStatusTip(QStringLiteral(
      "Sets compression, stretch and shear of all links to their defaults, including links with values of their own"));
  unpinAll_ = menu.addAction(QStringLiteral("&Unpin all"), this,
                             [this] { edits::setPinned(document_, document_.pins(), false); });
  unpinAll_->setObjectName(QStringLiteral("unpinAll"));
  unpinAll_->setStatusTip(QStringLiteral("Lets all pinned elements move again"));
  menu.addMenu(&pinLayers_->menu());
  files_->repair().fill(menu);
  filling_->fill(menu);
  const auto adapt = [this] { unpinAll_->setEnabled(!document_.pins().empty()); };
  connect(&document_, &Document::pinsChanged, unpinAll_, adapt);
  connect(&document_, &Document::meshChanged, unpinAll_, adapt);
  adapt();
}

void MainWindow::fillViewMenu(QMenu& menu) {
  fitView_ = menu.addAction(QStringLiteral("Fit &view"), area_, &PanelArea::fit);
  fitView_->setObjectName(QStringLiteral("fitView"));
  fitView_->setShortcut(Qt::Key_F);
  fitView_->setStatusTip(QStringLiteral("Shows the whole object as it is now in every view, from the current side"));
  cameraActions_->fillMoves(menu);
  auto* fitRest = menu.actions().constLast()->menu()->addAction(icon("fit"), QStringLiteral("Fit rest shape"), area_,
                                                                &PanelArea::fitRest);
  fitRest->setObjectName(QStringLiteral("fitRest"));
  fitRest->setShortcut(Qt::Key_Home);
  fitRest->setStatusTip(QStringLiteral("Shows the whole rest shape in every view, from the initial side"));
  panelActions_->fill(menu);
  regions_.fill(menu);
  cameraActions_->fillSides(menu);
  showMenu_->fill(menu);
  menu.addMenu(QStringLiteral("&Colour by"))->addActions(colourBy_->menuActions());
  menu.addMenu(colourRange_);
  addFigures(menu);
  menu.addSeparator();
  menu.addAction(&lecture_->action());
  auto* reset = menu.addAction(QStringLiteral("Reset la&yout"), this, &MainWindow::resetLayout);
  reset->setObjectName(QStringLiteral("resetLayout"));
  reset->setStatusTip(QStringLiteral("Shows, hides and places the docks and the tool bar as at the first start"));
  addThemes(menu);
}

/// Adds the switch of the figures below the panels, which is remembered.
void MainWindow::addFigures(QMenu& menu) {
  auto* figures = menu.addAction(QStringLiteral("Fi&gures of the last pass"));
  figures->setObjectName(QStringLiteral("showFigures"));
  figures->setCheckable(true);
  figures->setShortcut(Qt::Key_I);
  figures->setStatusTip(QStringLiteral("Shows counts, time and violation of the last pass below each panel"));
  connect(figures, &QAction::toggled, this, [this](bool on) {
    area_->setFigures(on);
    QSettings().setValue(QStringLiteral("figures"), on);
  });
  figures->setChecked(QSettings().value(QStringLiteral("figures")).toBool());
}

/// Shows names beside the icons of the tool bar if there is room for all of them.
void MainWindow::adaptToolBar() {
  const auto withNames = Qt::ToolButtonTextBesideIcon;
  if (bar_->toolButtonStyle() == withNames) {
    widthWithNames_ = bar_->sizeHint().width();
  }
  const auto style = widthWithNames_ <= width() ? withNames : Qt::ToolButtonIconOnly;
  if (style != bar_->toolButtonStyle()) {
    bar_->setToolButtonStyle(style);
  }
}

void MainWindow::resizeEvent(QResizeEvent* event) {
  QMainWindow::resizeEvent(event);
  if (event->size().width() != event->oldSize().width()) {
    adaptToolBar();
  }
}

void MainWindow::makeToolBar() {
  bar_ = addToolBar(QStringLiteral("Main"));
  auto* bar = bar_;
  connect(&colouring_, &Colouring::modeChanged, this, &MainWindow::adaptToolBar, Qt::QueuedConnection);
  bar->setObjectName(QStringLiteral("mainToolBar"));
  bar->setMovable(false);
  files_->fill(*bar);
  bar->addSeparator();
  bar->addActions({undo_, redo_});
  bar->addSeparator();
  bar->addActions({resetObject_, unpinAll_, fitView_});
  bar->addSeparator();
  // Before the switches of the links, so that it is the last to be hidden in a narrow window.
  bar->addWidget(new QLabel(QStringLiteral(" Colour by ")));
  bar->addWidget(colourBy_);
  panelActions_->fill(*bar);
  bar->addSeparator();
  bar->addWidget(new QLabel(QStringLiteral(" Linked ")));
  bar->addActions(area_->links().actions());
}

// Docks and the layout.

void MainWindow::makeDocks() {
  docks_ = std::make_unique<Docks>(DockParts{*this, document_, jobs_, *files_, *messages_, *area_, *pinLayers_,
                                             propagation_, propagationOverlay_, *toolActions_, cutTool_, selectTool_,
                                             *editMenu_, *objectMenu_, *viewMenu_, showMenu_->menu(),
                                             [this](const QString& sentence) { showStatus(sentence); }});
  menuBar()->actions().first()->menu()->insertAction(afterFilm_, &docks_->get<ReplayDock>().exportFilm());
  docks_->fill(*menuBar()->addMenu(QStringLiteral("&Docks")));
}

Layout MainWindow::arrangement() const { return lecture_->isOn() ? lecture_->before() : docks_->layout(); }

void MainWindow::takeDocks(const QJsonObject& layout) {
  if (layout.contains(QStringLiteral("docks"))) {
    lecture_->leave();
    docks_->take(layout);
  }
}

void MainWindow::resetLayout() {
  lecture_->leave();
  docks_->reset();
  bar_->show();
}

void MainWindow::restoreLayout() {
  const auto json = QJsonDocument::fromJson(QSettings().value(layoutKey).toString().toUtf8()).object();
  const Layout kept = fitted(layoutFrom(json, {}), availableScreens());
  const QSize available = screen()->availableSize();
  const bool isSmall = usualSize.boundedTo(available - roomOfFrame) != usualSize;
  kept.window.isNull() ? resize(usualSize.boundedTo(available)) : setGeometry(kept.window);
  if (kept.window.isNull() ? isSmall : kept.maximized) {
    setWindowState(Qt::WindowMaximized);  // else its frame would move its last lines out of the screen
  }
  bar_->setVisible(kept.toolBar);
  docks_->reset();
  docks_->take(json);
  // Widgets that were never shown ask for more room than they need, which widens the window beyond a small screen.
  QTimer::singleShot(0, this, [this] {
    gatherDocks(*this);
    const QSize largest = screen()->availableSize() - (frameGeometry().size() - size());
    if (isMaximized() || isFullScreen()) {
      return;
    }
    resize(size().boundedTo(largest));
    if (const QRect there = screen()->availableGeometry(); !there.contains(QRect(pos(), size() + roomOfFrame))) {
      move(there.topLeft());
    }
  });
}

// The window as a whole.

void MainWindow::openFile(const QString& path, bool first) {
  files_->openPath(path, first ? edits::Opening::first : edits::Opening::next);
}

void MainWindow::welcome() {
  if (help_->welcome()) {
    messages_->note(
        QStringLiteral("Drag an element in any panel: all algorithms respond, side by side. F1 lists the keys; Help > "
                       "Lessons has short lessons."));
  }
}

void MainWindow::showStatus(const QString& sentence) { statusBar()->showMessage(sentence, statusMilliseconds); }

void MainWindow::showTitle() {
  const QString file = shownName(document_.files().session());
  setWindowTitle(QStringLiteral("%1[*] – ChainMail workbench").arg(file.isEmpty() ? document_.name() : file));
}

QString MainWindow::keepWork() { return keepWorkBy(&Sessions::keep); }

QString MainWindow::keepWorkBy(QString (Sessions::*keep)()) {
  Application::guarded(
      [this] { document_.solvers().abandonMoves(lastMovePatience); });  // then the work is kept in any case
  return (sessions_->*keep)();
}

/// Keeps unsaved work for the next start. Returns false if that fails and the user does not want to lose the work.
bool MainWindow::keepsWork(QString (Sessions::*keep)()) {
  const QString why = keepWorkBy(keep);
  if (why.isEmpty()) {
    return true;
  }
  const ClosingAnswer answer = askBeforeClosing(*this, why);
  if (answer == ClosingAnswer::discard) {
    return true;
  }
  document_.solvers().goOn();
  if (answer == ClosingAnswer::saveAs) {
    closesWhenSaved_ = files_->saveSessionAs() && keep == &Sessions::keep;
  }
  return false;
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!keepsWork(&Sessions::keep)) {
    event->ignore();
    return;
  }
  const QByteArray layout = QJsonDocument(toJson(arrangement())).toJson(QJsonDocument::Compact);
  lecture_->leave();
  jobs_.close();
  QSettings().setValue(layoutKey, QString::fromUtf8(layout));
  QMainWindow::closeEvent(event);
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) {
    event->acceptProposedAction();
  }
}

void MainWindow::dropEvent(QDropEvent* event) {
  const QUrl url = event->mimeData()->urls().value(0);
  const bool isHere = url.host().isEmpty() || url.host() == QStringLiteral("localhost");
  if (url.isLocalFile() && isHere) {
    openFile(pathOf(QByteArray::fromPercentEncoding(url.path(QUrl::FullyEncoded).toLatin1())));
  } else if (!url.isEmpty()) {
    messages_->say(QStringLiteral("%1: it is not a file of this computer; save it to a file first, then drop that file")
                       .arg(text(shortened(url.toDisplayString().toStdString(), longestUrl))));
  }
}

}  // namespace chainmail
