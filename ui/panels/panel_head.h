#pragma once

#include <QComboBox>
#include <QLabel>
#include <QWidget>

#include "document/document.h"

class QHBoxLayout;
class QToolButton;

namespace chainmail {

class View;

/// What stands above a panel's view: its colour and letter, the algorithm's selector, what state the object is in, and
/// the buttons that arrange the panel. A double-click beside them shows the panel alone, or all again.
class PanelHead : public QWidget {
  Q_OBJECT

 public:
  PanelHead(Document& document, View& view, int panel);

  QComboBox& selector() { return *selector_; }
  void showState(const QString& state);
  /// Whether its panel is shown alone.
  void showAlone(bool alone);
  /// Buttons for actions; they are there as long as the actions are enabled, where they are shown here.
  void setActions(const QList<QAction*>& actions);
  void showActions(bool shown);

 signals:
  void aloneToggled();

 protected:
  void mouseDoubleClickEvent(QMouseEvent* event) override;

 private:
  void fillSelector();
  void showAlgorithm();
  void arrange(View& view);
  QToolButton* makeAloneButton();

  Document& document_;
  int panel_;
  QComboBox* selector_;
  QLabel* state_;
  QToolButton* alone_;
  QHBoxLayout* row_;
  QList<QToolButton*> buttons_;
  bool actionsShown_ = false;
};

}  // namespace chainmail
