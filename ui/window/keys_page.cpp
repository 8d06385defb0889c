#include "window/keys_page.h"

#include <QKeyEvent>
#include <QMenu>
#include <QMenuBar>
#include <QScreen>
#include <QTextBrowser>
#include <QVBoxLayout>
#include <array>

#include "common/actions.h"

namespace chainmail {
namespace {

constexpr QSize preferredPage(920, 640);

struct Task {
  const char* menu;
  const char* title;
};
constexpr std::array tasks{Task{"File", "Open, save, export"},  Task{"Edit", "Tools and undo"},
                           Task{"Object", "Change the object"}, Task{"View", "Look at it"},
                           Task{"Docks", "Show a dock"},        Task{"Help", "Learn"}};

struct MouseRow {
  const char* keys;
  const char* effect;
};
constexpr std::array mouseRows{MouseRow{"Left button", "the tool: drag, cut, pin, measure, select"},
                               MouseRow{"Wheel", "zoom"},
                               MouseRow{"Middle button", "pan"},
                               MouseRow{"Right button", "turn"},
                               MouseRow{"Double click", "moves a point of the object to the middle"},
                               MouseRow{"R + wheel", "radius of the brush of Drag"},
                               MouseRow{"Shift in a drag", "rotates the handle"}};

/// Returns the actions of a menu and its submenus.
QList<QAction*> actionsIn(const QMenu& menu) {
  QList<QAction*> all;
  for (QAction* action : menu.actions()) {
    all += action->menu() != nullptr ? actionsIn(*action->menu()) : QList{action};
  }
  return all;
}

QString rowOf(const QString& keys, const QString& effect) {
  return QStringLiteral("<tr><td style='white-space:nowrap'><b>%1</b>&nbsp;&nbsp;</td><td>%2</td></tr>")
      .arg(keys.toHtmlEscaped(), effect.toHtmlEscaped());
}

QString keysOf(const QAction& action) {
  return QKeySequence::listToString(action.shortcuts(), QKeySequence::NativeText);
}

/// Returns a heading and its rows.
QString section(const QString& title, const QString& rows) {
  return QStringLiteral("<h3>%1</h3><table cellspacing='2'>%2</table>").arg(title.toHtmlEscaped(), rows);
}

/// Returns the keys of a menu, under the task that it serves.
QString sectionOf(const QAction& top) {
  QString rows;
  for (const QAction* action : actionsIn(*top.menu())) {
    rows += action->shortcut().isEmpty() ? QString() : rowOf(keysOf(*action), plainText(*action));
  }
  const QString menu = plainText(top);
  for (const Task& task : tasks) {
    if (menu == QLatin1String(task.menu)) {
      return section(QLatin1String(task.title), rows);
    }
  }
  return section(menu, rows);
}

QString pageOf(const QMainWindow& window) {
  QString mouse;
  for (const MouseRow& row : mouseRows) {
    mouse += rowOf(QLatin1String(row.keys), QLatin1String(row.effect));
  }
  // The columns are about equally long: the longest section, that of View, has the right one.
  QString left = section(QStringLiteral("In a panel"), mouse), right;
  for (const QAction* top : window.menuBar()->actions()) {
    const bool isRight = plainText(*top) == QLatin1String("View") || plainText(*top) == QLatin1String("Help");
    (isRight ? right : left) += sectionOf(*top);
  }
  return QStringLiteral("<table width='100%'><tr><td width='50%'>%1</td><td width='50%'>%2</td></tr></table>")
      .arg(left, right);
}

}  // namespace

KeysPage::KeysPage(QMainWindow* window) : QDialog(window), window_(*window), page_(new QTextBrowser) {
  setObjectName(QStringLiteral("keysPage"));
  setWindowTitle(QStringLiteral("Keys"));
  resize(preferredPage.boundedTo(window->screen()->availableSize() * 0.9));
  page_->setAccessibleName(QStringLiteral("Keys by task"));
  page_->setFrameShape(QFrame::NoFrame);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(page_);
}

/// Escape closes the page, though it is the key of an action of the window.
bool KeysPage::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
    event->accept();
    return true;
  }
  return QDialog::event(event);
}

/// Actions may come and go.
void KeysPage::showEvent(QShowEvent* event) {
  page_->setHtml(pageOf(window_));
  QDialog::showEvent(event);
}

}  // namespace chainmail
