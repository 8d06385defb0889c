// The mouse in a view: the left button is the tool's, the others move the camera.

#include <QMouseEvent>
#include <QWheelEvent>
#include <cmath>

#include "panels/view.h"

namespace chainmail {
namespace {

constexpr double zoomPerNotch = 1.2;

}  // namespace

void View::mousePressEvent(QMouseEvent* event) {
  links_.point(panel_);
  cursor_ = event->position();
  if (event->button() == Qt::LeftButton && tool_ != nullptr) {
    hover_.stop();
    tool_->press(*this, cursor_, event->modifiers());
  }
}

void View::mouseMoveEvent(QMouseEvent* event) {
  links_.point(panel_);
  const QPointF travel = event->position() - cursor_;
  cursor_ = event->position();
  if (event->buttons() == Qt::NoButton) {
    if (!hover_.isActive()) {
      hover_.start();
    }
  } else if ((event->buttons() & Qt::LeftButton) != 0) {
    if (tool_ != nullptr) {
      tool_->move(*this, cursor_);
    }
  } else {
    moveCamera(travel, event->buttons());
  }
}

void View::moveCamera(QPointF travel, Qt::MouseButtons buttons) {
  if ((buttons & Qt::RightButton) != 0 && camera_->spatial()) {
    orbit(travel);
  } else {
    pan(travel);
  }
}

/// The second press of a double click: what was pressed on comes into the middle, and no hand takes hold of it.
void View::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || (tool_ != nullptr && tool_->clicks())) {
    mousePressEvent(event);
    return;
  }
  cursor_ = event->position();
  const auto element = elementAt(cursor_);
  camera_->centreOn(element ? asVector(position(*element)) : camera_->pointAt(cursor_, camera_->centre(), size()));
  announceCamera();
}

void View::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && tool_ != nullptr) {
    tool_->release(*this, event->position());
  }
}

void View::leaveEvent(QEvent* event) {
  QOpenGLWidget::leaveEvent(event);
  hover_.stop();
  if (tool_ != nullptr) {
    tool_->leave(*this);
  }
  if (!document_.highlight().grabbed && document_.highlight().links.empty()) {
    document_.setHighlight({});
  }
}

void View::wheelEvent(QWheelEvent* event) {
  zoom(std::pow(zoomPerNotch, event->angleDelta().y() / 120.0), event->position());
}

}  // namespace chainmail
