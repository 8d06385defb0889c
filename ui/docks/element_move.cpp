#include "docks/element_move.h"

#include <QDoubleValidator>
#include <QGridLayout>
#include <algorithm>

#include "document/element_facts.h"

namespace chainmail {
namespace {

constexpr int mostSteps = 1000;
constexpr int standardSteps = 10;

}  // namespace

ElementMove::ElementMove(Document& document)
    : document_(document),
      drag_(document),
      how_(new QComboBox),
      steps_(new QSpinBox),
      go_(new QPushButton(QStringLiteral("&Move"))) {
  how_->setObjectName(QStringLiteral("moveHow"));
  how_->addItems({QStringLiteral("to (absolute)"), QStringLiteral("by (relative)")});
  how_->setAccessibleName(QStringLiteral("Meaning of the numbers"));
  how_->setToolTip(QStringLiteral("Moves to a position, or by a distance from the position in panel A"));
  steps_->setObjectName(QStringLiteral("moveSteps"));
  steps_->setRange(1, mostSteps);
  steps_->setValue(standardSteps);
  steps_->setKeyboardTracking(false);
  steps_->setToolTip(QStringLiteral("Number of equal steps along a straight line; each is a pass in every panel"));
  go_->setObjectName(QStringLiteral("moveElement"));
  arrange();
  connect(go_, &QPushButton::clicked, this, [this] { drag_.running() ? drag_.stop() : go(); });
  connect(how_, &QComboBox::currentIndexChanged, this, &ElementMove::adapt);
  connect(&drag_, &SteppedDrag::changed, this, &ElementMove::adapt);
  connect(&document, &Document::meshChanged, this, &ElementMove::adapt);
  connect(&document, &Document::pinsChanged, this, &ElementMove::adapt);
  adapt();
}

void ElementMove::arrange() {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  const auto add = [grid](QLabel* label, QWidget* field) {
    const int row = grid->rowCount();
    label->setBuddy(field);
    grid->addWidget(label, row, 0);
    grid->addWidget(field, row, 1);
  };
  add(new QLabel(QStringLiteral("M&ove")), how_);
  for (std::size_t k = 0; k < 3; ++k) {
    const QChar axis = QLatin1Char("xyz"[k]);
    names_[k] = new QLabel(QStringLiteral("&%1").arg(axis));
    numbers_[k] = new QLineEdit(QStringLiteral("0"));
    numbers_[k]->setObjectName(QStringLiteral("move%1").arg(axis.toUpper()));
    numbers_[k]->setAccessibleName(QStringLiteral("Target, %1 (mesh units)").arg(axis));
    auto* validator = new QDoubleValidator(-coordinate_limit, coordinate_limit, -1, numbers_[k]);
    validator->setNotation(QDoubleValidator::ScientificNotation);
    numbers_[k]->setValidator(validator);
    connect(numbers_[k], &QLineEdit::textChanged, this, &ElementMove::adapt);
    connect(numbers_[k], &QLineEdit::returnPressed, go_, &QPushButton::click);
    add(names_[k], numbers_[k]);
  }
  add(new QLabel(QStringLiteral("S&teps")), steps_);
  grid->addWidget(go_, grid->rowCount(), 0, 1, 2);
}

void ElementMove::setElement(std::optional<ElementId> element) {
  if (element != element_) {
    drag_.stop();
    element_ = element;
    if (element && !relative()) {
      const Point at = positionIn(document_, 0, *element);
      for (std::size_t k = 0; k < 3; ++k) {
        numbers_[k]->setText(figure(at[int(k)]));
      }
    }
  }
  adapt();
}

void ElementMove::adapt() {
  const Mesh& mesh = *document_.mesh();
  const auto end = mesh.axes.begin() + mesh.space_dimension;
  for (std::size_t k = 0; k < 3; ++k) {
    const bool carried = std::find(mesh.axes.begin(), end, int(k)) != end;
    names_[k]->setVisible(carried);
    numbers_[k]->setVisible(carried);
    numbers_[k]->setToolTip(relative() ? QStringLiteral("Distance along this axis (mesh units)")
                                       : QStringLiteral("Target position on this axis (mesh units)"));
  }
  const bool pinned = element_ && document_.isPinned(*element_);
  go_->setText(drag_.running() ? QStringLiteral("&Stop at step %1 of %2").arg(drag_.stepsDone()).arg(drag_.steps())
                               : QStringLiteral("&Move"));
  go_->setEnabled(drag_.running() || (element_ && !pinned && typed()));
  go_->setToolTip(
      !element_  ? QStringLiteral("Select an element first")
      : pinned   ? QStringLiteral("This element is pinned: unpin it first")
      : !typed() ? QStringLiteral("Type a number on each axis")
                 : QStringLiteral("Grabs the element, drags it to the target in steps and releases it, as one drag"));
}

std::optional<Point> ElementMove::typed() const {
  Point point = Point::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    bool valid = true;
    const double value = numbers_[k]->isHidden() ? 0 : numbers_[k]->locale().toDouble(numbers_[k]->text(), &valid);
    if (!valid || !(std::abs(value) <= coordinate_limit)) {
      return {};
    }
    point[int(k)] = value;
  }
  return point;
}

void ElementMove::go() {
  const auto numbers = typed();
  if (!element_ || !numbers) {
    return;
  }
  const Point from = positionIn(document_, 0, *element_);
  drag_.start(*element_, from, relative() ? Point(from + *numbers) : *numbers, steps_->value());
}

}  // namespace chainmail
