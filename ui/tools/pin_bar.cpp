#include "tools/pin_bar.h"

#include <QPushButton>

#include "common/text.h"
#include "document/element_facts.h"

namespace chainmail {

PinBar::PinBar(Document& document, PinLayers& layers)
    : AskBar(QStringLiteral("pins"), QStringLiteral("Pin &bottom layer"),
             QStringLiteral("Pins the bottom layer at its present positions, as one undo step")),
      document_(document),
      layers_(layers) {
  addChoices();
  connect(this, &AskBar::agreed, this, [this] { layers_.pin(layers_.foot()); });
  connect(&document, &Document::unpinned, this, &PinBar::await);
  // The end of a drag adds an undo step.
  connect(&document.undoStack(), &QUndoStack::indexChanged, this, &PinBar::offer);
  connect(&document, &Document::pinsChanged, this, &PinBar::follow);
  connect(&document, &Document::meshChanged, this, &PinBar::follow);
  connect(&document, &Document::algorithmChanged, this, &PinBar::follow);
  connect(&document, &Document::panelsChanged, this, &PinBar::follow);
}

void PinBar::addChoices() {
  const auto add = [this](const char* name, const QString& text, const QString& help) {
    auto* button = new QPushButton(text);
    button->setObjectName(QLatin1String(name));
    button->setToolTip(help);
    addAnswer(button);
    return button;
  };
  auto* boundary =
      add("pinsBoundary", QStringLiteral("Pin b&oundary"),
          QStringLiteral("Pins all elements on the boundary at their present positions, as one undo step"));
  auto* byHand = add("pinsByHand", QStringLiteral("Pin &single elements"),
                     QStringLiteral("Switches to the pin tool: click the elements to pin"));
  connect(boundary, &QPushButton::clicked, this, [this] { layers_.pinBoundary(); });
  connect(byHand, &QPushButton::clicked, this, [this] {
    hide();
    emit byHandChosen();
  });
  byHand_ = byHand;
}

/// Asks when the drag ends, because the bar must not move the panels during a drag.
void PinBar::await(int panel) {
  panel_ = panel;
  awaits_ = !asked_;
  offer();
}

void PinBar::offer() {
  if (!awaits_ || !document_.handle().held().empty() || panel_ >= document_.panels() || !lacksPins(document_, panel_)) {
    return;
  }
  awaits_ = false;
  asked_ = true;
  setAgree(QStringLiteral("Pin &%1 layer").arg(text(layers_.foot().name)));
  ask(QStringLiteral("Nothing pins this object, so %1 has no solution.")
          .arg(text(info(document_.algorithm(panel_)).label)),
      byHand_);
}

void PinBar::follow() {
  awaits_ = asked_ = false;
  hide();
}

}  // namespace chainmail
