#include "io/recovery_bar.h"

#include <QDateTime>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLocale>
#include <QPushButton>

#include "common/colours.h"
#include "io/unsaved_work.h"

namespace chainmail {
namespace {

QPushButton* makeButton(const QString& text, const char* name, const QString& help) {
  auto* button = new QPushButton(text);
  button->setObjectName(QLatin1String(name));
  button->setToolTip(help);
  return button;
}

}  // namespace

RecoveryBar::RecoveryBar()
    : takeBack_(new QAction(QStringLiteral("&Take back discarded work"), this)), text_(new QLabel) {
  setObjectName(QStringLiteral("recoveryBar"));
  setFrameShape(QFrame::StyledPanel);
  setAutoFillBackground(true);
  text_->setObjectName(QStringLiteral("recovery"));
  text_->setWordWrap(true);
  auto* restore = makeButton(QStringLiteral("&Restore"), "restoreWork",
                             QStringLiteral("Restores object, cuts, pins, softness and positions as one undo step"));
  auto* discard = makeButton(QStringLiteral("Dis&card"), "discardWork",
                             QStringLiteral("Deletes the unsaved work when this window closes; the open object stays"));
  takeBack_->setObjectName(QStringLiteral("takeBackWork"));
  takeBack_->setStatusTip(QStringLiteral("Offers unsaved work again that was discarded since this window opened"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(10, 4, 6, 4);
  row->addWidget(text_, 1);
  row->addWidget(restore);
  row->addWidget(discard);
  connect(restore, &QPushButton::clicked, this, [this] { emit restoreRequested(found_.back().path); });
  connect(discard, &QPushButton::clicked, this, [this] {
    moveLast(found_, discarded_);
    show();
    emit discarded();
  });
  connect(takeBack_, &QAction::triggered, this, [this] {
    while (!discarded_.empty()) {
      moveLast(discarded_, found_);
    }
    show();
  });
  takeBack_->setEnabled(false);
  hide();
  followTheme(*this, [this] {
    QPalette own;
    own.setColor(QPalette::Window, colours::infoGround);
    setPalette(own);
  });
}

void RecoveryBar::offer() {
  unsaved_work::discardLeftovers();
  for (const QString& path : unsaved_work::all()) {
    if (auto lock = unsaved_work::lock(path)) {
      found_.push_back({path, std::move(lock)});
    }
  }
  show();
}

void RecoveryBar::moveLast(std::vector<Found>& from, std::vector<Found>& to) {
  to.push_back(std::move(from.back()));
  from.pop_back();
}

void RecoveryBar::show() {
  takeBack_->setEnabled(!discarded_.empty());
  setVisible(!found_.empty());
  if (found_.empty()) {
    return;
  }
  const QString time = QLocale().toString(QFileInfo(found_.back().path).lastModified(), QLocale::ShortFormat);
  const QString others = found_.size() > 1 ? QStringLiteral(" (1 of %1)").arg(found_.size()) : QString();
  const bool closed = unsaved_work::isClosed(found_.back().path);
  text_->setText((closed ? QStringLiteral("Unsaved work from %1: the window was closed without saving%2")
                         : QStringLiteral("Unsaved work from %1: the workbench ended without saving%2"))
                     .arg(time, others));
}

void RecoveryBar::release() {
  for (const Found& work : discarded_) {
    unsaved_work::discard(work.path);
  }
  discarded_.clear();
  found_.clear();
  show();
}

std::unique_ptr<QLockFile> RecoveryBar::take() {
  std::unique_ptr<QLockFile> lock;
  if (!found_.empty()) {
    lock = std::move(found_.back().lock);
    found_.pop_back();
  }
  show();
  return lock;
}

}  // namespace chainmail
