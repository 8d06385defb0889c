#include "panels/panel_area.h"

#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "drawing/mesh_levels.h"
#include "panels/panel.h"

namespace chainmail {
namespace {

constexpr int panelsPerRow = 2;
constexpr int handleWidth = 3;
constexpr int equalSize = 10'000;  // the splitter scales it to the available space

QSplitter* makeSplitter(Qt::Orientation orientation) {
  auto* splitter = new QSplitter(orientation);
  splitter->setChildrenCollapsible(false);
  splitter->setHandleWidth(handleWidth);
  return splitter;
}

void shareEqually(QSplitter& splitter) { splitter.setSizes(QList<int>(splitter.count(), equalSize)); }

double aspect(const Panel& panel) { return double(panel.width()) / std::max(1, panel.height()); }

}  // namespace

PanelArea::PanelArea(Document& document, Colouring& colouring)
    : document_(document),
      fitted_(document.unsplitMesh()),
      colouring_(colouring),
      links_(colouring, this),
      camera_(std::make_shared<Camera>()),
      levels_(std::make_shared<MeshLevels>()),
      column_(makeSplitter(Qt::Vertical)),
      rows_{makeSplitter(Qt::Horizontal), makeSplitter(Qt::Horizontal)},
      refit_(this) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(column_);
  for (QSplitter* row : rows_) {
    column_->addWidget(row);
  }
  refit_.setSingleShot(true);
  refit_.setInterval(0);  // runs after all views have their sizes
  connect(&refit_, &QTimer::timeout, this, &PanelArea::fitAgain);
  for (const auto& [moved, other] : {std::pair(rows_[0], rows_[1]), std::pair(rows_[1], rows_[0])}) {
    connect(moved, &QSplitter::splitterMoved, this, [this, moved = moved, other = other] {
      if (inSight().size() == rows_.size() * panelsPerRow) {
        other->setSizes(moved->sizes());  // panels above each other are equally wide
      }
    });
  }
  followPanels();
  connect(&links_, &PanelLinks::camerasLinked, this, &PanelArea::linkCameras);
  connect(&levels_->maker(), &SurfaceMaker::made, this, &PanelArea::refresh);
  connect(&document, &Document::cutsChanged, this,
          [this](const std::vector<LinkId>& links, bool cut) { levels_->showCuts(links, cut); });
  connect(&document, &Document::meshChanged, this, [this] {
    levels_->forgetSurface();
    if (std::exchange(fitted_, document_.unsplitMesh()) != document_.unsplitMesh()) {
      fit();
    }
  });
  connect(&document, &Document::panelsChanged, this, &PanelArea::followPanels);
  connect(&document, &Document::panelLeaves, this, &PanelArea::removePanel);
}

void PanelArea::followPanels() {
  while (int(panels_.size()) < document_.panels()) {
    addPanel();
    emit added(panels_.back());
  }
  arrange();
}

void PanelArea::addPanel() {
  const int number = int(panels_.size());
  auto* panel = new Panel(document_, colouring_, links_, number, camera_, levels_);
  if (!panels_.empty() && number >= Document::fewestPanels) {
    const auto& first = panels_.front()->view().camera();
    panel->view().setCamera(links_.cameras() ? first : std::make_shared<Camera>(*first));
  }
  panels_.push_back(panel);
  order_.push_back(number);
  shown_.push_back(true);
  alone_.reset();  // the new panel must be visible
  for (Overlay* overlay : overlays_) {
    panel->addOverlay(*overlay);
  }
  if (tool_ != nullptr) {
    panel->view().setTool(tool_);
  }
  panel->view().setLook(look_);
  panel->head().setActions(headActions_);
  listenTo(*panel, number);
}

void PanelArea::listenTo(Panel& panel, int number) {
  View& view = panel.view();
  connect(&view, &View::failed, this, &PanelArea::failed);
  connect(&view, &View::resized, &refit_, qOverload<>(&QTimer::start));
  connect(&view, &View::ghostChanged, this, &PanelArea::ghostsChanged);
  connect(&view, &View::cameraChanged, this, [this, &view] {
    for (Panel* other : panels_) {
      if (&other->view() != &view && other->view().camera() == view.camera()) {
        other->view().update();
      }
    }
  });
  connect(&panel.head(), &PanelHead::aloneToggled, this,
          [this, number] { setAlone(alone_ == number ? std::nullopt : std::optional(number)); });
}

/// Removes the last panel before its frames are destroyed.
void PanelArea::removePanel() {
  const int number = int(panels_.size()) - 1;
  for (Panel* panel : panels_) {
    if (panel->view().ghost().of == number) {
      panel->view().setGhost({std::nullopt, panel->view().ghost().blend});
    }
  }
  delete panels_.back();
  panels_.pop_back();
  std::erase(order_, number);
  shown_.pop_back();
  if (std::find(shown_.begin(), shown_.end(), true) == shown_.end()) {
    shown_.front() = true;
  }
  if (alone_ == number) {
    alone_.reset();
  }
}

void PanelArea::setHeadActions(const QList<QAction*>& actions) {
  headActions_ = actions;
  for (Panel* panel : panels_) {
    panel->head().setActions(actions);
  }
  arrange();
}

void PanelArea::setTool(Tool& tool) {
  tool_ = &tool;
  for (Panel* panel : panels_) {
    panel->view().setTool(&tool);
  }
}

void PanelArea::setLook(const Look& look) {
  look_.faces = look.faces;
  look_.links = look.links;
  for (Panel* panel : panels_) {
    panel->view().setLook(look_);
  }
}

void PanelArea::setSection(const std::optional<SectionPlane>& section) {
  look_.section = section;
  setLook(look_);
}

/// Returns the panels, hidden and wide ones first. Linked views share one camera, which must fit the narrowest view
/// last: if that view shows the whole object, all views do.
std::vector<Panel*> PanelArea::byAspect() const {
  auto all = panels_;
  const auto hidden =
      std::stable_partition(all.begin(), all.end(), [](const Panel* panel) { return panel->isHidden(); });
  std::stable_sort(hidden, all.end(), [](const Panel* a, const Panel* b) { return aspect(*a) > aspect(*b); });
  return all;
}

void PanelArea::fit() {
  for (Panel* panel : byAspect()) {
    panel->view().fit();
  }
}

/// Fits the views again after a resize. Does nothing during a drag, because the object must stay under the cursor.
void PanelArea::fitAgain() {
  if (document_.highlight().grabbed) {
    return;
  }
  const auto all = byAspect();
  for (Panel* panel : all) {
    if (!panel->isHidden() && (!links_.cameras() || panel == all.back())) {
      panel->view().fitAgain();
    }
  }
}

void PanelArea::addOverlay(Overlay& overlay) {
  overlays_.push_back(&overlay);
  for (Panel* panel : panels_) {
    panel->addOverlay(overlay);
  }
}

void PanelArea::refresh() {
  for (Panel* panel : panels_) {
    panel->refresh();
  }
}

void PanelArea::linkCameras(bool linked) {
  camera_ = panels_.front()->view().camera();
  for (Panel* panel : panels_) {
    if (panel != panels_.front()) {
      panel->view().setCamera(linked ? camera_ : std::make_shared<Camera>(*camera_));
    }
  }
}

std::vector<int> PanelArea::inSight() const {
  std::vector<int> visible = alone_ ? std::vector{*alone_} : order_;
  std::erase_if(visible, [this](int panel) { return !alone_ && !isShown(panel); });
  return visible;
}

void PanelArea::setShown(int panel, bool shown) {
  const bool last = std::count(shown_.begin(), shown_.end(), true) == 1;
  if (shown != isShown(panel) && (shown || !last)) {
    shown_[std::size_t(panel)] = shown;
  }
  alone_.reset();
  arrange();
}

void PanelArea::setAlone(std::optional<int> panel) {
  alone_ = panel;
  arrange();
}

void PanelArea::rotatePanels() {
  std::rotate(order_.begin(), order_.begin() + 1, order_.end());
  arrange();
}

void PanelArea::arrange() {
  const auto visible = inSight();
  moveIntoRows(visible);
  for (int panel = 0; panel < int(panels_.size()); ++panel) {
    Panel& one = *panels_[std::size_t(panel)];
    const bool shows = std::find(visible.begin(), visible.end(), panel) != visible.end();
    one.setVisible(shows);
    one.head().showAlone(alone_ == panel);
    one.head().showActions(&one == panels_.back());
    if (!shows) {
      colouring_.forget(panel);
    }
  }
  rows_[1]->setVisible(visible.size() > panelsPerRow);
  for (QSplitter* splitter : {rows_[0], rows_[1], column_}) {
    shareEqually(*splitter);
  }
  emit arranged();
}

/// Moves the visible panels into their rows, in this order. Hidden panels stay in any row.
void PanelArea::moveIntoRows(const std::vector<int>& visible) {
  for (Panel* panel : panels_) {
    if (panel->parentWidget() == nullptr || panel->parentWidget() == this) {
      rows_[0]->addWidget(panel);
    }
  }
  for (std::size_t i = 0; i < visible.size(); ++i) {
    QSplitter& row = *rows_[i / panelsPerRow];
    Panel* panel = panels_[std::size_t(visible[i])];
    if (row.indexOf(panel) != int(i % panelsPerRow)) {
      row.insertWidget(int(i % panelsPerRow), panel);
    }
  }
}

void PanelArea::setGhosts(bool on) {
  const int count = int(panels_.size());
  for (int panel = 0; panel < count; ++panel) {
    View& view = panels_[std::size_t(panel)]->view();
    view.setGhost({on ? std::optional((panel + 1) % count) : std::nullopt, view.ghost().blend});
  }
}

bool PanelArea::hasGhosts() const {
  return std::any_of(panels_.begin(), panels_.end(), [](Panel* one) { return one->view().ghost().of.has_value(); });
}

}  // namespace chainmail
