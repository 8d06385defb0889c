#include "tools/pin_tool.h"

#include <QPushButton>
#include <algorithm>
#include <iterator>

#include "common/icons.h"
#include "common/text.h"
#include "document/edits.h"
#include "document/element_facts.h"
#include "panels/view.h"

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

QString PinTool::hint() const {
  return QStringLiteral("Left: pin or unpin an element  ·  Object > Unpin all  ·  Ctrl+Z: undo");
}

void PinTool::hover(View& view, QPointF position) {
  document_.highlight().set({view.search().elementAt(position), false, {}});
}

void PinTool::press(View& view, QPointF position, Qt::KeyboardModifiers /*modifiers*/) {
  if (const auto element = view.search().elementAt(position)) {
    edits::setPinned(document_, {*element}, !isPinned(document_, *element));
  }
}

}  // namespace chainmail
