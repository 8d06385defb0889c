#include "window/job_bar.h"

#include <QHBoxLayout>

#include "common/icons.h"

namespace chainmail {
namespace {

constexpr int patience = 200;                                     // milliseconds: what ends sooner shows nothing
constexpr int milliseconds = 100;                                 // from one look at the progress to the next
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
  cancel_->setToolTip(QStringLiteral("Cancel (Esc): the object stays as it is, and so does a file that was there"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(text_);
  row->addWidget(share_);
  row->addWidget(cancel_);
  // Its place is kept: the panels must not jump under the hand when it comes and goes.
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
    clock_.start(patience);
  } else {
    clock_.stop();
    hide();
  }
}

void JobBar::showShare() {
  text_->setText(text_->fontMetrics().elidedText(jobs_.text(), Qt::ElideMiddle, textWidth));
  // A progress bar paints itself, and with it the whole window, before setValue returns: here it waits its turn.
  share_->setUpdatesEnabled(false);
  share_->setValue(int(percent * jobs_.share()));
  share_->setUpdatesEnabled(true);
  show();
  clock_.start(milliseconds);
}

}  // namespace chainmail
