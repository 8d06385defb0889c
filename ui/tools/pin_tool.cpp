#include "tools/pin_tool.h"

#include <QPushButton>
#include <algorithm>
#include <iterator>

#include "common/actions.h"
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

PinLayers::PinLayers(Document& document, QObject* parent) : QObject(parent), document_(document) {
  for (const auto signal : {&Document::meshChanged, &Document::pinsChanged}) {
    connect(&document, signal, this, [this] { counts_.clear(); });
  }
}

void PinLayers::fill(Actions& actions) {
  std::vector<ActionRow> rows;
  rows.reserve(std::size(object_sides) + 2);
  for (const ObjectSide& side : object_sides) {
    rows.push_back(rowOf(&side));
  }
  rows.emplace_back();
  rows.push_back(rowOf(nullptr));
  actions.add("Object", {{"pinLayers", "&Pin a layer", "pin"}});
  actions.add("pinLayers", rows);
  connect(&actions.menu("pinLayers"), &QMenu::aboutToShow, &actions, [this, &actions] {
    count();
    actions.refresh();
  });
}

/// Returns the row of a side, or of the boundary if `side` is null. The sides along axes that the scene does not have
/// are hidden.
ActionRow PinLayers::rowOf(const ObjectSide* side) {
  const QString name = side == nullptr ? QStringLiteral("boundary") : text(side->name);
  const QString layer = side == nullptr ? name : name + " layer";
  QString words = side == nullptr ? "Bound&ary" : "&" + layer.left(1).toUpper() + layer.mid(1);
  if (name == "back") {
    words = "Bac&k layer";  // the bottom layer uses the key B
  }
  return {"pin" + name.left(1).toUpper() + name.mid(1),
          words,
          "",
          "",
          QStringLiteral("Pins the elements of the %1 at their present positions, as one undo step").arg(layer),
          [this, side] { pin(side); },
          When([this, side, layer] {
            return counts_.contains(side) && counts_[side] == 0
                       ? QStringLiteral("All elements of the %1 are pinned already").arg(layer)
                       : QString();
          }),
          Appears([this, side, words] {
            const auto some = counts_.contains(side)
                                  ? QStringLiteral(" (%1)").arg(counted(counts_[side], QStringLiteral("element")))
                                  : QString();
            return Appearance{.text = words + some, .visible = exists(side)};
          })};
}

bool PinLayers::exists(const ObjectSide* side) const { return side == nullptr || carries(*document_.mesh(), *side); }

const ObjectSide& PinLayers::foot() const {
  const ObjectSide& bottom = *find_side("bottom");
  return carries(*document_.mesh(), bottom) ? bottom : *find_side("left");
}

void PinLayers::pin(const ObjectSide* side) { edits::setPinned(document_, elements(side), true); }

/// Returns the unpinned elements of a side, or of the boundary if `side` is null.
std::vector<ElementId> PinLayers::elements(const ObjectSide* side) const {
  const auto all = side == nullptr ? boundary(*document_.mesh()) : layer(*document_.mesh(), *side);
  std::vector<ElementId> free;
  std::ranges::set_difference(all, document_.pins(), std::back_inserter(free));
  return free;
}

/// Counts the elements that each row would pin.
void PinLayers::count() {
  counts_.clear();
  if (document_.mesh()->element_count() > maxCounted) {
    return;
  }
  counts_[nullptr] = elements(nullptr).size();
  for (const ObjectSide& side : object_sides) {
    if (exists(&side)) {
      counts_[&side] = elements(&side).size();
    }
  }
}

PinBar::PinBar(Document& document, PinLayers& layers)
    : AskBar(QStringLiteral("pins"), QStringLiteral("Pin &bottom layer"),
             QStringLiteral("Pins the bottom layer at its present positions, as one undo step")),
      document_(document),
      layers_(layers) {
  addChoices();
  connect(this, &AskBar::agreed, this, [this] { layers_.pin(&layers_.foot()); });
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
  connect(boundary, &QPushButton::clicked, this, [this] { layers_.pin(nullptr); });
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
