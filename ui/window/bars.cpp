#include "window/bars.h"

#include <QAccessible>
#include <QEvent>
#include <QHBoxLayout>
#include <QVBoxLayout>
#include <algorithm>

#include "common/colours.h"
#include "common/icons.h"
#include "panels/panel.h"
#include "panels/panel_area.h"

namespace chainmail {
namespace {

constexpr std::size_t maxMessages = 50;  // older ones are removed
constexpr int signSize = 18;             // pixels

struct SeverityStyle {
  const char* icon;
  const char* name;
  colours::Colour ground, sign;
};

const SeverityStyle& styleOf(Severity severity) {
  static constexpr std::array looks{SeverityStyle{"info", "Note", colours::infoGround, colours::infoSign},
                                    SeverityStyle{"warning", "Warning", colours::warningGround, colours::warningSign},
                                    SeverityStyle{"error", "Error", colours::errorGround, colours::errorSign}};
  return looks[std::size_t(severity)];
}

constexpr int showAfterMilliseconds = 200;  // jobs that take less time show nothing
constexpr int refreshMilliseconds = 100;
constexpr int textWidth = 260, shareWidth = 160, barHeight = 14;  // pixels
constexpr int percent = 100;

constexpr int distance = 6;  // pixels, from the edges of the views and between bars

}  // namespace

MessageBar::MessageBar()
    : sign_(new QLabel), text_(new QLabel), waiting_(new QLabel), all_(new QToolButton), close_(new QToolButton) {
  setObjectName(QStringLiteral("messageBar"));
  setAutoFillBackground(true);
  setFrameShape(QFrame::StyledPanel);
  text_->setObjectName(QStringLiteral("message"));
  text_->setWordWrap(true);
  text_->setTextFormat(Qt::PlainText);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  waiting_->setObjectName(QStringLiteral("messagesWaiting"));
  all_->setObjectName(QStringLiteral("dismissAll"));
  all_->setText(QStringLiteral("Dismiss all"));
  all_->setToolTip(QStringLiteral("Removes all messages, including unread ones"));
  close_->setObjectName(QStringLiteral("dismiss"));
  close_->setIcon(icon("close"));
  close_->setToolTip(QStringLiteral("Removes this message (Esc) and shows the one before it"));
  close_->setAccessibleName(QStringLiteral("Dismiss message"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(10, 4, 6, 4);
  row->setSpacing(8);
  row->addWidget(sign_);
  row->addWidget(text_, 1);
  row->addWidget(waiting_);
  for (QToolButton* button : {all_, close_}) {
    button->setAutoRaise(true);
    row->addWidget(button);
  }
  connect(close_, &QToolButton::clicked, this, &MessageBar::dismiss);
  connect(all_, &QToolButton::clicked, this, &MessageBar::clear);
  hide();
  followTheme(*this, [this] { paintGround(); });
}

void MessageBar::add(Severity severity, const QString& sentence) {
  const Message message{severity, sentence.simplified()};  // one line, whatever names it has
  std::erase(messages_, message);                          // a repeated message becomes the newest
  messages_.push_back(message);
  if (messages_.size() > maxMessages) {
    messages_.erase(messages_.begin());
  }
  refresh();
  show();
  QAccessibleEvent alert(this, QAccessible::Alert);
  QAccessible::updateAccessibility(&alert);
}

void MessageBar::retract(const QString& sentence) {
  const auto removed = std::erase_if(messages_, [&](const Message& message) { return message.sentence == sentence; });
  if (removed > 0) {
    messages_.empty() ? hide() : refresh();
  }
}

void MessageBar::dismiss() {
  if (!messages_.empty()) {
    messages_.pop_back();
  }
  messages_.empty() ? hide() : refresh();
}

void MessageBar::clear() {
  messages_.clear();
  hide();
}

void MessageBar::hideEvent(QHideEvent* event) {
  QFrame::hideEvent(event);
  if (isHidden()) {  // false if only the window is hidden
    messages_.clear();
  }
}

void MessageBar::refresh() {
  text_->setText(sentence());
  setAccessibleName(QStringLiteral("%1: %2").arg(QLatin1String(styleOf(severity()).name), sentence()));
  const bool several = messages_.size() > 1;
  waiting_->setText(QStringLiteral("1 of %1").arg(count()));
  waiting_->setVisible(several);
  all_->setVisible(several);
  paintGround();
}

void MessageBar::paintGround() {
  const SeverityStyle& style = styleOf(severity());
  QPalette own;
  own.setColor(QPalette::Window, style.ground);
  setPalette(own);
  sign_->setPixmap(icon(style.icon, style.sign).pixmap({signSize, signSize}, devicePixelRatioF()));
  sign_->setToolTip(QLatin1String(style.name));
}

JobBar::JobBar(Jobs& jobs) : jobs_(jobs), text_(new QLabel), share_(new QProgressBar), cancel_(new QToolButton) {
  setObjectName(QStringLiteral("jobBar"));
  text_->setObjectName(QStringLiteral("jobText"));
  text_->setTextFormat(Qt::PlainText);
  share_->setObjectName(QStringLiteral("jobShare"));
  share_->setRange(0, percent);
  share_->setFixedSize(shareWidth, barHeight);
  cancel_->setObjectName(QStringLiteral("jobCancel"));
  cancel_->setIcon(icon("close"));
  cancel_->setAutoRaise(true);
  cancel_->setAccessibleName(QStringLiteral("Cancel"));
  cancel_->setToolTip(QStringLiteral("Cancels the job (Esc). The object and existing files stay unchanged"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(text_);
  row->addWidget(share_);
  row->addWidget(cancel_);
  // Keeps its space while hidden, so that the panels do not move.
  QSizePolicy keeps = sizePolicy();
  keeps.setRetainSizeWhenHidden(true);
  setSizePolicy(keeps);
  hide();
  connect(cancel_, &QToolButton::clicked, &jobs_, &Jobs::cancel);
  connect(&jobs_, &Jobs::changed, this, &JobBar::follow);
  connect(&clock_, &QTimer::timeout, this, &JobBar::showShare);
}

void JobBar::follow() {
  if (jobs_.running()) {
    clock_.start(showAfterMilliseconds);
  } else {
    clock_.stop();
    hide();
  }
}

void JobBar::showShare() {
  text_->setText(text_->fontMetrics().elidedText(jobs_.text(), Qt::ElideMiddle, textWidth));
  // setValue would repaint the whole window at once; with updates off, the repaint waits for the event loop.
  share_->setUpdatesEnabled(false);
  share_->setValue(int(percent * jobs_.share()));
  share_->setUpdatesEnabled(true);
  show();
  clock_.start(refreshMilliseconds);
}

BarsOverViews::BarsOverViews(PanelArea& area)
    : QWidget(area.parentWidget()), area_(&area), column_(new QVBoxLayout(this)) {
  column_->setContentsMargins(0, 0, 0, 0);
  column_->setSpacing(distance);
  column_->setSizeConstraint(QLayout::SetNoConstraint);  // a long sentence does not widen the window
  const auto follow = [this](Panel* panel) { panel->view().installEventFilter(this); };
  area.installEventFilter(this);
  std::ranges::for_each(area.panels(), follow);
  connect(&area, &PanelArea::added, this, follow);
  connect(&area, &PanelArea::arranged, this, &BarsOverViews::place);
  place();
}

void BarsOverViews::add(QWidget& bar) {
  column_->addWidget(&bar);
  bar.installEventFilter(this);
}

bool BarsOverViews::eventFilter(QObject* watched, QEvent* event) {
  const bool ofBar = watched->parent() == this;
  if (ofBar ? event->type() == QEvent::Show : event->type() == QEvent::Resize || event->type() == QEvent::Move) {
    place();
  }
  return QWidget::eventFilter(watched, event);
}

/// Another bar, a longer sentence or a larger font needs more lines.
bool BarsOverViews::event(QEvent* event) {
  const bool handled = QWidget::event(event);
  if (event->type() == QEvent::LayoutRequest) {
    place();
  }
  return handled;
}

void BarsOverViews::place() {
  if (area_ == nullptr) {
    return;
  }
  int bottom = 0;
  for (const int panel : area_->inSight()) {
    const View& view = area_->panels()[std::size_t(panel)]->view();
    bottom = std::max(bottom, view.mapTo(parentWidget(), QPoint(0, view.height())).y());
  }
  const QRect whole = area_->geometry().adjusted(distance, distance, -distance, 0);
  const int height = column_->isEmpty() ? 0 : column_->totalHeightForWidth(whole.width());
  setGeometry(whole.left(), bottom - distance - height, whole.width(), height);
  raise();
}

}  // namespace chainmail
