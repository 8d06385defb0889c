#include "tools/pin_tool.h"

#include "panels/view.h"

namespace chainmail {

QString PinTool::hint() const {
  return QStringLiteral("Left: pin or unpin an element  ·  Object > Unpin all  ·  Ctrl+Z: undo");
}

void PinTool::hover(View& view, QPointF position) { document_.setHighlight({view.elementAt(position), false, {}}); }

void PinTool::press(View& view, QPointF position, Qt::KeyboardModifiers /*modifiers*/) {
  if (const auto element = view.elementAt(position)) {
    document_.setPinned({*element}, !document_.isPinned(*element));
  }
}

}  // namespace chainmail
