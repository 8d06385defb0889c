#pragma once

#include <QDialog>
#include <QMainWindow>

class QTextBrowser;

namespace chainmail {

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
