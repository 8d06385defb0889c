#include "message_bar.h"

#include <QHBoxLayout>
#include <QToolButton>

namespace chainmail {

MessageBar::MessageBar() : text_(new QLabel) {
  setObjectName(QStringLiteral("messageBar"));
  setStyleSheet(QStringLiteral("#messageBar{background:#5a2a1e} #messageBar QLabel{color:#ffe9e0}"));
  text_->setObjectName(QStringLiteral("message"));
  text_->setWordWrap(true);
  text_->setTextFormat(Qt::PlainText);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* close = new QToolButton;
  close->setText(QStringLiteral("✕"));
  close->setAutoRaise(true);
  close->setAccessibleName(QStringLiteral("Dismiss the message"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(10, 4, 6, 4);
  row->addWidget(text_, 1);
  row->addWidget(close);
  connect(close, &QToolButton::clicked, this, &QWidget::hide);
  hide();
}

void MessageBar::say(const QString& sentence) {
  text_->setText(sentence);
  show();
}

}  // namespace chainmail
