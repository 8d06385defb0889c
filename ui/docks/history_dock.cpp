#include "docks/history_dock.h"

#include <QUndoView>

#include "document/document.h"

namespace chainmail {

HistoryDock::HistoryDock(Document& document) {
  auto* list = new QUndoView(&document.undoStack());
  list->setObjectName(QStringLiteral("undoList"));
  list->setAccessibleName(QStringLiteral("Undo list"));
  list->setEmptyLabel(QStringLiteral("initial state"));
  list->setToolTip(QStringLiteral("All steps, the newest last. Click a step to go back to the state after it"));
  setWidget(list);
}

}  // namespace chainmail
