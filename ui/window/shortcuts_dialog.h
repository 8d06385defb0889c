#pragma once

#include <QDialog>
#include <QKeySequenceEdit>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTreeWidget>

#include "window/shortcuts.h"

namespace chainmail {

/// The list of all actions with their keys, with a search field and an editor for keys. It is not modal: changed keys
/// can be tried at once.
class ShortcutsDialog : public QDialog {
  Q_OBJECT

 public:
  ShortcutsDialog(Shortcuts& shortcuts, QWidget* parent);

 protected:
  void showEvent(QShowEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void makeList();
  QLayout* makeEditor();
  void fill();
  void filter();
  void showChosen();
  void take(const QKeyEvent& press);
  void showAnswer(const QString& sentence);
  QAction* chosen() const;

  Shortcuts& shortcuts_;
  QLineEdit* search_;
  QTreeWidget* list_;
  QLabel* whose_;
  QKeySequenceEdit* keys_;
  QPushButton* none_;
  QPushButton* reset_;
  QPushButton* resetAll_;
  QLabel* answer_;
};

}  // namespace chainmail
