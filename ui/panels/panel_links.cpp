#include "panels/panel_links.h"

#include <utility>

#include "common/actions.h"
#include "panels/colouring.h"

namespace chainmail {

void PanelLinks::fill(Actions& actions, Colouring& colouring) {
  actions.add(
      "View",
      {{"linkCameras", "&Link cameras|Cameras", "link", "L", "Shows the object from the same side in all panels",
        [this](bool on) { setCameras(on); }, IsOn([this] { return cameras_; })},
       {"linkColours", "Lin&k colour range|Colours", "colour", "Shift+L",
        "Uses one colour scale for all panels, so that a colour means the same value in each; off: each panel "
        "shows its own range",
        [&colouring](bool on) { colouring.setSharesScale(on); },
        IsOn([&colouring] { return colouring.sharesScale(); })},
       {"linkMarks", "Link &highlight|Highlight", "select", "Ctrl+L",
        "Marks the element under the cursor and the selection in all panels; off: only in the panel under the "
        "cursor",
        [this](bool on) {
          marks_ = on;
          emit marksLinked();
        },
        IsOn([this] { return marks_; })}});
  connect(this, &PanelLinks::camerasLinked, &actions, &Actions::refresh);
}

void PanelLinks::setCameras(bool linked) {
  if (std::exchange(cameras_, linked) != linked) {
    emit camerasLinked(linked);
  }
}

}  // namespace chainmail
