#include "common/dock_scroll.h"

#include <QEvent>
#include <QMainWindow>
#include <QScreen>
#include <QScrollBar>
#include <algorithm>

#include "common/number_field.h"

namespace chainmail {
namespace {

/// Minimum width of docks (pixels), so that figures that change do not move the panels.
constexpr int dockWidth = 230;

/// Returns the share of the screen's width that the content of a dock may ask for. The two columns with panels between
/// them, or three docks at the bottom beside the right column, fit on a screen of 1024 pixels.
double largestFraction(QWidget* dock) {
  const auto* window = dock != nullptr ? qobject_cast<const QMainWindow*>(dock->parentWidget()) : nullptr;
  const auto area = window != nullptr ? window->dockWidgetArea(qobject_cast<QDockWidget*>(dock)) : Qt::NoDockWidgetArea;
  return area == Qt::LeftDockWidgetArea ? 0.25 : area == Qt::RightDockWidgetArea ? 0.275 : 0.23;
}

}  // namespace

DockScroll::DockScroll(QWidget* content) {
  setWidget(content);
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  if (const auto vertical = content->sizePolicy().verticalPolicy(); (vertical & QSizePolicy::GrowFlag) == 0) {
    setSizePolicy(QSizePolicy::Expanding, vertical);
  }
  content->installEventFilter(this);
  fitWidth();
}

QSize DockScroll::sizeHint() const {
  const int bar = contentWidth() > minimumWidth() ? horizontalScrollBar()->sizeHint().height() : 0;
  return widget()->sizeHint() + QSize(0, bar);
}

QSize DockScroll::minimumSizeHint() const {
  const bool fixed = sizePolicy().verticalPolicy() == QSizePolicy::Fixed;
  return fixed ? QSize(QScrollArea::minimumSizeHint().width(), sizeHint().height())
               : QScrollArea::minimumSizeHint().boundedTo(sizeHint());
}

void DockScroll::showEvent(QShowEvent* event) {
  QScrollArea::showEvent(event);
  fitWidth();  // the dock may be in another area
}

/// Follows the content, whose size may change.
bool DockScroll::eventFilter(QObject* content, QEvent* event) {
  if (event->type() == QEvent::LayoutRequest) {
    fitWidth();
    updateGeometry();
  }
  return QScrollArea::eventFilter(content, event);
}

void DockScroll::fitWidth() {
  const int maxWidth = int(largestFraction(parentWidget()) * screen()->availableSize().width());
  setMinimumWidth(std::min(std::max(dockWidth, contentWidth()), maxWidth));
}

int DockScroll::contentWidth() const {
  return widget()->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width();
}

void setColumn(QDockWidget& dock, QVBoxLayout& column) {
  column.setSpacing(6);
  column.setContentsMargins(9, 4, 9, 4);
  column.addStretch();
  auto* content = new QWidget;
  content->setLayout(&column);
  dock.setWidget(new DockScroll(content));
}

}  // namespace chainmail
