#include <QtTest>

#include "calibrate/calibrate.h"
#include "calibrate/optimum.h"
#include "core/support.h"
#include "mesh/error.h"
#include "mesh/layers.h"

using namespace chainmail;
using chainmail::test::make_mesh;

/// Calibration: the search, and what it finds on a tiny sheet.
class CalibrateTest : public QObject {
  Q_OBJECT

 private slots:
  void an_optimum_is_found_within_its_bounds_data();
  void an_optimum_is_found_within_its_bounds();
  void what_is_thrown_comes_through();
  void it_comes_closer();
  void it_is_the_same_each_time();
  void more_evaluations_are_no_worse();
  void it_tells_its_progress_and_is_cancelled();
  void what_makes_no_sense_is_refused();
};

namespace {

const MeshPointer sheet = make_mesh(MeshKind::cloth, {5, 5, 1});

CalibrationOptions quick() {
  CalibrationOptions options;
  options.pins = layer(*sheet, *find_side("top"));
  options.drags = 2;
  options.evaluations = 40;
  return options;
}

CalibrationResult found(const CalibrationOptions& options) { return calibrate(sheet, Cuts(sheet), options); }

}  // namespace

void CalibrateTest::an_optimum_is_found_within_its_bounds_data() {
  QTest::addColumn<Search>("search");
  QTest::addColumn<double>("x");
  QTest::addColumn<double>("y");
  for (const Search search : {Search::everywhere, Search::about_a_point}) {
    const char* name = search == Search::everywhere ? "everywhere" : "about a point";
    QTest::addRow("%s, inside", name) << search << 0.3 << 2.5;
    QTest::addRow("%s, beyond a corner", name) << search << -1.0 << 9.0;
  }
}

void CalibrateTest::an_optimum_is_found_within_its_bounds() {
  QFETCH(Search, search);
  QFETCH(double, x);
  QFETCH(double, y);
  int asked = 0;
  const Optimum optimum = find_optimum(search, {0, 1}, {1, 3}, {1, 1}, 200, [&](const std::vector<double>& at) {
    ++asked;
    [&] { QVERIFY(at[0] >= 0 && at[0] <= 1 && at[1] >= 1 && at[1] <= 3); }();
    return std::abs(at[0] - x) + std::abs(at[1] - y);  // no derivative at its least
  });
  QVERIFY(asked <= 200);
  // A hundredth of the ranges: what 200 evaluations reach with ease, and a grid of as many would not.
  QVERIFY(std::abs(optimum.at[0] - std::clamp(x, 0.0, 1.0)) < 0.01);
  QVERIFY(std::abs(optimum.at[1] - std::clamp(y, 1.0, 3.0)) < 0.02);
}

void CalibrateTest::what_is_thrown_comes_through() {
  int asked = 0;
  const auto fails = [&](const std::vector<double>&) -> double {
    ++asked;
    throw Cancelled();
  };
  QVERIFY_EXCEPTION_THROWN(find_optimum(Search::everywhere, {0, 0}, {1, 1}, {0, 0}, 100, fails), Cancelled);
  QCOMPARE(asked, 1);
}

void CalibrateTest::it_comes_closer() {
  for (const Algorithm algorithm : {Algorithm::exact, Algorithm::natural_queue}) {
    CalibrationOptions options = quick();
    options.algorithm = algorithm;
    const CalibrationResult result = found(options);
    QVERIFY(result.rms > 0 && result.rms < 0.9 * result.rms_before);
    QCOMPARE(result.evaluations, 40);
    const auto& [compression, stretch, shear] = result.softness;
    QVERIFY(compression >= 0 && compression <= 1 && stretch >= 1 && stretch <= 3 && shear >= 0 && shear <= 2);
    QCOMPARE(result.drags.size(), std::size_t{2});
    double before = 0, after = 0, worst = 0;
    for (const CalibrationDrag& drag : result.drags) {
      before += drag.before.rms / 2;
      after += drag.after.rms / 2;
      worst = std::max(worst, drag.after.max);
    }
    QVERIFY(std::abs(before - result.rms_before) < 1e-15 && std::abs(after - result.rms) < 1e-15);
    QCOMPARE(worst, result.max);
  }
}

void CalibrateTest::it_is_the_same_each_time() {
  const CalibrationResult first = found(quick());
  QVERIFY(found(quick()) == first);
  CalibrationOptions other = quick();
  other.seed = 2;
  const CalibrationResult second = found(other);
  QVERIFY(second.drags[0].target != first.drags[0].target);
  // Pins in another order, or twice, are the same pins.
  CalibrationOptions same = quick();
  std::ranges::reverse(same.pins);
  same.pins.push_back(same.pins.front());
  QVERIFY(found(same) == first);
}

void CalibrateTest::more_evaluations_are_no_worse() {
  double last = std::numeric_limits<double>::infinity();
  for (const int evaluations : {1, 20, 80}) {
    CalibrationOptions options = quick();
    options.evaluations = evaluations;
    const CalibrationResult result = found(options);
    QVERIFY(result.evaluations <= evaluations);
    QVERIFY(result.rms <= result.rms_before && result.rms <= last);
    last = result.rms;
  }
}

void CalibrateTest::it_tells_its_progress_and_is_cancelled() {
  JobState job;
  calibrate(sheet, Cuts(sheet), quick(), Progress(job));
  QCOMPARE(job.share.load(), 1.0);
  job.cancelled = true;
  QVERIFY_EXCEPTION_THROWN(calibrate(sheet, Cuts(sheet), quick(), Progress(job)), Cancelled);
}

void CalibrateTest::what_makes_no_sense_is_refused() {
  const auto refused = [](const char* where, auto change) {
    CalibrationOptions options = quick();
    change(options);
    try {
      found(options);
    } catch (const Error& error) {
      return QString::fromStdString(error.where()) == where;
    }
    return false;
  };
  QVERIFY(refused("pins", [](auto& options) { options.pins = {}; }));
  QVERIFY(refused("pins", [](auto& options) { options.pins = {0, 25}; }));
  QVERIFY(refused("pins", [](auto& options) {
    for (ElementId e = 0; e < 25; ++e) {
      options.pins.push_back(e);
    }
  }));
  QVERIFY(refused("poisson", [](auto& options) { options.elastic.material.poisson = 0.5; }));
  QVERIFY(refused("young", [](auto& options) { options.elastic.material.young = 0; }));
  QVERIFY(refused("drags", [](auto& options) { options.drags = 0; }));
  QVERIFY(refused("evaluations", [](auto& options) { options.evaluations = 0; }));
  QVERIFY(refused("algorithm", [](auto& options) { options.algorithm = Algorithm::linear_fem; }));
}

QTEST_APPLESS_MAIN(CalibrateTest)
#include "test_calibrate.moc"
