#include <QtTest>
#include <atomic>
#include <chrono>
#include <ctime>
#include <thread>
#include <tuple>

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
  void who_takes_too_long_is_left_out();
  void stops_at_once();
  void what_is_finished_stays();
  void stops_between_repetitions();
  void stops_between_sweeps_data();
  void stops_between_sweeps();
  void progress_goes_from_0_to_1();
  void contradicting_pins_are_told();
  void wrong_moves_and_numbers_are_refused();
};

void CompareRunTest::repetitions_are_counted() {
  // A drag of four moves reads the clocks a few dozen times.
  for (const auto& [seconds_of_reading, seconds, count] :
       {std::tuple(1e-4, 0.0, 3), {1e-4, 1e3, 51}, {1.0, 1e3, 1}}) {  // at least, at most, and a slow drag
    DrivenClocks driven(seconds_of_reading);
    auto options = quick({Algorithm::spiral});
    options.clocks = driven.clocks();
    options.repetitions.reset();
    options.seconds = seconds;
    const Row row = compare({jittered()}, options).rows.at(0);
    const TimeSpread spread = row.find(figures::ms_per_move)->spread.value();
    QCOMPARE(spread.count, count);
    QVERIFY(0 < spread.min && spread.min <= spread.lower_quartile && spread.lower_quartile <= spread.median);
    QVERIFY(spread.median <= spread.upper_quartile && spread.upper_quartile <= spread.max);
    QVERIFY(row[figures::worst_move_ms].value() >= row[figures::first_ms].value());
  }
  QCOMPARE(row_of(jittered(), Algorithm::spiral).find(figures::ms_per_move)->spread->count, 2);
}

/// One of them would take many minutes.
void CompareRunTest::who_takes_too_long_is_left_out() {
  const auto mesh = chainmail::test::jittered_triangles(40, 40, 1);
  Case one = object(mesh, drag(*mesh, 27, {4, 2, 0}));
  one.drags.push_back(one.drags[0]);
  auto options = quick({Algorithm::exact}, {0, 100'000'000});
  options.longest = 1;
  const Results result = compare({one}, options);
  QVERIFY(!result.stopped);
  for (const std::size_t drag : {0, 1}) {
    QVERIFY(row_of(result, 0, drag, {Algorithm::exact}).has_figures());
    const Row& slow = row_of(result, 0, drag, {Algorithm::exact, 100'000'000});
    QVERIFY(!slow.has_figures());
    QVERIFY2(slow.refusal.starts_with("left out after 1 s;"), slow.refusal.c_str());
  }
}

void CompareRunTest::stops_at_once() {
  const Progress job = Progress::watched();
  job.cancel();
  const Results result = compare({jittered()}, quick(), job);
  QVERIFY(result.stopped);
  QVERIFY(result.objects.at(0).drags.empty() && result.rows.empty());
}

void CompareRunTest::what_is_finished_stays() {
  Case one = jittered();
  one.drags.push_back(one.drags[0]);
  const Progress job = Progress::watched();
  std::size_t rows = 0;
  const Results result = compare({one}, quick(), job, [&](const Results& finished) {
    rows = finished.rows.size();
    job.cancel();
  });
  QVERIFY(result.stopped);
  QCOMPARE(result.objects.at(0).drags.size(), std::size_t{1});
  QCOMPARE(rows, algorithms().size());
  QCOMPARE(result.rows.size(), rows);
}

void CompareRunTest::stops_between_repetitions() {
  auto options = quick();
  options.repetitions = 1'000'000'000;  // would take years
  int reported = 0;
  Progress job;
  job = Progress::watched([&](double, const std::string&) {
    if (++reported == 10) {
      job.cancel();
    }
  });
  const Results result = compare({jittered()}, options, job);
  QVERIFY(result.stopped);
  QCOMPARE(reported, 10);
  QVERIFY(result.objects.at(0).drags.empty());
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
  const Results result = compare({one}, quick({Algorithm::exact}, {after_a_move}), job);
  QVERIFY(result.stopped);
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
  const Results result = compare({one}, quick({Algorithm::natural_queue, Algorithm::exact}));
  // No contestant can grab a pinned element: all are listed with the reason.
  QCOMPARE(result.rows.size(), std::size_t{2});
  for (const Row& row : result.rows) {
    QVERIFY(!row.has_figures() && QString::fromStdString(row.refusal).contains("pinned"));
  }
  QVERIFY(!result.objects[0].drags[0].no_reference.empty());
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
