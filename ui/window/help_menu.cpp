#include "window/help_menu.h"

#include <QMainWindow>
#include <QTimer>

#include "common/icons.h"

namespace chainmail {
namespace {

constexpr int exampleDelay = 300;  // milliseconds

}  // namespace

HelpMenu::HelpMenu(QMainWindow& window, Document& document)
    : QObject(&window), window_(window), shortcuts_(window), example_(document, nullptr), hints_(new Hints) {
  connect(hints_, &Hints::lessonRequested, this, &HelpMenu::lessonRequested);
}

void HelpMenu::fill(QMenu& menu) {
  auto* manual = menu.addAction(icon("help"), QStringLiteral("&Manual"), this, &HelpMenu::showManual);
  manual->setObjectName(QStringLiteral("showManual"));
  manual->setShortcut(Qt::CTRL | Qt::Key_F1);
  manual->setStatusTip(QStringLiteral("Opens the manual: a tour, the algorithms, results, files and the command line"));
  auto* keys = menu.addAction(QStringLiteral("&Keyboard shortcuts…"), this, &HelpMenu::showShortcuts);
  keys->setObjectName(QStringLiteral("showShortcuts"));
  keys->setShortcut(QKeySequence::HelpContents);
  keys->setStatusTip(QStringLiteral("Lists all actions with their keys and effects; keys can be changed"));
  auto* again = menu.addAction(QStringLiteral("Show &hints"), hints_, &Hints::present);
  again->setObjectName(QStringLiteral("showHints"));
  again->setStatusTip(QStringLiteral("Shows the three hints of the first start"));
  menu.addSeparator();
  auto* about = menu.addAction(QStringLiteral("&About ChainMail workbench"), this, &HelpMenu::showAbout);
  about->setObjectName(QStringLiteral("showAbout"));
  about->setStatusTip(QStringLiteral("Shows version, licences, Qt and OpenGL as text that can be copied"));
}

bool HelpMenu::welcome() {
  if (Hints::seen()) {
    return false;
  }
  hints_->present();
  // The views fit the object when the hints and the legends have their places, but not during a drag.
  QTimer::singleShot(exampleDelay, &example_, &ExampleDrag::start);
  return true;
}

void HelpMenu::showManual() {
  if (manual_ == nullptr) {
    manual_ = new ManualWindow(&window_);
  }
  manual_->show();
  manual_->raise();
  manual_->activateWindow();
}

void HelpMenu::showAbout() {
  if (about_ == nullptr) {
    about_ = new AboutDialog(&window_);
  }
  about_->show();
  about_->raise();
  about_->activateWindow();
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
