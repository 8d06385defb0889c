#pragma once

#include <QActionGroup>
#include <QJsonArray>
#include <QLabel>
#include <QMainWindow>
#include <QRect>
#include <vector>

namespace chainmail {

class PanelArea;
class Propagation;

/// Shows only the panels, on the whole screen, with large texts and a ring at the cursor, for an audience. The
/// propagation that is shown stays, without its dock. The status bar names the tool and the way out. Afterwards, docks,
/// bars and the window are as before.
class LectureMode : public QObject {
  Q_OBJECT

 public:
  LectureMode(QMainWindow& window, PanelArea& area, Propagation& propagation, QActionGroup& tools, QWidget& hints,
              int layoutVersion);

  /// The switch for the menu.
  QAction& action() { return *action_; }
  bool isOn() const { return action_->isChecked(); }
  void leave() { action_->setChecked(false); }
  /// The layout to restore afterwards (QMainWindow::saveState).
  const QByteArray& layoutBefore() const { return layout_; }
  /// The places of the docks to restore afterwards (dockLayout()).
  const QJsonArray& placesBefore() const { return places_; }

 private:
  void enter();
  void restore();
  void nameTool();

  QMainWindow& window_;
  PanelArea& area_;
  Propagation& propagation_;
  const QActionGroup& tools_;
  QLabel* tool_;
  QWidget& hints_;
  bool hadHints_ = false;
  int layoutVersion_;
  QAction* action_;
  QByteArray layout_, geometry_;
  QRect at_;  // of the window before
  QJsonArray places_;
};

}  // namespace chainmail
