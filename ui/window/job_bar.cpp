#include "window/job_bar.h"

#include <QHBoxLayout>

#include "common/icons.h"

namespace chainmail {
namespace {

constexpr int showAfterMilliseconds = 200;  // jobs that take less time show nothing
constexpr int refreshMilliseconds = 100;
constexpr int textWidth = 260, shareWidth = 160, barHeight = 14;  // pixels
constexpr int percent = 100;

}  // namespace

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

}  // namespace chainmail
