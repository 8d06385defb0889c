#include "tools/drag_tool.h"

#include <QCoreApplication>
#include <QKeyEvent>
#include <QLineF>
#include <cmath>

#include "common/text.h"
#include "document/element_facts.h"
#include "panels/view.h"

namespace chainmail {
namespace {

// The first notch changes the radius by about 4 pixels, later ones by more.
constexpr double firstNotch = 4, growthPerNotch = 0.25;  // pixels

double radiusAfter(double notches) { return notches * (firstNotch + growthPerNotch * notches); }

/// Returns the number of notches that lead to a radius.
double notchesOf(double radius) {
  return (std::sqrt(firstNotch * firstNotch + 4 * growthPerNotch * radius) - firstNotch) / (2 * growthPerNotch);
}

constexpr int brushCorners = 64;
// Nearer to the pivot, a small move of the mouse would be a large angle: there it does not rotate.
constexpr double smallestArm = 12;  // pixels

Point pointOf(const QVector3D& at) { return {at.x(), at.y(), at.z()}; }

/// Returns the axis across the view, towards the eye. In a plane, it is exactly the axis that the mesh does not have.
Point axisToEye(const View& view, const Mesh& mesh) {
  if (mesh.space_dimension == 3) {
    return pointOf(view.camera()->toView().row(2).toVector3D()).normalized();
  }
  Point axis = Point::Zero();
  for (int k = 0; k < 3; ++k) {
    axis[k] = mesh.has_axis(k) ? 0 : 1;  // the camera looks at a plane from the positive side
  }
  return axis;
}

}  // namespace

GrabBrush::GrabBrush() { QCoreApplication::instance()->installEventFilter(this); }

GrabBrush::~GrabBrush() { QCoreApplication::instance()->removeEventFilter(this); }

int GrabBrush::radius() const { return int(std::lround(radiusAfter(notches_))); }

void GrabBrush::turn(double notches) { setNotches(notches_ + notches); }

void GrabBrush::setNotches(double notches) {
  notches = std::clamp(notches, 0.0, notchesOf(largestRadius));
  if (notches != notches_) {
    notches_ = notches;
    emit changed();
  }
}

void GrabBrush::setReached(std::size_t elements) {
  if (elements != reached_) {
    reached_ = elements;
    emit changed();
  }
}

/// Follows the key in the whole application, because the view under the cursor may not have the keyboard focus.
bool GrabBrush::eventFilter(QObject* /*watched*/, QEvent* event) {
  if (event->type() == QEvent::KeyPress || event->type() == QEvent::KeyRelease) {
    const auto& key = static_cast<const QKeyEvent&>(*event);
    if (key.key() == Qt::Key_R && !key.isAutoRepeat()) {
      keyHeld_ = event->type() == QEvent::KeyPress && key.modifiers() == Qt::NoModifier;
    }
  } else if (event->type() == QEvent::WindowDeactivate || event->type() == QEvent::ApplicationDeactivate) {
    keyHeld_ = false;  // the release goes to another window
  }
  return false;
}

QString DragTool::hint() const {
  if (brush_.radius() > 0) {
    return QStringLiteral(
               "Radius %1 px · %2  ·  Left: drag these elements as one body  ·  Shift: rotate  ·  R + wheel: radius  · "
               " "
               "Esc: one element")
        .arg(brush_.radius())
        .arg(counted(brush_.reached(), QStringLiteral("element")));
  }
  return QStringLiteral(
      "Left: drag an element or the selection  ·  Shift: rotate the selection  ·  R + wheel: brush  ·  Right: orbit "
      "(3D)  ·  Middle: pan  ·  Wheel: zoom  ·  F: fit");
}

// Hover: the rotation ring, the brush, and the element under the cursor

void DragTool::hover(View& view, QPointF position) {
  if (busy()) {
    cancel();  // no button is pressed: another widget, for example a dialog, received the release
  }
  const bool onRing = ring_.isAt(view, position);
  setRingHovered(onRing ? &view : nullptr);
  outline_.clear();
  if (!onRing && brush_.radius() > 0) {
    hoverBrush(view, position);
    prepare(std::nullopt);
  } else {
    const auto element = onRing ? std::nullopt : view.search().elementAt(position);
    document_.highlight().set({element, false, {}});
    prepare(element);
  }
}

/// Prepares the drag that a press would begin, if it would grab one element: a selection is grabbed as a whole.
void DragTool::prepare(std::optional<ElementId> element) {
  const auto& selected = document_.selection().elements();
  const bool ofSelection = element && selected.size() > 1 && std::ranges::binary_search(selected, *element);
  document_.solvers().prepare(ofSelection ? std::nullopt : element);
}

void DragTool::hoverBrush(View& view, QPointF position) {
  outline(view, position);
  Marks marks;
  std::ranges::set_difference(withinBrush(view, position), document_.pins(), std::back_inserter(marks.handle));
  brush_.setReached(marks.handle.size());
  document_.highlight().set(marks);
}

/// Draws the brush around a position.
void DragTool::outline(View& view, QPointF position) {
  brushAt_ = &view;
  outline_.clear();
  for (int i = 0; i <= brushCorners; ++i) {
    const double angle = 2 * M_PI * i / brushCorners;
    outline_.push_back(position + brush_.radius() * QPointF(std::cos(angle), std::sin(angle)));
  }
  view.update();
}

void DragTool::setRingHovered(View* view) {
  if (ringHovered_ && ringHovered_ != view) {
    ringHovered_->setCursor(cursor());
  }
  if (view != nullptr && ringHovered_ != view) {
    view->setCursor(Qt::OpenHandCursor);
  }
  ringHovered_ = view;
  ring_.setHovered(view != nullptr);
}

void DragTool::leave(View& view) {
  if (busy()) {
    return;
  }
  setRingHovered(nullptr);
  document_.solvers().prepare({});
  if (!outline_.empty()) {
    outline_.clear();
    view.update();
  }
}

std::span<const QPointF> DragTool::stroke(const View& view) const {
  return brushAt_ == &view ? std::span<const QPointF>(outline_) : std::span<const QPointF>();
}

bool DragTool::wheel(View& view, QPointF position, double notches) {
  if (!brush_.keyHeld()) {
    return false;
  }
  if (!busy()) {
    brush_.turn(notches);
    hover(view, position);
    view.update();
  }
  return true;
}

// Press: the elements of the handle

void DragTool::press(View& view, QPointF position, Qt::KeyboardModifiers /*modifiers*/) {
  if (ring_.isAt(view, position)) {
    grab(view, position, ring_.elements(), Grip::ring);
  } else if (const auto elements = elementsToGrab(view, position); !elements.empty()) {
    grab(view, position, elements, Grip::handle);
  }
}

std::vector<ElementId> DragTool::withinBrush(const View& view, QPointF position) const {
  const double radius = brush_.radius();
  const QRectF bounds(position.x() - radius, position.y() - radius, 2 * radius, 2 * radius);
  return view.search().elementsWhere(bounds, [=](QPointF at) { return QLineF(position, at).length() <= radius; });
}

std::vector<ElementId> DragTool::elementsToGrab(View& view, QPointF position) const {
  if (brush_.radius() > 0) {
    return withinBrush(view, position);
  }
  const auto element = view.search().elementAt(position);
  if (!element) {
    return {};
  }
  const auto& selected = document_.selection().elements();
  const bool ofSelection = selected.size() > 1 && std::ranges::binary_search(selected, *element);
  return ofSelection ? selected : std::vector{*element};
}

void DragTool::grab(View& view, QPointF position, const std::vector<ElementId>& elements, Grip grip) {
  document_.handle().grab(elements);
  const std::vector<ElementId> held(document_.handle().held().begin(), document_.handle().held().end());
  if (held.empty()) {
    return;  // all are pinned: the document refuses them, and a message gives the reason
  }
  const auto under = view.search().elementAt(position);
  motion_ = {};
  motion_.pivot = middleIn(document_, view.panel(), held);
  motion_.cursor = position;
  start_ = under && std::ranges::binary_search(held, *under) ? view.position(*under) : motion_.pivot;
  gripAt_ = view.pointAt(position, start_);
  grip_ = held.size() == 1 ? Grip::element : grip;
  if (grip_ == Grip::element) {
    start_ = view.position(held.front());
    gripAt_ = view.pointAt(position, start_);
    document_.highlight().set({held.front(), true, {}});
  } else {
    document_.highlight().set({std::nullopt, true, {}, held});
  }
  if (grip_ == Grip::ring) {
    setRingHovered(&view);
    view.setCursor(Qt::ClosedHandCursor);
  }
}

// Drag

void DragTool::move(View& view, QPointF position, Qt::KeyboardModifiers modifiers) {
  if (!busy()) {
    return;
  }
  if (grip_ == Grip::handle || grip_ == Grip::ring) {
    const bool shift = (modifiers & Qt::ShiftModifier) != 0;
    followCursor(view, position, grip_ == Grip::ring || (shift && RotationRing::canRotate(*document_.mesh())));
    document_.handle().drag(commands::Drag{motion_.by, motion_.rotation, true});
  } else {
    document_.handle().drag(commands::Drag{start_ + (view.pointAt(position, start_) - gripAt_)});
  }
}

/// Moves or rotates the handle with the cursor.
void DragTool::followCursor(View& view, QPointF position, bool turns) {
  if (turns != motion_.turns) {
    change(view, turns);
  }
  if (turns) {
    outline_.clear();
    turn(view, position);
    ring_.showRotation({document_.handle().held().begin(), document_.handle().held().end()}, view.panel(), position,
                       motion_.rotation.degrees);
  } else {
    motion_.by = motion_.byBefore + (view.pointAt(position, start_) - gripAt_);
    ring_.hideRotation();
    if (grip_ == Grip::handle && brush_.radius() > 0) {
      outline(view, position);
    }
  }
  motion_.cursor = position;
}

/// Changes between translation and rotation at the last position of the cursor, so that the handle does not jump.
void DragTool::change(const View& view, bool turns) {
  motion_.turns = turns;
  motion_.byBefore = motion_.by;
  gripAt_ = view.pointAt(motion_.cursor, start_);
  motion_.rotationBefore = motion_.rotation;
  motion_.axis = axisToEye(view, *document_.mesh());
  motion_.turned = 0;
  motion_.angle = angleAt(view, motion_.cursor);
}

/// Rotates the handle by the angle of the cursor about the pivot since the last position of the cursor.
void DragTool::turn(const View& view, QPointF position) {
  const auto angle = angleAt(view, position);
  if (angle && motion_.angle) {
    motion_.turned += std::remainder(*angle - *motion_.angle, 360);
    motion_.rotation = composed(motion_.rotationBefore, {motion_.axis, motion_.turned});
  }
  motion_.angle = angle;
}

/// Returns the angle of a position about the pivot (degrees), counterclockwise on the screen.
std::optional<double> DragTool::angleAt(const View& view, QPointF position) const {
  const QPointF arm = position - view.viewPosition(Point(motion_.pivot + motion_.by));
  if (std::hypot(arm.x(), arm.y()) < smallestArm) {
    return std::nullopt;
  }
  return std::atan2(-arm.y(), arm.x()) * 180 / M_PI;
}

void DragTool::release(View& view, QPointF /*position*/) {
  if (busy()) {
    cancel();
    view.hoverSoon();
  }
}

void DragTool::cancel() {
  if (busy()) {
    grip_ = Grip::nothing;
    document_.handle().release();
  }
  ring_.hideRotation();
  setRingHovered(nullptr);
  outline_.clear();
  document_.highlight().set({});
}

/// Cancels the drag and restores the object. Without a drag, makes the brush grab one element again; without a brush,
/// clears a selection of many.
void DragTool::escape() {
  if (busy()) {
    grip_ = Grip::nothing;
    document_.handle().cancel();
  } else if (brush_.radius() > 0) {
    brush_.setNotches(0);
  } else if (document_.selection().elements().size() > 1) {
    document_.selection().set({});
  }
  cancel();
}

}  // namespace chainmail
