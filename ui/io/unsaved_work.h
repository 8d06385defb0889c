#pragma once

#include <QFrame>
#include <QLabel>
#include <QLockFile>
#include <QStringList>
#include <memory>
#include <vector>

#include "files/session/session.h"
#include "mesh/progress.h"

namespace chainmail {

/// Files of unsaved work, which all running programs of a user keep in one folder that only this user can read. Work is
/// a session `N-ID.chainmail`, or `N-ID.closed-M.chainmail` of a window that was closed or
/// has got another object. N and M count up, so that the order
/// of work does not depend on a clock. Its object may be in a file of its own, `N-ID.object-K`, so that saving again
/// writes only what the user has changed. A lock beside the session shows whether a program still uses it.
namespace unsaved_work {

/// Closed work that is kept: the oldest is removed when there is more.
inline constexpr int maxClosed = 50;

/// Returns the folder, and creates it if it does not exist.
QString folder();
/// Returns a path that no work has, for newer work than all others.
QString newPath();
/// Returns the path that work has after its window was closed now.
QString closedPath(const QString& path);
/// True for work from a window that was closed, false for work from a crash.
bool isClosed(const QString& path);
/// Returns the lock of work, valid as long as this program runs; null if a running program has it.
std::unique_ptr<QLockFile> lock(const QString& path);
/// Returns the name of file `number` for the object of work.
QString objectName(const QString& path, int number);

/// Reads work with its object. Throws Error and Cancelled.
Session read(const QString& path, const Progress& progress = {});
/// Removes the files of the object except one.
void discardObjects(const QString& path, const QString& kept = {});
/// Removes work and its object.
void discard(const QString& path);
/// Returns all work: first that of closed windows, then that of crashes, of each the newest last.
QStringList all();
/// Removes the oldest work of closed windows beyond maxClosed, but none that a window offers.
void discardOldest();
/// Removes what crashes have left: unfinished files, locks, objects without work.
void discardLeftovers();

}  // namespace unsaved_work

/// Offers unsaved work from crashes and closed windows, one file at a time, the newest first. Files that are neither
/// restored nor discarded are offered again at the next start. Discarded files are removed when the window closes.
class RecoveryBar : public QFrame {
  Q_OBJECT

 public:
  RecoveryBar();

  /// Finds files that no running program has locked, and offers them.
  void offer();
  bool hasDiscarded() const { return !discarded_.empty(); }
  /// Offers discarded files again.
  void takeBack();
  /// Offers nothing any more and removes what was discarded, because the window closes.
  void release();
  /// Offers this file no longer. Returns its lock, which belongs to another owner now.
  std::unique_ptr<QLockFile> take(const QString& path);

 signals:
  void restoreRequested(const QString& path);
  void discarded();
  /// Other files are offered or discarded.
  void changed();

 private:
  struct Found {
    QString path;
    std::unique_ptr<QLockFile> lock;  // so that no other window offers the file
  };

  void show();
  static void moveLast(std::vector<Found>& from, std::vector<Found>& to);

  std::vector<Found> found_;      // newest last
  std::vector<Found> discarded_;  // the last one was discarded last
  QLabel* text_;
};

}  // namespace chainmail
