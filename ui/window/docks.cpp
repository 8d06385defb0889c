#include "window/docks.h"

#include <QAction>
#include <QMainWindow>
#include <QUndoView>
#include <algorithm>
#include <array>
#include <memory>

#include "common/actions.h"
#include "docks/element_dock.h"
#include "docks/frame_rate_dock.h"
#include "docks/mesh_dock.h"
#include "docks/physics_dock.h"
#include "docks/propagation_dock.h"
#include "docks/relaxation_dock.h"
#include "docks/replay_dock.h"
#include "docks/report/report_dock.h"
#include "docks/section_dock.h"
#include "docks/stiffness_dock.h"
#include "docks/tools_dock.h"
#include "document/document.h"
#include "io/file_actions.h"
#include "panels/panel.h"
#include "panels/panel_area.h"
#include "window/bars.h"
#include "window/layout.h"

namespace chainmail {
namespace {

/// Reports the errors of a dock and the files that it saves.
template <typename Dock>
Dock* connectFiles(Dock* dock, const DockParts& parts) {
  QObject::connect(dock, &Dock::failed, &parts.messages, &MessageBar::say);
  QObject::connect(dock, &Dock::saved, &parts.files, &FileActions::saved);
  return dock;
}

QDockWidget* makeMesh(const DockParts& parts) {
  auto* dock = new MeshDock(parts.document, parts.jobs);
  QObject::connect(dock, &MeshDock::openRequested, &parts.files, &FileActions::open);
  QObject::connect(dock, &MeshDock::saveRequested, &parts.files, &FileActions::save);
  QObject::connect(dock, &MeshDock::sampleRequested, &parts.files, &FileActions::openSample);
  return dock;
}

QDockWidget* makeStiffness(const DockParts& parts) {
  auto* dock = new StiffnessDock(parts.document, parts.actions);
  QObject::connect(&dock->presets(), &PresetRow::failed, &parts.messages, &MessageBar::say);
  QObject::connect(&dock->presets(), &PresetRow::noted, &parts.window, parts.showStatus);
  return dock;
}

QDockWidget* makePropagation(const DockParts& parts) {
  auto* dock = new PropagationDock(parts.document, parts.propagation, parts.propagationOverlay, parts.actions);
  QObject::connect(dock, &PropagationDock::changed, &parts.area, &PanelArea::refresh);
  return dock;
}

QDockWidget* makeSection(const DockParts& parts) {
  auto* dock = new SectionDock(parts.document, parts.actions);
  QObject::connect(dock, &SectionDock::changed, &parts.area,
                   [&area = parts.area, dock] { area.setSection(dock->plane()); });
  return dock;
}

/// The undo list: the name of every step. A click on a step goes back to it.
QDockWidget* makeHistory(const DockParts& parts) {
  auto* dock = new QDockWidget;
  auto* list = new QUndoView(&parts.document.undoStack());
  list->setObjectName(QStringLiteral("undoList"));
  list->setAccessibleName(QStringLiteral("Undo list"));
  list->setEmptyLabel(QStringLiteral("initial state"));
  list->setToolTip(QStringLiteral("All steps, the newest last. Click a step to go back to the state after it"));
  dock->setWidget(list);
  return dock;
}

const std::array entries{
    DockEntry{.id = "toolsDock",
              .action = "showToolsDock",
              .title = "Tools",
              .tooltip = "Tools of the left mouse button, and their options",
              .icon = "tools",
              .area = Qt::LeftDockWidgetArea,
              .make = [](const DockParts& parts) -> QDockWidget* {
                return new ToolsDock(parts.document, parts.cut, parts.select, parts.actions);
              }},
    DockEntry{.id = "meshDock",
              .action = "showMeshDock",
              .title = "Mesh",
              .tooltip = "Builds, opens and saves the object; shows samples",
              .icon = "mesh",
              .area = Qt::LeftDockWidgetArea,
              .width = 1,
              .make = makeMesh},
    DockEntry{.id = "stiffnessDock",
              .action = "showStiffnessDock",
              .title = "Stiffness",
              .tooltip = "Stiffness parameters: how far links may shorten, stretch and lean",
              .icon = "stiffness",
              .area = Qt::RightDockWidgetArea,
              .height = 400,
              .make = makeStiffness},
    DockEntry{
        .id = "physicsDock",
        .action = "showPhysics",
        .title = "Physics",
        .tooltip = "Material, pins and control points of the methods that ChainMail is compared with",
        .icon = "physics",
        .key = "J",
        .area = Qt::RightDockWidgetArea,
        .tabbedWith = "stiffnessDock",
        .visible = false,
        .make = [](const DockParts& parts) -> QDockWidget* { return new PhysicsDock(parts.document, parts.actions); }},
    DockEntry{.id = "relaxationDock",
              .action = "showRelaxationDock",
              .title = "Relaxation",
              .tooltip = "How elements move toward their rest shape in idle time",
              .icon = "relaxation",
              .area = Qt::RightDockWidgetArea,
              .make = [](const DockParts& parts) -> QDockWidget* { return new RelaxationDock(parts.document); }},
    DockEntry{.id = "frameRateDock",
              .action = "showFrameRateDock",
              .title = "Frame rate",
              .tooltip = "Painted frames per second, passes per second and pass times (ms) of each panel",
              .icon = "frameRate",
              .area = Qt::RightDockWidgetArea,
              .height = 270,
              .make = [](const DockParts& parts) -> QDockWidget* {
                return connectFiles(new FrameRateDock(parts.document, parts.area.panels(), parts.actions), parts);
              }},
    DockEntry{.id = "reportDock",
              .action = "showReport",
              .title = "Report",
              .tooltip = "Measures time per move and errors of the algorithms on this object",
              .icon = "report",
              .key = "E",
              .area = Qt::BottomDockWidgetArea,
              .visible = false,
              .floating = true,
              .make = [](const DockParts& parts) -> QDockWidget* {
                return connectFiles(new ReportDock(parts.document), parts);
              }},
    DockEntry{.id = "propagationDock",
              .action = "showPropagation",
              .title = "Propagation",
              .tooltip = "Slow motion and single steps through a pass, with its waiting lists",
              .icon = "propagation",
              .key = "O",
              .area = Qt::LeftDockWidgetArea,
              .tabbedWith = "meshDock",
              .visible = false,
              .make = makePropagation},
    DockEntry{.id = "replayDock",
              .action = "showReplay",
              .title = "Record and replay",
              .tooltip = "Steps through all moves since the object was opened; plays them and saves them as files",
              .icon = "record",
              .key = "Ctrl+R",
              .area = Qt::BottomDockWidgetArea,
              .visible = false,
              .make = [](const DockParts& parts) -> QDockWidget* {
                return connectFiles(new ReplayDock(parts.document, parts.area, parts.jobs, parts.actions), parts);
              }},
    DockEntry{.id = "sectionDock",
              .action = "showSectionDock",
              .title = "Section",
              .tooltip = "Cuts the view of the object along a plane to show its inside",
              .icon = "section",
              .area = Qt::BottomDockWidgetArea,
              .visible = false,
              .make = makeSection},
    DockEntry{.id = "elementDock",
              .action = "showElement",
              .title = "Element",
              .tooltip = "Selects an element by its id, moves it by numbers, pins it, cuts its links",
              .icon = "element",
              .key = "Ctrl+E",
              .area = Qt::LeftDockWidgetArea,
              .tabbedWith = "meshDock",
              .visible = false,
              .make = [](const DockParts& parts) -> QDockWidget* { return new ElementDock(parts.document); }},
    DockEntry{.id = "historyDock",
              .action = "showHistoryDock",
              .title = "Undo list",
              .tooltip = "Lists every step that can be undone; a click goes back to it",
              .icon = "history",
              .area = Qt::LeftDockWidgetArea,
              .tabbedWith = "meshDock",
              .visible = false,
              .make = makeHistory},
};

std::vector<DockEntry>& dockTable() {
  static std::vector<DockEntry> all(entries.begin(), entries.end());
  return all;
}

/// Brings a dock to the front of its tabs when it is shown. If it is behind another tab, its action does not hide it
/// but brings it to the front, too.
void raiseWhenShown(QDockWidget& dock) {
  const auto behind = std::make_shared<bool>(false);
  QObject::connect(&dock, &QDockWidget::visibilityChanged, &dock,
                   [&dock, behind](bool seen) { *behind = !seen && (*behind || !dock.isHidden()); });
  QObject::connect(dock.toggleViewAction(), &QAction::triggered, &dock, [&dock, behind](bool shown) {
    if (shown || *behind) {
      bringUp(dock);
    }
  });
}

}  // namespace

void bringUp(QDockWidget& dock) {
  dock.show();
  dock.raise();
}

std::span<const DockEntry> dockEntries() { return dockTable(); }

template <>
std::vector<DockEntry>& table_of() {
  return dockTable();
}

Docks::Docks(const DockParts& parts) : window_(parts.window) {
  window_.setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);  // gives the right column the full height
  for (const DockEntry& entry : dockEntries()) {
    add(entry, parts);
  }
}

void Docks::add(const DockEntry& entry, const DockParts& parts) {
  QDockWidget* dock = entry.make(parts);
  dock->setObjectName(QLatin1String(entry.id));
  dock->setWindowTitle(QLatin1String(entry.title));
  dock->setToolTip(QLatin1String(entry.tooltip));
  parts.actions.add("Docks", {entry.action, entry.title, entry.icon, entry.key, entry.tooltip},
                    dock->toggleViewAction());
  window_.addDockWidget(entry.area, dock);
  if (entry.tabbedWith != nullptr) {
    raiseWhenShown(*dock);
  }
  docks_.push_back(dock);
}

Layout Docks::first() const {
  Layout layout;
  for (std::size_t i = 0; i < docks_.size(); ++i) {
    const DockEntry& entry = dockEntries()[i];
    DockPlace& place = layout.docks.emplace_back(
        DockPlace{.id = QLatin1String(entry.id),
                  .area = entry.area,
                  .floating = entry.floating,
                  .visible = entry.visible,
                  .tabs = QLatin1String(entry.tabbedWith != nullptr ? entry.tabbedWith : entry.id),
                  .front = entry.visible,
                  .size = {entry.width, entry.height}});
    if (entry.floating) {
      place.size = docks_[i]->sizeHint();
      place.position = window_.geometry().center() - QPoint(place.size.width(), place.size.height()) / 2;
    }
  }
  return layout;
}

Layout Docks::layout() const { return layoutOf(window_, applied_); }

void Docks::take(const QJsonObject& json) {
  QStringList ids;
  for (const DockEntry& entry : dockEntries()) {
    ids << QLatin1String(entry.id);
  }
  if (const Layout layout = layoutFrom(json, ids); !layout.docks.empty()) {
    apply(layout);
  }
}

void Docks::apply(const Layout& layout) {
  moveDocks(window_, layout);
  for (const DockPlace& place : layout.docks) {
    const auto known = std::ranges::find(applied_.docks, place.id, &DockPlace::id);
    (known != applied_.docks.end() ? *known : applied_.docks.emplace_back()) = place;
  }
}

}  // namespace chainmail
