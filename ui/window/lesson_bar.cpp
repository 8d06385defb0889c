#include "window/lesson_bar.h"

#include <QAccessible>
#include <QAction>
#include <QGridLayout>
#include <QToolButton>

#include "common/colours.h"
#include "common/icons.h"

namespace chainmail {
namespace {

QLabel* makeLabel(const char* name) {
  auto* label = new QLabel;
  label->setObjectName(QLatin1String(name));
  label->setTextFormat(Qt::PlainText);
  return label;
}

QPushButton* makeButton(const QString& text, const char* name, QAction& action) {
  auto* button = new QPushButton(text);
  button->setObjectName(QLatin1String(name));
  button->setFocusPolicy(Qt::TabFocus);  // a click leaves the keyboard with the panels
  QObject::connect(button, &QPushButton::clicked, &action, &QAction::trigger);
  return button;
}

QString shown(const std::string& text) { return QString::fromStdString(text); }

}  // namespace

LessonBar::LessonBar(const LessonPlayer& player, QAction& back, QAction& next, QAction& close)
    : player_(player),
      backAction_(back),
      nextAction_(next),
      title_(makeLabel("lessonTitle")),
      text_(makeLabel("lessonText")),
      step_(makeLabel("lessonStep")),
      back_(makeButton(QStringLiteral("Back"), "lessonBackButton", back)),
      next_(makeButton(QStringLiteral("Next"), "lessonNextButton", next)) {
  setObjectName(QStringLiteral("lessonBar"));
  setAccessibleName(QStringLiteral("Lesson"));
  setFrameShape(QFrame::StyledPanel);
  setAutoFillBackground(true);
  QFont bold = title_->font();
  bold.setBold(true);
  title_->setFont(bold);
  title_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  text_->setWordWrap(true);
  auto* leave = new QToolButton;
  leave->setObjectName(QStringLiteral("lessonCloseButton"));
  leave->setIcon(icon("close"));
  leave->setAutoRaise(true);
  leave->setToolTip(QStringLiteral("Closes the lesson; the object stays as it is"));
  leave->setAccessibleName(QStringLiteral("Close lesson"));
  connect(leave, &QToolButton::clicked, &close, &QAction::trigger);
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(12, 6, 8, 6);
  grid->setHorizontalSpacing(8);
  grid->setColumnStretch(0, 1);
  grid->addWidget(title_, 0, 0);
  grid->addWidget(step_, 0, 1, 1, 2, Qt::AlignRight);
  grid->addWidget(leave, 0, 3);
  grid->addWidget(text_, 1, 0);
  grid->addWidget(back_, 1, 1, Qt::AlignBottom);
  grid->addWidget(next_, 1, 2, Qt::AlignBottom);
  connect(&player, &LessonPlayer::openChanged, this, &LessonBar::refresh);
  connect(&player, &LessonPlayer::stepChanged, this, &LessonBar::refresh);
  connect(&player, &LessonPlayer::playsChanged, this, &LessonBar::refresh);
  for (const QAction* action : {&back, &next}) {
    connect(action, &QAction::changed, this, &LessonBar::showKeys);
  }
  showKeys();
  hide();
  followTheme(*this, [this] {
    QPalette own;
    own.setColor(QPalette::Window, colours::infoGround);
    setPalette(own);
  });
}

void LessonBar::showKeys() {
  const auto tip = [](const QString& what, const QAction& action) {
    const QString key = action.shortcut().toString(QKeySequence::NativeText);
    return key.isEmpty() ? what : QStringLiteral("%1 (%2)").arg(what, key);
  };
  back_->setToolTip(tip(QStringLiteral("Restores the end of the step before"), backAction_));
  next_->setToolTip(tip(QStringLiteral("Plays the next step; during a step, goes to its end"), nextAction_));
}

void LessonBar::resizeEvent(QResizeEvent* event) {
  QFrame::resizeEvent(event);
  showTitle();
}

/// Shows the titles of the lesson and of the step, or of the step alone where there is no room for both.
void LessonBar::showTitle() {
  if (!player_.isOpen()) {
    return;
  }
  const QString ofStep = shown(player_.lesson().steps[player_.step()].title);
  const QString both = QStringLiteral("%1: %2").arg(shown(player_.lesson().title), ofStep);
  const bool fits = title_->fontMetrics().horizontalAdvance(both) <= title_->width();
  title_->setText(fits ? both : title_->fontMetrics().elidedText(ofStep, Qt::ElideRight, title_->width()));
  title_->setToolTip(both);
}

void LessonBar::refresh() {
  setVisible(player_.isOpen());
  if (!player_.isOpen()) {
    return;
  }
  const Lesson& lesson = player_.lesson();
  const LessonStep& step = lesson.steps[player_.step()];
  const QString caption = shown(step.text);
  showTitle();
  step_->setText(QStringLiteral("Step %1 of %2").arg(player_.step() + 1).arg(lesson.steps.size()));
  back_->setEnabled(backAction_.isEnabled());
  next_->setEnabled(nextAction_.isEnabled());
  if (text_->text() != caption) {
    text_->setText(caption);
    QAccessibleEvent alert(this, QAccessible::Alert);
    QAccessible::updateAccessibility(&alert);
  }
}

}  // namespace chainmail
