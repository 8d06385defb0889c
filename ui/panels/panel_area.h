#pragma once

#include <QSplitter>
#include <QTimer>
#include <QWidget>
#include <optional>
#include <vector>

#include "drawing/look.h"
#include "panels/colouring.h"
#include "panels/panel_links.h"

namespace chainmail {

class Camera;
class MeshLevels;
class Overlay;
class Panel;
class Tool;

/// The panels, side by side: up to two in a row, up to two rows of the same height. They keep their numbers wherever
/// they stand; hidden ones go on as all others do.
class PanelArea : public QWidget {
  Q_OBJECT

 public:
  PanelArea(Document& document, Colouring& colouring);

  PanelLinks& links() { return links_; }
  /// By their numbers.
  const std::vector<Panel*>& panels() const { return panels_; }
  void setTool(Tool& tool);
  /// Draws it over every panel's object, and says there what it notes.
  void addOverlay(Overlay& overlay);
  /// Offers actions above the newest panel, as long as they are enabled.
  void setHeadActions(const QList<QAction*>& actions);
  /// Paints and says anew what an overlay has changed.
  void refresh();
  /// What every panel shows of its object, beside the section; and the section.
  void setLook(const Look& look);
  void setSection(const std::optional<SectionPlane>& section);
  /// Shows the whole rest shape in every panel.
  void fit();

  bool isShown(int panel) const { return shown_[std::size_t(panel)]; }
  /// The last one that is shown stays.
  void setShown(int panel, bool shown);
  /// The one panel that has all the room, if any; none brings back those that were shown.
  std::optional<int> alone() const { return alone_; }
  void setAlone(std::optional<int> panel);
  /// Each panel takes the next one's place: two exchange sides.
  void moveOn();
  /// The panels on the screen, in the order of their places.
  std::vector<int> inSight() const;

  /// Lays the next panel's object over each panel's own, or takes all ghosts away.
  void setGhosts(bool on);
  bool hasGhosts() const;

 signals:
  void failed(const QString& sentence);
  /// One more panel, after those that were there from the start.
  void added(Panel* panel);
  /// Other panels are in sight, or elsewhere.
  void arranged();
  void ghostsChanged();

 private:
  void addPanel();
  void removePanel();
  void followPanels();
  void listenTo(Panel& panel, int number);
  void place(const std::vector<int>& seen);
  void arrange();
  void linkCameras(bool linked);
  std::vector<Panel*> byAspect() const;
  void fitAgain();

  Document& document_;
  Colouring& colouring_;
  PanelLinks links_;
  std::shared_ptr<Camera> camera_;  // of all panels whose cameras are linked
  std::shared_ptr<MeshLevels> levels_;
  Look look_;
  Tool* tool_ = nullptr;
  std::vector<Overlay*> overlays_;
  QList<QAction*> headActions_;
  QSplitter* column_;
  std::array<QSplitter*, 2> rows_;
  std::vector<Panel*> panels_;
  std::vector<int> places_;  // which panel stands where
  std::vector<bool> shown_;
  std::optional<int> alone_;
  QTimer refit_;
};

}  // namespace chainmail
