#include "panels/panel_area.h"

#include <QVBoxLayout>
#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "common/theme.h"
#include "drawing/camera.h"
#include "drawing/mesh_levels.h"
#include "panels/legend.h"
#include "panels/panel.h"

namespace chainmail {
namespace {

constexpr int panelsPerRow = 2;
constexpr int refreshMilliseconds = 100;
constexpr int handleWidth = 3;
constexpr int panelRest = 90;  // height of a panel's head and figures at the usual size of texts (pixels)
// Panels change between next to each other and above each other if that shows the object larger by this factor.
constexpr double maxBetter = 1.3;
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
      links_(this),
      camera_(std::make_shared<Camera>()),
      levels_(std::make_shared<MeshLevels>()),
      legend_(new Legend),
      column_(makeSplitter(Qt::Vertical)),
      rows_{makeSplitter(Qt::Horizontal), makeSplitter(Qt::Horizontal)},
      refresh_(this),
      refit_(this) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(legend_);
  layout->addWidget(column_, 1);
  legend_->setObjectName(QStringLiteral("legendOfAll"));
  for (QSplitter* row : rows_) {
    column_->addWidget(row);
  }
  refresh_.setSingleShot(true);
  refresh_.setInterval(refreshMilliseconds);
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
  // Queued, because it may come in the middle of painting.
  connect(&levels_->maker(), &SurfaceMaker::failed, this, &PanelArea::failed, Qt::QueuedConnection);
  connect(&document, &Document::cutsChanged, this,
          [this](const std::vector<LinkId>& links, bool cut) { levels_->showCuts(links, cut); });
  connect(&document, &Document::meshChanged, this, [this] {
    levels_->forgetSurface();
    if (std::exchange(fitted_, document_.unsplitMesh()) != document_.unsplitMesh()) {
      turnUp(usuallyZUp(document_.name()) ? Camera::Up::z : Camera::Up::y);
      arrange();
      fitRest();
    }
  });
  connect(&document.highlight(), &Highlight::changed, this,
          [this] { dragged_ = dragged_ || document_.highlight().marks().grabbed; });
  connect(&document.solvers(), &PanelSolvers::becameIdle, this, &PanelArea::followObject);
  connect(&document.solvers(), &PanelSolvers::frameReady, this, &PanelArea::followObject);
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
  auto* panel = new Panel(document_, colouring_, links_, number, camera_, levels_, refresh_);
  if (!panels_.empty() && number >= Document::minPanels) {
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
  panel->view().setDrawOptions(drawOptions_);
  panel->head().setActions(headActions_);
  panel->showFigures(figures_);
  panel->setLecture(lecture_);
  listenTo(*panel, number);
}

void PanelArea::listenTo(Panel& panel, int number) {
  View& view = panel.view();
  connect(&view, &View::failed, this, &PanelArea::failed);
  connect(&view, &View::resized, &refit_, qOverload<>(&QTimer::start));
  connect(&view, &View::sideChosen, &refit_, qOverload<>(&QTimer::start));
  connect(&view, &View::ghostChanged, this, &PanelArea::ghostsChanged);
  connect(&view, &View::cameraChanged, this, [this, &view] {
    for (Panel* other : panels_) {
      if (&other->view() != &view && other->view().camera() == view.camera()) {
        other->view().update();
      }
    }
  });
  connect(&panel, &Panel::legendChanged, this, &PanelArea::shareLegend);
  connect(&panel.head(), &PanelHead::pinWanted, this, &PanelArea::pinWanted);
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
  // Deleting it moves the others, whose listeners may ask which panels there are.
  const std::unique_ptr<Panel> removed(panels_.back());
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

void PanelArea::setDrawOptions(const DrawOptions& options) {
  const auto section = drawOptions_.section;
  drawOptions_ = options;
  drawOptions_.section = section;
  for (Panel* panel : panels_) {
    panel->view().setDrawOptions(drawOptions_);
  }
}

void PanelArea::setFigures(bool on) {
  figures_ = on;
  for (Panel* panel : panels_) {
    panel->showFigures(on);
  }
}

void PanelArea::setLecture(bool on) {
  lecture_ = on;
  for (Panel* panel : panels_) {
    panel->setLecture(on);
  }
  if (!panels_.empty()) {
    legend_->setFont(panels_.front()->legend().font());
  }
}

void PanelArea::setSection(const std::optional<SectionPlane>& section) {
  drawOptions_.section = section;
  setDrawOptions(drawOptions_);
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

Camera::Up PanelArea::up() const { return panels_.front()->view().camera()->up(); }

void PanelArea::setUp(Camera::Up up) {
  turnUp(up);
  fitRest();
}

void PanelArea::turnUp(Camera::Up up) {
  for (Panel* panel : panels_) {
    panel->view().camera()->setUp(up);
  }
}

void PanelArea::fitWith(std::vector<QVector3D> reach) {
  reach_ = std::move(reach);
  frame(false);
}

void PanelArea::fitRest() {
  reach_.clear();
  for (Panel* panel : byAspect()) {
    panel->view().fitRest();
  }
  fitsRest_ = true;
}

/// Frames the object in every view, or only in the narrowest one of those that share a camera. Linked views show what
/// all of them have to show.
void PanelArea::frame(bool atRest) {
  fitsRest_ = atRest;
  const auto all = byAspect();
  std::map<const Camera*, std::vector<QVector3D>> outlines;
  for (Panel* panel : all) {
    if (!panel->isHidden()) {
      const auto outline = panel->view().outline(atRest);
      auto& shared = outlines[panel->view().camera().get()];
      shared.insert(shared.end(), outline.begin(), outline.end());
      shared.insert(shared.end(), reach_.begin(), reach_.end());
    }
  }
  for (Panel* panel : all) {
    const bool narrowest = panel == all.back() || panel->view().camera() != all.back()->view().camera();
    if (!panel->isHidden() && narrowest) {
      panel->view().frame(outlines[panel->view().camera().get()]);
    }
  }
}

/// Fits the views again after a resize or from another side, unless the user has panned or zoomed since. Does nothing
/// during a drag, because the object must stay under the cursor.
void PanelArea::fitAgain() {
  if (!document_.highlight().marks().grabbed && fits()) {
    frame(fitsRest_);
  }
}

/// After a drag that led out of the views, fits them again once they show its end, unless the user has panned or zoomed
/// since the last fit.
void PanelArea::followObject() {
  if (!dragged_ || document_.handle().isActive() || !document_.solvers().settled()) {
    return;
  }
  // A part at a time, so that the window stays responsive.
  if (fits() &&
      !std::ranges::all_of(panels_, [](Panel* one) { return one->isHidden() || one->view().prepareSearch(); })) {
    QTimer::singleShot(0, this, &PanelArea::followObject);
    return;
  }
  dragged_ = false;
  if (fits() && !showsAll()) {
    frame(false);
  }
}

bool PanelArea::fits() const {
  return std::ranges::all_of(panels_, [](Panel* panel) { return panel->view().camera()->framed(); });
}

bool PanelArea::showsAll() const {
  return std::ranges::all_of(panels_, [](Panel* panel) { return panel->isHidden() || panel->view().showsAll(); });
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

QString PanelArea::overlayTitle() const { return panels_[std::size_t(inSight().front())]->overlayTitle(); }

/// Shows one legend above all visible panels if they share a scale. If their titles differ, they show these alone.
void PanelArea::shareLegend() {
  std::vector<Legend*> all;
  for (const int panel : inSight()) {
    all.push_back(&panels_[std::size_t(panel)]->legend());
  }
  const Legend& first = *all.front();
  const bool shares =
      all.size() > 1 && std::ranges::all_of(all, [&](const Legend* one) { return first.sharesScaleWith(*one); });
  const bool oneTitle = !overlayTitle().isEmpty() || !colouring_.hasTitlesOfPanels();
  for (Legend* one : all) {
    one->setPart(!shares ? Legend::Part::whole : oneTitle ? Legend::Part::nothing : Legend::Part::title);
  }
  legend_->setPart(shares ? Legend::Part::whole : Legend::Part::nothing);
  legend_->take(first, oneTitle ? first.title() : colouring_.title());
  if (const QString title = overlayTitle(); title != std::exchange(overlayTitle_, title)) {
    emit overlayTitleChanged();
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
  stacked_ = stacksPanels(int(visible.size()));
  moveIntoRows(visible);
  for (int panel = 0; panel < int(panels_.size()); ++panel) {
    Panel& one = *panels_[std::size_t(panel)];
    const bool shows = std::find(visible.begin(), visible.end(), panel) != visible.end();
    one.setVisible(shows);
    one.head().showAlone(alone_ == panel);
    one.head().showActions(headActionsOf(panel));
    if (!shows) {
      colouring_.forget(panel);
    }
  }
  rows_[1]->setVisible(stacked_ || visible.size() > panelsPerRow);
  for (QSplitter* splitter : {rows_[0], rows_[1], column_}) {
    shareEqually(*splitter);
  }
  shareLegend();
  emit arranged();
}

/// The action that adds a panel stays at the last position. The one that removes the last panel belongs to that panel.
QList<QAction*> PanelArea::headActionsOf(int panel) const {
  QList<QAction*> actions;
  if (!headActions_.isEmpty() && panel == inSight().back()) {
    actions << headActions_.first();
  }
  if (panel == int(panels_.size()) - 1) {
    actions << headActions_.mid(1);
  }
  return actions;
}

/// Moves the visible panels into their rows, in this order. Hidden panels stay in any row.
void PanelArea::moveIntoRows(const std::vector<int>& visible) {
  for (Panel* panel : panels_) {
    if (panel->parentWidget() == nullptr || panel->parentWidget() == this) {
      rows_[0]->addWidget(panel);
    }
  }
  const std::size_t perRow = stacked_ ? 1 : panelsPerRow;
  for (std::size_t i = 0; i < visible.size(); ++i) {
    QSplitter& row = *rows_[i / perRow];
    Panel* panel = panels_[std::size_t(visible[i])];
    if (row.indexOf(panel) != int(i % perRow)) {
      row.insertWidget(int(i % perRow), panel);
    }
  }
}

/// True if two panels show the object larger above each other than next to each other.
bool PanelArea::stacksPanels(int shown) const {
  if (shown != 2) {
    return false;
  }
  const Mesh& mesh = *document_.mesh();
  const Point size = bounds(mesh)[1] - bounds(mesh)[0];
  const bool spatial = mesh.space_dimension == 3;
  const double across = spatial ? std::max(size.x(), size.z()) : size[mesh.axes[0]];
  const double up = spatial ? size.y() : mesh.space_dimension == 2 ? size[mesh.axes[1]] : 0;
  const double around = std::max(0.0, std::min(across, 0.25 * across));  // a turned object is higher than its side
  const double high = std::max(spatial ? up + around : up, 1e-9 * across);
  const double rowWidth = width(), rest = scaled(panelRest, *this);
  const double columnHeight = std::max(1.0, height() - 2 * rest);
  const double beside = std::min(rowWidth / 2 / across, (columnHeight + rest) / high);
  const double above = std::min(rowWidth / across, columnHeight / 2 / high);
  return above > (stacked_ ? 1 / maxBetter : maxBetter) * beside;
}

void PanelArea::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  if (const auto visible = inSight(); stacksPanels(int(visible.size())) != stacked_) {
    arrange();
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
