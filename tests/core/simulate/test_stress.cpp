#include <QtTest>
#include <cmath>

#include "core/any_command.h"
#include "core/simulate/frame_reader.h"
#include "core/threads.h"
#include "program.h"
#include "simulate/command_log.h"

namespace chainmail::test_stress {

using namespace chainmail::test;

/// All kinds of commands in random order, as fast as possible. Mostly for the thread sanitizer.
class StressTest : public QObject {
  Q_OBJECT

 private slots:
  void any_commands_in_any_order_data();
  void any_commands_in_any_order();
  void shut_down_at_any_moment();
};

namespace {

constexpr auto duration = 1s;

std::vector<MeshPointer> some_meshes() {
  return {make_mesh(MeshKind::grid, {24, 24, 1}), make_mesh(MeshKind::tetra, {4, 4, 4}), jittered_triangles(9, 9, 5),
          make_mesh(MeshKind::line, {40, 1, 1}, 3)};
}

/// Reads a solver's frames on a thread of its own, and checks what a reader relies on at any moment.
class Reading {
 public:
  explicit Reading(SolverThread& solver) : solver_(solver) {}
  ~Reading() { stop(); }

  /// Stops reading. Returns what was wrong, if anything.
  std::string stop() {
    thread_.request_stop();
    if (thread_.joinable()) {
      thread_.join();
    }
    return wrong_;
  }

 private:
  void run(const std::stop_token& stop) {
    FrameReader reader;
    while (!stop.stop_requested() && wrong_.empty()) {
      const Frame& frame = solver_.latest_frame();
      if (frame.number < reader.number()) {
        wrong_ = "an older frame came after a newer one";
      } else if (!std::all_of(frame.positions.begin(), frame.positions.end(),
                              [](float x) { return std::isfinite(x); })) {
        wrong_ = "a position is not finite";
      } else if (!reader.take(frame)) {
        wrong_ = "an element moved in a block that is not marked as changed";
      }
      std::this_thread::yield();
    }
  }

  SolverThread& solver_;
  std::string wrong_;
  std::jthread thread_{[this](const std::stop_token& stop) { run(stop); }};
};

}  // namespace

void StressTest::any_commands_in_any_order_data() {
  QTest::addColumn<bool>("relaxed");
  QTest::newRow("without relaxation") << false;
  QTest::newRow("with relaxation") << true;
}

void StressTest::any_commands_in_any_order() {
  QFETCH(bool, relaxed);
  const auto mesh = some_meshes().front();
  std::atomic<int> frames = 0;
  SolverThread left(mesh, Algorithm::natural_queue, [&] { ++frames; });
  SolverThread right(mesh, Algorithm::natural_queue, [&] { ++frames; });
  CommandLog log({&left, &right});
  AnyCommand any(relaxed ? 31 : 32, relaxed, some_meshes(), 60, 150);
  {
    Reading left_reading(left), right_reading(right);
    const auto end = std::chrono::steady_clock::now() + duration;
    while (std::chrono::steady_clock::now() < end) {
      log.post(any.draw());
      if (any.below(8) == 0) {
        wait_until([&] { return left.idle() && right.idle(); }, std::chrono::microseconds(any.below(3000)));
      }
    }
    QCOMPARE(left_reading.stop(), std::string());
    QCOMPARE(right_reading.stop(), std::string());
  }
  QVERIFY(frames > 2);
  if (!relaxed) {  // relaxation depends on the clock, everything else only on the commands
    log.post(commands::Grab{1});
    log.post(commands::Drag{Point(1, 2, 3)});
    log.post(commands::Release{});
    QVERIFY(wait_until([&] {
      const Frame &one = left.latest_frame(), &other = right.latest_frame();
      return left.idle() && right.idle() && one.mesh == other.mesh && one.positions == other.positions &&
             one.statistics.passes == other.statistics.passes;
    }));
  }
}

void StressTest::shut_down_at_any_moment() {
  const auto mesh = some_meshes().front();
  AnyCommand any(33, true, some_meshes(), 60, 150);
  const auto end = std::chrono::steady_clock::now() + duration;
  while (std::chrono::steady_clock::now() < end) {
    SolverThread left(mesh, Algorithm::generalized, [] {});
    SolverThread right(mesh, Algorithm::natural_queue, [] {});
    Reading left_reading(left), right_reading(right);
    CommandLog log({&left, &right});
    for (std::uint32_t i = any.below(40); i > 0; --i) {
      log.post(any.draw());
    }
    if (any.below(4) == 0) {
      wait_until([&] { return left.idle() && right.idle(); }, std::chrono::microseconds(any.below(20'000)));
    }
    QCOMPARE(left_reading.stop(), std::string());
    QCOMPARE(right_reading.stop(), std::string());
  }
}

CHAINMAIL_TEST(StressTest)

}  // namespace chainmail::test_stress

#include "test_stress.moc"
