#pragma once

#include <QAbstractButton>
#include <QLabel>
#include <QPointer>
#include <utility>
#include <vector>

#include "window/layout.h"

namespace chainmail {

class Actions;
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
  LectureMode(MainWindow& window, Propagation& propagation, Actions& actions);

  /// Adds the switch to the View menu.
  void fill();
  bool isOn() const { return isOn_; }
  void setOn(bool on);
  void leave() { setOn(false); }
  /// The status bar shows the name of this tool.
  void nameTool(const QString& name);
  /// The layout to restore afterwards.
  const Layout& before() const { return before_; }

 private:
  void enter();
  void restore();
  void enlargeTexts();
  void enlargeIcons();
  void shrink();

  MainWindow& window_;
  PanelArea& area_;
  Propagation& propagation_;
  Actions& actions_;
  QLabel* tool_;
  bool isOn_ = false;
  Layout before_;
  QFont font_;
  std::vector<std::pair<QPointer<QAbstractButton>, QSize>> icons_;  // buttons with large icons, and the size before
  bool hadMenus_ = false;
};

}  // namespace chainmail
