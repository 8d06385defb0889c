// The keyboard in a view: a frame that says where the keys go.

#include <QFocusEvent>

#include "panels/view.h"

namespace chainmail {

/// A click needs no frame to say where it went.
void View::focusInEvent(QFocusEvent* event) {
  QOpenGLWidget::focusInEvent(event);
  framed_ = event->reason() == Qt::TabFocusReason || event->reason() == Qt::BacktabFocusReason ||
            event->reason() == Qt::ShortcutFocusReason;
  update();
}

void View::focusOutEvent(QFocusEvent* event) {
  QOpenGLWidget::focusOutEvent(event);
  framed_ = false;
  update();
}

void View::drawFocus() {
  if (framed_) {
    const QRectF inner = QRectF(rect()).adjusted(1, 1, -1, -1);
    const std::array corners{inner.topLeft(), inner.topRight(), inner.bottomRight(), inner.bottomLeft(),
                             inner.topLeft()};
    painter_.drawStroke(scene(devicePixelRatioF()), corners, colours::focus);
  }
}

}  // namespace chainmail
