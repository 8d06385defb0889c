#include "window/lecture_mode.h"

#include <QDockWidget>
#include <QLayout>
#include <QStatusBar>
#include <QToolBar>

#include "document/propagation.h"
#include "panels/panel_area.h"
#include "window/dock_layout.h"

namespace chainmail {

LectureMode::LectureMode(QMainWindow& window, PanelArea& area, Propagation& propagation, QActionGroup& tools,
                         QWidget& hints, int layoutVersion)
    : QObject(&window),
      window_(window),
      area_(area),
      propagation_(propagation),
      tools_(tools),
      tool_(new QLabel),
      hints_(hints),
      layoutVersion_(layoutVersion),
      action_(new QAction(QStringLiteral("Lecture mode"), this)) {
  action_->setObjectName(QStringLiteral("lectureMode"));
  action_->setCheckable(true);
  action_->setShortcut(Qt::Key_F11);
  action_->setStatusTip(
      QStringLiteral("Shows only the panels, on the whole screen, with large texts and a ring at the cursor"));
  tool_->setTextFormat(Qt::RichText);
  tool_->setObjectName(QStringLiteral("lectureTool"));
  tool_->hide();
  window.statusBar()->addPermanentWidget(tool_);
  connect(&tools, &QActionGroup::triggered, this, &LectureMode::nameTool);
  connect(action_, &QAction::toggled, this, [this](bool on) { on ? enter() : restore(); });
}

void LectureMode::enter() {
  layout_ = window_.saveState(layoutVersion_);
  places_ = dockLayout(window_);
  geometry_ = window_.saveGeometry();
  at_ = window_.geometry();
  propagation_.setHeld(propagation_.isShown());
  for (auto* dock : window_.findChildren<QDockWidget*>()) {
    dock->hide();
  }
  for (auto* bar : window_.findChildren<QToolBar*>(Qt::FindDirectChildrenOnly)) {
    bar->hide();
  }
  nameTool();
  tool_->show();
  hadHints_ = hints_.isVisible();
  hints_.hide();
  area_.setLecture(true);
  window_.showFullScreen();
}

void LectureMode::restore() {
  window_.showNormal();
  window_.restoreGeometry(geometry_);
  if (!window_.isMaximized()) {
    window_.setGeometry(at_);  // Qt 6.8 makes a window that fills the screen two pixels smaller
  }
  tool_->hide();
  // restoreState shows tabbed docks one by one. A layout that reacts at once removes some meanwhile, and Qt crashes.
  window_.layout()->setEnabled(false);
  window_.restoreState(layout_, layoutVersion_);
  window_.layout()->setEnabled(true);
  window_.layout()->activate();
  hints_.setVisible(hadHints_);
  propagation_.setHeld(false);
  area_.setLecture(false);
}

void LectureMode::nameTool() {
  const QAction* tool = tools_.checkedAction();
  tool_->setText(QStringLiteral("Tool: <b>%1</b>  ·  %2 ends the lecture mode")
                     .arg(tool != nullptr ? tool->text().remove(QLatin1Char('&')) : QString(),
                          action_->shortcut().toString(QKeySequence::NativeText).toHtmlEscaped()));
}

}  // namespace chainmail
