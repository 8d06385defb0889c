#pragma once

#include <QObject>
#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "report/run/compare.h"

namespace chainmail {

/// Compares algorithms on a thread of its own, one run at a time.
///
/// Whoever calls never waits for that thread: a run that is cancelled is over at once, its thread ends at its
/// next look at the stop token, and what it still finds is dropped. Only the destructor waits.
class ReportThread : public QObject {
  Q_OBJECT

 public:
  using Result = std::shared_ptr<const report::Comparison>;

  struct Order {
    report::Case object;
    bool generateDrags = false;  // the object comes without drags: three are found for it
    report::CompareOptions options;
  };

  explicit ReportThread(QObject* parent) : QObject(parent) {}
  ~ReportThread() override;

  /// Cancels the run before, if there is one.
  void start(Order order);
  void cancel();
  bool running() const { return running_; }
  /// Whether a thread computes yet, be it for a run that was cancelled.
  bool atWork() const { return atWork_.load(std::memory_order_acquire) != 0; }

 signals:
  void progressed(double fraction, const QString& text);
  void finished(const chainmail::ReportThread::Result& result);
  /// The run could not be made: one sentence.
  void failed(const QString& sentence);

 private:
  /// What a run tells the window.
  struct News {
    double fraction = 0;
    std::string text;
    Result result;
    std::string error;
  };

  void run(Order& order, const std::stop_token& stop);
  void tell(News news, const std::stop_token& stop);
  void receive();

  bool running_ = false;
  std::atomic<int> atWork_ = 0;
  std::atomic<bool> announced_ = false;  // news are announced at most once until they are received
  std::mutex mutex_;                     // guards news_
  News news_;

  std::jthread thread_;  // last: it ends before what it writes to
};

}  // namespace chainmail
