#pragma once

#include <QMenu>
#include <QObject>

#include "window/about_dialog.h"
#include "window/example_drag.h"
#include "window/keys_page.h"
#include "window/manual_window.h"

class QMainWindow;

namespace chainmail {

/// The Help menu: the manual, the page of keys, and the example of the first start.
class HelpMenu : public QObject {
  Q_OBJECT

 public:
  HelpMenu(QMainWindow& window, Document& document);
  void fill(QMenu& menu);
  /// On the first start, shows an example and returns true.
  bool welcome();

 private:
  QMainWindow& window_;
  // Made on first use.
  ManualWindow* manual_ = nullptr;
  KeysPage* keys_ = nullptr;
  AboutDialog* about_ = nullptr;
  ExampleDrag example_;
};

}  // namespace chainmail
