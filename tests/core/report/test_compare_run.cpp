#include <QtTest>
#include <atomic>
#include <chrono>
#include <ctime>
#include <thread>

#include "core/report/comparisons.h"
#include "core/threads.h"
#include "mesh/error.h"
#include "program.h"

namespace chainmail::test_compare_run {

using namespace chainmail::report;
using namespace chainmail::report::test;
using chainmail::test::make_mesh;

/// How the experiment runs: repetitions, progress, stopping, refusals.
class CompareRunTest : public QObject {
  Q_OBJECT

 private slots:
  void repetitions_are_counted();
  void stops_at_once();
  void stops_between_repetitions();
  void stops_between_sweeps_data();
  void stops_between_sweeps();
  void progress_goes_from_0_to_1();
  void contradicting_pins_are_told();
  void wrong_moves_and_numbers_are_refused();
};

void CompareRunTest::repetitions_are_counted() {
  auto options = quick({Algorithm::spiral});
  const auto ms = [&] { return compare_one(jittered(), options).entries[0].measurement.value(); };
  QCOMPARE(ms().ms_per_move.count, 2);
  options.repetitions.reset();
  options.seconds = 0;
  const Measurement measurement = ms();
  QCOMPARE(measurement.ms_per_move.count, 5);
  const TimeSpread& spread = measurement.ms_per_move;
  QVERIFY(0 < spread.min && spread.min <= spread.lower_quartile && spread.lower_quartile <= spread.median);
  QVERIFY(spread.median <= spread.upper_quartile && spread.upper_quartile <= spread.max);
  QVERIFY(measurement.worst_move_ms > 0);
}

void CompareRunTest::stops_at_once() {
  const Progress job = Progress::watched();
  job.cancel();
  const auto comparison = compare({jittered()}, quick(), job);
  QVERIFY(comparison.stopped);
  QVERIFY(comparison.cases.at(0).drags.empty());
}

void CompareRunTest::stops_between_repetitions() {
  Case one = jittered();
  one.drags.push_back(one.drags[0]);
  auto options = quick();
  options.repetitions = 1'000'000'000;  // would take years
  int reported = 0;
  Progress job;
  job = Progress::watched([&](double, const std::string&) {
    if (++reported == 10) {
      job.cancel();
    }
  });
  const auto comparison = compare({one}, options, job);
  QVERIFY(comparison.stopped);
  QCOMPARE(reported, 10);
  QVERIFY(comparison.cases.at(0).drags.empty());
}

void CompareRunTest::stops_between_sweeps_data() {
  QTest::addColumn<int>("after_a_move");
  QTest::addColumn<quint32>("among_the_moves");
  QTest::newRow("after each move") << 100'000'000 << 0U;
  QTest::newRow("as recorded") << 0 << 1'000'000U;
}

void CompareRunTest::stops_between_sweeps() {
  QFETCH(int, after_a_move);
  QFETCH(quint32, among_the_moves);
  const auto grid = make_mesh(MeshKind::grid, {64, 64, 1});
  RecordedMoves moves = drag(*grid, 2080, {40, 20, 0});
  moves.commands.emplace_back(commands::Relax{among_the_moves, 1, RelaxationScheme::mean});
  const Case one = object(grid, moves);
  const Progress job = Progress::watched();
  std::atomic<std::clock_t> asked = 0;
  const std::clock_t begun = std::clock();
  const std::jthread user([&] {
    // Measured in this program's processor time, so that it is running by then even on a busy machine.
    chainmail::test::wait_until([&] { return std::clock() - begun > CLOCKS_PER_SEC / 30; });
    asked = std::clock();
    job.cancel();
  });
  // This number of sweeps would take hours.
  const auto comparison = compare({one}, quick({Algorithm::exact}, {after_a_move}), job);
  QVERIFY(comparison.stopped);
  // It may still be in the pass before the sweeps. Processor time, because other programs may run.
  QVERIFY(std::clock() - asked < 2 * CLOCKS_PER_SEC);
}

void CompareRunTest::progress_goes_from_0_to_1() {
  std::vector<double> reported;
  const Progress job = Progress::watched([&](double fraction, const std::string& text) {
    reported.push_back(fraction);
    QVERIFY(fraction == 1 || text == "object, drag");
  });
  compare({jittered(), jittered()}, quick({Algorithm::spiral}), job);
  QCOMPARE(job.text(), std::string("done"));
  QVERIFY(reported.size() > 4);
  QCOMPARE(reported.front(), 0.0);
  QCOMPARE(reported.back(), 1.0);
  QVERIFY(std::is_sorted(reported.begin(), reported.end()));
}

void CompareRunTest::contradicting_pins_are_told() {
  // Element 1 is dragged and pinned there. Then 3 is pinned far away, in the same recording.
  const auto line = make_mesh(MeshKind::line, {4, 1, 1});
  RecordedMoves moves = drag(*line, 3, {9, 0, 0}, 1);
  moves.commands.insert(moves.commands.end(), {commands::Release{}, commands::Pin{{0, 3}}, commands::Grab{1},
                                               commands::Drag{Point(2, 0, 0)}, commands::Drag{Point(3, 0, 0)}});
  Case one = object(line, moves);
  one.pins = {1};
  const auto result = compare_one(one, quick({Algorithm::natural_queue, Algorithm::exact}));
  // No contestant can grab a pinned element: all are listed with the reason.
  for (const Entry& entry : result.entries) {
    QVERIFY(!entry.measurement && QString::fromStdString(entry.refusal).contains("pinned"));
  }
  QVERIFY(!result.no_exact.empty());
}

void CompareRunTest::wrong_moves_and_numbers_are_refused() {
  const auto line = make_mesh(MeshKind::line, {4, 1, 1});
  const RecordedMoves good = drag(*line, 0, {-1, 0, 0});
  RecordedMoves none{"none", "", {commands::Grab{0}}}, undo = good, other = good;
  undo.commands.emplace_back(commands::RestoreState{1});
  other.commands.emplace_back(commands::ReplaceMesh{line});
  for (const RecordedMoves& moves : {none, undo, other}) {
    QVERIFY_EXCEPTION_THROWN(compare({object(line, moves)}, quick()), Error);
  }
  for (const std::vector<int>& sweeps : {std::vector<int>{}, {0, -1}}) {
    QVERIFY_EXCEPTION_THROWN(compare({object(line, good)}, quick({}, sweeps)), Error);
  }
  auto options = quick();
  options.repetitions = 0;
  QVERIFY_EXCEPTION_THROWN(compare({object(line, good)}, options), Error);
  options = quick();
  options.relax_step = 0;
  QVERIFY_EXCEPTION_THROWN(compare({object(line, good)}, options), Error);
}

CHAINMAIL_TEST(CompareRunTest)

}  // namespace chainmail::test_compare_run

#include "test_compare_run.moc"
