#include "window/lesson_bar.h"

#include <QAccessible>
#include <QAction>
#include <QHBoxLayout>
#include <QScrollArea>
#include <QScrollBar>
#include <algorithm>

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

constexpr int buttonMargins = 80;  // pixels around the buttons and their texts
constexpr int buttonPadding = 24;  // pixels beside the text of a button
constexpr int widestName = 260;    // pixels that the button of the next lesson asks for
constexpr int largestPart = 3;     // a caption has at most a third of the window's height

QString shown(const std::string& text) { return QString::fromStdString(text); }

}  // namespace

LessonBar::LessonBar(const LessonPlayer& player, QAction& back, QAction& next, QAction& following, QAction& close)
    : player_(player),
      backAction_(back),
      nextAction_(next),
      followingAction_(following),
      caption_(new QScrollArea),
      title_(makeLabel("lessonTitle")),
      text_(makeLabel("lessonText")),
      step_(makeLabel("lessonStep")),
      back_(makeButton(QStringLiteral("Back"), "lessonBackButton", back)),
      next_(makeButton(QStringLiteral("Next"), "lessonNextButton", next)),
      following_(makeButton(QStringLiteral("Next lesson"), "lessonFollowingButton", following)),
      end_(makeButton(QStringLiteral("Close"), "lessonEndButton", close)),
      leave_(new QToolButton) {
  setObjectName(QStringLiteral("lessonBar"));
  setAccessibleName(QStringLiteral("Lesson"));
  setFrameShape(QFrame::StyledPanel);
  setAutoFillBackground(true);
  QFont bold = title_->font();
  bold.setBold(true);
  title_->setFont(bold);
  title_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  text_->setWordWrap(true);
  text_->setMinimumWidth(1);  // a word that is too long for the window makes it no wider
  caption_->setWidgetResizable(true);
  caption_->setFrameShape(QFrame::NoFrame);
  caption_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  caption_->setFocusPolicy(Qt::NoFocus);
  caption_->viewport()->setAutoFillBackground(false);
  text_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  describeButtons();
  arrange();
  listen();
  showKeys();
  hide();
  followTheme(*this, [this] {
    QPalette own;
    own.setColor(QPalette::Window, colours::infoGround);
    setPalette(own);
  });
}

void LessonBar::describeButtons() {
  following_->setToolTip(QStringLiteral("Opens the next lesson"));
  leave_->setObjectName(QStringLiteral("lessonCloseButton"));
  leave_->setIcon(icon("close"));
  leave_->setAutoRaise(true);
  leave_->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Ignored);  // as high as the buttons that replace it
  leave_->setAccessibleName(QStringLiteral("Close lesson"));
  connect(leave_, &QToolButton::clicked, end_, &QPushButton::click);
  for (QWidget* button : {static_cast<QWidget*>(leave_), static_cast<QWidget*>(end_)}) {
    button->setToolTip(QStringLiteral("Closes the lesson; the object stays as it is"));
  }
}

/// The caption has the whole width in every step, so that its longest text decides on one height for the lesson.
void LessonBar::arrange() {
  auto* head = new QHBoxLayout;
  head->addWidget(title_, 1);
  for (QWidget* part : std::initializer_list<QWidget*>{step_, back_, next_, following_, end_, leave_}) {
    head->addWidget(part);
  }
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(12, 6, 8, 6);
  column->setSpacing(4);
  column->addLayout(head);
  caption_->setWidget(text_);
  column->addWidget(caption_);
}

void LessonBar::listen() {
  connect(&player_, &LessonPlayer::openChanged, this, &LessonBar::refresh);
  connect(&player_, &LessonPlayer::stepChanged, this, &LessonBar::refresh);
  connect(&player_, &LessonPlayer::playsChanged, this, &LessonBar::refresh);
  for (const QAction* action : {&backAction_, &nextAction_}) {
    connect(action, &QAction::changed, this, &LessonBar::showKeys);
  }
}

void LessonBar::showKeys() {
  back_->setToolTip(backAction_.toolTip());
  next_->setToolTip(nextAction_.toolTip());
  if (player_.isOpen()) {
    showStep();
  }
}

void LessonBar::resizeEvent(QResizeEvent* event) {
  QFrame::resizeEvent(event);
  fit();
}

/// Texts are large in the lecture mode.
void LessonBar::changeEvent(QEvent* event) {
  QFrame::changeEvent(event);
  if (event->type() == QEvent::FontChange && layout() != nullptr) {
    fit();
  }
}

/// Fits all texts into the width of the bar.
void LessonBar::fit() {
  if (player_.isOpen()) {
    showStep();
    fitFollowing();
    layout()->activate();  // gives the title its width
    showTitle();
    keepHeight();
  }
}

/// Reserves the height of the longest caption of the lesson, so that the views keep their size from step to step. A
/// caption that would leave them little room scrolls.
void LessonBar::keepHeight() {
  if (!player_.isOpen()) {
    return;
  }
  const QMargins margins = layout()->contentsMargins();
  const QRect room(0, 0, contentsRect().width() - margins.left() - margins.right(), QWIDGETSIZE_MAX);
  int height = 0;
  for (const LessonStep& step : player_.lesson().steps) {
    const QRect used = text_->fontMetrics().boundingRect(room, Qt::TextWordWrap, shown(step.text));
    height = std::max(height, used.height());
  }
  caption_->setFixedHeight(std::min(height, window()->height() / largestPart));
}

/// At the end of the last step, the buttons lead on instead of to a next step.
void LessonBar::showButtons() {
  const bool ended = isEnded();
  back_->setEnabled(backAction_.isEnabled());
  next_->setEnabled(nextAction_.isEnabled());
  next_->setVisible(!ended);
  leave_->setVisible(!ended);
  following_->setToolTip(
      QStringLiteral("Opens the next lesson, '%1'").arg(followingAction_.text().section(QStringLiteral(": "), 1)));
  following_->setVisible(ended && followingAction_.isEnabled());
  end_->setVisible(ended);
  fitFollowing();
}

/// Shortens the name of the next lesson if there is no room for it, but not below the width of a usual name: a long
/// name in large letters must not keep the window wide.
void LessonBar::fitFollowing() {
  const QFontMetrics metrics = following_->fontMetrics();
  const int whole = metrics.horizontalAdvance(followingAction_.text()) + buttonPadding;
  const int ofOthers = step_->sizeHint().width() + back_->sizeHint().width() + end_->sizeHint().width();
  const int least = std::min(whole, widestName);
  const int room = std::max(least, width() - ofOthers - buttonMargins);
  following_->setMinimumWidth(least);
  following_->setText(metrics.elidedText(followingAction_.text(), Qt::ElideRight, room - buttonPadding));
}

/// Returns the width that is left for the number of the step if its title and the buttons show their whole texts
/// (pixels).
int LessonBar::roomForStep() const {
  const QString title = shown(player_.lesson().steps[player_.step()].title);
  const int ofTitle = title_->fontMetrics().horizontalAdvance(title);
  const int ofName = following_->fontMetrics().horizontalAdvance(followingAction_.text()) + buttonPadding;
  const int ofOthers = isEnded() ? end_->sizeHint().width() + (followingAction_.isEnabled() ? ofName : 0)
                                 : next_->sizeHint().width() + leave_->sizeHint().width();
  return width() - ofTitle - back_->sizeHint().width() - ofOthers - buttonMargins;
}

/// Shows the number of the step, and, if there is room, where the keys lead from the ends of the lesson.
void LessonBar::showStep() {
  const QString number = QStringLiteral("Step %1 of %2").arg(player_.step() + 1).arg(player_.lesson().steps.size());
  const auto leading = [](const QAction& action, const QString& where) {
    const QString key = action.shortcut().toString(QKeySequence::NativeText);
    return key.isEmpty() || !action.isEnabled() ? QString() : QStringLiteral(" · %1: %2").arg(key, where);
  };
  const QString whole = number + (isEnded()             ? leading(nextAction_, QStringLiteral("next lesson"))
                                  : player_.step() == 0 ? leading(backAction_, QStringLiteral("lesson before"))
                                                        : QString());
  step_->setText(step_->fontMetrics().horizontalAdvance(whole) <= roomForStep() ? whole : number);
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
  const QString caption = shown(player_.lesson().steps[player_.step()].text);
  showButtons();
  fit();
  if (text_->text() != caption) {
    text_->setText(caption);
    caption_->verticalScrollBar()->setValue(0);
    QAccessibleEvent alert(this, QAccessible::Alert);
    QAccessible::updateAccessibility(&alert);
  }
}

}  // namespace chainmail
