#pragma once

#include <QObject>
#include <functional>
#include <memory>
#include <thread>

#include "mesh/progress.h"

namespace chainmail {

/// Runs the long jobs of a window on a thread of their own, one at a time: opening, building, saving.
///
/// The window never waits for that thread. A cancelled job is over at once for the window; its thread ends when it next
/// reports progress, and its result is dropped. Only the destructor waits.
class Jobs : public QObject {
  Q_OBJECT

 public:
  enum class Kind { load, save };
  /// Runs in the GUI thread when the work is done.
  using Finish = std::function<void()>;
  /// Runs on the thread of the job and must not access the window. May throw Error.
  using Work = std::function<Finish(const Progress&)>;

  Jobs() = default;
  ~Jobs() override;

  /// Starts a job. A load job replaces a running load job, as its result would. If either of the two saves, the new job
  /// is refused with a sentence, so that no work is lost.
  void start(Kind kind, const QString& text, Work work);
  void cancel();
  /// The window closes: cancels a load job; a save job still ends.
  void close();

  bool running() const { return current_ != nullptr; }
  /// The text of the running job, and the share that is done, from 0 to 1.
  const QString& text() const { return text_; }
  double share() const;

 signals:
  /// A job has started or ended.
  void changed();
  /// A job failed; one sentence says why.
  void failed(const QString& sentence);

 private:
  struct Job;

  void run(Job& job, const Work& work);
  void receive();

  QString text_;
  std::shared_ptr<Job> current_;  // shared with its thread
  std::thread thread_;            // of the newest job; it waits for the threads before
};

}  // namespace chainmail
