#include "window/lecture_mode.h"

#include <QDockWidget>
#include <QMenuBar>
#include <QStatusBar>
#include <QToolBar>
#include <algorithm>
#include <utility>

#include "common/actions.h"
#include "common/theme.h"
#include "document/propagation.h"
#include "panels/panel_area.h"
#include "window/docks.h"
#include "window/main_window.h"

namespace chainmail {
namespace {

constexpr double largeTexts = 1.6;  // times the usual size
constexpr int leastLetters = 24;    // pixels, which the last row of a lecture hall can read

}  // namespace

LectureMode::LectureMode(MainWindow& window, Propagation& propagation, Actions& actions)
    : QObject(&window),
      window_(window),
      area_(window.area()),
      propagation_(propagation),
      actions_(actions),
      tool_(new QLabel) {
  tool_->setTextFormat(Qt::RichText);
  tool_->setObjectName(QStringLiteral("lectureTool"));
  tool_->hide();
  window.statusBar()->addPermanentWidget(tool_);
  connect(&area_, &PanelArea::arranged, this, [this] {  // also after a panel was added
    if (isOn()) {
      enlargeIcons();
    }
  });
}

void LectureMode::fill() {
  actions_.add("View",
               {{"lectureMode", "Lecture mode", "", "F11",
                 "Shows only the panels and the lesson, on the whole screen, with large texts and a ring at the "
                 "cursor",
                 [this](bool on) { setOn(on); }, IsOn([this] { return isOn_; })}});
}

void LectureMode::setOn(bool on) {
  if (std::exchange(isOn_, on) != on) {
    on ? enter() : restore();
    actions_.refresh();
  }
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
  tool_->show();
  area_.setLecture(true);
  hadMenus_ = !window_.menuBar()->isHidden();
  window_.menuBar()->hide();
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

void LectureMode::restore() {
  shrink();  // first: large texts would make the docks and the window larger
  window_.menuBar()->setVisible(hadMenus_);
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

void LectureMode::nameTool(const QString& name) {
  tool_->setText(QStringLiteral("Tool: <b>%1</b>  ·  %2 ends the lecture mode")
                     .arg(name, actions_["lectureMode"].shortcut().toString(QKeySequence::NativeText).toHtmlEscaped()));
}

}  // namespace chainmail
