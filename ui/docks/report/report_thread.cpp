#include "docks/report/report_thread.h"

#include <new>
#include <utility>

#include "common/jobs.h"
#include "mesh/error.h"
#include "report/run/drags.h"

namespace chainmail {

ReportThread::~ReportThread() { stop_.request_stop(); }

void ReportThread::start(Order order) {
  cancel();
  stop_ = std::stop_source();
  ++atWork_;
  try {
    // Two runs at once would disturb each other's times. The thread waits for the one before, not the window.
    thread_.add([this, order = std::make_shared<Order>(std::move(order)), stop = stop_.get_token()] {
      run(*order, stop);
      atWork_.fetch_sub(1, std::memory_order_release);
    });
    running_ = true;
  } catch (...) {
    --atWork_;
    emit failed(QString::fromStdString(failure_sentence("report")));
  }
}

void ReportThread::cancel() {
  stop_.request_stop();
  running_ = false;
  const std::scoped_lock lock(mutex_);
  news_ = {};  // drops messages from before the request; the thread posts no more
}

void ReportThread::run(Order& order, const std::stop_token& stop) {
  try {
    if (order.generateDrags) {
      post({0, "generating the drags", {}, {}}, stop);
      order.object.drags = report::three_drags(order.object, stop);
    }
    const auto progress = [&](double fraction, const std::string& text) { post({fraction, text, {}, {}}, stop); };
    auto comparison = report::compare({order.object}, order.options, progress, stop);
    post({1, {}, std::make_shared<report::Comparison>(std::move(comparison)), {}}, stop);
  } catch (const std::bad_alloc&) {
    post({0, {}, {}, order.object.name + ": there is not enough memory; choose fewer algorithms"}, stop);
  } catch (...) {
    post({0, {}, {}, failure_sentence(order.object.name)}, stop);
  }
}

void ReportThread::post(News news, const std::stop_token& stop) {
  const std::scoped_lock lock(mutex_);
  // cancel() requests the stop and then takes the same lock, so no message of a cancelled run can follow it.
  if (stop.stop_requested()) {
    return;
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
