#include "common/jobs.h"

#include <string>
#include <utility>

#include "mesh/error.h"

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

struct Jobs::Job {
  Kind kind;
  std::string text;
  Progress progress = Progress::watched();
  QString replaces;  // a sentence about the computation that it has cancelled
  // Written by the thread before it sets `done`; read by the window after that.
  Finish finish;
  std::string error;
  std::atomic<bool> done = false;
};

Jobs::~Jobs() { close(); }

void Jobs::start(Kind kind, const QString& text, Work work) {
  receive();  // there may have been no memory to announce the end of the last job
  if (running() && (kind == Kind::save || current_->kind == Kind::save)) {
    emit failed(
        QStringLiteral("%1: another job, '%2', is still running; wait until it ends, or cancel it").arg(text, text_));
    return;
  }
  const QString replaces = running() && current_->kind == Kind::compute
                               ? QStringLiteral("'%1' ended without a result, because '%2' began").arg(text_, text)
                               : QString();
  cancel();
  try {
    const auto job = std::make_shared<Job>();
    job->kind = kind;
    job->replaces = replaces;
    job->text = text.toStdString();
    // A cancelled job may still run: two at a time would slow each other down. The thread waits for it, the window does
    // not.
    thread_.add([this, job, work = std::move(work)] { run(*job, work); });
    text_ = text;
    current_ = job;
  } catch (...) {
    emit failed(QString::fromStdString(failure_sentence(text.toStdString())));
    return;
  }
  emit changed();
}

void Jobs::cancel() {
  if (running()) {
    current_->progress.cancel();
    const auto job = std::exchange(current_, nullptr);
    emit changed();
    announceReplaced(*job);
  }
}

void Jobs::close() {
  if (running() && current_->kind != Kind::save) {
    cancel();
  }
}

double Jobs::share() const { return current_->progress.share(); }

void Jobs::run(Job& job, const Work& work) {
  try {
    job.finish = work(job.progress);
  } catch (const Cancelled&) {
    return;
  } catch (...) {
    job.error = failure_sentence(job.text);
  }
  job.done = true;
  announce(this, &Jobs::receive);
}

void Jobs::receive() {
  if (!running() || !current_->done) {
    return;  // the job was cancelled
  }
  const auto job = std::exchange(current_, nullptr);
  emit changed();
  if (job->finish) {
    try {
      job->finish();
    } catch (const Cancelled&) {
      // The user has answered a question.
    } catch (...) {
      job->error = failure_sentence(job->text);
    }
  }
  if (!job->error.empty()) {
    emit failed(QString::fromStdString(job->error));
  }
  announceReplaced(*job);
}

/// Says which computation a job has cancelled. Called at its end: opening an object removes older messages.
void Jobs::announceReplaced(const Job& job) {
  if (!job.replaces.isEmpty()) {
    emit replaced(job.replaces);
  }
}

}  // namespace chainmail
