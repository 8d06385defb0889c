#include <QtTest>
#include <cmath>

#include "core/threads.h"
#include "simulate/command_log.h"

using namespace chainmail;
using namespace chainmail::test;

/// Everything at once, in a random order, as fast as it goes: for the thread sanitizer first of all.
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
  return {make_mesh(MeshKind::grid, {12, 12, 1}), make_mesh(MeshKind::tetra, {4, 4, 4}), jittered_triangles(9, 9, 5),
          make_mesh(MeshKind::line, {40, 1, 1}, 3)};
}

/// Draws commands, some of which do not fit the object and are refused.
class AnyCommand {
 public:
  AnyCommand(std::uint64_t seed, bool relaxed) : random_(seed), relaxed_(relaxed) {}

  Command draw() {
    using namespace commands;
    switch (random_() % 26) {
      case 0:
        return Cut{{below(150), below(150)}};
      case 1:
        return Uncut{{below(150), below(150)}};
      case 2:
        return SetSoftness{{{between(-0.05, 1), between(1, 2), between(0, 1)}, {{below(150), {1, 1, 0}}}}};
      case 3:
        return SetRelaxation{relaxed_ && below(4) != 0, between(0.1, 1),
                             below(2) == 0 ? RelaxationScheme::mean : RelaxationScheme::link};
      case 4:
        return SetAlgorithm{algorithms()[below(6)].algorithm};
      case 5:
        return below(3) == 0 ? Command(ReplaceMesh{meshes_[below(4)]}) : Command(Reset{});
      case 6:
        return KeepState{below(4)};
      case 7:
        return SwapState{below(4)};
      case 8:
        return below(3) == 0 ? Command(DropState{below(4)}) : Command(Release{});
      case 12:
        return Pin{{below(60)}};
      case 13:
        return Unpin{{below(60), below(60), below(60)}};
      case 9:
      case 10:
      case 11:
        return Grab{below(60)};
      default:
        return Drag{Point(between(-4, 16), between(-4, 16), between(-4, 4))};
    }
  }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }

 private:
  double between(double low, double high) { return uniform(random_, low, high); }

  std::mt19937_64 random_;
  bool relaxed_;
  std::vector<MeshPointer> meshes_ = some_meshes();
};

/// What a reader of frames relies on, at any moment.
void check_frame(SolverThread& solver, std::uint64_t& last_number) {
  const Frame& frame = solver.latest_frame();
  QVERIFY(frame.number >= last_number);
  last_number = frame.number;
  QVERIFY(frame.mesh != nullptr);
  QCOMPARE(frame.positions.size(), frame.mesh->rest.size());
  QVERIFY(std::all_of(frame.positions.begin(), frame.positions.end(), [](float x) { return std::isfinite(x); }));
}

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
  AnyCommand any(relaxed ? 31 : 32, relaxed);
  std::uint64_t left_number = 0, right_number = 0;
  const auto end = std::chrono::steady_clock::now() + duration;
  while (std::chrono::steady_clock::now() < end && !QTest::currentTestFailed()) {
    log.post(any.draw());
    log.sample();
    check_frame(left, left_number);
    check_frame(right, right_number);
    if (any.below(8) == 0) {
      std::this_thread::sleep_for(std::chrono::microseconds(any.below(3000)));
    }
  }
  QVERIFY(frames > 2);
  if (!relaxed) {  // relaxation goes by the clock; all else by the commands alone
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
  AnyCommand any(33, true);
  const auto end = std::chrono::steady_clock::now() + duration;
  while (std::chrono::steady_clock::now() < end) {
    SolverThread left(mesh, Algorithm::generalized, [] {});
    SolverThread right(mesh, Algorithm::natural_queue, [] {});
    CommandLog log({&left, &right});
    for (std::uint32_t i = any.below(40); i > 0; --i) {
      log.post(any.draw());
      log.sample();
    }
    std::this_thread::sleep_for(std::chrono::microseconds(any.below(4) == 0 ? any.below(20'000) : 0));
  }
}

QTEST_APPLESS_MAIN(StressTest)
#include "test_stress.moc"
