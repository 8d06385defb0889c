#pragma once

#include <QMetaObject>
#include <QObject>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <thread>

#include "mesh/progress.h"

namespace chainmail {

/// Runs tasks one after another on a thread of its own, which starts with the first task and then stays. Its owner uses
/// it from one thread.
///
/// A task reports its failures itself. What it throws nevertheless ends the task, and nothing else.
class TaskThread {
 public:
  using Task = std::function<void()>;

  TaskThread() = default;
  TaskThread(const TaskThread&) = delete;
  TaskThread& operator=(const TaskThread&) = delete;
  ~TaskThread() { finish(); }

  /// Starts the thread, so that a later add() needs none. Throws std::system_error if the system starts no thread.
  void start();
  /// Appends a task. Throws std::system_error if the thread does not run and the system starts none, and
  /// std::bad_alloc; the task is not added then.
  void add(Task task);
  /// Runs the tasks that wait, and ends the thread. A later task starts another one.
  void finish();

 private:
  void run(const std::stop_token& stop);

  std::mutex mutex_;  // guards the tasks
  std::condition_variable_any changed_;
  std::deque<Task> tasks_;
  std::jthread thread_;
};

/// Calls a function or a member function of `receiver` in the GUI thread, soon. For other threads: the window would
/// wait for ever for an announcement that is lost, so this waits some seconds for memory if there is none. Throws
/// std::bad_alloc after that.
template <class Receiver, class Call>
void announce(Receiver* receiver, const Call& call) {
  constexpr int tries = 500;
  constexpr std::chrono::milliseconds pause(10);
  for (int i = 1;; ++i) {
    try {
      QMetaObject::invokeMethod(receiver, call, Qt::QueuedConnection);
      return;
    } catch (const std::bad_alloc&) {
      if (i == tries) {
        throw;
      }
      std::this_thread::sleep_for(pause);
    }
  }
}

/// The same, unless such a call is on its way: `announced` is true from now until the call resets it. For callers that
/// try again later: throws std::bad_alloc at once if there is no memory.
template <class Receiver, class Call>
void announceOnce(std::atomic<bool>& announced, Receiver* receiver, const Call& call) {
  if (announced.exchange(true)) {
    return;
  }
  try {
    QMetaObject::invokeMethod(receiver, call, Qt::QueuedConnection);
  } catch (...) {
    announced = false;
    throw;
  }
}

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
