#include "simulate/solver_thread.h"

#include <algorithm>
#include <future>
#include <utility>

#include "exact/thread_team.h"
#include "mesh/error.h"
#include "mesh/generate.h"

namespace chainmail {
namespace {

using Clock = PassTimes::Clock;

constexpr auto frame_time = std::chrono::milliseconds(16);
// Time for relaxation per frame, also while dragging. The rest is for drawing and for the other panels.
constexpr auto relaxation_share = std::chrono::milliseconds(8);
// While something is grabbed, slices of relaxation that take longer than that wait until no command came for this time.
constexpr auto pause_of_handle = std::chrono::milliseconds(100);
// The same for a slice that must first prepare for seconds what the handle does not need.
constexpr auto rest_of_handle = std::chrono::seconds(1);
// A drag is prepared when the pointer has rested for this time.
constexpr auto rest_of_pointer = std::chrono::milliseconds(80);
// After a failure, the thread waits so long before it tries the same again.
constexpr auto pause_of_failure = std::chrono::milliseconds(500);
// After the last change, links that are not measured yet wait for this time.
constexpr auto violation_time = std::chrono::milliseconds(250);

using namespace commands;

template <class... Kinds>
bool is_one_of(const Command* command) {
  return command != nullptr && (std::holds_alternative<Kinds>(*command) || ...);
}

/// Returns true if a task makes unfinished passes or sweeps before it unnecessary.
template <class Task>
bool overrules(const Task& task) {
  return is_one_of<SetAlgorithm, ReplaceMesh>(std::get_if<Command>(&task));
}

/// Returns true if a command only moves elements of the current object.
bool only_moves(const Command* command) { return is_one_of<Drag, Relax, Relaxed, SetSoftness, SetElastic>(command); }

/// Returns an object of one element, used until the real one arrives.
MeshPointer no_mesh() { return generate({MeshKind::line, {1, 1, 1}, 1, {}}); }

}  // namespace

SolverThread::SolverThread(MeshPointer mesh, Algorithm algorithm, std::function<void()> frame_ready,
                           std::function<void()> became_idle)
    : simulation_(std::move(mesh), algorithm, Precision::single_precision),
      frame_ready_(std::move(frame_ready)),
      became_idle_(std::move(became_idle)) {
  simulation_.set_progress(work_);
  simulation_.set_threads(core_count());
  publish();
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

SolverThread::SolverThread(SolverThread& other, Algorithm algorithm, std::function<void()> frame_ready,
                           std::function<void()> became_idle)
    : SolverThread(no_mesh(), Algorithm::natural_queue, std::move(frame_ready), std::move(became_idle)) {
  const auto promise = std::make_shared<std::promise<SimulationState>>();
  // If the other solver ends first, the promise is broken, so this task does not wait forever.
  add([taken = promise->get_future().share(), algorithm](Simulation& simulation) {
    simulation.take(taken.get(), algorithm);
  });
  other.add([promise](Simulation& simulation) { promise->set_value(simulation.hand_over()); });
}

SolverThread::~SolverThread() {
  thread_.request_stop();
  const std::lock_guard lock(mutex_);  // tasks that begin later see the stop request
  work_.cancel(true);
}

void SolverThread::post(Command command, const SliceNote& note) { add(std::move(command), note); }

void SolverThread::ask(Question question, const SliceNote& note) { add(std::move(question), note); }

/// Adds a task, and a note before it: nothing else happens between them.
void SolverThread::add(Task task, const SliceNote& note) {
  {
    const std::lock_guard lock(mutex_);
    const int more = overrules(task) ? 1 : 0, count = note.counts ? 2 : 1;
    if (note.counts) {
      tasks_.emplace_back(Question([this, note](const Simulation& simulation) { note_slices(note, simulation); }));
    }
    try {
      tasks_.push_back(std::move(task));  // may run out of memory, so it comes before any change
    } catch (...) {
      if (note.counts) {
        tasks_.pop_back();
      }
      throw;
    }
    overrulers_ += more;
    const bool is_command = std::holds_alternative<Command>(tasks_.back());
    const bool ends_preparation =
        preparing_ == Preparation::drag || (preparing_ == Preparation::relaxation && is_command);
    work_.cancel(work_.cancelled() || overrulers_ > 0 || ends_preparation);
    posted_ += std::size_t(count);
    waiting_.fetch_add(count, std::memory_order_release);
  }
  changed_.notify_one();
}

void SolverThread::note_slices(const SliceNote& note, const Simulation& simulation) {
  const std::uint32_t before = std::exchange(noted_slices_, simulation.slices());
  note.counts->note(note.panel, simulation.statistics().algorithm, noted_slices_ - before);
}

void SolverThread::prepare(std::optional<ElementId> element) {
  {
    const std::lock_guard lock(mutex_);
    if (element == next_grabbed_) {
      return;
    }
    next_grabbed_ = element;
    is_prepared_ = false;
    pointed_at_ = Clock::now();
    work_.cancel(work_.cancelled() || preparing_ == Preparation::drag);
  }
  changed_.notify_one();
}

void SolverThread::cut_sweeps() {
  const std::lock_guard lock(mutex_);
  sweeps_cut_ = posted_;
  work_.cancel(work_.cancelled() || sweeping_);
}

void SolverThread::abandon() {
  const std::lock_guard lock(mutex_);
  abandoned_ = true;
  work_.cancel();
}

void SolverThread::go_on() {
  const std::lock_guard lock(mutex_);
  abandoned_ = false;
}

void SolverThread::pause(bool on) {
  paused_ = on;
  ask([](const Simulation&) {});  // wakes the thread
}

std::string SolverThread::take_error() {
  const std::lock_guard lock(mutex_);
  return std::exchange(error_, {});
}

void SolverThread::refuse(std::string sentence) noexcept {
  const std::lock_guard lock(mutex_);
  error_ = std::move(sentence);
  unseen_ = true;  // the next frame announces it
}

/// Reports the exception that is being handled. The thread goes on: its owner must not lose the object.
void SolverThread::report_failure() noexcept {
  refuse(failure_sentence(info(simulation_.statistics().algorithm).label));
}

/// Moves are dropped when the window closes, and after one has failed, until something else comes than a move of the
/// same handle.
bool SolverThread::is_dropped(const Task& task) const {
  const auto* command = std::get_if<Command>(&task);
  return (abandoned_ && only_moves(command)) || (stopped_ && is_one_of<Drag>(command));
}

void SolverThread::carry_out(const Task& task) {
  const auto* command = std::get_if<Command>(&task);
  if (!is_dropped(task)) {
    run_task(task);
    if (!std::holds_alternative<Question>(task)) {
      if (!is_one_of<Grab>(command)) {  // a grab changes no picture, and a frame now would delay that of the first move
        unseen_ = true;
        measured_ = false;
      }
      last_command_ = Clock::now();
    }
  }
  finish_task();
}

void SolverThread::run_task(const Task& task) {
  const auto* command = std::get_if<Command>(&task);
  work_.show(0);
  stopped_ = stopped_ && command == nullptr;
  try {
    if (command != nullptr) {
      recorder_.begin(*command, simulation_);
      simulation_.apply(*command);
    } else if (const auto* question = std::get_if<Question>(&task)) {
      (*question)(simulation_);
    } else {
      std::get<Job>(task)(simulation_);
    }
  } catch (const Error&) {
    report_failure();
  } catch (const Cancelled&) {
    // The next task replaces the result.
  } catch (const std::future_error&) {
    // The panel whose state this task should copy no longer exists.
  } catch (...) {
    report_failure();
    stopped_ = is_one_of<Drag>(command);
  }
  if (command != nullptr) {
    recorder_.end(simulation_);
  }
}

void SolverThread::finish_task() {
  if (waiting_.fetch_sub(1, std::memory_order_acq_rel) == 1) {
    announce_idle();
  }
}

void SolverThread::announce_idle() {
  try {
    if (became_idle_) {
      became_idle_();
    }
    owes_idle_ = false;
  } catch (...) {
    owes_idle_ = true;
  }
}

/// Removes and returns the next task. The caller must hold the lock.
SolverThread::Task SolverThread::take_task(const std::stop_token& stop) {
  Task task = std::move(tasks_.front());
  tasks_.pop_front();
  overrulers_ -= overrules(task) ? 1 : 0;
  sweeping_ = is_one_of<Relax, Relaxed>(std::get_if<Command>(&task));
  is_prepared_ = is_prepared_ && std::holds_alternative<Question>(task);
  is_relaxation_prepared_ = false;
  preparing_ = Preparation::none;
  const bool is_cut = sweeping_ && posted_ - tasks_.size() <= sweeps_cut_;
  work_.cancel(stop.stop_requested() || abandoned_ || overrulers_ > 0 || is_cut);
  return task;
}

void SolverThread::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    try {
      take_turn(lock, stop);
    } catch (...) {  // nothing below should throw; an exception must not end the process
      if (lock.owns_lock()) {
        lock.unlock();
      }
      report_failure();
      lock.lock();
      changed_.wait_for(lock, stop, pause_of_failure, [&] { return stop.stop_requested(); });
    }
  }
  answer_questions(lock, stop);
}

/// Does what is most urgent, or waits until there is something to do. The caller must hold the lock.
void SolverThread::take_turn(std::unique_lock<std::mutex>& lock, const std::stop_token& stop) {
  const bool is_still = !unseen_ && !relaxes();
  if (!tasks_.empty()) {
    const Task task = take_task(stop);
    lock.unlock();
    carry_out(task);
  } else if (may_relax()) {
    work_.cancel(abandoned_ || stop.stop_requested());  // the last task may have been cancelled
    lock.unlock();
    relax();
  } else if (is_still && must_prepare() && Clock::now() >= time_to_prepare()) {
    prepare_next(lock);
    return;
  } else if (owes_idle_) {
    changed_.wait_for(lock, stop, pause_of_failure, [this] { return !tasks_.empty(); });
    lock.unlock();
    announce_idle();
    lock.lock();
    return;
  } else if (is_still && measured_ && !is_relaxation_prepared_) {
    prepare_relaxation(lock);
    return;
  } else if (is_still && measured_) {
    wait_for_news(lock, stop);
    return;
  } else {
    lock.unlock();
  }
  if (unseen_ && Clock::now() >= last_frame_ + frame_time) {
    refresh_figures();
    show();
  }
  lock.lock();
  rest(lock, stop);
}

/// Answers the remaining questions: a session that is saved while the window closes waits for them. Drops commands that
/// move elements.
void SolverThread::answer_questions(std::unique_lock<std::mutex>& lock, const std::stop_token& stop) {
  abandoned_ = true;
  const auto last = std::find_if(tasks_.rbegin(), tasks_.rend(),
                                 [](const Task& task) { return std::holds_alternative<Question>(task); });
  for (auto left = tasks_.rend() - last; left > 0; --left) {
    const Task task = take_task(stop);
    lock.unlock();
    carry_out(task);
    lock.lock();
  }
}

/// Returns true if there is something to relax and this does not delay the next move of the handle.
bool SolverThread::may_relax() const {
  return relaxes() && (simulation_.grabbed().empty() || Clock::now() >= last_command_ + pause_before_slice());
}

/// How long no command must have come before the next slice, while something is grabbed.
PassTimes::Clock::duration SolverThread::pause_before_slice() const {
  if (simulation_.gives_way()) {
    return rest_of_handle;
  }
  return simulation_.follows_next() || slice_time_ <= relaxation_share ? Clock::duration::zero() : pause_of_handle;
}

void SolverThread::relax() {
  const auto end = Clock::now() + relaxation_share;
  while (Clock::now() < end && may_relax() && begin_slice()) {
    const auto start = Clock::now();
    const bool follows = simulation_.follows_next();
    simulation_.continue_relaxation();
    if (!follows && !simulation_.has_prepared()) {  // what happens once says nothing about the next slice
      slice_time_ = Clock::now() - start;
    }
  }
  unseen_ = true;
  measured_ = false;
}

/// Returns true if no task waits. If the slice would prepare for many seconds what only an object at rest needs, a
/// command cancels it: the handle must go on.
bool SolverThread::begin_slice() {
  const bool gives_way = simulation_.gives_way();
  const std::lock_guard lock(mutex_);
  preparing_ = gives_way ? Preparation::relaxation : Preparation::none;  // until the next task
  return tasks_.empty();
}

/// Waits for a task, for another element under the pointer, or until its drag must be prepared.
void SolverThread::wait_for_news(std::unique_lock<std::mutex>& lock, const std::stop_token& stop) {
  const auto has_news = [this, at = pointed_at_] { return !tasks_.empty() || pointed_at_ != at; };
  if (must_prepare()) {
    changed_.wait_until(lock, stop, time_to_prepare(), has_news);
  } else {
    changed_.wait(lock, stop, has_news);
  }
}

PassTimes::Clock::time_point SolverThread::time_to_prepare() const {
  return std::max(pointed_at_, last_command_) + rest_of_pointer;
}

/// Prepares the drag of the element under the pointer. The caller must hold the lock.
void SolverThread::prepare_next(std::unique_lock<std::mutex>& lock) {
  is_prepared_ = true;
  const auto prepare = [this, element = *next_grabbed_] {
    simulation_.prepare(element);
    return true;
  };
  if (!run_preparation(lock, Preparation::drag, prepare)) {
    is_prepared_ = false;
    pointed_at_ = Clock::now();
  }
}

/// Prepares relaxation of the object as it is, once after each task: that may also have cancelled it. The caller must
/// hold the lock.
void SolverThread::prepare_relaxation(std::unique_lock<std::mutex>& lock) {
  is_relaxation_prepared_ = true;
  run_preparation(lock, Preparation::relaxation, [this] { return simulation_.prepare_relaxation(); });
}

/// Runs a preparation, which returns whether it counts. Returns false if it was cancelled. The caller must hold the
/// lock.
template <class Prepare>
bool SolverThread::run_preparation(std::unique_lock<std::mutex>& lock, Preparation kind, Prepare prepare) {
  preparing_ = kind;
  work_.cancel(abandoned_.load());
  lock.unlock();
  bool is_cancelled = false;
  try {
    prepared_.fetch_add(prepare() ? 1 : 0, std::memory_order_release);
  } catch (const Cancelled&) {
    is_cancelled = true;
  } catch (...) {
    // The move will fail, too, and say so.
  }
  lock.lock();
  preparing_ = Preparation::none;
  return !is_cancelled;
}

void SolverThread::rest(std::unique_lock<std::mutex>& lock, const std::stop_token& stop) {
  const auto has_command = [this] { return !tasks_.empty(); };
  if (unseen_ || relaxes()) {
    const auto share = may_relax() ? relaxation_share : frame_time.zero();
    const bool only_waits = !unseen_ && !may_relax();
    changed_.wait_until(
        lock, stop, only_waits ? last_command_ + pause_before_slice() : last_frame_ + frame_time - share, has_command);
  } else if (!measured_) {
    measure_later(lock, stop);
  }
}

/// Measures the whole mesh once no command has come for a while, so that the object does not move.
void SolverThread::measure_later(std::unique_lock<std::mutex>& lock, const std::stop_token& stop) {
  const auto when = std::max(last_command_, last_frame_) + violation_time;
  const auto until = must_prepare() ? std::min(when, time_to_prepare()) : when;
  const auto has_news = [this, at = pointed_at_] { return !tasks_.empty() || pointed_at_ != at; };
  if (changed_.wait_until(lock, stop, until, has_news) || stop.stop_requested() || Clock::now() < when) {
    return;
  }
  lock.unlock();
  if (measure(stop)) {
    measured_ = true;
    show();
  }
  lock.lock();
}

/// Measures the violation of the whole mesh, unless a command comes. Returns true if it was measured, or if it failed
/// and must not be tried again before something changes.
bool SolverThread::measure(const std::stop_token& stop) {
  const RunningPass running;
  try {
    while (idle() && !stop.stop_requested()) {
      if (simulation_.measure()) {
        return true;
      }
    }
  } catch (...) {
    report_failure();
    return true;
  }
  return false;
}

/// Updates the statistics of a frame, which takes at most a tenth of the time.
void SolverThread::refresh_figures() {
  const auto now = Clock::now();
  if (!simulation_.is_measured() && now >= next_violation_) {
    try {
      simulation_.measure();
    } catch (...) {
      report_failure();  // the frame shows the figures of before
    }
    next_violation_ = now + 10 * (Clock::now() - now);
  }
}

/// Publishes a frame. If that fails, the reader gets the reason instead, and the next frame comes some time later.
void SolverThread::show() {
  try {
    publish();
  } catch (...) {
    report_failure();
    last_frame_ = Clock::now() + pause_of_failure;
    frame_ready_();
  }
}

void SolverThread::publish() {
  last_frame_ = Clock::now();
  recorder_.note_changes(simulation_);
  writer_.publish(simulation_);
  published_.store(writer_.number(), std::memory_order_release);
  unseen_ = false;
  measured_ = measured_ || simulation_.is_measured();
  frame_ready_();
}

}  // namespace chainmail
