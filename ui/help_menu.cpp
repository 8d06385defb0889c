#include "help_menu.h"

#include <QMainWindow>

namespace chainmail {

HelpMenu::HelpMenu(QMainWindow& window) : QObject(&window), window_(window), shortcuts_(window) {}

void HelpMenu::fill(QMenu& menu) {
  auto* keys = menu.addAction(QStringLiteral("&Keyboard shortcuts…"), this, &HelpMenu::showShortcuts);
  keys->setObjectName(QStringLiteral("showShortcuts"));
  keys->setShortcut(QKeySequence::HelpContents);
  keys->setStatusTip(QStringLiteral("All actions with their keys and effects; keys can be changed there"));
}

void HelpMenu::showShortcuts() {
  if (dialog_ == nullptr) {
    dialog_ = new ShortcutsDialog(shortcuts_, &window_);
  }
  dialog_->show();
  dialog_->raise();
  dialog_->activateWindow();
}

}  // namespace chainmail
