#include "tools/measure_tool.h"

#include "panels/view.h"

namespace chainmail {

QString MeasureTool::hint() const {
  return QStringLiteral(
      "Left: click one element, then another: their distance now and at rest (mesh units)  ·  Esc: clear");
}

void MeasureTool::hover(View& view, QPointF place) {
  const auto element = view.elementAt(place);
  document_.setHighlight({element, false, {}});
  if (busy()) {
    measurement_.lead(element);
  }
}

void MeasureTool::press(View& view, QPointF place, Qt::KeyboardModifiers /*modifiers*/) {
  const auto element = view.elementAt(place);
  if (!element) {
    measurement_.clear();
  } else if (!busy()) {
    measurement_.begin(*element);
  } else if (element != measurement_.from()) {
    measurement_.end(*element);
  }
}

/// A measured distance stays while another tool drags the elements.
void MeasureTool::cancel() {
  if (busy()) {
    measurement_.clear();
  }
  document_.setHighlight({});
}

void MeasureTool::escape() {
  measurement_.clear();
  document_.setHighlight({});
}

}  // namespace chainmail
