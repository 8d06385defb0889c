#include "window/panel_actions.h"

#include <QMenu>
#include <QToolBar>
#include <QToolButton>
#include <algorithm>

#include "common/icons.h"
#include "common/text.h"
#include "panels/panel_area.h"

namespace chainmail {

PanelActions::PanelActions(PanelArea& area, Document& document, Colouring& colouring)
    : QObject(&area),
      area_(area),
      document_(document),
      colouring_(colouring),
      compare_(new QMenu(QStringLiteral("Co&mpare with"), &area)),
      compared_(new QAction(this)),
      add_(add(QStringLiteral("addPanel"), QStringLiteral("&Add panel"), Qt::Key_N, {})),
      remove_(add(QStringLiteral("removePanel"), QStringLiteral("&Remove panel"), Qt::SHIFT | Qt::Key_N, {})),
      swap_(add(QStringLiteral("swapPanels"), QStringLiteral("S&wap panels"), Qt::Key_W,
                QStringLiteral("Moves each panel to the next position; two panels swap sides"))),
      ghosts_(add(QStringLiteral("ghosts"), QStringLiteral("&Ghosts"), Qt::Key_G,
                  QStringLiteral("Shows the next panel's object over each panel's own, transparent and in that panel's "
                                 "colour. The button above a panel chooses another"))) {
  add_->setIcon(icon("plus"));
  remove_->setIcon(icon("close"));
  swap_->setIcon(icon("swap"));
  ghosts_->setIcon(icon("overlay"));
  ghosts_->setCheckable(true);
  compare_->setObjectName(QStringLiteral("compareWith"));
  compare_->setToolTipsVisible(true);
  for (int panel = 0; panel < Document::maxPanels; ++panel) {
    makeOnes(panel);
  }
  refreshCount();
  area.setHeadActions({add_, remove_});
  listen();
  refresh();
}

void PanelActions::listen() {
  connect(add_, &QAction::triggered, &document_, &Document::addPanel);
  // Queued, because the panel deletes the button that was pressed.
  connect(remove_, &QAction::triggered, &document_, &Document::removePanel, Qt::QueuedConnection);
  connect(swap_, &QAction::triggered, &area_, &PanelArea::rotatePanels);
  connect(ghosts_, &QAction::triggered, &area_, &PanelArea::setGhosts);
  connect(&area_, &PanelArea::arranged, this, &PanelActions::refresh);
  connect(&area_, &PanelArea::ghostsChanged, this, &PanelActions::refresh);
  connect(&colouring_, &Colouring::modeChanged, this, &PanelActions::refresh);
}

QAction* PanelActions::add(const QString& name, const QString& text, const QKeySequence& key,
                           const QString& statusTip) {
  auto* action = new QAction(text, this);
  action->setObjectName(name);
  action->setShortcut(key);
  action->setStatusTip(statusTip);
  const QString keys = key.toString(QKeySequence::NativeText);
  action->setToolTip(keys.isEmpty() ? statusTip : QStringLiteral("%1 (%2)").arg(statusTip, keys));
  return action;
}

/// Makes the actions that exist for each panel.
void PanelActions::makeOnes(int panel) {
  const QString name = panelName(panel);
  const auto key = Qt::Key(Qt::Key_1 + panel);
  show_ << add(
      QStringLiteral("showPanel%1").arg(name), QStringLiteral("Show &%1").arg(name), Qt::CTRL | key,
      QStringLiteral("Shows panel %1. Hidden panels keep running. At least one panel stays visible").arg(name));
  connect(show_.last(), &QAction::triggered, this, [this, panel](bool shown) {
    area_.setShown(panel, shown);
    refresh();
  });
  reference_ << add(
      QStringLiteral("compareWith%1").arg(name), QStringLiteral("Panel &%1").arg(name), {},
      QStringLiteral("Compares all other panels with panel %1 in colours of distance and difference").arg(name));
  connect(reference_.last(), &QAction::triggered, this, [this, panel] {
    colouring_.setReference(panel);
    refresh();
  });
  compare_->addAction(reference_.last());
  makeOneAlone(panel);
  for (QAction* action : {show_.last(), alone_.last(), reference_.last()}) {
    action->setCheckable(true);
  }
}

void PanelActions::makeOneAlone(int panel) {
  const QString name = panelName(panel);
  alone_ << add(
      QStringLiteral("showAlone%1").arg(name), QStringLiteral("Show only %1").arg(name),
      Qt::ALT | Qt::Key(Qt::Key_1 + panel),
      QStringLiteral("Show only panel %1, or all panels (or double-click the header of the panel)").arg(name));
  connect(alone_.last(), &QAction::triggered, this,
          [this, panel](bool alone) { area_.setAlone(alone ? std::optional(panel) : std::nullopt); });
}

void PanelActions::fill(QMenu& menu) {
  menu.addActions(area_.links().actions());
  auto* panels = menu.addMenu(QStringLiteral("&Panels"));
  panels->addActions({add_, remove_, swap_, ghosts_});
  panels->addSeparator();
  panels->addActions(show_);
  panels->addSeparator();
  panels->addActions(alone_);
  menu.addMenu(compare_);
}

void PanelActions::fill(QToolBar& bar) {
  bar.addAction(compared_);
  auto* button = qobject_cast<QToolButton*>(bar.widgetForAction(compared_));
  button->setMenu(compare_);  // the action's own menu would give the View menu its text, too
  button->setPopupMode(QToolButton::InstantPopup);
}

/// Enables and disables the actions. The tool tip of a disabled action explains why.
void PanelActions::refreshCount() {
  const auto say = [](QAction* action, bool enabled, const QString& help) {
    action->setEnabled(enabled);
    action->setStatusTip(help);
    const QString keys = action->shortcut().toString(QKeySequence::NativeText);
    action->setToolTip(QStringLiteral("%1 (%2)").arg(help, keys));
  };
  const int count = document_.panels();
  const bool full = count == Document::maxPanels, least = count == Document::minPanels;
  say(add_, !full,
      full ? QStringLiteral("Not available: the window shows at most four panels")
           : QStringLiteral("Adds a panel with the object as in panel A and another algorithm"));
  say(remove_, !least,
      least ? QStringLiteral("Not available: the window keeps two panels. Hide one of them instead")
            : QStringLiteral("Removes panel %1 and its results").arg(panelName(count - 1)));
}

void PanelActions::refresh() {
  refreshCount();
  for (int panel = 0; panel < Document::maxPanels; ++panel) {
    refreshOnes(panel);
  }
  ghosts_->setChecked(area_.hasGhosts());
  compared_->setText(QStringLiteral("with %1").arg(panelName(colouring_.reference())));
  compared_->setToolTip(QStringLiteral("Panel that all others are compared with"));
  compared_->setVisible(comparesPanels(colouring_.mode()) && document_.panels() > 2);
}

void PanelActions::refreshOnes(int panel) {
  const auto seen = area_.inSight();
  const bool exists = panel < document_.panels();
  const bool isSeen = std::find(seen.begin(), seen.end(), panel) != seen.end();
  const bool compares = comparesPanels(colouring_.mode());
  for (QAction* action : {show_[panel], alone_[panel], reference_[panel]}) {
    action->setVisible(exists);
  }
  show_[panel]->setChecked(isSeen);
  show_[panel]->setEnabled(!isSeen || seen.size() > 1);  // the last visible panel stays
  alone_[panel]->setChecked(area_.alone() == panel);
  reference_[panel]->setChecked(colouring_.reference() == panel);
  reference_[panel]->setEnabled(compares);
  reference_[panel]->setToolTip(
      compares ? reference_[panel]->statusTip()
               : QStringLiteral("Not available: choose a distance or a difference in 'Colour by' first"));
}

}  // namespace chainmail
