#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

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

}  // namespace chainmail
