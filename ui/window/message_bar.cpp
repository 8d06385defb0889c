#include "window/message_bar.h"

#include <QAccessible>
#include <QHBoxLayout>
#include <QToolButton>
#include <algorithm>

#include "common/colours.h"
#include "common/icons.h"

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

}  // namespace chainmail
