#pragma once

#include <QObject>
#include <functional>
#include <memory>

#include "common/task_thread.h"
#include "mesh/progress.h"

namespace chainmail {

/// Runs the long jobs of a window (opening, building, saving) on a separate thread, one at a time.
///
/// The window never waits for that thread. A cancelled job ends at once for the window. Its thread ends when it next
/// reports progress, and its result is dropped. Only the destructor waits for the thread.
class Jobs : public QObject {
  Q_OBJECT

 public:
  /// A job that opens something; one whose result took long to compute; one that writes a file.
  enum class Kind { load, compute, save };
  /// Runs in the GUI thread when the work is done. If it throws, the job has failed, or was
  /// cancelled.
  using Finish = std::function<void()>;
  /// Runs on the thread of the jobs and must not access the window. Its exceptions become the sentence of
  /// failed(); Error brings its own.
  using Work = std::function<Finish(const Progress&)>;

  Jobs() = default;
  ~Jobs() override;

  /// Starts a job. It cancels a running job, and replaced() says so if that was to compute something. If the new or the
  /// running job is a save job, the new job is refused and failed() is emitted, so that no work is lost. The same if
  /// the system starts no thread for it.
  void start(Kind kind, const QString& text, Work work);
  void cancel();
  /// Call this when the window closes. Cancels a job; a save job still finishes.
  void close();

  bool running() const { return current_ != nullptr; }
  /// Text of the running job, and the completed share, from 0 to 1.
  const QString& text() const { return text_; }
  double share() const;

 signals:
  /// Emitted when a job starts or ends.
  void changed();
  /// Emitted when a job fails; `sentence` says why.
  void failed(const QString& sentence);
  /// Emitted when a job has ended that had cancelled a computation; `sentence` names both.
  void replaced(const QString& sentence);

 private:
  struct Job;

  void run(Job& job, const Work& work);
  void receive();
  void announceReplaced(const Job& job);

  QString text_;
  std::shared_ptr<Job> current_;  // shared with the thread
  TaskThread thread_;             // last: ends before the members that its tasks use
};

}  // namespace chainmail
