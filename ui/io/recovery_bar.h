#pragma once

#include <QFrame>
#include <QLabel>
#include <QLockFile>
#include <QToolButton>
#include <memory>
#include <vector>

namespace chainmail {

/// Offers the unsaved work of programs that have crashed or were closed on it, one after the other, the newest first,
/// without standing in the way. What is neither restored nor discarded is offered again at the next start.
class RecoveryBar : public QFrame {
  Q_OBJECT

 public:
  RecoveryBar();

  /// Looks for work that no running program holds, and offers it.
  void offer();
  /// What was asked for is there: its file is somebody else's now.
  void taken();

 signals:
  void restoreRequested(const QString& path);

 private:
  struct Found {
    QString path;
    std::unique_ptr<QLockFile> lock;  // so that no other window offers it too
  };

  void show();
  void discard();

  std::vector<Found> found_;  // the newest last
  QLabel* text_;
};

}  // namespace chainmail
