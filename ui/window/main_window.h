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

class QActionGroup;
class QLabel;
class QMenu;

namespace chainmail {

class AxisViews;
class CameraActions;
class ColourSelector;
class ElementReadout;
class FileActions;
class Filling;
class HelpMenu;
class MessageBar;
class PanelActions;
class PinBar;
class PinLayers;
class Panel;
class Sessions;
class UndoActions;

/// The workbench's window: panels, docks, tools and named actions, wired to one document.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  MainWindow(MeshPointer mesh, const QString& name);
  ~MainWindow() override;

  Document& document() { return document_; }
  Panel& panel(int which) { return *area_->panels()[std::size_t(which)]; }
  Colouring& colouring() { return colouring_; }
  MessageBar& messages() { return *messages_; }
  Jobs& jobs() { return jobs_; }
  Sessions& sessions() { return *sessions_; }
  /// The docks as they stand, and back again; of other docks than these it takes nothing.
  QByteArray savedLayout() const;
  void takeLayout(const QByteArray& layout);
  /// Opens a session or a mesh file in the background, as one step of undo or as the window's first object; a bad file
  /// gets a sentence and changes nothing.
  void openFile(const QString& path, bool first = false);
  /// To be called where the window begins with its sample: shows the first start's example and hints, once.
  void welcome();

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void listen();
  void makeTools();
  void makeDocks();
  void shareRoom(QDockWidget& other, QDockWidget& dock);
  void makeStiffnessDock();
  void makePhysicsDock();
  void makeFrameRateDock();
  void makeReportDock();
  void makeSizeTestDock();
  void makePropagationDock();
  void makeReplayDock();
  void makeSectionDock();
  void makeMenus();
  void makePictures(QMenu& menu);
  void fillEditMenu(QMenu& menu);
  void fillObjectMenu(QMenu& menu);
  void fillViewMenu(QMenu& menu);
  void makeToolBar();
  void giveUp();
  void activate(Tool& tool);
  /// Says something in the status bar for a while.
  void tell(const QString& sentence);
  void showTitle();
  void restoreLayout();

  Document document_;
  Colouring colouring_;
  Propagation propagation_;
  PropagationOverlay propagationOverlay_;
  ValidRegions regions_;
  ControlPoints controlPoints_;
  DragTool dragTool_;
  CutTool cutTool_;
  PinTool pinTool_;
  Measurement measurement_;
  MeasureTool measureTool_;
  SelectTool selectTool_;
  Tool* tool_ = nullptr;
  Jobs jobs_;
  UndoActions* undoActions_;
  Sessions* sessions_;
  FileActions* files_;
  CameraActions* cameraActions_;
  MessageBar* messages_;
  PanelArea* area_;
  PinLayers* pinLayers_;
  PinBar* pinBar_;
  Filling* filling_;
  HelpMenu* help_;
  PanelActions* panelActions_;
  QActionGroup* toolActions_;
  ColourSelector* colourBy_;
  AxisViews* axisViews_;
  ElementReadout* readout_;
};

}  // namespace chainmail
