#pragma once

#include <QMainWindow>
#include <memory>
#include <vector>

#include "cut_tool.h"
#include "document.h"
#include "drag_tool.h"

class QActionGroup;
class QLabel;
class QSplitter;

namespace chainmail {

class FileActions;
class MessageBar;
class Panel;

/// The workbench's window: panels, docks, tools and named actions, wired to one document.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  MainWindow(MeshPointer mesh, const QString& name);
  ~MainWindow() override;

  Document& document() { return document_; }
  Panel& panel(int which) { return *panels_[which]; }
  MessageBar& messages() { return *messages_; }
  /// Opens a mesh file as one step of undo; a bad file gets a sentence and changes nothing.
  void openFile(const QString& path);

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void makePanels();
  void makeTools();
  void makeDocks();
  void makeMenus();
  void makeObjectMenu();
  void makeViewMenu();
  void activate(Tool& tool);
  void linkCameras(bool linked);
  void showTitle();
  void restoreLayout();

  Document document_;
  DragTool dragTool_;
  CutTool cutTool_;
  Tool* tool_ = nullptr;
  FileActions* files_;
  MessageBar* messages_;
  QSplitter* splitter_;
  std::vector<Panel*> panels_;
  QActionGroup* toolActions_;
  QAction* linkCameras_ = nullptr;
  QLabel* hint_;
};

}  // namespace chainmail
