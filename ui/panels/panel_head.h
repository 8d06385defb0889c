#pragma once

#include <QComboBox>
#include <QLabel>
#include <QMenu>
#include <QToolButton>
#include <QWidget>

#include "document/document.h"

class QHBoxLayout;

namespace chainmail {

class View;

/// Chooses the panel whose object is drawn as a ghost over a panel's own object, and how the two are blended.
class GhostButton : public QToolButton {
  Q_OBJECT

 public:
  GhostButton(Document& document, View& view, int panel);

 private:
  void fill();
  void addChoice(const QString& text, std::optional<int> of);
  void addBlend();

  Document& document_;
  View& view_;
  int panel_;
  QMenu* menu_;
};

/// The line above a panel's view: colour and letter, the algorithm selector, the state of the object, and the buttons
/// that arrange the panel. A double-click next to them shows only this panel, or all panels again.
class PanelHead : public QWidget {
  Q_OBJECT

 public:
  PanelHead(Document& document, View& view, int panel);

  QComboBox& selector() { return *selector_; }
  /// Shows as many states, from the first on, as there is room for.
  void showStates(const QStringList& states);
  /// Shows on the button whether the panel is shown alone.
  void showAlone(bool alone);
  /// Adds buttons for actions. A button is visible if its action is enabled and `showActions` was called with it.
  void setActions(const QList<QAction*>& actions);
  void showActions(const QList<QAction*>& shown);

 signals:
  void aloneToggled();
  /// The states for which there is no room have changed.
  void leftOver(const QStringList& states);
  /// The user wants to pin the bottom, because the algorithm has no solution without pins.
  void pinWanted();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void changeEvent(QEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;

 private:
  void fillSelector();
  void fitStates();
  void fitList();
  void fitSwatch();
  void showAlgorithm();
  void arrange(View& view);
  QToolButton* makeAloneButton();
  void followPins();

  Document& document_;
  int panel_;
  QComboBox* selector_;
  QLabel* swatch_;
  QLabel* state_;
  QStringList states_;
  QToolButton* alone_;
  QToolButton* pin_;
  QHBoxLayout* row_;
  QList<QToolButton*> buttons_;
  QList<QAction*> shownActions_;
};

}  // namespace chainmail
