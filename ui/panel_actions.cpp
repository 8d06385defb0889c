#include "panel_actions.h"

#include <QActionGroup>
#include <QMenu>
#include <algorithm>

#include "icons.h"
#include "panel_area.h"
#include "panel_names.h"

namespace chainmail {

PanelActions::PanelActions(PanelArea& area, Document& document, Colouring& colouring)
    : QObject(&area),
      area_(area),
      document_(document),
      colouring_(colouring),
      swap_(add(QStringLiteral("swapPanels"), QStringLiteral("S&wap places"), Qt::Key_W,
                QStringLiteral("Each panel takes the next one's place: two exchange sides, with all that is theirs"))),
      ghosts_(add(QStringLiteral("ghosts"), QStringLiteral("&Ghosts"), Qt::Key_G,
                  QStringLiteral("Lays the next panel's object over each panel's own, see-through and in that panel's "
                                 "colour; the button above a panel chooses another"))) {
  swap_->setIcon(icon("swap"));
  ghosts_->setIcon(icon("overlay"));
  ghosts_->setCheckable(true);
  connect(swap_, &QAction::triggered, &area, &PanelArea::moveOn);
  connect(ghosts_, &QAction::triggered, &area, &PanelArea::setGhosts);
  for (int panel = 0; panel < Document::panels; ++panel) {
    makeOnes(panel);
  }
  connect(&area, &PanelArea::arranged, this, &PanelActions::refresh);
  connect(&area, &PanelArea::ghostsChanged, this, &PanelActions::refresh);
  connect(&colouring, &Colouring::modeChanged, this, &PanelActions::refresh);
  refresh();
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

/// Those that every panel has one of.
void PanelActions::makeOnes(int panel) {
  const QString name = panelName(panel);
  const auto key = Qt::Key(Qt::Key_1 + panel);
  show_ << add(
      QStringLiteral("showPanel%1").arg(name), QStringLiteral("Show &%1").arg(name), Qt::CTRL | key,
      QStringLiteral("Panel %1 is on the screen; out of sight it goes on as the others do. One stays").arg(name));
  connect(show_.last(), &QAction::triggered, this, [this, panel](bool shown) {
    area_.setShown(panel, shown);
    refresh();
  });
  alone_ << add(QStringLiteral("showAlone%1").arg(name), QStringLiteral("%1 alone").arg(name), Qt::ALT | key,
                QStringLiteral("Panel %1 has all the room, or all are back (as a double-click on its head)").arg(name));
  connect(alone_.last(), &QAction::triggered, this,
          [this, panel](bool alone) { area_.setAlone(alone ? std::optional(panel) : std::nullopt); });
  reference_ << add(
      QStringLiteral("compareWith%1").arg(name), QStringLiteral("Panel &%1").arg(name), {},
      QStringLiteral("Colours of distance and difference compare all other panels with panel %1").arg(name));
  connect(reference_.last(), &QAction::triggered, this, [this, panel] {
    colouring_.setReference(panel);
    refresh();
  });
  for (QAction* action : {show_.last(), alone_.last(), reference_.last()}) {
    action->setCheckable(true);
  }
}

void PanelActions::fill(QMenu& menu) {
  menu.addActions(area_.links().actions());
  auto* panels = menu.addMenu(QStringLiteral("&Panels"));
  panels->addActions({swap_, ghosts_});
  panels->addSeparator();
  panels->addActions(show_);
  panels->addSeparator();
  panels->addActions(alone_);
  auto* compare = menu.addMenu(QStringLiteral("Co&mpare with"));
  compare->setObjectName(QStringLiteral("compareWith"));
  compare->setToolTipsVisible(true);
  compare->addActions(reference_);
}

void PanelActions::refresh() {
  const auto seen = area_.inSight();
  const bool compares = comparesPanels(colouring_.mode());
  for (int panel = 0; panel < Document::panels; ++panel) {
    const bool isSeen = std::find(seen.begin(), seen.end(), panel) != seen.end();
    show_[panel]->setChecked(isSeen);
    show_[panel]->setEnabled(!isSeen || seen.size() > 1);  // one stays, as its tip says
    alone_[panel]->setChecked(area_.alone() == panel);
    reference_[panel]->setChecked(colouring_.reference() == panel);
    reference_[panel]->setEnabled(compares);
    reference_[panel]->setToolTip(
        compares ? reference_[panel]->statusTip()
                 : QStringLiteral("Colours compare panels when they show a distance or a difference: see 'Colour by'"));
  }
  ghosts_->setChecked(area_.hasGhosts());
}

}  // namespace chainmail
