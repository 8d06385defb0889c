#include "tools/pin_tool.h"

#include "document/edits.h"
#include "document/element_facts.h"
#include "panels/view.h"

namespace chainmail {

QString PinTool::hint() const {
  return QStringLiteral("Left: pin or unpin an element  ·  Object > Unpin all  ·  Ctrl+Z: undo");
}

void PinTool::hover(View& view, QPointF position) {
  document_.highlight().set({view.search().elementAt(position), false, {}});
}

void PinTool::press(View& view, QPointF position, Qt::KeyboardModifiers /*modifiers*/) {
  if (const auto element = view.search().elementAt(position)) {
    edits::setPinned(document_, {*element}, !isPinned(document_, *element));
  }
}

}  // namespace chainmail
