#pragma once

#include <QAction>
#include <QObject>

class QMenu;
class QToolBar;

namespace chainmail {

class Colouring;
class Document;
class PanelArea;

/// What can be done with the panels as such, as named actions: which are shown, where, with whose ghost, and which one
/// the others are compared with.
class PanelActions : public QObject {
  Q_OBJECT

 public:
  PanelActions(PanelArea& area, Document& document, Colouring& colouring);

  void fill(QMenu& menu);
  /// Adds the choice of the panel to compare with, which is there when it makes a difference.
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
  QAction* compared_;  // says with whom, in the tool bar
  QAction* add_;
  QAction* remove_;
  QAction* swap_;
  QAction* ghosts_;
  QList<QAction*> show_, alone_, reference_;  // by the panel
};

}  // namespace chainmail
