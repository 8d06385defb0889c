#include "docks/report/report_thread.h"

#include <new>
#include <utility>

#include "common/jobs.h"
#include "mesh/error.h"
#include "report/run/drags.h"

namespace chainmail {

void ReportThread::start(Order order) {
  cancel();
  const std::uint64_t number = number_;  // only this thread changes it
  job_ = Progress::watched([this, number](double share, const std::string& text) {
    post({share, text, {}, {}}, number);
  });
  ++atWork_;
  try {
    // Two runs at once would disturb each other's times. The thread waits for the one before, not the window.
    thread_.add([this, order = std::make_shared<Order>(std::move(order)), job = job_, number] {
      run(*order, job, number);
      atWork_.fetch_sub(1, std::memory_order_release);
    });
    running_ = true;
  } catch (...) {
    --atWork_;
    emit failed(QString::fromStdString(failure_sentence("report")));
  }
}

void ReportThread::cancel() {
  job_.cancel();
  running_ = false;
  const std::scoped_lock lock(mutex_);
  news_ = {};  // drops messages of this run; it posts no more
  ++number_;
}

void ReportThread::run(Order& order, const Progress& progress, std::uint64_t number) {
  try {
    if (order.generateDrags) {
      progress.say("generating the drags");
      progress.show(0);
      order.object.drags = report::three_drags(order.object, progress);
    }
    auto comparison = report::compare({order.object}, order.options, progress);
    post({1, {}, std::make_shared<report::Comparison>(std::move(comparison)), {}}, number);
  } catch (const std::bad_alloc&) {
    post({0, {}, {}, order.object.name + ": there is not enough memory; choose fewer algorithms"}, number);
  } catch (...) {
    post({0, {}, {}, failure_sentence(order.object.name)}, number);
  }
}

void ReportThread::post(News news, std::uint64_t number) {
  const std::scoped_lock lock(mutex_);
  if (number != number_) {
    return;  // the run was cancelled
  }
  news_ = std::move(news);
  if (announced_.exchange(true)) {
    return;
  }
  try {
    announce(this, &ReportThread::receive);
  } catch (...) {
    announced_ = false;  // the next news tries it again
    throw;
  }
}

void ReportThread::receive() {
  announced_ = false;
  News news;
  {
    const std::scoped_lock lock(mutex_);
    news = news_;
  }
  if (!running_) {
    return;
  }
  running_ = news.result == nullptr && news.error.empty();
  if (news.result != nullptr) {
    emit finished(news.result);
  } else if (!news.error.empty()) {
    emit failed(QString::fromStdString(news.error));
  } else {
    emit progressed(news.fraction, QString::fromStdString(news.text));
  }
}

}  // namespace chainmail
