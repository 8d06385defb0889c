#pragma once

#include <QObject>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/jobs.h"
#include "report/run/physics.h"

namespace chainmail {

/// Compares contestants on a separate thread, one run at a time.
///
/// Callers never wait for the thread. A cancelled run ends at once for the caller. Its thread ends when it next checks
/// its progress; what it finishes after that is dropped. Only the destructor waits for the thread.
class ReportThread : public QObject {
  Q_OBJECT

 public:
  using Results = std::shared_ptr<const report::Results>;

  struct Order {
    report::Case object;
    std::vector<std::string> drags = {};  // names of the generated drags that follow those of the object
    bool againstPhysics = false;
    report::PhysicsOptions options = {};  // against Exact: those of CompareOptions
  };

  explicit ReportThread(QObject* parent) : QObject(parent) {}
  ~ReportThread() override { drop(); }

  /// Starts a run. Drops the current run first, if there is one. Emits failed() if the system starts no thread.
  void start(Order order);
  /// Cancels the run. Emits arrived() with its finished drags, if there are any.
  void cancel();
  bool running() const { return running_; }
  /// True while a thread computes, also for a cancelled run.
  bool atWork() const { return atWork_.load(std::memory_order_acquire) != 0; }

 signals:
  void progressed(double share, const QString& text);
  /// Emitted with everything that is finished: after each drag, and at the end, when the run is no longer running.
  void arrived(const chainmail::ReportThread::Results& results);
  /// Emitted when the run fails; `sentence` gives the reason.
  void failed(const QString& sentence);

 private:
  /// A message from a run to the window.
  struct News {
    double share = 0;
    std::string text;
    Results results = {};
    bool isEnd = false;
    std::string error = {};
  };

  void run(Order& order, const Progress& progress, std::uint64_t number);
  void post(News news, std::uint64_t number);
  void receive();
  void drop();

  bool running_ = false;
  Results last_;  // that have arrived from the current run
  std::atomic<int> atWork_ = 0;
  std::atomic<bool> announced_ = false;  // at most one queued call to receive() at a time
  std::mutex mutex_;                     // guards the following members
  std::optional<News> news_;
  std::uint64_t number_ = 0;  // of the newest run; a new one after a cancelled run

  Progress job_;       // of the newest run
  TaskThread thread_;  // last, so that the thread ends before the members that it writes to
};

}  // namespace chainmail
