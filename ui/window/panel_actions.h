#pragma once

#include <QAction>
#include <QObject>

class QMenu;
class QToolBar;

namespace chainmail {

class Colouring;
class Document;
class PanelArea;

/// Actions on the panels: add, remove, show, hide and swap them, lay ghosts over them, and choose the panel that the
/// others are compared with.
class PanelActions : public QObject {
  Q_OBJECT

 public:
  PanelActions(PanelArea& area, Document& document, Colouring& colouring);

  void fill(QMenu& menu);
  /// Adds the choice of the panel to compare with. It is visible if there are more than two panels and the colours
  /// compare panels.
  void fill(QToolBar& bar);

 private:
  QAction* add(const QString& name, const QString& text, const QKeySequence& key, const QString& statusTip);
  void listen();
  void makeOnes(int panel);
  void makeOneAlone(int panel);
  void refresh();
  void refreshOnes(int panel);
  void refreshCount();

  PanelArea& area_;
  Document& document_;
  Colouring& colouring_;
  QMenu* compare_;
  QAction* compared_;  // tool bar button that shows the chosen panel
  QAction* add_;
  QAction* remove_;
  QAction* swap_;
  QAction* ghosts_;
  QList<QAction*> show_, alone_, reference_;  // one action per panel
};

}  // namespace chainmail
