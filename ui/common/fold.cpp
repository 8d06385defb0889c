#include "common/fold.h"

#include <QSettings>

namespace chainmail {

Fold::Fold(const QString& title, const QString& name, const QString& help)
    : title_(title), button_(new QToolButton), content_(new QWidget), column_(new QVBoxLayout(content_)) {
  column_->setContentsMargins(0, 0, 0, 0);
  column_->setSpacing(6);
  button_->setObjectName(name);
  button_->setCheckable(true);
  button_->setAutoRaise(true);
  button_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  button_->setFocusPolicy(Qt::TabFocus);
  button_->setToolTip(help);
  auto* whole = new QVBoxLayout(this);
  whole->setContentsMargins(0, 0, 0, 0);
  whole->setSpacing(6);
  whole->addWidget(button_);
  whole->addWidget(content_);
  setChanged(false);
  const QString key = QStringLiteral("folds/") + name;
  connect(button_, &QToolButton::toggled, this, [this, key](bool on) {
    unfold(on);
    QSettings().setValue(key, on);
  });
  const bool unfolded = QSettings().value(key).toBool();
  button_->setChecked(unfolded);
  unfold(unfolded);
}

void Fold::unfold(bool unfolded) {
  button_->setArrowType(unfolded ? Qt::DownArrow : Qt::RightArrow);
  content_->setVisible(unfolded);
}

void Fold::setChanged(bool changed) {
  button_->setText(changed ? QStringLiteral("%1 · changed").arg(title_) : title_);
  button_->setAccessibleName(button_->text());
}

}  // namespace chainmail
