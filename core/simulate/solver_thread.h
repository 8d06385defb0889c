#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <variant>

#include "simulate/frame_writer.h"
#include "simulate/pass_recorder.h"

namespace chainmail {

/// Runs one Simulation on a thread of its own. It sleeps while there is nothing to do, relaxes in idle
/// time, and hands over a frame when something changed, at most 60 times a second.
class SolverThread {
 public:
  using Question = std::function<void(const Simulation&)>;

  /// `frame_ready` is called after a frame was handed over, for the first frame here and from then on
  /// by the solver's thread; `became_idle` is called by that thread each time idle() becomes true. They must not wait.
  SolverThread(MeshPointer mesh, Algorithm algorithm, std::function<void()> frame_ready,
               std::function<void()> became_idle = {});
  /// Goes on by `algorithm` from what the other one's object will be when it has carried out all that was asked of it
  /// so far; until then it shows an object of its own. What is posted here comes after.
  SolverThread(SolverThread& other, Algorithm algorithm, std::function<void()> frame_ready,
               std::function<void()> became_idle = {});
  /// Leaves the commands not yet begun undone, and a pass that takes long unfinished.
  ~SolverThread();

  /// Adds a command to the end of the list. Another algorithm or object lets no pass before it take long.
  void post(Command command);
  /// Sweeps of relaxation that were posted so far, which may go on for hours, end at once: the object is brought
  /// elsewhere next.
  void cut_sweeps();
  /// The window closes: passes and sweeps are no longer wanted. The one under way ends as soon as it can, those posted
  /// are left out, and questions are answered for the object as it is by then.
  void abandon();
  /// Calls `question` on the solver's thread, after what was posted before; it must not wait. When the solver ends, it
  /// answers the remaining questions for the object as it is.
  void ask(Question question);
  /// Whether every command posted has been carried out, and every question answered.
  bool idle() const { return waiting() == 0; }
  /// Number of commands and questions that are not done, the one under way among them.
  int waiting() const { return waiting_.load(std::memory_order_acquire); }
  /// Whether, beside, a frame that shows what came of them was handed over.
  bool settled() const { return idle() && !unseen_.load(std::memory_order_acquire); }
  /// The newest frame; for one reading thread.
  const Frame& latest_frame() { return frames_.latest(); }
  /// Takes the sentence of the last command that was refused, if any.
  std::string take_error();

  /// From now on passes are recorded, or no more.
  void record_passes(bool on) { recorder_.set_on(on); }
  /// The last pass that was recorded, as PassRecorder::last.
  std::unique_ptr<RecordedPass> last_pass(std::uint64_t seen) const { return recorder_.last(seen); }

 private:
  using Job = std::function<void(Simulation&)>;
  using Task = std::variant<Command, Job, Question>;

  void add(Task task);
  Task take_task(const std::stop_token& stop);
  void run(const std::stop_token& stop);
  void refuse(const std::string& sentence);
  void carry_out(const Task& task);
  void finish_task();
  void relax();
  void rest(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);
  void answer_questions(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);
  bool measure(const std::stop_token& stop);
  void refresh_figures();
  void publish();

  JobState work_;  // of a pass that takes long
  Simulation simulation_;
  std::function<void()> frame_ready_, became_idle_;
  TripleBuffer frames_;
  FrameWriter writer_{frames_};
  PassRecorder recorder_;
  PassTimes::Clock::time_point last_frame_{};
  PassTimes::Clock::time_point next_violation_{};
  std::atomic<bool> unseen_ = false;  // something changed since the last frame
  bool measured_ = false;             // the last frame shows the violation of the whole mesh

  std::atomic<bool> abandoned_ = false;

  std::mutex mutex_;  // guards what follows
  std::condition_variable_any changed_;
  std::deque<Task> tasks_;
  std::size_t posted_ = 0;      // number of tasks so far
  std::size_t sweeps_cut_ = 0;  // of which so many, from the first on, may not go on with sweeps
  int overrulers_ = 0;          // number of waiting tasks that let nothing before them take long
  bool sweeping_ = false;       // the task under way, or the last one, is sweeps of relaxation
  std::string error_;

  std::atomic<int> waiting_ = 0;  // tasks added and not yet carried out

  std::jthread thread_;  // last: it starts when all else stands, and ends first
};

}  // namespace chainmail
