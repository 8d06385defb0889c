#include <QtTest>
#include <cmath>

#include "core/support.h"
#include "measure/distance.h"
#include "measure/pass_times.h"
#include "program.h"

namespace chainmail::test_measures {

using namespace chainmail::test;

/// Distances between states, ratios, and the spread of times, compared with figures computed by hand.
class MeasuresTest : public QObject {
  Q_OBJECT

 private slots:
  void distance_by_hand();
  void distance_is_in_mean_rest_lengths();
  void distance_between_precisions();
  void energy_ratio_is_none_at_0();
  void largest_over_handle_by_hand();
  void a_hand_that_is_back_gives_no_ratio();
  void spread_by_hand();
  void spread_of_few();
};

namespace {

std::unique_ptr<Deformer> at(const MeshPointer& mesh, const std::vector<double>& positions,
                             Precision precision = Precision::double_precision) {
  auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, precision);
  solver->body().set_positions(positions);
  return solver;
}

}  // namespace

void MeasuresTest::distance_by_hand() {
  const auto mesh = make_mesh(MeshKind::line, {4, 1, 1}, 2);
  const auto one = at(mesh, {0, 0, 1, 0, 2, 0, 3, 0});
  const auto other = at(mesh, {0, 0, 1, 0, 2, 0, 6, 4});  // the last one by (3, 4)
  const Distance distance = measure_distance(*mesh, one->body().positions(), other->body().positions());
  QCOMPARE(distance.max, 5.0);
  QCOMPARE(distance.rms, 2.5);
  QVERIFY(distance == measure_distance(*mesh, other->body().positions(), one->body().positions()));
  QVERIFY(measure_distance(*mesh, one->body().positions(), one->body().positions()) == Distance{});
}

void MeasuresTest::distance_is_in_mean_rest_lengths() {
  const auto mesh = make_mesh(MeshKind::line, {2, 1, 1}, {}, 4);
  QCOMPARE(measure_distance(*mesh, at(mesh, {0, 4})->body().positions(), at(mesh, {2, 4})->body().positions()).max,
           0.5);
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {4, 0, 0}};  // no link, so no rest length
  const auto unlinked = build_mesh(std::move(parts));
  QCOMPARE(
      measure_distance(*unlinked, at(unlinked, {0, 4})->body().positions(), at(unlinked, {2, 4})->body().positions())
          .max,
      2.0);
}

void MeasuresTest::distance_between_precisions() {
  const auto mesh = make_mesh(MeshKind::line, {2, 1, 1});
  const auto in_float = at(mesh, {0, 0.1}, Precision::single_precision);
  const auto in_double = at(mesh, {0, 0.1});
  QCOMPARE(measure_distance(*mesh, in_float->body().positions(), in_double->body().positions()).max,
           double(0.1F) - 0.1);
}

void MeasuresTest::energy_ratio_is_none_at_0() {
  QCOMPARE(energy_ratio(3, 2).value(), 1.5);
  QCOMPARE(energy_ratio(0, 2).value(), 0.0);
  QVERIFY(!energy_ratio(3, 0));
  QVERIFY(!energy_ratio(0, 0));
}

void MeasuresTest::largest_over_handle_by_hand() {
  const auto mesh = make_mesh(MeshKind::line, {3, 1, 1}, 2);
  const auto solver = at(mesh, {0, 2, 1, 0, 5, 4});  // the handle moved by 2, the last element by (3, 4)
  QCOMPARE(largest_over_handle(*mesh, solver->body().positions(), std::array{ElementId{0}}).value(), 2.5);
  QCOMPARE(largest_over_handle(*mesh, solver->body().positions(), std::array{ElementId{2}}).value(), 1.0);
}

void MeasuresTest::a_hand_that_is_back_gives_no_ratio() {
  const auto mesh = make_mesh(MeshKind::line, {3, 1, 1}, {}, 0.1);
  // 1e-4 mean rest lengths are 1e-5 here.
  QVERIFY(!largest_over_handle(*mesh, at(mesh, {0.9e-5, 0.1, 0.5})->body().positions(), std::array{ElementId{0}}));
  QVERIFY(largest_over_handle(*mesh, at(mesh, {1.1e-5, 0.1, 0.5})->body().positions(), std::array{ElementId{0}}));
}

void MeasuresTest::spread_by_hand() {
  // Sorted: 1 2 3 4 10. The quartiles are the second and the fourth.
  QVERIFY(spread_of({10, 1, 3, 2, 4}) == (TimeSpread{3, 2, 4, 1, 10, 5}));
  // Sorted: 0 1 2 10. The median is between 1 and 2. The quartiles are at 3/4 and 9/4 of the way from the first.
  QVERIFY(spread_of({2, 0, 10, 1}) == (TimeSpread{1.5, 0.75, 4, 0, 10, 4}));
}

void MeasuresTest::spread_of_few() {
  QVERIFY(spread_of({}) == TimeSpread{});
  QVERIFY(spread_of({7}) == (TimeSpread{7, 7, 7, 7, 7, 1}));
  QVERIFY(spread_of({4, 8}) == (TimeSpread{6, 5, 7, 4, 8, 2}));
}

CHAINMAIL_TEST(MeasuresTest)

}  // namespace chainmail::test_measures

#include "test_measures.moc"
