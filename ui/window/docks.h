#pragma once

#include <QDockWidget>
#include <functional>
#include <span>
#include <vector>

#include "mesh/extra_row.h"
#include "window/layout.h"

class QMainWindow;

namespace chainmail {

class Actions;
class CutTool;
class Document;
class FileActions;
class Jobs;
class MessageBar;
class PanelArea;
class Propagation;
class PropagationOverlay;
class SelectTool;

/// The parts of the window that the docks use.
struct DockParts {
  QMainWindow& window;
  Document& document;
  Jobs& jobs;
  FileActions& files;
  MessageBar& messages;
  PanelArea& area;
  Propagation& propagation;
  PropagationOverlay& propagationOverlay;
  Actions& actions;
  CutTool& cut;
  SelectTool& select;
  std::function<void(const QString&)> showStatus;
};

/// An entry of the table of all docks, which is in docks.cpp.
struct DockEntry {
  const char* id;      // object name: identifies the dock in stored layouts, so it must not change
  const char* action;  // object name of the action that shows the dock: identifies it for scripts and tests
  const char* title;
  const char* tooltip;  // what the dock shows or does
  const char* icon;
  const char* key = "";
  Qt::DockWidgetArea area;
  const char* tabbedWith = nullptr;  // id of an earlier entry; both docks share a place as tabs
  bool visible = true;               // visible at the first start
  bool floating = false;             // a window of its own until the user docks it
  int width = 0, height = 0;         // at the first start (pixels); 0: as Qt divides the room
  /// Makes the dock, connects it and adds its own actions to the menus.
  QDockWidget* (*make)(const DockParts& parts);
};

/// Returns the entries of all docks, in the order in which they are made and listed.
std::span<const DockEntry> dockEntries();

/// For ExtraRow, in tests.
template <>
std::vector<DockEntry>& table_of();

/// The docks of a window.
class Docks {
 public:
  /// Makes a dock per entry of the table and adds it to the window.
  explicit Docks(const DockParts& parts);

  const std::vector<QDockWidget*>& all() const { return docks_; }
  /// Returns the dock of this class.
  template <typename Dock>
  Dock& get() const {
    for (QDockWidget* one : docks_) {
      if (auto* dock = qobject_cast<Dock*>(one)) {
        return *dock;
      }
    }
    qFatal("docks: no entry makes %s", Dock::staticMetaObject.className());
    std::abort();
  }
  /// Returns where the window and its docks are.
  Layout layout() const;
  /// Places the docks as in the JSON of a layout. A dock that it does not name stays as it is.
  void take(const QJsonObject& json);
  /// Shows, hides and places all docks as in a layout; without one, as at the first start.
  void apply(const Layout& layout);
  void reset() { apply(first()); }

 private:
  void add(const DockEntry& entry, const DockParts& parts);
  Layout first() const;

  QMainWindow& window_;
  std::vector<QDockWidget*> docks_;  // owned by the window
  Layout applied_;                   // where each dock was placed last
};

/// Shows a dock in front of its tabs.
void bringUp(QDockWidget& dock);

}  // namespace chainmail
