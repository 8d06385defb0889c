#pragma once

#include <QObject>
#include <functional>
#include <memory>
#include <thread>

#include "mesh/progress.h"

namespace chainmail {

/// The long work of a window, one piece at a time on a thread of its own: opening, building, saving.
///
/// The window never waits for that thread. A job that is cancelled is over at once; its thread ends at its next look
/// at the progress, and what it still finds is dropped. Only the destructor waits.
class Jobs : public QObject {
  Q_OBJECT

 public:
  enum class Kind { load, save };
  /// What is left for the window to do when the work is done.
  using Finish = std::function<void()>;
  /// Runs on the job's thread and touches nothing that belongs to the window. May throw Error.
  using Work = std::function<Finish(const Progress&)>;

  Jobs() = default;
  ~Jobs() override;

  /// Begins a job. What is loaded now replaces what was being loaded, as its result would; while a file is saved, or
  /// to save one, nothing is given up unasked: the new job is refused with a sentence.
  void start(Kind kind, const QString& text, Work work);
  void cancel();
  /// The window closes: what is being loaded is given up, what is being saved will be saved.
  void close();

  bool running() const { return current_ != nullptr; }
  /// What is being done, and how much of it is, from 0 to 1; while one runs.
  const QString& text() const { return text_; }
  double share() const;

 signals:
  /// A job has begun, or is over.
  void changed();
  /// It could not be done: one sentence.
  void failed(const QString& sentence);

 private:
  struct Job;

  void run(Job& job, const Work& work);
  void receive();

  QString text_;
  std::shared_ptr<Job> current_;  // shared with its thread
  std::thread thread_;            // of the newest job; it has waited for those before
};

}  // namespace chainmail
