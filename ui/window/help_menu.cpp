#include "window/help_menu.h"

#include <QMainWindow>
#include <QSettings>
#include <QTimer>

#include "common/icons.h"

namespace chainmail {
namespace {

constexpr int exampleDelay = 300;  // milliseconds
const QString welcomedKey = QStringLiteral("hintsSeen");

/// Shows a window in front, which is made on first use.
template <class Window>
void present(Window*& window, QMainWindow& parent) {
  if (window == nullptr) {
    window = new Window(&parent);
  }
  window->show();
  window->raise();
  window->activateWindow();
}

}  // namespace

HelpMenu::HelpMenu(QMainWindow& window, Document& document)
    : QObject(&window), window_(window), example_(document, nullptr) {}

void HelpMenu::fill(QMenu& menu) {
  auto* manual = menu.addAction(icon("help"), QStringLiteral("&Manual"), this, [this] { present(manual_, window_); });
  manual->setObjectName(QStringLiteral("showManual"));
  manual->setShortcut(Qt::CTRL | Qt::Key_F1);
  manual->setStatusTip(QStringLiteral("Opens the manual: a tour, the algorithms, results, files and the command line"));
  auto* keys = menu.addAction(QStringLiteral("&Keys"), this, [this] { present(keys_, window_); });
  keys->setObjectName(QStringLiteral("showShortcuts"));
  keys->setShortcut(QKeySequence::HelpContents);
  keys->setStatusTip(QStringLiteral("Lists all keys on one page, by task"));
  menu.addSeparator();
  auto* about =
      menu.addAction(QStringLiteral("&About ChainMail workbench"), this, [this] { present(about_, window_); });
  about->setObjectName(QStringLiteral("showAbout"));
  about->setStatusTip(QStringLiteral("Shows version, licences, Qt and OpenGL as text that can be copied"));
}

bool HelpMenu::welcome() {
  QSettings settings;
  if (settings.value(welcomedKey).toBool()) {
    return false;
  }
  settings.setValue(welcomedKey, true);
  // The views fit the object when the legends have their places, but not during a drag.
  QTimer::singleShot(exampleDelay, &example_, &ExampleDrag::start);
  return true;
}

}  // namespace chainmail
