#include "docks/report/report_thread.h"

#include <QCoreApplication>
#include <algorithm>
#include <new>
#include <utility>

#include "mesh/error.h"
#include "report/run/drags.h"
#include "report/run/physics_cases.h"

namespace chainmail {
namespace {

/// Adds the generated drags. Against physics, they have one handle.
void addDrags(ReportThread::Order& order, const Progress& progress) {
  const auto isChosen = [&](const std::string& name) { return std::ranges::count(order.drags, name) > 0; };
  std::vector<report::RecordedMoves>& drags = order.object.drags;
  if (!order.drags.empty()) {
    progress.say("generating the drags");
    progress.show(0);
    auto made = order.againstPhysics ? report::physics_drags(order.object, isChosen("cut, then move"), 0, 1)
                                     : report::three_drags(order.object, progress);
    std::ranges::copy_if(made, std::back_inserter(drags), isChosen, &report::RecordedMoves::name);
  }
  if (drags.empty()) {
    throw Error(order.object.name, "none of the chosen drags is possible", "choose other drags");
  }
}

report::Origin origin() {
  return {report::this_machine(), "the Report dock of the workbench, while its window was open", report::now_in_words(),
          "chainmail " + QCoreApplication::applicationVersion().toStdString()};
}

}  // namespace

void ReportThread::start(Order order) {
  drop();
  last_.reset();
  const std::uint64_t number = number_;  // only this thread changes it
  job_ = Progress::watched([this, number](double share, const std::string& text) { post({share, text}, number); });
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
  const bool wasRunning = running_;
  drop();
  if (wasRunning && last_ != nullptr) {
    auto results = std::make_shared<report::Results>(*last_);
    results->stopped = true;
    emit arrived(results);
  }
}

void ReportThread::drop() {
  job_.cancel();
  running_ = false;
  const std::scoped_lock lock(mutex_);
  if (news_ && news_->results != nullptr) {
    last_ = news_->results;
  }
  news_.reset();  // drops messages of this run; it posts no more
  ++number_;
}

void ReportThread::run(Order& order, const Progress& progress, std::uint64_t number) {
  const report::Origin here = origin();
  const auto send = [&](report::Results results, bool isEnd) {
    results.runs = {report::ReportRun{here, {}, {}}};
    post({progress.share(), progress.text(), std::make_shared<report::Results>(std::move(results)), isEnd}, number);
  };
  const auto fail = [&](std::string sentence) { post({0, {}, {}, true, std::move(sentence)}, number); };
  try {
    addDrags(order, progress);
    const report::Finished finished = [&](const report::Results& results) { send(results, false); };
    send(order.againstPhysics ? report::compare_with_physics({order.object}, order.options, progress, finished)
                              : report::compare({order.object}, order.options, progress, finished),
         true);
  } catch (const std::bad_alloc&) {
    fail(order.object.name + ": there is not enough memory; choose fewer contestants");
  } catch (...) {
    fail(failure_sentence(order.object.name));
  }
}

void ReportThread::post(News news, std::uint64_t number) {
  const std::scoped_lock lock(mutex_);
  if (number != number_) {
    return;  // the run was cancelled
  }
  if (news.results == nullptr && news_) {
    news.results = std::move(news_->results);  // the window has not received them yet
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
  std::optional<News> news;
  {
    const std::scoped_lock lock(mutex_);
    news = std::exchange(news_, std::nullopt);
  }
  if (!running_ || !news) {
    return;
  }
  running_ = !news->isEnd;
  if (news->results != nullptr) {
    last_ = news->results;
    emit arrived(last_);
  }
  if (!news->error.empty()) {
    emit failed(QString::fromStdString(news->error));
  } else if (running_) {
    emit progressed(news->share, QString::fromStdString(news->text));
  }
}

}  // namespace chainmail
