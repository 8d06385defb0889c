#pragma once

#include <QMenu>
#include <QObject>

#include "window/about_dialog.h"
#include "window/example_drag.h"
#include "window/hints.h"
#include "window/manual_window.h"
#include "window/shortcuts_dialog.h"

class QMainWindow;

namespace chainmail {

/// The Help menu: the manual, the list of shortcuts, and the example and hints of the first start.
class HelpMenu : public QObject {
  Q_OBJECT

 public:
  HelpMenu(QMainWindow& window, Document& document);
  void fill(QMenu& menu);
  Shortcuts& shortcuts() { return shortcuts_; }
  /// On the first start, shows an example and hints, and returns true.
  bool welcome();
  void dismissHints() { hints_->hide(); }
  /// Returns the hints. The window places and owns them.
  Hints& hints() { return *hints_; }

 signals:
  /// The user asked for a lesson in the hints.
  void lessonRequested();

 private:
  void showManual();
  void showShortcuts();
  void showAbout();

  QMainWindow& window_;
  Shortcuts shortcuts_;
  ManualWindow* manual_ = nullptr;     // made on first use
  ShortcutsDialog* dialog_ = nullptr;  // made on first use
  AboutDialog* about_ = nullptr;       // made on first use
  ExampleDrag example_;
  Hints* hints_;
};

}  // namespace chainmail
