#include "io/reload_bar.h"

#include <QFileInfo>
#include <QHBoxLayout>
#include <QPushButton>

#include "common/as_path.h"
#include "common/colours.h"

namespace chainmail {

ReloadBar::ReloadBar() : text_(new QLabel) {
  setObjectName(QStringLiteral("reloadBar"));
  setFrameShape(QFrame::StyledPanel);
  setAutoFillBackground(true);
  text_->setTextFormat(Qt::PlainText);
  text_->setWordWrap(true);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(10, 4, 6, 4);
  row->addWidget(text_, 1);
  auto* reload = new QPushButton(QStringLiteral("&Reload"));
  reload->setObjectName(QStringLiteral("reload"));
  reload->setToolTip(QStringLiteral("Opens the file as it is now, as one undo step"));
  auto* keep = new QPushButton(QStringLiteral("&Keep mine"));
  keep->setObjectName(QStringLiteral("keepMine"));
  keep->setToolTip(QStringLiteral("Changes nothing; Save asks before it overwrites the file"));
  row->addWidget(reload);
  row->addWidget(keep);
  connect(reload, &QPushButton::clicked, this, [this] {
    hide();
    emit reloadRequested(path_);
  });
  connect(keep, &QPushButton::clicked, this, &QWidget::hide);
  hide();
  followTheme(*this, [this] {
    QPalette own;
    own.setColor(QPalette::Window, colours::warningGround);
    setPalette(own);
  });
}

void ReloadBar::offer(const QString& path) {
  path_ = path;
  text_->setText(
      QStringLiteral("Another program has changed %1 since it was opened or saved here").arg(shownName(path)));
  show();
}

}  // namespace chainmail
