#pragma once

#include <QAction>
#include <QFrame>
#include <QLabel>
#include <QLockFile>
#include <QToolButton>
#include <memory>
#include <vector>

namespace chainmail {

/// Offers unsaved work from crashes and closed windows, one file at a time, the newest first. Files that are neither
/// restored nor discarded are offered again at the next start. Discarded files are removed when the window closes.
class RecoveryBar : public QFrame {
  Q_OBJECT

 public:
  RecoveryBar();

  /// Finds files that no running program has locked, and offers them.
  void offer();
  /// The action that offers discarded files again.
  QAction& takeBack() { return *takeBack_; }
  /// Offers nothing any more and removes what was discarded, because the window closes.
  void release();
  /// Offers the next file. Returns the lock of this one, which belongs to another owner now.
  std::unique_ptr<QLockFile> take();

 signals:
  void restoreRequested(const QString& path);
  void discarded();

 private:
  struct Found {
    QString path;
    std::unique_ptr<QLockFile> lock;  // so that no other window offers the file
  };

  void show();
  static void moveLast(std::vector<Found>& from, std::vector<Found>& to);

  std::vector<Found> found_;      // newest last
  std::vector<Found> discarded_;  // the last one was discarded last
  QAction* takeBack_;
  QLabel* text_;
};

}  // namespace chainmail
