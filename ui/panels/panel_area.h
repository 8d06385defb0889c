#pragma once

#include <QSplitter>
#include <QTimer>
#include <QWidget>
#include <optional>
#include <vector>

#include "drawing/camera.h"
#include "drawing/object_drawing.h"
#include "panels/colouring.h"
#include "panels/panel_links.h"

namespace chainmail {

class Legend;
class MeshLevels;
class Overlay;
class Panel;
class Tool;

/// The panels, in up to two rows of the same height with up to two panels each. A panel keeps its number when it moves.
/// Hidden panels keep running.
class PanelArea : public QWidget {
  Q_OBJECT

 public:
  PanelArea(Document& document, Colouring& colouring);

  PanelLinks& links() { return links_; }
  /// The legend above all panels, visible while they share one scale.
  Legend& legend() { return *legend_; }
  /// Returns the title of the overlay that colours the objects instead of the values; empty if there is none.
  QString overlayTitle() const;
  /// All panels, by number.
  const std::vector<Panel*>& panels() const { return panels_; }
  void setTool(Tool& tool);
  /// Draws an overlay over the object of every panel and shows its notes there.
  void addOverlay(Overlay& overlay);
  /// Shows buttons for actions while the actions are enabled: the first at the last position, the others in the head of
  /// the newest panel.
  void setHeadActions(const QList<QAction*>& actions);
  /// Repaints all panels after an overlay has changed.
  void refresh();
  /// Sets the parts of the object that all panels draw. Ignores the section of `options`, which setSection() sets.
  void setDrawOptions(const DrawOptions& options);
  void setSection(const std::optional<SectionPlane>& section);
  /// Shows or hides the figures of the last pass in all panels.
  void setFigures(bool on);
  bool figures() const { return figures_; }
  /// Marks the cursor with a ring and draws wide links, so that an audience can follow.
  void setLecture(bool on);
  /// Shows all that is there now in every panel, from its current side. Panels with linked cameras show the objects of
  /// all of them.
  void fit() { fitWith({}); }
  /// Shows all that is there now, and these points (mesh units), which the object will reach soon.
  void fitWith(std::vector<QVector3D> reach);
  /// True if the user has neither panned nor zoomed since the views were fitted.
  bool fits() const;
  /// True if no panel shows a part of its object outside its view.
  bool showsAll() const;
  /// Shows the whole rest shape in every panel, from the initial side.
  void fitRest();

  /// The axis that points up in all panels. A new object gets the axis that is usual for its file format.
  Camera::Up up() const;
  void setUp(Camera::Up up);

  bool isShown(int panel) const { return shown_[std::size_t(panel)]; }
  /// Shows or hides a panel. At least one panel stays visible.
  void setShown(int panel, bool shown);
  /// The panel that is shown alone, if any. Without a value, setAlone() shows all panels again, except hidden ones.
  std::optional<int> alone() const { return alone_; }
  void setAlone(std::optional<int> panel);
  /// Moves each panel to the position of the previous one. Two panels swap sides.
  void rotatePanels();
  /// The visible panels, in the order of their positions.
  std::vector<int> inSight() const;

  /// Gives each panel the next panel's object as a ghost, or removes all ghosts.
  void setGhosts(bool on);
  bool hasGhosts() const;

 protected:
  void resizeEvent(QResizeEvent* event) override;

 signals:
  /// The title of the overlay that colours the objects has changed.
  void overlayTitleChanged();
  void failed(const QString& sentence);
  /// A panel was added after the first ones.
  void added(Panel* panel);
  /// Panels were shown, hidden or moved.
  void arranged();
  void ghostsChanged();
  /// See PanelHead::pinWanted.
  void pinWanted();

 private:
  void addPanel();
  void removePanel();
  void followPanels();
  void listenTo(Panel& panel, int number);
  QList<QAction*> headActionsOf(int panel) const;
  void moveIntoRows(const std::vector<int>& visible);
  void arrange();
  void linkCameras(bool linked);
  std::vector<Panel*> byAspect() const;
  void frame(bool atRest);
  void turnUp(Camera::Up up);
  void fitAgain();
  void followObject();
  void shareLegend();
  bool stacksPanels(int shown) const;

  Document& document_;
  MeshPointer fitted_;  // Document::unsplitMesh() of the object that the cameras were fitted to
  Colouring& colouring_;
  PanelLinks links_;
  std::vector<QVector3D> reach_;    // fitted views show these points, too (mesh units)
  std::shared_ptr<Camera> camera_;  // shared by all panels whose cameras are linked
  std::shared_ptr<MeshLevels> levels_;
  DrawOptions drawOptions_;
  Tool* tool_ = nullptr;
  std::vector<Overlay*> overlays_;
  QList<QAction*> headActions_;
  Legend* legend_;
  QString overlayTitle_;
  QSplitter* column_;
  std::array<QSplitter*, 2> rows_;
  std::vector<Panel*> panels_;
  std::vector<int> order_;  // the panels' numbers, by position
  std::vector<bool> shown_;
  std::optional<int> alone_;
  bool figures_ = false, lecture_ = false;
  QTimer refresh_;  // of the figures of all panels at once, so that they and the legend are of one moment
  QTimer refit_;
  bool dragged_ = false;  // since the views were fitted to the object after a drag
  bool fitsRest_ = true;  // true if the views show the rest shape since the last fit
  bool stacked_ = false;  // true if two panels are above each other
};

}  // namespace chainmail
