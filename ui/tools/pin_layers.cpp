#include "tools/pin_layers.h"

#include <algorithm>
#include <iterator>

#include "common/icons.h"
#include "common/text.h"
#include "document/edits.h"

namespace chainmail {
namespace {

// Largest number of elements for which the menu shows counts. In larger meshes, counting would delay the menu.
constexpr ElementId maxCounted = 100'000;

bool carries(const Mesh& mesh, const ObjectSide& side) {
  const auto end = mesh.axes.begin() + mesh.space_dimension;
  return std::find(mesh.axes.begin(), end, side.axis) != end;
}

}  // namespace

PinLayers::PinLayers(Document& document, QWidget* parent)
    : QObject(parent), document_(document), menu_(new QMenu(QStringLiteral("&Pin a layer"), parent)) {
  menu_->setObjectName(QStringLiteral("pinLayers"));
  menu_->setIcon(icon("pin"));
  menu_->setToolTipsVisible(true);
  for (const ObjectSide& side : object_sides) {
    add(&side);
  }
  menu_->addSeparator();
  add(nullptr);
  connect(menu_, &QMenu::aboutToShow, this, &PinLayers::count);
  connect(&document, &Document::meshChanged, this, &PinLayers::adapt);
  connect(&document, &Document::pinsChanged, this, &PinLayers::adapt);
  adapt();
}

void PinLayers::add(const ObjectSide* side) {
  QString name = side == nullptr ? QStringLiteral("boundary") : text(side->name) + QStringLiteral(" layer");
  QString capital = side == nullptr ? QStringLiteral("boundary") : text(side->name);
  capital[0] = capital[0].toUpper();
  auto* action = menu_->addAction(QString());
  action->setObjectName(QStringLiteral("pin") + capital);
  connect(action, &QAction::triggered, this, [this, side] { side == nullptr ? pinBoundary() : pin(*side); });
  choices_.push_back({side, std::move(name), action});
}

const ObjectSide& PinLayers::foot() const {
  const ObjectSide& bottom = *find_side("bottom");
  return carries(*document_.mesh(), bottom) ? bottom : *find_side("left");
}

void PinLayers::pin(const ObjectSide& side) { pin(elements(&side)); }
void PinLayers::pinBoundary() { pin(elements(nullptr)); }

/// Returns the unpinned elements of a side, or of the boundary if `side` is null.
std::vector<ElementId> PinLayers::elements(const ObjectSide* side) const {
  const auto all = side == nullptr ? boundary(*document_.mesh()) : layer(*document_.mesh(), *side);
  std::vector<ElementId> free;
  std::ranges::set_difference(all, document_.pins(), std::back_inserter(free));
  return free;
}

void PinLayers::pin(const std::vector<ElementId>& elements) { edits::setPinned(document_, elements, true); }

/// Hides the sides along axes that the scene does not have.
void PinLayers::adapt() {
  for (const Choice& one : choices_) {
    one.action->setVisible(one.side == nullptr || carries(*document_.mesh(), *one.side));
    show(one, std::nullopt);
  }
}

void PinLayers::count() {
  if (document_.mesh()->element_count() > maxCounted) {
    return;
  }
  for (const Choice& one : choices_) {
    if (one.action->isVisible()) {
      show(one, elements(one.side).size());
    }
  }
}

void PinLayers::show(const Choice& choice, std::optional<std::size_t> count) const {
  QString words = choice.name;
  words[0] = words[0].toUpper();
  words.insert(0, QLatin1Char('&'));
  if (choice.side != nullptr && choice.side->name == "back") {
    words = QStringLiteral("Bac&k layer");  // the bottom layer uses the key B
  } else if (choice.side == nullptr) {
    words = QStringLiteral("Bound&ary");
  }
  if (count) {
    words += QStringLiteral(" (%1)").arg(counted(*count, QStringLiteral("element")));
  }
  const bool some = count.value_or(1) > 0;
  choice.action->setText(words);
  choice.action->setEnabled(some);
  choice.action->setStatusTip(
      some ? QStringLiteral("Pins the elements of the %1 at their present positions, as one undo step").arg(choice.name)
           : QStringLiteral("All elements of the %1 are pinned already").arg(choice.name));
  choice.action->setToolTip(choice.action->statusTip());
}

}  // namespace chainmail
