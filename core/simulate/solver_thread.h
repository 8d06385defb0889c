#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>

#include "simulate/frame_writer.h"
#include "simulate/pass_recorder.h"

namespace chainmail {

/// Notes the slices of relaxation since the last note, directly before a command or a question.
struct SliceNote {
  std::shared_ptr<commands::SliceCounts> counts = {};  // null: nothing is noted
  std::size_t panel = 0;                               // of the solver
};

/// Runs one Simulation on its own thread. It sleeps while there is nothing to do, relaxes in idle time, and publishes a
/// frame after changes, at most 60 times per second.
class SolverThread {
 public:
  using Question = std::function<void(const Simulation&)>;

  /// `frame_ready` is called after a frame was published, and when there is an error to take: for the first frame by
  /// this constructor, then by the solver's thread. That thread calls `became_idle` each time idle() becomes true.
  /// Neither may block. If one throws, it is called again later. Throws std::bad_alloc, and std::system_error if the
  /// system starts no thread.
  SolverThread(MeshPointer mesh, Algorithm algorithm, std::function<void()> frame_ready,
               std::function<void()> became_idle = {});
  /// Continues, with `algorithm`, from the object of another solver after all its posted tasks. Until then it shows an
  /// empty object. Tasks posted here run after that.
  SolverThread(SolverThread& other, Algorithm algorithm, std::function<void()> frame_ready,
               std::function<void()> became_idle = {});
  /// Drops the commands that have not begun, and cancels the running one.
  ~SolverThread();

  /// Appends a command to the queue. A command that sets another algorithm or object cancels long passes before it.
  void post(Command command, const SliceNote& note = {});
  /// Cancels the sweeps of relaxation that were posted so far; they may take hours. Call this before the object is
  /// replaced.
  void cut_sweeps();
  /// Ends the running pass or sweep as soon as possible, and drops posted ones. Remaining questions are answered for
  /// the object in that state. Call this when the window closes.
  void abandon();
  /// Takes abandon() back, because the window stays open.
  void go_on();
  /// Stops relaxation in idle time, or takes that back.
  void pause(bool on);
  /// Names the element that the next drag will probably grab, if any. Its drag is prepared when the solver has had
  /// nothing to do for a while, and again after commands. A command, a question or another element ends a preparation
  /// at once. Relaxation that is fine only where needed is prepared without an element, and only commands end that.
  void prepare(std::optional<ElementId> element);
  /// Returns the number of preparations that ended, also of those of drags that had nothing to do.
  int prepared() const { return prepared_.load(std::memory_order_acquire); }
  /// Calls `question` on the solver's thread, after everything posted before. It must not block. What it throws is
  /// reported as an error. When the solver ends, it answers the remaining questions for the current object.
  void ask(Question question, const SliceNote& note = {});
  /// Returns true if all posted commands are done and all questions are answered.
  bool idle() const { return waiting() == 0; }
  /// Returns the number of commands and questions that are not done, including the running one.
  int waiting() const { return waiting_.load(std::memory_order_acquire); }
  /// Share of the running task that is done, if it reports any; from 0 to 1.
  double share() const { return work_.share(); }
  /// Returns true if idle and the newest frame is up to date.
  bool settled() const { return idle() && !unseen_.load(std::memory_order_acquire); }
  /// Returns the number of the newest frame. A reader that has an older one is about to be told.
  std::uint64_t newest_frame() const { return published_.load(std::memory_order_acquire); }
  /// Returns the newest frame. Only one thread may call this.
  const Frame& latest_frame() { return frames_.latest(); }
  /// Returns and clears the message of the last refused command or failure, if any. A method that fails in the middle
  /// of a move stops: further moves of the same handle are dropped. The thread goes on with everything else.
  std::string take_error();

  /// Turns recording of passes on or off.
  void record_passes(bool on) { recorder_.set_on(on); }
  /// Returns the last recorded pass: see PassRecorder::last.
  std::unique_ptr<RecordedPass> last_pass(std::uint64_t seen) const { return recorder_.last(seen); }

 private:
  using Job = std::function<void(Simulation&)>;
  enum class Preparation { none, drag, relaxation };
  using Task = std::variant<Command, Job, Question>;

  void add(Task task, const SliceNote& note = {});
  void note_slices(const SliceNote& note, const Simulation& simulation);
  Task take_task(const std::stop_token& stop);
  void run(const std::stop_token& stop);
  void take_turn(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);
  void refuse(std::string sentence) noexcept;
  void report_failure() noexcept;
  void carry_out(const Task& task);
  void run_task(const Task& task);
  bool is_dropped(const Task& task) const;
  void finish_task();
  void announce_idle();
  void relax();
  bool begin_slice();
  bool relaxes() const { return !paused_ && simulation_.relaxes_in_idle_time(); }
  bool may_relax() const;
  PassTimes::Clock::duration pause_before_slice() const;
  void wait_for_news(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);
  void measure_later(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);
  bool must_prepare() const { return next_grabbed_ && !is_prepared_; }
  void prepare_next(std::unique_lock<std::mutex>& lock);
  void prepare_relaxation(std::unique_lock<std::mutex>& lock);
  template <class Prepare>
  bool run_preparation(std::unique_lock<std::mutex>& lock, Preparation kind, Prepare prepare);
  PassTimes::Clock::time_point time_to_prepare() const;
  void rest(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);
  void answer_questions(std::unique_lock<std::mutex>& lock, const std::stop_token& stop);
  bool measure(const std::stop_token& stop);
  void refresh_figures();
  void show();
  void publish();

  Progress work_ = Progress::watched();  // state of a long pass
  Simulation simulation_;
  std::function<void()> frame_ready_, became_idle_;
  FrameExchange frames_;
  FrameWriter writer_{frames_};
  PassRecorder recorder_;
  PassTimes::Clock::time_point last_frame_{};
  PassTimes::Clock::time_point next_violation_{};
  PassTimes::Clock::time_point last_command_{};
  PassTimes::Clock::duration slice_time_{};   // of the last slice of relaxation that did not follow a handle
  std::atomic<bool> unseen_ = false;          // something changed since the last frame
  std::atomic<std::uint64_t> published_ = 0;  // number of the newest frame
  bool measured_ = false;                     // the last frame shows the violation of the whole mesh
  bool stopped_ = false;                      // a move failed: further moves of this handle are dropped
  bool owes_idle_ = false;                    // became_idle has to be called again, because it threw

  std::uint32_t noted_slices_ = 0;  // of all slices so far

  std::atomic<int> prepared_ = 0;
  std::atomic<bool> abandoned_ = false;
  std::atomic<bool> paused_ = false;

  std::mutex mutex_;  // guards the following members
  std::condition_variable_any changed_;
  std::deque<Task> tasks_;
  std::size_t posted_ = 0;                     // number of tasks so far
  std::size_t sweeps_cut_ = 0;                 // number of the first tasks whose sweeps are cancelled
  int overrulers_ = 0;                         // number of waiting tasks that cancel long work before them
  bool sweeping_ = false;                      // true if the running or the last task is sweeps of relaxation
  std::optional<ElementId> next_grabbed_;      // see prepare()
  PassTimes::Clock::time_point pointed_at_{};  // when it was named, or the last preparation was cancelled
  bool is_prepared_ = false;                   // its drag
  bool is_relaxation_prepared_ = false;
  Preparation preparing_ = Preparation::none;  // what is being prepared
  std::string error_;

  std::atomic<int> waiting_ = 0;  // number of tasks that are not done

  std::jthread thread_;  // last member: starts after all others exist, and ends first
};

}  // namespace chainmail
