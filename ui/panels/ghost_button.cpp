#include "panels/ghost_button.h"

#include <QActionGroup>
#include <QGridLayout>
#include <QLabel>
#include <QSlider>
#include <QWidgetAction>
#include <cmath>

#include "common/icons.h"
#include "common/text.h"
#include "panels/view.h"

namespace chainmail {
namespace {

constexpr int blendSteps = 100;
constexpr int sliderWidth = 180;

}  // namespace

GhostButton::GhostButton(Document& document, View& view, int panel)
    : document_(document), view_(view), panel_(panel), menu_(new QMenu(this)) {
  setObjectName(QStringLiteral("ghostButton%1").arg(panel));
  setAccessibleName(QStringLiteral("Ghost in panel %1").arg(panelName(panel)));
  setToolTip(QStringLiteral("Shows another panel's object over this one, see-through and in that panel's colour"));
  setIcon(chainmail::icon("overlay"));
  setAutoRaise(true);
  setCheckable(true);
  setPopupMode(InstantPopup);
  menu_->setObjectName(QStringLiteral("ghostMenu%1").arg(panel));
  menu_->setToolTipsVisible(true);
  setMenu(menu_);
  connect(menu_, &QMenu::aboutToShow, this, &GhostButton::fill);
  connect(&view, &View::ghostChanged, this, [this] { setChecked(view_.ghost().of.has_value()); });
}

/// Fills the menu each time it opens, because panels and their algorithms change.
void GhostButton::fill() {
  menu_->clear();
  addChoice(QStringLiteral("No ghost"), std::nullopt);
  for (int other = 0; other < document_.panels(); ++other) {
    if (other != panel_) {
      const QString algorithm = chainmail::text(info(document_.algorithm(other)).label);
      addChoice(QStringLiteral("Panel &%1: %2").arg(panelName(other), algorithm), other);
    }
  }
  menu_->addSeparator();
  addBlend();
}

void GhostButton::addChoice(const QString& choice, std::optional<int> of) {
  auto* action = menu_->addAction(choice, this, [this, of] { view_.setGhost({of, view_.ghost().blend}); });
  action->setCheckable(true);
  action->setChecked(view_.ghost().of == of);
}

void GhostButton::addBlend() {
  auto* content = new QWidget;
  auto* grid = new QGridLayout(content);
  grid->setContentsMargins(10, 4, 10, 6);
  auto* slider = new QSlider(Qt::Horizontal);
  slider->setObjectName(QStringLiteral("ghostBlend%1").arg(panel_));
  slider->setAccessibleName(QStringLiteral("Blend between this panel's object and the ghost"));
  slider->setRange(0, blendSteps);
  slider->setValue(int(std::lround(view_.ghost().blend * blendSteps)));
  slider->setMinimumWidth(sliderWidth);
  slider->setEnabled(view_.ghost().of.has_value());
  slider->setToolTip(slider->isEnabled() ? QStringLiteral("Left: only this panel's object. Right: only the ghost")
                                         : QStringLiteral("There is no ghost yet: choose a panel above"));
  connect(slider, &QSlider::valueChanged, this, [this](int value) {
    view_.setGhost({view_.ghost().of, double(value) / blendSteps});
  });
  grid->addWidget(new QLabel(QStringLiteral("This panel")), 0, 0, Qt::AlignLeft);
  grid->addWidget(new QLabel(QStringLiteral("Ghost")), 0, 1, Qt::AlignRight);
  grid->addWidget(slider, 1, 0, 1, 2);
  auto* action = new QWidgetAction(menu_);
  action->setDefaultWidget(content);
  menu_->addAction(action);
}

}  // namespace chainmail
