#include "tools/grab_brush.h"

#include <QCoreApplication>
#include <QKeyEvent>
#include <cmath>

namespace chainmail {
namespace {

// The first notch changes the radius by about 4 pixels, later ones by more.
constexpr double firstNotch = 4, growthPerNotch = 0.25;  // pixels

double radiusAfter(double notches) { return notches * (firstNotch + growthPerNotch * notches); }

/// Returns the number of notches that lead to a radius.
double notchesOf(double radius) {
  return (std::sqrt(firstNotch * firstNotch + 4 * growthPerNotch * radius) - firstNotch) / (2 * growthPerNotch);
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

}  // namespace chainmail
