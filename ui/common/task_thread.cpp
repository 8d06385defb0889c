#include "common/task_thread.h"

#include <utility>

namespace chainmail {

void TaskThread::start() {
  if (!thread_.joinable()) {
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }
}

void TaskThread::add(Task task) {
  start();
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  changed_.notify_one();
}

void TaskThread::finish() {
  if (thread_.joinable()) {
    thread_.request_stop();
    thread_.join();
  }
}

void TaskThread::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return !tasks_.empty(); })) {
    Task task = std::move(tasks_.front());
    tasks_.pop_front();
    lock.unlock();
    try {
      task();
    } catch (...) {
      // An exception that the task did not report must not end the process.
    }
    task = nullptr;  // frees what it holds before the next one
    lock.lock();
  }
}

}  // namespace chainmail
