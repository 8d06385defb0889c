#pragma once

#include <QMenu>
#include <QObject>

#include "window/example_drag.h"
#include "window/hints.h"
#include "window/shortcuts_dialog.h"

class QMainWindow;

namespace chainmail {

/// What helps to find one's way: the first start's example and hints, and the list of shortcuts.
class HelpMenu : public QObject {
  Q_OBJECT

 public:
  HelpMenu(QMainWindow& window, Document& document);
  void fill(QMenu& menu);
  Shortcuts& shortcuts() { return shortcuts_; }
  /// To who sees the workbench for the first time, an example and hints.
  void welcome();
  void dismissHints() { hints_->hide(); }
  /// To be placed in the window, which owns it then.
  QWidget& hints() { return *hints_; }

 private:
  void showShortcuts();

  QMainWindow& window_;
  Shortcuts shortcuts_;
  ShortcutsDialog* dialog_ = nullptr;  // made when it is first asked for
  ExampleDrag example_;
  Hints* hints_;
};

}  // namespace chainmail
