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

RecoveryBar::RecoveryBar() : text_(new QLabel) {
  setObjectName(QStringLiteral("recoveryBar"));
  setFrameShape(QFrame::StyledPanel);
  setAutoFillBackground(true);
  text_->setObjectName(QStringLiteral("recovery"));
  text_->setWordWrap(true);
  auto* restore = makeButton(QStringLiteral("&Restore"), "restoreWork",
                             QStringLiteral("Restores object, cuts, pins, softness and positions as one undo step"));
  auto* discard = makeButton(QStringLiteral("Dis&card"), "discardWork",
                             QStringLiteral("Deletes the unsaved work permanently; the open object stays"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(10, 4, 6, 4);
  row->addWidget(text_, 1);
  row->addWidget(restore);
  row->addWidget(discard);
  connect(restore, &QPushButton::clicked, this, [this] { emit restoreRequested(found_.back().path); });
  connect(discard, &QPushButton::clicked, this, &RecoveryBar::discard);
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
    auto lock = std::make_unique<QLockFile>(unsaved_work::lockOf(path));
    lock->setStaleLockTime(0);  // locks of running programs never become stale
    if (lock->tryLock()) {
      found_.push_back({path, std::move(lock)});
    }
  }
  show();
}

void RecoveryBar::show() {
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

void RecoveryBar::discard() {
  unsaved_work::discard(found_.back().path);
  take();
}

void RecoveryBar::release() {
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
