#pragma once

#include <QAbstractButton>
#include <QActionGroup>
#include <QJsonArray>
#include <QLabel>
#include <QMainWindow>
#include <QPointer>
#include <QRect>
#include <utility>
#include <vector>

namespace chainmail {

class PanelArea;
class Propagation;

/// Shows only the panels and an open lesson, on the whole screen, for an audience: all texts and icons are large, links
/// are wide, and a ring marks the cursor. The keys of the hidden menus work. The propagation that is shown stays,
/// without its dock. The status bar names the tool and the way out. Afterwards, docks, bars and the window are as
/// before.
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
  void enlargeTexts();
  void enlargeIcons();
  void shrink();
  void hideMenus();
  void showMenus();

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
  QFont font_;
  std::vector<std::pair<QPointer<QAbstractButton>, QSize>> icons_;  // buttons with large icons, and the size before
  bool hadMenus_ = false;
  std::vector<QPointer<QAction>> lent_;  // actions of the menus that the window has meanwhile
};

}  // namespace chainmail
