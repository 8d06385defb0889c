#include "panels/colour_selector.h"

#include "common/text.h"

namespace chainmail {

ColourSelector::ColourSelector(Colouring& colouring) : colouring_(colouring), actions_(new QActionGroup(this)) {
  setObjectName(QStringLiteral("colourBy"));
  setAccessibleName(QStringLiteral("Colour by"));
  for (const ColourModeInfo& info : colourModes()) {
    addItem(text(info.label), int(info.mode));
    auto* action = actions_->addAction(text(info.label));
    action->setObjectName(QStringLiteral("colourBy-") + text(info.name));
    action->setCheckable(true);
    action->setStatusTip(
        info.title.empty() ? QStringLiteral("Draws each object in the colour of its panel")
                           : QStringLiteral("Colours the objects by: %1 (%2)").arg(text(info.title), text(info.unit)));
    connect(action, &QAction::triggered, this, [this, mode = info.mode] { colouring_.setMode(mode); });
  }
  connect(this, &QComboBox::activated, this, [this] {
    colouring_.setMode(ColourMode(currentData().toInt()));
    clearFocus();  // so that shortcuts work again
  });
  connect(&colouring, &Colouring::modeChanged, this, &ColourSelector::showMode);
  showMode();
}

void ColourSelector::showMode() {
  const int index = findData(int(colouring_.mode()));
  actions_->actions().at(index)->setChecked(true);
  // While nothing is selected, the box shows its placeholder.
  setPlaceholderText(overlay_.section(QStringLiteral(" ("), 0, 0));  // without the unit
  setCurrentIndex(overlay_.isEmpty() ? index : -1);
  setToolTip(overlay_.isEmpty()
                 ? QStringLiteral("The quantity that the colours of all panels show")
                 : QStringLiteral("%1: the colours of a dock that is open. When it is closed, they show: %2")
                       .arg(overlay_, text(info(colouring_.mode()).label)));
}

void ColourSelector::showOverlay(const QString& title) {
  overlay_ = title;
  showMode();
}

}  // namespace chainmail
