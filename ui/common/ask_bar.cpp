#include "common/ask_bar.h"

#include <QKeyEvent>
#include <QPushButton>
#include <QVBoxLayout>

#include "common/colours.h"

namespace chainmail {

AskBar::AskBar(const QString& name, const QString& agree, const QString& help)
    : fields_(new QHBoxLayout),
      about_(new QLabel),
      result_(new QLabel),
      details_(new QLabel),
      agree_(new QPushButton(agree)) {
  setObjectName(name + QStringLiteral("Bar"));
  setFrameShape(QFrame::StyledPanel);
  setAutoFillBackground(true);
  about_->setObjectName(name + QStringLiteral("About"));
  about_->setTextFormat(Qt::PlainText);
  about_->setWordWrap(true);
  result_->setObjectName(name + QStringLiteral("Result"));
  details_->setObjectName(name + QStringLiteral("Details"));
  details_->setTextFormat(Qt::PlainText);
  details_->setWordWrap(true);
  details_->hide();
  agree_->setObjectName(name + QStringLiteral("Agree"));
  agree_->setToolTip(help);
  auto* leave = new QPushButton(QStringLiteral("&Cancel"));
  leave->setObjectName(name + QStringLiteral("Cancel"));
  leave->setToolTip(QStringLiteral("Closes this bar; the object does not change"));
  // Several rows: the bar must not make the window wider than the screen.
  auto* words = new QHBoxLayout;
  words->addWidget(about_, 1);
  words->addWidget(result_);
  fields_->addStretch(1);
  fields_->addWidget(agree_);
  fields_->addWidget(leave);
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(10, 4, 6, 4);
  rows->addLayout(words);
  rows->addWidget(details_);
  rows->addLayout(fields_);
  connect(agree_, &QPushButton::clicked, this, &AskBar::agree);
  connect(leave, &QPushButton::clicked, this, &QWidget::hide);
  hide();
  followTheme(*this, [this] {
    QPalette own;
    own.setColor(QPalette::Window, colours::infoGround);
    setPalette(own);
  });
}

void AskBar::addField(const QString& label, QWidget* field) {
  const auto add = [this](QWidget* one) { fields_->insertWidget(fields_->count() - 3, one); };
  if (!label.isEmpty()) {
    auto* text = new QLabel(label);
    text->setBuddy(field);
    add(text);
  }
  add(field);
}

void AskBar::ask(const QString& about, QWidget* field) {
  about_->setText(about);
  show();
  field->setFocus();
}

void AskBar::addAnswer(QPushButton* answer) { fields_->insertWidget(fields_->count() - 1, answer); }

void AskBar::setAgree(const QString& text) { agree_->setText(text); }

void AskBar::showResult(const QString& result, bool possible) {
  result_->setText(result);
  agree_->setEnabled(possible);
}

void AskBar::showDetails(const QString& details) {
  details_->setText(details);
  details_->setVisible(!details.isEmpty());
}

void AskBar::agree() {
  if (agree_->isEnabled()) {
    hide();
    emit agreed();
  }
}

/// Takes the Escape key from the shortcuts while this bar has the keyboard focus.
bool AskBar::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
    event->accept();
    return true;
  }
  return QFrame::event(event);
}

void AskBar::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) {
    hide();
  } else if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) {
    agree();
  } else {
    QFrame::keyPressEvent(event);
  }
}

}  // namespace chainmail
