#pragma once

#include <QAction>
#include <QDockWidget>

#include "document/document.h"

class QWidget;

namespace chainmail {

/// Undo and redo, for the menu and the tool bar; they end what the hand is at before.
class UndoActions : public QObject {
  Q_OBJECT

 public:
  UndoActions(Document& document, QObject& parent);

  /// Adds both to a menu or a tool bar.
  void fill(QWidget& place) { place.addActions({undo_, redo_}); }

 private:
  QAction* undo_;
  QAction* redo_;
};

/// The undo list: every step by its name; a click goes there.
class HistoryDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit HistoryDock(Document& document);
};

}  // namespace chainmail
