#include <QtTest>
#include <cmath>
#include <numbers>
#include <set>
#include <sstream>

#include "core/families.h"
#include "program.h"
#include "report/page/report.h"
#include "report/page/tables.h"
#include "report/run/ramp.h"
#include "report/run/scripted_drags.h"
#include "report/table/growth.h"

namespace chainmail::test_ramp {

using namespace chainmail::report;
using namespace chainmail::report::figures;
using namespace chainmail::test;

/// The ramp: its figures, its drags, and when an algorithm drops out. Times come from a clock that the test controls.
class RampTest : public QObject {
  Q_OBJECT

 private slots:
  void percentiles();
  void growth_of_a_power_law();
  void growth_needs_three_sizes();
  void drags_repeat_with_their_seed();
  void drags_are_a_hands();
  void drags_keep_to_the_scenes_axes();
  void a_race_gives_second_attempts();
  void every_size_and_algorithm_has_a_row();
  void all_make_the_same_moves();
  void every_attempt_has_drags_of_its_own();
  void a_budget_may_be_used_up();
  void a_lost_algorithm_is_out();
  void a_hiccup_does_not_count();
  void what_others_take_does_not_count();
  void it_stops();
};

namespace {

/// Clocks on which every pass takes this long (ms).
class Time {
 public:
  Clocks clocks() {
    return {[this] { return read(wall_, wall_ms); }, [this] { return read(own_, own_ms); }};
  }
  void set(double ms) { wall_ms = own_ms = ms; }

  double wall_ms = 1;
  double own_ms = 1;

 private:
  /// Each reading is one pass later than the last one.
  static double read(double& seconds, double ms) { return seconds += ms / 1000; }

  double wall_ = 0, own_ = 0;
};

RampOptions options_of(Time& time, std::uint64_t largest, std::vector<Algorithm> algorithms = {}) {
  RampOptions options;
  options.algorithms = std::move(algorithms);
  options.largest = largest;
  options.drags = 3;
  options.moves = 8;
  options.clocks = time.clocks();
  return options;
}

/// Returns a job whose watcher hears of the width of each drag, and whether its size is repeated.
Progress heard(std::function<void(int width, bool repeated)> hear) {
  return Progress::watched([hear = std::move(hear)](double, const std::string& text) {
    hear(std::stoi(text), text.find("repeated") != std::string::npos);
  });
}

std::vector<std::string> sizes_of(const Results& ramp) {
  std::vector<std::string> sizes;
  for (const ObjectInfo& grid : ramp.objects) {
    sizes.push_back(grid.name);
  }
  return sizes;
}

std::string text_of(const Results& ramp) {
  std::ostringstream out;
  write_text(out, ramp);
  return out.str();
}

bool same(const ScriptedDrag& a, const ScriptedDrag& b) { return a.element == b.element && a.targets == b.targets; }

}  // namespace

void RampTest::percentiles() {
  std::vector<double> values;
  for (int i = 100; i > 0; --i) {
    values.push_back(i);
  }
  QCOMPARE(percentile(values, 0.99), 99.0);
  QCOMPARE(percentile(values, 0.5), 50.0);
  QCOMPARE(percentile(values, 1), 100.0);
  QCOMPARE(percentile(values, 0.001), 1.0);
  QCOMPARE(percentile({3, 1, 2}, 0.99), 3.0);
  QCOMPARE(percentile({3, 1, 2}, 0.5), 2.0);
  QCOMPARE(percentile({7}, 0.5), 7.0);
}

void RampTest::growth_of_a_power_law() {
  std::vector<SizedTime> times{{100, 5}, {999, 7}};  // below the first size that counts
  for (const double n : {1000.0, 3000.0, 10'000.0, 2e5}) {
    times.push_back({n, 0.25 * std::pow(n, 1.5)});
  }
  const auto growth = growth_of(times, 1000);
  QVERIFY(growth.has_value());
  QVERIFY(std::abs(growth->power - 1.5) < 1e-12);  // a few roundings of logarithms
  QCOMPARE(growth->from, 1000.0);
  QCOMPARE(growth->to, 2e5);
  QCOMPARE(growth->sizes, 4);
  // Computed by hand: (ln n, ln ms) = (0, 0), (1, 2), (2, 1) has the slope 1/2.
  const double e = std::numbers::e;
  QVERIFY(std::abs(growth_of(std::vector<SizedTime>{{1, 1}, {e, e * e}, {e * e, e}}, 0)->power - 0.5) < 1e-12);
}

void RampTest::growth_needs_three_sizes() {
  const std::vector<SizedTime> times{{10, 1}, {100, 1}, {1000, 2}, {2000, 4}};
  QVERIFY(!growth_of(times, 1000));
  QVERIFY(growth_of(times, 100));
  QVERIFY(!growth_of(std::vector<SizedTime>{{1000, 0}, {2000, 1}, {3000, 1}}, 1000));  // no logarithm of 0
  QVERIFY(!growth_of(std::vector<SizedTime>{{1000, 1}, {1000, 2}, {1000, 3}}, 1000));
  QVERIFY(!growth_of({}, 0));
}

void RampTest::drags_repeat_with_their_seed() {
  const auto mesh = make_mesh(MeshKind::grid, {20, 20, 1});
  const auto once = scripted_drags(*mesh, 5, 4, 30), again = scripted_drags(*mesh, 5, 4, 30),
             other = scripted_drags(*mesh, 6, 4, 30);
  QCOMPARE(once.size(), std::size_t{4});
  for (std::size_t i = 0; i < 4; ++i) {
    QVERIFY(same(once[i], again[i]));
    QVERIFY(!same(once[i], other[i]));
    QVERIFY(i == 0 || !same(once[i], once[i - 1]));
  }
}

void RampTest::drags_are_a_hands() {
  const auto mesh = make_mesh(MeshKind::grid, {26, 26, 1}, {}, 2);
  const double width = 50;
  for (const ScriptedDrag& drag : scripted_drags(*mesh, 1, 200, 30)) {
    QVERIFY(drag.element < mesh->element_count());
    QCOMPARE(drag.targets.size(), std::size_t{30});
    Point last = mesh->rest_position(drag.element), last_step = Point::Zero();
    double path = 0, turned = 0;
    for (const Point& target : drag.targets) {
      QVERIFY(target.allFinite() && target.z() == 0);
      const Point step = target - last;
      path += step.norm();
      // It turns by at most 0.15 more than before, and keeps 0.8 of the last turn: 0.75 at most.
      QVERIFY(last_step.isZero() || step.dot(last_step) >= std::cos(0.75) * step.norm() * last_step.norm());
      turned += std::abs(last_step.x() * step.y() - last_step.y() * step.x());
      last = target;
      last_step = step;
    }
    QVERIFY(turned > 1e-3 * width);  // the handle never moves straight ahead
    // On average 2% of the width per move, half or twice that. The mean of the half sine is 1 to 0.2% for 30 moves.
    QVERIFY(path > 0.998 * 30 * 0.01 * width && path < 1.002 * 30 * 0.04 * width);
  }
}

void RampTest::drags_keep_to_the_scenes_axes() {
  const auto line = make_mesh(MeshKind::line, {9, 1, 1});
  const auto upright =
      build_mesh(placed(*make_mesh(MeshKind::grid, {5, 5, 1}), [](const Point& p) { return Point(p[0], 2.5, p[1]); }));
  double moved = 0;
  for (const ScriptedDrag& drag : scripted_drags(*line, 1, 5, 10)) {
    for (const Point& target : drag.targets) {
      QVERIFY(target.y() == 0 && target.z() == 0);
    }
  }
  for (const ScriptedDrag& drag : scripted_drags(*upright, 1, 5, 10)) {
    for (const Point& target : drag.targets) {
      QCOMPARE(target.y(), 2.5);
      moved = std::max(moved, std::abs(target.z() - upright->rest_position(drag.element).z()));
    }
  }
  QVERIFY(moved > 0);
}

void RampTest::a_race_gives_second_attempts() {
  RampRace race({4, 5}, {Algorithm::exact, Algorithm::spiral}, 0.001);
  const RampPasses fast{{0.5, 0.5}, 4}, slow{{2, 2}, 4};  // ms
  QVERIFY(race.finish_attempt(std::vector{slow, fast}).empty());
  QCOMPARE(race.width(), 4U);
  QCOMPARE(race.attempt(), 1);
  QCOMPARE(race.attempting(), std::vector{Algorithm::exact});
  const auto of = [](const std::vector<Row>& rows, Algorithm algorithm, const Figure& figure) {
    const auto found = std::ranges::find(rows, Contestant{algorithm}, &Row::contestant);
    return found == rows.end() ? -1 : (*found)[figure].value();
  };
  auto rows = race.finish_attempt(std::vector{fast});
  QCOMPARE(rows.size(), std::size_t{2});
  QVERIFY(of(rows, Algorithm::exact, repeated) == 1 && of(rows, Algorithm::exact, real_time) == 1);
  QVERIFY(of(rows, Algorithm::spiral, repeated) == 0 && of(rows, Algorithm::spiral, real_time) == 1);
  QCOMPARE(race.width(), 5U);
  QCOMPARE(race.attempting().size(), std::size_t{2});
  QVERIFY(race.finish_attempt(std::vector{fast, slow}).empty());
  rows = race.finish_attempt(std::vector{slow});
  QCOMPARE(of(rows, Algorithm::spiral, real_time), 0.0);
  QCOMPARE(race.in_race(), std::vector{Algorithm::exact});
  QVERIFY(race.is_over());  // no size is left
}

void RampTest::every_size_and_algorithm_has_a_row() {
  Time time;
  const Results result = ramp(options_of(time, 49));
  QCOMPARE(sizes_of(result), (std::vector<std::string>{"4x4", "5x5", "6x6", "7x7"}));
  QCOMPARE(result.rows.size(), 4 * algorithms().size());
  QVERIFY(!result.stopped);
  for (const Row& row : result.rows) {
    const std::size_t width = row.object + 4;
    QCOMPARE(result.object_of(row).elements, std::uint64_t{width * width});
    QCOMPARE(result.object_of(row).links, std::uint64_t{2 * width * (width - 1)});
    QCOMPARE(row[passes].value(), 3.0 * 8);
    QVERIFY(std::abs(*row[median_ms] - 1) < 1e-9 && std::abs(*row[p99_ms] - 1) < 1e-9);  // of a clock near 1 s
    QVERIFY(row[real_time] == 1.0 && row[repeated] == 0.0 && row[mean_moved] > 0.0);
  }
  const auto verdicts = ramp_verdicts(result);
  QCOMPARE(verdicts.size(), algorithms().size());
  for (const RampVerdict& verdict : verdicts) {
    QCOMPARE(verdict.largest, std::optional<std::size_t>(3));
    QVERIFY(!verdict.lost && !verdict.growth);
  }
  std::ostringstream csv;
  write_csv(csv, result);
  const std::string lines = csv.str();
  QVERIFY2(
      lines.starts_with("width,elements,links,algorithm,passes,median_ms,p99_ms,mean_moved,repeated,real_time\n4,"),
      lines.c_str());
  QCOMPARE(std::ranges::count(lines, '\n'), std::ptrdiff_t(1 + result.rows.size()));
  QVERIFY(text_of(result).find("7x7 or more") != std::string::npos);
}

void RampTest::all_make_the_same_moves() {
  // Spiral and Natural Queue end in the same positions, bit for bit, so the same moves move the same number of
  // elements.
  Time time;
  const auto two = ramp(options_of(time, 400, {Algorithm::natural_queue, Algorithm::spiral})).rows;
  for (std::size_t i = 0; i < two.size(); i += 2) {
    QCOMPARE(two[i].object, two[i + 1].object);
    QCOMPARE(two[i][mean_moved].value(), two[i + 1][mean_moved].value());
  }
  // Neither other contestants nor their order change the moves. Another seed does.
  const auto alone = ramp(options_of(time, 400, {Algorithm::spiral})).rows;
  auto options = options_of(time, 400, {Algorithm::spiral});
  options.seed = 2;
  const auto other = ramp(options).rows;
  QCOMPARE(2 * alone.size(), two.size());
  bool differs = false;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    QCOMPARE(alone[i][mean_moved].value(), two[2 * i][mean_moved].value());
    differs |= alone[i][mean_moved] != other[i][mean_moved];
  }
  QVERIFY(differs);
}

/// A second attempt at a size shows whether the first one was bad luck, so it must use other drags.
void RampTest::every_attempt_has_drags_of_its_own() {
  std::set<std::uint64_t> seeds;
  for (std::uint32_t width = 4; width < 100; ++width) {
    for (const int attempt : {0, 1}) {
      seeds.insert(ramp_seed(1, width, attempt));
      seeds.insert(ramp_seed(2, width, attempt));
    }
  }
  QCOMPARE(seeds.size(), std::size_t(4 * 96));
}

void RampTest::a_budget_may_be_used_up() {
  const auto in_time = [](double ms) {
    return ramp_row(Algorithm::spiral, {std::vector<double>(10, ms), 20}, 0.016)[real_time] == 1.0;
  };
  QVERIFY(in_time(16));
  QVERIFY(!in_time(16.001));
}

void RampTest::a_lost_algorithm_is_out() {
  Time time;
  const Progress slow_from_7 = heard([&](int width, bool) { time.set(width < 7 ? 16 : 17); });
  const Results result = ramp(options_of(time, 400, {Algorithm::spiral}), slow_from_7);
  QCOMPARE(sizes_of(result), (std::vector<std::string>{"4x4", "5x5", "6x6", "7x7"}));
  QVERIFY(result.rows[3][repeated] == 1.0 && result.rows[3][real_time] == 0.0 && result.rows[2][repeated] == 0.0);
  const RampVerdict verdict = ramp_verdicts(result).at(0);
  QVERIFY(verdict.lost && verdict.largest == 2);
  QVERIFY(text_of(result).find(" 6x6 ") != std::string::npos && text_of(result).find("17/17!") != std::string::npos);
  const auto marks = plots_of(result).at(0).plot.panels.at(0).marks;
  QVERIFY(marks.size() == 4 && marks[3].hollow && !marks[2].hollow);  // hollow above the budget

  time.set(17);
  const Results never = ramp(options_of(time, 400, {Algorithm::spiral, Algorithm::exact}));
  QCOMPARE(sizes_of(never), std::vector<std::string>{"4x4"});
  QVERIFY(ramp_verdicts(never).at(0).lost && !ramp_verdicts(never).at(0).largest);
  QVERIFY(text_of(never).find("never in real time") != std::string::npos);
}

void RampTest::a_hiccup_does_not_count() {
  Time time;
  const Progress slow_once = heard([&](int width, bool repeats) { time.set(width == 6 && !repeats ? 1000 : 1); });
  const Results result = ramp(options_of(time, 64, {Algorithm::spiral}), slow_once);
  QCOMPARE(result.objects.size(), std::size_t{5});  // to 8x8
  QVERIFY(result.rows[2][repeated] == 1.0 && result.rows[2][real_time] == 1.0 && result.rows[2][p99_ms] < 2.0);
  QVERIFY(!ramp_verdicts(result).at(0).lost);
}

void RampTest::what_others_take_does_not_count() {
  Time time;
  time.wall_ms = 1000;
  const auto waited = ramp(options_of(time, 16, {Algorithm::spiral}));
  QVERIFY(waited.rows[0][p99_ms] < 2.0 && waited.rows[0][repeated] == 0.0);
  // Reading the thread's own clock is slower. This must not make a pass longer.
  time.wall_ms = 1;
  time.own_ms = 1000;
  QVERIFY(ramp(options_of(time, 16, {Algorithm::spiral})).rows[0][p99_ms] < 2.0);
  // The clocks of the machine run, and not backwards.
  const Clocks clocks = machine_clocks();
  volatile double sum = 0;
  const double seconds = seconds_of(clocks, [&] {
    for (int i = 0; i < 1'000'000; ++i) {
      sum = sum + i;
    }
  });
  QVERIFY(seconds > 1e-5 && seconds < 10);  // a million additions, on any machine
}

/// The size in which it stops is missing.
void RampTest::it_stops() {
  Time time;
  Progress job;
  job = heard([&](int width, bool) { job.cancel(width == 6); });
  const Results result = ramp(options_of(time, 400, {Algorithm::spiral}), job);
  QVERIFY(result.stopped);
  QCOMPARE(sizes_of(result), (std::vector<std::string>{"4x4", "5x5"}));
  QCOMPARE(ramp_verdicts(result).at(0).largest, std::optional<std::size_t>(1));
  const Results nothing = ramp(options_of(time, 400), job);
  QVERIFY(nothing.stopped && nothing.rows.empty() && ramp_verdicts(nothing).empty());
  QCOMPARE(text_of(nothing), std::string("It was stopped before its end.\n"));
}

CHAINMAIL_TEST(RampTest)

}  // namespace chainmail::test_ramp

#include "test_ramp.moc"
