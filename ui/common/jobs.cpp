#include "common/jobs.h"

#include <exception>
#include <new>
#include <string>

namespace chainmail {

struct Jobs::Job {
  Kind kind;
  std::string text;
  JobState state;
  // Written by the thread before it sets `done`; read by the window after that.
  Finish finish;
  std::string error;
  std::atomic<bool> done = false;
};

Jobs::~Jobs() {
  close();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void Jobs::start(Kind kind, const QString& text, Work work) {
  if (running() && (kind == Kind::save || current_->kind == Kind::save)) {
    emit failed(
        QStringLiteral("%1: another job, '%2', is still running; wait until it ends, or cancel it").arg(text, text_));
    return;
  }
  cancel();
  text_ = text;
  current_ = std::make_shared<Job>();
  current_->kind = kind;
  current_->text = text.toStdString();
  thread_ = std::thread([this, job = current_, work = std::move(work), before = std::move(thread_)]() mutable {
    // Only one job runs at a time: two would slow each other down. This thread waits for the previous one; the window
    // does not wait.
    if (before.joinable()) {
      before.join();
    }
    run(*job, work);
  });
  emit changed();
}

void Jobs::cancel() {
  if (running()) {
    current_->state.cancelled = true;
    current_.reset();
    emit changed();
  }
}

void Jobs::close() {
  if (running() && current_->kind == Kind::load) {
    cancel();
  }
}

double Jobs::share() const { return current_->state.share; }

void Jobs::run(Job& job, const Work& work) {
  try {
    job.finish = work(Progress(job.state));
  } catch (const Cancelled&) {
    return;
  } catch (const std::bad_alloc&) {
    job.error = job.text + ": there is not enough memory; use a smaller mesh";
  } catch (const std::exception& error) {
    job.error = error.what();
  }
  job.done = true;
  QMetaObject::invokeMethod(this, &Jobs::receive, Qt::QueuedConnection);
}

void Jobs::receive() {
  if (!running() || !current_->done) {
    return;  // the job was cancelled
  }
  const auto job = std::exchange(current_, nullptr);
  emit changed();
  if (job->finish) {
    job->finish();
  } else {
    emit failed(QString::fromStdString(job->error));
  }
}

}  // namespace chainmail
