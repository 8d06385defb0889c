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
/// Callers never wait for the thread. A cancelled run is over at once; its thread ends when it next checks the stop
/// token, and its results are dropped. Only the destructor waits.
class ReportThread : public QObject {
  Q_OBJECT

 public:
  using Result = std::shared_ptr<const report::Comparison>;

  struct Order {
    report::Case object;
    bool generateDrags = false;  // the object has no drags; three are generated
    report::CompareOptions options;
  };

  explicit ReportThread(QObject* parent) : QObject(parent) {}
  ~ReportThread() override;

  /// Cancels the present run first, if there is one.
  void start(Order order);
  void cancel();
  bool running() const { return running_; }
  /// True while a thread computes, also for a cancelled run.
  bool atWork() const { return atWork_.load(std::memory_order_acquire) != 0; }

 signals:
  void progressed(double fraction, const QString& text);
  void finished(const chainmail::ReportThread::Result& result);
  /// The run has failed, for the reason in this sentence.
  void failed(const QString& sentence);

 private:
  /// A message from a run to the window.
  struct News {
    double fraction = 0;
    std::string text;
    Result result;
    std::string error;
  };

  void run(Order& order, const std::stop_token& stop);
  void post(News news, const std::stop_token& stop);
  void receive();

  bool running_ = false;
  std::atomic<int> atWork_ = 0;
  std::atomic<bool> announced_ = false;  // at most one queued call to receive() at a time
  std::mutex mutex_;                     // guards news_
  News news_;

  std::jthread thread_;  // last, so that it ends before the members that it writes to
};

}  // namespace chainmail
