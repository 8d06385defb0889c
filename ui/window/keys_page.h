#pragma once

#include <QAction>
#include <QDialog>
#include <QMainWindow>

class QTextBrowser;

namespace chainmail {

/// Returns the named actions of a window, each once: first those of the menus, in their order.
QList<QAction*> actionsOf(const QMainWindow& window);

/// Adds the keys and the effect of each action to its tool tip, which tool bar buttons show.
void showKeysInToolTips(const QMainWindow& window);

/// All keys of a window on one page, by task: those of its actions, and what the mouse does in a view.
class KeysPage : public QDialog {
  Q_OBJECT

 public:
  explicit KeysPage(QMainWindow* window);

 protected:
  bool event(QEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  const QMainWindow& window_;
  QTextBrowser* page_;
};

}  // namespace chainmail
