#include "tools/measure_tool.h"

#include "panels/view.h"

namespace chainmail {

QString MeasureTool::hint() const {
  return QStringLiteral(
      "Left: click one element, then another: their distance now and at rest (mesh units)  ·  Esc: clear");
}

void MeasureTool::hover(View& view, QPointF position) {
  const auto element = view.search().elementAt(position);
  document_.highlight().set({element, false, {}});
  if (busy()) {
    measurement_.lead(element);
  }
}

void MeasureTool::press(View& view, QPointF position, Qt::KeyboardModifiers /*modifiers*/) {
  const auto element = view.search().elementAt(position);
  if (!element) {
    measurement_.clear();
  } else if (!busy()) {
    measurement_.begin(*element);
  } else if (element != measurement_.from()) {
    measurement_.end(*element);
  }
}

/// Clears an incomplete measurement. A complete one stays while another tool drags the elements.
void MeasureTool::cancel() {
  if (busy()) {
    measurement_.clear();
  }
  document_.highlight().set({});
}

void MeasureTool::escape() {
  measurement_.clear();
  document_.highlight().set({});
}

}  // namespace chainmail
