#pragma once

#include <QObject>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "common/jobs.h"
#include "report/run/compare.h"

namespace chainmail {

/// Compares algorithms on a separate thread, one run at a time.
///
/// Callers never wait for the thread. A cancelled run ends at once for the caller. Its thread ends when it next checks
/// its progress, and its results are dropped. Only the destructor waits for the thread.
class ReportThread : public QObject {
  Q_OBJECT

 public:
  using Result = std::shared_ptr<const report::Comparison>;

  struct Order {
    report::Case object;
    bool generateDrags = false;  // true if the object has no drags: three are generated
    report::CompareOptions options;
  };

  explicit ReportThread(QObject* parent) : QObject(parent) {}
  ~ReportThread() override { cancel(); }

  /// Starts a run. Cancels the current run first, if there is one. Emits failed() if the system starts no thread.
  void start(Order order);
  void cancel();
  bool running() const { return running_; }
  /// True while a thread computes, also for a cancelled run.
  bool atWork() const { return atWork_.load(std::memory_order_acquire) != 0; }

 signals:
  void progressed(double fraction, const QString& text);
  void finished(const chainmail::ReportThread::Result& result);
  /// Emitted when the run fails; `sentence` gives the reason.
  void failed(const QString& sentence);

 private:
  /// A message from a run to the window.
  struct News {
    double fraction = 0;
    std::string text;
    Result result;
    std::string error;
  };

  void run(Order& order, const Progress& progress, std::uint64_t number);
  void post(News news, std::uint64_t number);
  void receive();

  bool running_ = false;
  std::atomic<int> atWork_ = 0;
  std::atomic<bool> announced_ = false;  // at most one queued call to receive() at a time
  std::mutex mutex_;                     // guards the following members
  News news_;
  std::uint64_t number_ = 0;  // of the newest run; a new one after a cancelled run

  Progress job_;       // of the newest run
  TaskThread thread_;  // last, so that the thread ends before the members that it writes to
};

}  // namespace chainmail
