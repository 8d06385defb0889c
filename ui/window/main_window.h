#pragma once

#include <QMainWindow>
#include <memory>

#include "common/jobs.h"
#include "document/document.h"
#include "panels/colouring.h"
#include "panels/panel_area.h"
#include "tools/cut_tool.h"
#include "tools/drag_tool.h"
#include "tools/measure_tool.h"
#include "tools/pin_tool.h"
#include "tools/propagation_overlay.h"
#include "tools/select_tool.h"
#include "tools/valid_regions.h"
#include "window/layout.h"

class QToolBar;

namespace chainmail {

class Actions;
class ColourRangeMenu;
class ColourSelector;
class Docks;
class ElementReadout;
class FileActions;
class Filling;
class HelpMenu;
class LectureMode;
class Lessons;
class MessageBar;
class Panel;
class PinBar;
class PinLayers;
class Sessions;
class ShowMenu;

/// The workbench's window: panels, docks, tools, menus and bars, connected to one document.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  MainWindow(MeshPointer mesh, const QString& name);
  ~MainWindow() override;

  Document& document() { return document_; }
  PanelArea& area() { return *area_; }
  Panel& panel(int which) { return *area_->panels()[std::size_t(which)]; }
  Colouring& colouring() { return colouring_; }
  ShowMenu& showMenu() { return *showMenu_; }
  ColourRangeMenu& colourRange() { return *colourRange_; }
  const Docks& docks() const { return *docks_; }
  MessageBar& messages() { return *messages_; }
  Jobs& jobs() { return jobs_; }
  Sessions& sessions() { return *sessions_; }
  Lessons& lessons() { return *lessons_; }
  Docks& docks() { return *docks_; }
  /// Returns where the window and its docks are; in the lecture mode, as they were before it.
  Layout arrangement() const;
  /// Places the docks that the JSON of a layout names.
  void takeDocks(const QJsonObject& layout);
  /// Opens a session, mesh, volume or picture in the background: as one undo step, or as the first object of the
  /// window. If the file has an error, shows a message and changes nothing.
  void openFile(const QString& path, bool first = false);
  /// Keeps unsaved work for the next start, without questions. Returns why not, or an empty text.
  QString keepWork();
  /// Shows an example on the first start. Called if the window starts without a file.
  void welcome();

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void arrange();
  void listen();
  void listenToFiles();
  void addActions();
  void addPictures();
  void addEdits();
  void addTools();
  void addObject();
  void addView();
  void listenForActions();
  void makeToolBar();
  void adaptToolBar();
  void makeDocks();
  void cancelCurrent();
  void activate(Tool& tool);
  /// Shows a sentence in the status bar for 4 s.
  void showStatus(const QString& sentence);
  void showTitle();
  QString keepWorkBy(QString (Sessions::*keep)());
  bool keepsWork(QString (Sessions::*keep)());
  void restoreLayout();
  void resetLayout();

  Document document_;
  Colouring colouring_;
  Propagation propagation_;
  PropagationOverlay propagationOverlay_;
  ValidRegions regions_;
  GrabBrush grabBrush_;
  RotationRing rotationRing_;
  DragTool dragTool_;
  CutTool cutTool_;
  PinTool pinTool_;
  Measurement measurement_;
  MeasureTool measureTool_;
  SelectTool selectTool_;
  Tool* tool_ = nullptr;
  Jobs jobs_;
  Actions* actions_;
  Sessions* sessions_;
  FileActions* files_;
  MessageBar* messages_;
  PanelArea* area_;
  PinLayers* pinLayers_;
  PinBar* pinBar_;
  Filling* filling_;
  HelpMenu* help_;
  ShowMenu* showMenu_;
  LectureMode* lecture_;
  Lessons* lessons_;
  ColourSelector* colourBy_;
  ColourRangeMenu* colourRange_;
  QToolBar* bar_ = nullptr;
  int widthWithNames_ = 0;  // of the tool bar (pixels)
  bool closesWhenSaved_ = false;
  ElementReadout* readout_;
  std::unique_ptr<Docks> docks_;
};

}  // namespace chainmail
