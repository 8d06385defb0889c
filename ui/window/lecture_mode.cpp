#include "window/lecture_mode.h"

#include <QDockWidget>
#include <QMenu>
#include <QMenuBar>
#include <QStatusBar>
#include <QToolBar>
#include <algorithm>

#include "common/theme.h"
#include "document/propagation.h"
#include "panels/panel_area.h"
#include "window/docks.h"
#include "window/main_window.h"

namespace chainmail {
namespace {

constexpr double largeTexts = 1.6;  // times the usual size
constexpr int leastLetters = 24;    // pixels, which the last row of a lecture hall can read

/// Adds the actions of menus and their submenus to a list.
void collect(const QList<QAction*>& actions, QList<QAction*>& all) {
  for (QAction* action : actions) {
    if (action->menu() != nullptr) {
      collect(action->menu()->actions(), all);
    } else if (!action->isSeparator()) {
      all << action;
    }
  }
}

}  // namespace

LectureMode::LectureMode(MainWindow& window, Propagation& propagation, QActionGroup& tools)
    : QObject(&window),
      window_(window),
      area_(window.area()),
      propagation_(propagation),
      tools_(tools),
      tool_(new QLabel),
      action_(new QAction(QStringLiteral("Lecture mode"), this)) {
  action_->setObjectName(QStringLiteral("lectureMode"));
  action_->setCheckable(true);
  action_->setShortcut(Qt::Key_F11);
  action_->setStatusTip(
      QStringLiteral("Shows only the panels and the lesson, on the whole screen, with large texts and a ring at the "
                     "cursor"));
  tool_->setTextFormat(Qt::RichText);
  tool_->setObjectName(QStringLiteral("lectureTool"));
  tool_->hide();
  window.statusBar()->addPermanentWidget(tool_);
  connect(&tools, &QActionGroup::triggered, this, &LectureMode::nameTool);
  connect(action_, &QAction::toggled, this, [this](bool on) { on ? enter() : restore(); });
  connect(&area_, &PanelArea::arranged, this, [this] {  // also after a panel was added
    if (isOn()) {
      enlargeIcons();
    }
  });
}

void LectureMode::enter() {
  before_ = window_.docks().layout();
  propagation_.setHeld(propagation_.isShown());
  for (auto* dock : window_.findChildren<QDockWidget*>()) {
    dock->hide();
  }
  for (auto* bar : window_.findChildren<QToolBar*>(Qt::FindDirectChildrenOnly)) {
    bar->hide();
  }
  nameTool();
  tool_->show();
  area_.setLecture(true);
  hideMenus();
  enlargeTexts();
  enlargeIcons();
  window_.showFullScreen();
}

void LectureMode::enlargeTexts() {
  font_ = window_.testAttribute(Qt::WA_SetFont) ? window_.font() : QFont();
  QFont large = window_.font();
  large.setPointSizeF(largeTexts * QApplication::font().pointSizeF());
  while (QFontInfo(large).pixelSize() < leastLetters) {
    large.setPointSizeF(large.pointSizeF() + 0.5);
  }
  window_.setFont(large);
}

/// Enlarges the icons of all buttons that have usual ones.
void LectureMode::enlargeIcons() {
  for (auto* button : window_.findChildren<QAbstractButton*>()) {
    const auto isThis = [button](const auto& one) { return one.first == button; };
    if (std::ranges::none_of(icons_, isThis)) {
      icons_.emplace_back(button, button->iconSize());
      button->setIconSize(button->iconSize() * textScale(window_));
    }
  }
}

void LectureMode::shrink() {
  window_.setFont(font_);
  for (const auto& [button, size] : std::exchange(icons_, {})) {
    if (button != nullptr) {
      button->setIconSize(size);
    }
  }
}

/// Hides the menus. The keys of an action work only while a widget that has it is visible, so the window takes them.
void LectureMode::hideMenus() {
  QList<QAction*> all;
  collect(window_.menuBar()->actions(), all);
  for (QAction* action : all) {
    if (!window_.actions().contains(action)) {
      window_.addAction(action);
      lent_.emplace_back(action);
    }
  }
  hadMenus_ = !window_.menuBar()->isHidden();
  window_.menuBar()->hide();
}

void LectureMode::showMenus() {
  for (const QPointer<QAction>& action : std::exchange(lent_, {})) {
    if (action != nullptr) {
      window_.removeAction(action);
    }
  }
  window_.menuBar()->setVisible(hadMenus_);
}

void LectureMode::restore() {
  shrink();  // first: large texts would make the docks and the window larger
  showMenus();
  window_.showNormal();
  if (before_.maximized) {
    window_.showMaximized();
  } else {
    window_.setGeometry(before_.window);
  }
  tool_->hide();
  for (auto* bar : window_.findChildren<QToolBar*>(Qt::FindDirectChildrenOnly)) {
    bar->setVisible(before_.toolBar);
  }
  window_.docks().apply(before_);
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
