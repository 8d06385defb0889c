#include "window/undo_actions.h"

#include <QUndoView>
#include <QWidget>

#include "common/icons.h"

namespace chainmail {
namespace {

void follow(QAction& action, const QString& verb, const QString& step) {
  action.setText(step.isEmpty() ? QStringLiteral("&%1").arg(verb) : QStringLiteral("&%1 %2").arg(verb, step));
  // The names of the steps stand in the tool tips: the bar does not change its width with them.
  action.setIconText(verb);
  action.setToolTip(step.isEmpty() ? verb : QStringLiteral("%1: %2").arg(verb, step));
}

QAction* makeAction(QObject& parent, const QString& verb, const char* name, QKeySequence::StandardKey key) {
  auto* action = new QAction(&parent);
  action->setObjectName(QLatin1String(name));
  action->setIcon(icon(name));
  action->setShortcut(key);
  action->setEnabled(false);
  follow(*action, verb, {});
  return action;
}

}  // namespace

UndoActions::UndoActions(Document& document, QObject& parent)
    : QObject(&parent),
      undo_(makeAction(parent, QStringLiteral("Undo"), "undo", QKeySequence::Undo)),
      redo_(makeAction(parent, QStringLiteral("Redo"), "redo", QKeySequence::Redo)) {
  undo_->setStatusTip(
      QStringLiteral("Takes the last step back: every element, cut, pin and parameter as it was before"));
  redo_->setStatusTip(QStringLiteral("Does again what was undone last"));
  const QUndoStack& stack = document.undoStack();
  connect(&stack, &QUndoStack::canUndoChanged, undo_, &QAction::setEnabled);
  connect(&stack, &QUndoStack::canRedoChanged, redo_, &QAction::setEnabled);
  connect(&stack, &QUndoStack::undoTextChanged, undo_,
          [this](const QString& step) { follow(*undo_, QStringLiteral("Undo"), step); });
  connect(&stack, &QUndoStack::redoTextChanged, redo_,
          [this](const QString& step) { follow(*redo_, QStringLiteral("Redo"), step); });
  connect(undo_, &QAction::triggered, &document, &Document::undo);
  connect(redo_, &QAction::triggered, &document, &Document::redo);
}

HistoryDock::HistoryDock(Document& document) : QDockWidget(QStringLiteral("Undo list")) {
  setObjectName(QStringLiteral("historyDock"));
  auto* list = new QUndoView(&document.undoStack());
  list->setObjectName(QStringLiteral("undoList"));
  list->setAccessibleName(QStringLiteral("Undo list"));
  list->setEmptyLabel(QStringLiteral("as it was at first"));
  list->setToolTip(QStringLiteral("Every step, the newest last; a click brings the object to where it was after it"));
  setWidget(list);
}

}  // namespace chainmail
