#pragma once

#include <QAction>
#include <QObject>

class QMenu;

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

 private:
  QAction* add(const QString& name, const QString& text, const QKeySequence& key, const QString& statusTip);
  void makeOnes(int panel);
  void refresh();

  PanelArea& area_;
  Document& document_;
  Colouring& colouring_;
  QAction* swap_;
  QAction* ghosts_;
  QList<QAction*> show_, alone_, reference_;  // by the panel
};

}  // namespace chainmail
