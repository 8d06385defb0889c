#include "docks/element_move.h"

#include <QDoubleValidator>
#include <QGridLayout>
#include <QHBoxLayout>
#include <algorithm>
#include <cmath>
#include <utility>

#include "document/element_facts.h"

namespace chainmail {
namespace {

constexpr int maxSteps = 1000;
constexpr int standardSteps = 10;
constexpr double maxDegrees = 3600;
constexpr int byDistance = 1;  // index of the choice

/// Returns the typed number; empty if it is not a number, or beyond the limit.
std::optional<double> numberIn(const QLineEdit& field, double limit) {
  bool valid = true;
  const double value = field.locale().toDouble(field.text(), &valid);
  return valid && std::abs(value) <= limit ? std::optional(value) : std::nullopt;
}

}  // namespace

SteppedDrag::SteppedDrag(Document& document) : document_(document) {
  connect(&document.solvers(), &PanelSolvers::becameIdle, this, &SteppedDrag::step);
  connect(&document.solvers(), &PanelSolvers::frameReady, this, [this](int panel) {
    shown_ = shown_ || panel == 0;
    step();
  });
  connect(&document.undoStack(), &QUndoStack::indexChanged, this, &SteppedDrag::stop);
}

void SteppedDrag::start(ElementId element, const Point& from, const Point& target, int steps) {
  begin({element}, steps);
  from_ = from;
  target_ = target;
  relative_ = false;
}

void SteppedDrag::start(const std::vector<ElementId>& elements, const Point& by, const Rotation& rotation, int steps) {
  begin(elements, steps);
  by_ = by;
  rotation_ = rotation;
  relative_ = true;
}

void SteppedDrag::begin(const std::vector<ElementId>& elements, int steps) {
  stop();
  steps_ = steps;
  done_ = 0;
  shown_ = false;
  // First, because it may end another drag, and the new undo step would stop this one.
  document_.handle().grab(elements);
  held_.assign(document_.handle().held().begin(), document_.handle().held().end());
  running_ = true;
  emit changed();
}

bool SteppedDrag::holds() const { return !held_.empty() && std::ranges::equal(document_.handle().held(), held_); }

void SteppedDrag::stop() {
  if (!std::exchange(running_, false)) {
    return;
  }
  if (holds()) {
    document_.handle().release();
  }
  emit changed();
}

/// Makes the next step when all solvers have done the last one and the first panel has shown it. So every step is
/// shown, and the frames set the pace.
void SteppedDrag::step() {
  if (!running_) {
    return;
  }
  if (!holds()) {
    stop();  // something else was grabbed
  } else if (shown_ && document_.solvers().idle()) {
    if (done_ == steps_) {
      stop();
      return;
    }
    ++done_;
    shown_ = false;
    drag();
    emit changed();
  }
}

void SteppedDrag::drag() {
  const bool last = done_ == steps_;
  if (relative_) {
    const double share = double(done_) / steps_;
    document_.handle().dragBy(last ? by_ : Point(by_ * share),
                              last ? rotation_ : Rotation{rotation_.axis, rotation_.degrees * share});
  } else {
    document_.handle().drag(last ? target_ : Point(from_ + (target_ - from_) * done_ / steps_));
  }
}

ElementMove::ElementMove(Document& document)
    : document_(document),
      drag_(document),
      how_(new QComboBox),
      turn_(new QLabel),
      axis_(new QComboBox),
      degrees_(numberField("moveDegrees", QStringLiteral("Angle of the rotation (degrees)"), maxDegrees)),
      steps_(new QSpinBox),
      go_(new QPushButton(QStringLiteral("&Move"))) {
  how_->setObjectName(QStringLiteral("moveHow"));
  how_->addItems({QStringLiteral("to (absolute)"), QStringLiteral("by (relative)")});
  how_->setAccessibleName(QStringLiteral("Meaning of the numbers"));
  how_->setToolTip(QStringLiteral("Moves to a position, or by a distance from the position in panel A"));
  axis_->setObjectName(QStringLiteral("moveAxis"));
  axis_->addItems({QStringLiteral("x"), QStringLiteral("y"), QStringLiteral("z")});
  axis_->setCurrentIndex(2);
  axis_->setAccessibleName(QStringLiteral("Axis of the rotation"));
  axis_->setToolTip(QStringLiteral("Axis of the rotation, through the middle of the elements"));
  degrees_->setToolTip(
      QStringLiteral("Angle of the rotation about the middle of the elements (degrees), counterclockwise as seen from "
                     "the positive end of the axis"));
  steps_->setObjectName(QStringLiteral("moveSteps"));
  steps_->setRange(1, maxSteps);
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

/// Returns a field for a number of at most `limit`. Enter presses the button.
QLineEdit* ElementMove::numberField(const char* name, const QString& accessible, double limit) {
  auto* field = new QLineEdit(QStringLiteral("0"));
  field->setObjectName(QLatin1String(name));
  field->setAccessibleName(accessible);
  auto* validator = new QDoubleValidator(-limit, limit, -1, field);
  validator->setNotation(QDoubleValidator::ScientificNotation);
  field->setValidator(validator);
  connect(field, &QLineEdit::textChanged, this, &ElementMove::adapt);
  connect(field, &QLineEdit::returnPressed, this, [this] { go_->click(); });
  return field;
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
    numbers_[k] = numberField(std::array{"moveX", "moveY", "moveZ"}[k],
                              QStringLiteral("Target, %1 (mesh units)").arg(axis), coordinate_limit);
    add(names_[k], numbers_[k]);
  }
  auto* rotation = new QHBoxLayout;
  rotation->addWidget(axis_);
  rotation->addWidget(degrees_, 1);
  const int row = grid->rowCount();
  turn_->setBuddy(degrees_);
  grid->addWidget(turn_, row, 0);
  grid->addLayout(rotation, row, 1);
  add(new QLabel(QStringLiteral("S&teps")), steps_);
  grid->addWidget(go_, grid->rowCount(), 0, 1, 2);
}

void ElementMove::setElements(const std::vector<ElementId>& elements) {
  if (elements != elements_) {
    drag_.stop();
    const bool hadMany = hasMany();
    elements_ = elements;
    showHow();
    if (elements.size() == 1 && !relative()) {
      const Point at = positionIn(document_, 0, elements.front());
      for (std::size_t k = 0; k < 3; ++k) {
        numbers_[k]->setText(figure(at[int(k)]));
      }
    } else if (hasMany() && !hadMany) {
      for (QLineEdit* field : {numbers_[0], numbers_[1], numbers_[2], degrees_}) {
        field->setText(QStringLiteral("0"));  // a distance, where a position may have been
      }
    }
  }
  adapt();
}

void ElementMove::adapt() {
  const Mesh& mesh = *document_.mesh();
  for (std::size_t k = 0; k < 3; ++k) {
    const bool exists = mesh.has_axis(int(k));
    names_[k]->setVisible(exists);
    numbers_[k]->setVisible(exists);
    numbers_[k]->setToolTip(relative() ? QStringLiteral("Distance along this axis (mesh units)")
                                       : QStringLiteral("Target position on this axis (mesh units)"));
  }
  showHow();
  how_->setToolTip(hasMany() ? QStringLiteral("Many elements move only by a distance")
                             : QStringLiteral("Moves to a position, or by a distance from the position in panel A"));
  adaptRotation();
  adaptButton();
}

/// Many elements only move by a distance. The choice for one element comes back with it.
void ElementMove::showHow() {
  const QSignalBlocker quiet(how_);
  if (hasMany() && how_->isEnabled()) {
    howForOne_ = how_->currentIndex();
    how_->setCurrentIndex(byDistance);
  } else if (!hasMany() && !how_->isEnabled()) {
    how_->setCurrentIndex(howForOne_);
  }
  how_->setEnabled(!hasMany());
}

/// Shows the rotation for many elements. In a plane, its only axis is the one across the plane.
void ElementMove::adaptRotation() {
  const Mesh& mesh = *document_.mesh();
  const bool shown = hasMany() && mesh.space_dimension > 1;
  turn_->setVisible(shown);
  degrees_->setVisible(shown);
  axis_->setVisible(shown && mesh.space_dimension == 3);
  turn_->setText(QStringLiteral("&Rotate (°)"));
  for (int k = 0; mesh.space_dimension == 2 && k < 3; ++k) {
    if (!mesh.has_axis(k)) {
      axis_->setCurrentIndex(k);
      turn_->setText(QStringLiteral("&Rotate about %1 (°)").arg(QLatin1Char("xyz"[k])));
    }
  }
}

void ElementMove::adaptButton() {
  go_->setText(drag_.running() ? QStringLiteral("&Stop at step %1 of %2").arg(drag_.stepsDone()).arg(drag_.steps())
                               : QStringLiteral("&Move"));
  const QString why = whyNot();
  go_->setEnabled(drag_.running() || why.isEmpty());
  go_->setToolTip(
      !why.isEmpty() ? why
      : hasMany()    ? QStringLiteral("Grabs the elements that are not pinned, moves them as one rigid body in steps "
                                         "and releases them, as one drag")
                  : QStringLiteral("Grabs the element, drags it to the target in steps and releases it, as one drag"));
}

/// Returns a sentence that says why the elements cannot move now; empty if they can.
QString ElementMove::whyNot() const {
  const bool pinned =
      std::ranges::all_of(elements_, [this](ElementId element) { return isPinned(document_, element); });
  return elements_.empty()  ? QStringLiteral("Select an element first")
         : pinned           ? hasMany() ? QStringLiteral("All selected elements are pinned: unpin some first")
                                        : QStringLiteral("This element is pinned: unpin it first")
                   : !typed() ? QStringLiteral("Type a number on each axis")
         : !typedRotation() ? QStringLiteral("Type an angle from −%L1 to %L1 degrees").arg(int(maxDegrees))
                            : QString();
}

std::optional<Point> ElementMove::typed() const {
  Point point = Point::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto number = numbers_[k]->isHidden() ? std::optional(0.0) : numberIn(*numbers_[k], coordinate_limit);
    if (!number) {
      return {};
    }
    point[int(k)] = *number;
  }
  return point;
}

std::optional<Rotation> ElementMove::typedRotation() const {
  if (degrees_->isHidden()) {
    return Rotation();
  }
  const auto degrees = numberIn(*degrees_, maxDegrees);
  return degrees ? std::optional(Rotation{Point::Unit(axis_->currentIndex()), *degrees}) : std::nullopt;
}

void ElementMove::go() {
  const auto numbers = typed();
  const auto rotation = typedRotation();
  if (elements_.empty() || !numbers || !rotation) {
    return;
  }
  if (hasMany()) {
    drag_.start(elements_, *numbers, *rotation, steps_->value());
    return;
  }
  const Point from = positionIn(document_, 0, elements_.front());
  drag_.start(elements_.front(), from, relative() ? Point(from + *numbers) : *numbers, steps_->value());
}

}  // namespace chainmail
