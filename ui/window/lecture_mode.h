#pragma once

#include <QAbstractButton>
#include <QActionGroup>
#include <QLabel>
#include <QPointer>
#include <utility>
#include <vector>

#include "window/layout.h"

namespace chainmail {

class MainWindow;
class PanelArea;
class Propagation;

/// Shows only the panels and an open lesson, on the whole screen, for an audience: all texts and icons are large, links
/// are wide, and a ring marks the cursor. The keys of the hidden menus work. The propagation that is shown stays,
/// without its dock. The status bar names the tool and the way out. Afterwards, docks, bars and the window are as
/// before.
class LectureMode : public QObject {
  Q_OBJECT

 public:
  LectureMode(MainWindow& window, Propagation& propagation, QActionGroup& tools);

  /// The switch for the menu.
  QAction& action() { return *action_; }
  bool isOn() const { return action_->isChecked(); }
  void leave() { action_->setChecked(false); }
  /// The layout to restore afterwards.
  const Layout& before() const { return before_; }

 private:
  void enter();
  void restore();
  void nameTool();
  void enlargeTexts();
  void enlargeIcons();
  void shrink();
  void hideMenus();
  void showMenus();

  MainWindow& window_;
  PanelArea& area_;
  Propagation& propagation_;
  const QActionGroup& tools_;
  QLabel* tool_;
  QAction* action_;
  Layout before_;
  QFont font_;
  std::vector<std::pair<QPointer<QAbstractButton>, QSize>> icons_;  // buttons with large icons, and the size before
  bool hadMenus_ = false;
  std::vector<QPointer<QAction>> lent_;  // actions of the menus that the window has meanwhile
};

}  // namespace chainmail
