#pragma once

#include <QFrame>
#include <QLabel>
#include <QLockFile>
#include <QToolButton>
#include <memory>
#include <vector>

namespace chainmail {

/// Offers unsaved work from crashes and closed windows, one file at a time, the newest first. Files that are neither
/// restored nor discarded are offered again at the next start.
class RecoveryBar : public QFrame {
  Q_OBJECT

 public:
  RecoveryBar();

  /// Finds files that no running program has locked, and offers them.
  void offer();
  /// Offers nothing any more, because the window closes.
  void release();
  /// Offers the next file. Returns the lock of this one, which belongs to another owner now.
  std::unique_ptr<QLockFile> take();

 signals:
  void restoreRequested(const QString& path);

 private:
  struct Found {
    QString path;
    std::unique_ptr<QLockFile> lock;  // so that no other window offers the file
  };

  void show();
  void discard();

  std::vector<Found> found_;  // newest last
  QLabel* text_;
};

}  // namespace chainmail
