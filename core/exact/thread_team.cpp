#include "exact/thread_team.h"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <mutex>
#include <new>
#include <stop_token>
#include <thread>
#include <utility>

namespace chainmail {
namespace {

/// Number of threads that run a pass, or help in one.
std::atomic<int> busy{0};
/// Number of passes that this thread runs.
thread_local int passes_here = 0;

/// Waits for an event that another thread brings about soon: a part takes some microseconds.
class ShortWait {
 public:
  void again() {
    if (++rounds_ > spins) {
      std::this_thread::yield();
      return;
    }
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }

 private:
  static constexpr int spins = 1000;
  int rounds_ = 0;
};

}  // namespace

int core_count() {
  static const int count = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return count;
}

RunningPass::RunningPass() {
  ++busy;
  ++passes_here;
}
RunningPass::~RunningPass() {
  --busy;
  --passes_here;
}

struct ThreadTeam::Shared {
  /// The state of the work in one number, so that a helper that comes late cannot take a part of other work: number of
  /// the work (32 bits), its parts (16) and how many of them are taken (16).
  std::atomic<std::uint64_t> ticket{0};
  std::atomic<std::size_t> done{0};
  std::atomic<int> helpers{0};
  std::atomic<bool> ends{false};
  Call call = nullptr;
  void* context = nullptr;
  std::mutex mutex;
  std::exception_ptr error;  // the first; guarded by the mutex

  static std::uint64_t parts(std::uint64_t of) { return of >> 16 & max_parts; }
  static std::uint64_t taken(std::uint64_t of) { return of & max_parts; }

  /// Does a part, if one is left.
  bool take() {
    std::uint64_t now = ticket.load(std::memory_order_acquire);
    do {
      if (taken(now) == parts(now)) {
        return false;
      }
    } while (!ticket.compare_exchange_weak(now, now + 1, std::memory_order_acq_rel, std::memory_order_acquire));
    try {
      call(context, taken(now));
    } catch (...) {
      const std::lock_guard lock(mutex);
      error = error ? error : std::current_exception();
    }
    done.fetch_add(1, std::memory_order_release);
    return true;
  }

  /// Helps until the team ends or others need the core.
  void help() {
    ShortWait wait;
    while (!ends.load(std::memory_order_acquire) && busy.load(std::memory_order_relaxed) <= core_count()) {
      if (take()) {
        wait = {};
      } else {
        wait.again();
      }
    }
  }
};

namespace {

/// The helpers of the process. They are started when a team first needs them, and sleep while none does.
///
/// A fork copies only the thread that calls it. The new process has no helpers, nobody may wait for those that it seems
/// to have, and one of them may have held their mutex. So it leaves them alone and starts its own.
class Helpers {
 public:
  static Helpers& all() {
    Helpers* helpers = present.load(std::memory_order_acquire);
    if (helpers == nullptr) {
      auto made = std::make_unique<Helpers>();
      helpers = present.compare_exchange_strong(helpers, made.get()) ? made.release() : helpers;
    }
    return *helpers;
  }

  /// Ends the helpers, at the end of the process.
  static void end() { delete present.exchange(nullptr); }

  /// Call this in a process that a fork has made.
  static void begin_in_fork() {
    left_alone = present.exchange(nullptr);
    busy = passes_here;
  }

  /// Sends helpers to a team: those that are free, but at most `max_helpers`.
  void send(ThreadTeam::Shared& team, int max_helpers) {
    {
      const std::lock_guard lock(mutex_);
      for (std::size_t i = 0; max_helpers > 0 && busy.load() < core_count() && (i < helpers_.size() || start()); ++i) {
        if (Helper& helper = helpers_[i]; helper.team == nullptr) {
          helper.team = &team;
          ++team.helpers;
          ++busy;
          --max_helpers;
        }
      }
    }
    changed_.notify_all();
  }

  /// Takes back the helpers of a team that have not woken up yet.
  void take_back(ThreadTeam::Shared& team) {
    const std::lock_guard lock(mutex_);
    for (Helper& helper : helpers_) {
      if (helper.team == &team && !helper.helps) {
        leave(helper);
      }
    }
  }

 private:
  struct Helper {
    ThreadTeam::Shared* team = nullptr;
    bool helps = false;
    std::jthread thread;
  };

  /// Starts one more helper. Returns false if there are enough, or if the system allows no more threads or has no
  /// memory for one.
  bool start() {
    const std::size_t before = helpers_.size();
    if (int(before) >= core_count() - 1) {
      return false;
    }
    try {
      Helper& helper = helpers_.emplace_back();
      helper.thread = std::jthread([this, &helper](const std::stop_token& stop) { serve(helper, stop); });
    } catch (const std::exception&) {
      helpers_.resize(before);
      return false;
    }
    return true;
  }

  /// Throws nothing: take() keeps what a part throws for the team.
  void serve(Helper& helper, const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, stop, [&] { return helper.team != nullptr; })) {
      helper.helps = true;
      ThreadTeam::Shared& team = *helper.team;
      lock.unlock();
      team.help();
      lock.lock();
      helper.helps = false;
      leave(helper);
    }
  }

  static void leave(Helper& helper) {
    --busy;
    std::exchange(helper.team, nullptr)->helpers.fetch_sub(1, std::memory_order_release);  // the team may be gone now
  }

  inline static std::atomic<Helpers*> present = nullptr;     // made when they are first needed
  inline static std::atomic<Helpers*> left_alone = nullptr;  // of the process before the fork

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Helper> helpers_;  // last: its threads end before the members that they use
};

/// Exists as long as the process.
struct HelpersOfProcess {
  HelpersOfProcess() { pthread_atfork(nullptr, nullptr, &Helpers::begin_in_fork); }
  HelpersOfProcess(const HelpersOfProcess&) = delete;
  HelpersOfProcess& operator=(const HelpersOfProcess&) = delete;
  ~HelpersOfProcess() { Helpers::end(); }
};

const HelpersOfProcess helpers_of_process;

}  // namespace

ThreadTeam::ThreadTeam(int max_threads) : max_threads_(max_threads) {}

void ThreadTeam::call_helpers() {
  if (!has_called_ && std::min(max_threads_, core_count()) > 1 && busy.load() < core_count()) {
    shared_.reset(new (std::nothrow) Shared);  // without memory for it, the team stays alone
    if (shared_) {
      Helpers::all().send(*shared_, max_threads_ - 1);
    }
  }
  has_called_ = true;
}

ThreadTeam::~ThreadTeam() {
  if (shared_) {
    shared_->ends.store(true, std::memory_order_release);
    Helpers::all().take_back(*shared_);
    for (ShortWait wait; shared_->helpers.load(std::memory_order_acquire) > 0;) {
      wait.again();
    }
  }
}

void ThreadTeam::run(std::size_t parts, Call call, void* context) {
  if (!shared_ || parts < 2) {
    for (std::size_t part = 0; part < parts; ++part) {
      call(context, part);
    }
    return;
  }
  Shared& shared = *shared_;
  shared.call = call;
  shared.context = context;
  shared.done.store(0, std::memory_order_relaxed);
  const std::uint64_t number = (shared.ticket.load(std::memory_order_relaxed) >> 32) + 1;
  shared.ticket.store(number << 32 | std::uint64_t{parts} << 16, std::memory_order_release);
  while (shared.take()) {
  }
  for (ShortWait wait; shared.done.load(std::memory_order_acquire) < parts;) {
    wait.again();
  }
  if (shared.error) {
    std::rethrow_exception(std::exchange(shared.error, nullptr));
  }
}

}  // namespace chainmail
