#pragma once

#include <QMenu>
#include <QObject>

#include "shortcuts_dialog.h"

class QMainWindow;

namespace chainmail {

/// The Help menu: the list of shortcuts.
class HelpMenu : public QObject {
  Q_OBJECT

 public:
  explicit HelpMenu(QMainWindow& window);
  void fill(QMenu& menu);
  Shortcuts& shortcuts() { return shortcuts_; }

 private:
  void showShortcuts();

  QMainWindow& window_;
  Shortcuts shortcuts_;
  ShortcutsDialog* dialog_ = nullptr;  // made when it is first asked for
};

}  // namespace chainmail
