#include "window/axis_views.h"

#include "common/icons.h"
#include "panels/panel.h"
#include "panels/panel_area.h"

namespace chainmail {
namespace {

struct LookedFrom {
  const char* name;
  const char* text;
  const char* from;
  QKeyCombination key;
  double yaw, pitch;  // degrees
};
// The axis that is looked along is the key, with Shift for the side that lies toward its lower end.
constexpr std::array sides{
    LookedFrom{"viewFront", "From the &front", "+z", Qt::Key_Z, 0, 0},
    LookedFrom{"viewBack", "From the &back", "−z", Qt::SHIFT | Qt::Key_Z, 180, 0},
    LookedFrom{"viewRight", "From the &right", "+x", Qt::Key_X, -90, 0},
    LookedFrom{"viewLeft", "From the &left", "−x", Qt::SHIFT | Qt::Key_X, 90, 0},
    LookedFrom{"viewTop", "From the &top", "+y", Qt::Key_Y, 0, 90},
    LookedFrom{"viewBottom", "From b&elow", "−y", Qt::SHIFT | Qt::Key_Y, 0, -90},
};

}  // namespace

AxisViews::AxisViews(QObject* owner, const Document& document, const PanelArea& area)
    : QObject(owner), document_(document), area_(area) {
  connect(&document, &Document::meshChanged, this, &AxisViews::adapt);
}

void AxisViews::fill(QMenu& menu) {
  auto* from = menu.addMenu(QStringLiteral("Look &from"));
  from->setIcon(icon("axes"));
  from->setToolTipsVisible(true);
  for (const LookedFrom& side : sides) {
    auto* action = from->addAction(QString::fromUtf8(side.text), this, [this, side] {
      for (Panel* panel : area_.panels()) {
        panel->view().lookFrom(side.yaw, side.pitch);
      }
    });
    action->setObjectName(QLatin1String(side.name));
    action->setShortcut(QKeySequence(side.key));
    action->setStatusTip(QStringLiteral("Every panel looks at the object from %1").arg(QString::fromUtf8(side.from)));
    actions_.push_back(action);
  }
  auto* parallel = menu.addAction(QStringLiteral("&Parallel rays, no perspective"));
  parallel->setObjectName(QStringLiteral("parallelRays"));
  parallel->setCheckable(true);
  parallel->setShortcut(Qt::SHIFT | Qt::Key_F);
  parallel->setStatusTip(QStringLiteral("Equal lengths look equal, however far away they are"));
  connect(parallel, &QAction::toggled, this, [this](bool on) {
    for (Panel* panel : area_.panels()) {
      panel->view().setParallel(on);
    }
  });
  actions_.push_back(parallel);
  adapt();
}

void AxisViews::adapt() {
  const bool spatial = document_.mesh()->space_dimension == 3;
  for (QAction* action : actions_) {
    action->setEnabled(spatial);
    action->setToolTip(spatial ? action->statusTip()
                               : QStringLiteral("This object has no depth: it is seen from the one side there is"));
  }
}

}  // namespace chainmail
