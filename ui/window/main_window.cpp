#include "window/main_window.h"

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

#include "common/actions.h"
#include "common/application.h"
#include "common/as_path.h"
#include "common/text.h"
#include "common/theme.h"
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
#include "window/docks.h"
#include "window/help_menu.h"
#include "window/layout.h"
#include "window/lecture_mode.h"
#include "window/lesson_bar.h"
#include "window/lessons.h"
#include "window/show_menu.h"
#include "window/view_actions.h"
#include "window/window_layout.h"

namespace chainmail {
namespace {

constexpr QSize usualSize(1600, 900);  // at the first start
const QString layoutKey = QStringLiteral("window"), figuresKey = QStringLiteral("figures");
constexpr int statusMilliseconds = 4000;
constexpr std::size_t longestUrl = 200;                     // bytes, in a message
constexpr std::chrono::milliseconds lastMovePatience(500);  // for the last move of the handle when the window closes

/// Shows the name of an undo step in the text of the menu item. The text of the tool bar button stays short, so that
/// the tool bar keeps its width.
Appearance appearanceOf(const QString& verb, const QString& step) {
  return {.text = "&" + verb + (step.isEmpty() ? "" : " " + menuText(step))};
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
      actions_(new Actions(*this, {{"File", "&File"},
                                   {"Edit", "&Edit"},
                                   {"Object", "&Object"},
                                   {"View", "&View"},
                                   {"Docks", "&Docks"},
                                   {"Help", "&Help"}})),
      sessions_(new Sessions(
          document_, jobs_,
          {[this] { return layoutOf(*this); },
           [this](const std::string& layout) {
             applyLayout(*this, layout);
             actions_->refresh();
           },
           [this](QObject& context, const std::function<void()>& changed) { followLayout(*this, context, changed); }},
          this)),
      files_(new FileActions(*this, document_, jobs_, *sessions_)),
      messages_(new MessageBar),
      area_(new PanelArea(document_, colouring_)),
      pinLayers_(new PinLayers(document_, this)),
      pinBar_(new PinBar(document_, *pinLayers_)),
      filling_(new Filling(document_, jobs_)),
      help_(new HelpMenu(*this, document_)),
      showMenu_(new ShowMenu(document_, this)),
      lecture_(new LectureMode(*this, propagation_, *actions_)),
      lessons_(new Lessons(*this, propagation_, *sessions_, *actions_)),
      colourBy_(new ColourSelector(colouring_)),
      colourRange_(new ColourRangeMenu(colouring_, this)),
      readout_(new ElementReadout(document_, measurement_, [this] { return area_->links().pointed(); })) {
  arrange();
  listen();
  listenToFiles();
  addActions();
  listenForActions();
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
  hide();           // while the receivers of the docks' signals exist
  delete actions_;  // they read the document and the panels
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
  connect(area_, &PanelArea::pinWanted, this, [this] { pinLayers_->pin(&pinLayers_->foot()); });
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

void MainWindow::activate(Tool& tool) {
  if (tool_ != nullptr) {
    tool_->cancel();
    tool_->setActive(false);
  }
  tool_ = &tool;
  tool.setActive(true);
  area_->setTool(tool);
  readout_->setHint(tool.hint());
  lecture_->nameTool(tool.name());
  actions_->refresh();
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

// Actions, menus and the tool bar.

/// Each menu has its actions in the order in which they are added here.
void MainWindow::addActions() {
  files_->fill(*actions_);
  actions_->add("File", {{}});
  addPictures();
  addEdits();
  addTools();
  addObject();
  addView();
  makeToolBar();
  makeDocks();
  actions_->add("File", {{},
                         {"quit", "&Quit", "quit", QKeySequence::Quit,
                          "Closes the window. Layout and unsaved work are kept and offered at the next start",
                          [this] { close(); }}});
  actions_->add("Edit",
                {{"giveUp", "&Cancel", "giveUp", "Esc",
                  "Cancels the current stroke, drag or job, or clears the brush or the selection; dismisses the "
                  "message",
                  [this] { cancelCurrent(); }}});
  help_->fill(*actions_);
  actions_->addMnemonics();
}

void MainWindow::addPictures() {
  auto* pictures = new PictureActions(*this, document_, *area_, jobs_);
  pictures->fill(*actions_);
  connect(pictures, &PictureActions::failed, messages_, &MessageBar::say);
  connect(pictures, &PictureActions::noted, this, &MainWindow::showStatus);
  connect(pictures, &PictureActions::saved, files_, &FileActions::saved);
}

/// Document::undo and Document::redo end an unfinished drag first.
void MainWindow::addEdits() {
  const QUndoStack& stack = document_.undoStack();
  actions_->add("Edit", {{"undo", "&Undo|Undo", "undo", QKeySequence::Undo, "Undoes the last change",
                          [this] { document_.undo(); }, When([&stack] { return stack.canUndo(); }),
                          Appears([&stack] { return appearanceOf("Undo", stack.undoText()); })},
                         {"redo", "&Redo|Redo", "redo", QKeySequence::Redo, "Repeats the change that was undone",
                          [this] { document_.redo(); }, When([&stack] { return stack.canRedo(); }),
                          Appears([&stack] { return appearanceOf("Redo", stack.redoText()); })},
                         {}});
}

void MainWindow::addTools() {
  struct ToolRow {
    Tool* tool;
    const char *icon, *key;
  };
  std::vector<ActionRow> rows;
  for (const auto& [tool, icon, key] :
       {ToolRow{&dragTool_, "drag", "D"}, ToolRow{&cutTool_, "cut", "K"}, ToolRow{&pinTool_, "pin", "P"},
        ToolRow{&measureTool_, "measure", "M"}, ToolRow{&selectTool_, "select", "S"}}) {
    rows.emplace_back(
        "tool" + tool->name(), tool->name(), icon, key, tool->hint(), [this, one = tool] { activate(*one); },
        IsOn([this, one = tool] { return tool_ == one; }));
  }
  actions_->add("Edit", rows);
  connect(pinBar_, &PinBar::byHandChosen, &(*actions_)["toolPin"], &QAction::trigger);
}

void MainWindow::addObject() {
  actions_->add(
      "Object",
      {// R alone belongs to the brush of the Drag tool.
       {"resetObject", "Reset &object", "resetObject", "Ctrl+Backspace",
        "Moves all elements to their rest positions; cuts, pins and softness stay",
        [this] { edits::resetObject(document_); }},
       {"resetStiffness", "Reset &softness", "resetStiffness", "",
        "Sets compression, stretch and shear of all links to their defaults, including links with values of their own",
        [this] { edits::resetSoftness(document_); }},
       {"unpinAll", "&Unpin all", "unpin", "", "Lets all pinned elements move again",
        [this] { edits::setPinned(document_, document_.pins(), false); },
        When([this] { return !document_.pins().empty(); })}});
  pinLayers_->fill(*actions_);
  files_->repair().fill(*actions_);
  filling_->fill(*actions_);
}

void MainWindow::addView() {
  actions_->add(
      "View", {{"fitView", "Fit &view", "fit", "F",
                "Shows the whole object as it is now in every view, from the current side", [this] { area_->fit(); }}});
  addCameraMoves(*actions_, *area_);
  area_->links().fill(*actions_, colouring_);
  addPanelActions(*actions_, document_, *area_, colouring_);
  regions_.fill(*actions_);
  addSides(*actions_, document_, *area_);
  showMenu_->fill(*actions_);
  colourBy_->fill(*actions_);
  colourRange_->fill(*actions_);
  area_->setFigures(QSettings().value(figuresKey).toBool());
  actions_->add("View", {{"showFigures", "Fi&gures of the last pass", "", "I",
                          "Shows counts, time and violation of the last pass below each panel",
                          [this](bool on) {
                            area_->setFigures(on);
                            QSettings().setValue(figuresKey, on);
                          },
                          IsOn([this] { return area_->figures(); })},
                         {}});
  lecture_->fill();
  actions_->add(
      "View", {{"resetLayout", "Reset la&yout", "", "",
                "Shows, hides and places the docks and the tool bar as at the first start", [this] { resetLayout(); }},
               {"theme", "&Theme", "theme"}});
  const auto theme = [](const char* id, const char* name, colours::Ground ground, const char* tip) {
    return ActionRow(
        id, name, "", "", tip,
        [ground] {
          remember(ground);
          applyGround(ground);
        },
        IsOn([ground] { return rememberedGround() == ground; }));
  };
  actions_->add("theme", {theme("themeDark", "&Dark", colours::Ground::dark, "Light text on a dark background"),
                          theme("themeLight", "&Light", colours::Ground::light, "Dark text on a light background")});
}

/// Evaluates the actions again after what decides on them has changed.
void MainWindow::listenForActions() {
  for (const auto signal : {&Document::meshChanged, &Document::panelsChanged, &Document::pinsChanged}) {
    connect(&document_, signal, actions_, &Actions::refresh);
  }
  connect(&document_.undoStack(), &QUndoStack::indexChanged, actions_, &Actions::refresh);
  connect(area_, &PanelArea::arranged, actions_, &Actions::refresh);
  connect(area_, &PanelArea::ghostsChanged, actions_, &Actions::refresh);
  connect(&colouring_, &Colouring::modeChanged, actions_, &Actions::refresh);
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
  bar->addActions(actions_->all({"openFile", "saveSession"}));
  bar->addSeparator();
  bar->addActions(actions_->all({"undo", "redo"}));
  bar->addSeparator();
  bar->addActions(actions_->all({"resetObject", "unpinAll", "fitView"}));
  bar->addSeparator();
  // Before the switches of the links, so that it is the last to be hidden in a narrow window.
  bar->addWidget(new QLabel(QStringLiteral(" Colour by ")));
  bar->addWidget(colourBy_);
  addCompared(*bar, *actions_, *area_, colouring_);
  bar->addSeparator();
  bar->addWidget(new QLabel(QStringLiteral(" Linked ")));
  bar->addActions(actions_->all({"linkCameras", "linkColours", "linkMarks"}));
}

// Docks and the layout.

void MainWindow::makeDocks() {
  docks_ = std::make_unique<Docks>(DockParts{*this, document_, jobs_, *files_, *messages_, *area_, propagation_,
                                             propagationOverlay_, *actions_, cutTool_, selectTool_,
                                             [this](const QString& sentence) { showStatus(sentence); }});
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
