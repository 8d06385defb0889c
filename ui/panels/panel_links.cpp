#include "panels/panel_links.h"

#include "panels/colouring.h"

namespace chainmail {

PanelLinks::PanelLinks(Colouring& colouring, QObject* parent)
    : QObject(parent),
      cameras_(makeSwitch("linkCameras", QStringLiteral("&Link cameras"), QStringLiteral("Cameras"), Qt::Key_L,
                          QStringLiteral("Shows the object from the same side in all panels"))),
      colours_(makeSwitch(
          "linkColours", QStringLiteral("Lin&k colour range"), QStringLiteral("Colours"), Qt::SHIFT | Qt::Key_L,
          QStringLiteral("Uses one colour scale for all panels, so that a colour means the same value in "
                         "each; off: each panel shows its own range"))),
      marks_(
          makeSwitch("linkMarks", QStringLiteral("Link &highlight"), QStringLiteral("Highlight"), Qt::CTRL | Qt::Key_L,
                     QStringLiteral("Marks the element under the cursor and the selection in all panels; off: only in "
                                    "the panel under the cursor"))) {
  connect(cameras_, &QAction::toggled, this, &PanelLinks::camerasLinked);
  connect(colours_, &QAction::toggled, &colouring, &Colouring::setSharesScale);
  connect(marks_, &QAction::toggled, this, &PanelLinks::marksLinked);
}

QAction* PanelLinks::makeSwitch(const char* name, const QString& text, const QString& iconText, const QKeySequence& key,
                                const QString& statusTip) {
  auto* action = new QAction(text, this);
  action->setObjectName(QLatin1String(name));
  action->setIconText(iconText);
  action->setCheckable(true);
  action->setChecked(true);
  action->setShortcut(key);
  action->setStatusTip(statusTip);
  action->setToolTip(QStringLiteral("%1 (%2)").arg(statusTip, key.toString(QKeySequence::NativeText)));
  return action;
}

}  // namespace chainmail
