#include "tools/pin_tool.h"

#include "panels/view.h"

namespace chainmail {

QString PinTool::hint() const {
  return QStringLiteral("Left: pin or unpin an element  ·  Object > Unpin all  ·  Ctrl+Z: undo");
}

void PinTool::hover(View& view, QPointF place) { document_.setHighlight({view.elementAt(place), false, {}}); }

void PinTool::press(View& view, QPointF place, Qt::KeyboardModifiers /*modifiers*/) {
  if (const auto element = view.elementAt(place)) {
    document_.setPinned({*element}, !document_.isPinned(*element));
  }
}

}  // namespace chainmail
