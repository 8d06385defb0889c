#include <QtTest>

#include "core/spheres.h"
#include "measure/violation.h"
#include "program.h"
#include "simulate/frame_writer.h"

namespace chainmail::test_frame_space {

using namespace chainmail::test;

/// Objects far from the origin, and of extreme sizes, in single precision.
class FrameSpaceTest : public QObject {
  Q_OBJECT

 private slots:
  void a_usual_object_is_shown_in_its_own_units();
  void positions_keep_their_digits_data() { places(); }
  void positions_keep_their_digits();
  void an_object_answers_alike_wherever_it_lies_data() { places(); }
  void an_object_answers_alike_wherever_it_lies();
  void a_far_object_keeps_how_it_is_stored();

 private:
  static void places();
};

namespace {

MeshPointer sphere(double size, const Point& middle) {
  MeshParts parts = sphere_parts(6, size);
  for (Point& point : parts.rest) {
    point += middle;
  }
  return build_mesh(std::move(parts));
}

/// Drags the lowest element by half of the size, and returns all positions after it about the middle, in sizes.
std::vector<double> dragged(Algorithm algorithm, Precision precision, double size, const Point& middle) {
  Simulation simulation(sphere(size, middle), algorithm, precision);
  simulation.apply(commands::Grab{{0}});
  simulation.apply(commands::Drag{Point(simulation.mesh().rest_position(0) + size * Point(0.5, 0.2, -0.1))});
  std::vector<double> positions(simulation.mesh().rest.size());
  simulation.body().copy_positions(positions);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    positions[i] = (positions[i] - middle[int(i % 3)]) / size;
  }
  return positions;
}

double farthest_apart(const std::vector<double>& one, const std::vector<double>& other) {
  double apart = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    apart = std::max(apart, std::abs(one[i] - other[i]));
  }
  return apart;
}

}  // namespace

void FrameSpaceTest::places() {
  QTest::addColumn<double>("size");
  QTest::addColumn<double>("x");
  QTest::newRow("a survey") << 3.0 << 4.5e6;
  QTest::newRow("a survey, below zero") << 3.0 << -4.5e6;
  QTest::newRow("tiny") << 5e-8 << 0.0;
  QTest::newRow("tiny and far") << 5e-8 << 1e-3;
  QTest::newRow("huge") << 5e12 << 0.0;
  QTest::newRow("huge and far") << 5e12 << 3e17;
}

void FrameSpaceTest::a_usual_object_is_shown_in_its_own_units() {
  const auto mesh = sphere(3, {20, -10, 5});
  const FrameSpace space(*mesh);
  QVERIFY(space.is_of_mesh());
  QCOMPARE(space.unit(), 1.0);
  QCOMPARE(space.into(Point(1, 2, 3)), Point(1, 2, 3));
}

void FrameSpaceTest::positions_keep_their_digits() {
  QFETCH(double, size);
  QFETCH(double, x);
  Simulation simulation(sphere(size, {x, x / 2, -x}), Algorithm::natural_queue, Precision::double_precision);
  FrameExchange frames;
  FrameWriter writer(frames);
  writer.publish(simulation);
  const Frame& frame = frames.latest();
  float farthest = 0;
  for (const float coordinate : frame.positions) {
    farthest = std::max(farthest, std::abs(coordinate));
  }
  QVERIFY2(farthest > 1e-4F && farthest < 1e5F, qPrintable(QString::number(farthest)));
  for (ElementId e = 0; e < simulation.mesh().element_count(); ++e) {
    const Point at = simulation.mesh().rest_position(e);
    QVERIFY((point_of(*frame.mesh, frame.view(), e) - at).norm() <= 2e-7 * size);
    QVERIFY((frame.space.out_of(frame.space.into(at)) - at).norm() <= 1e-9 * size);
  }
  const Violation violation = measure_violation(*frame.mesh, simulation.body().softness(), {}, frame.view());
  QCOMPARE(violation.fraction, 0.0);
}

/// The same drag of the same object about the origin, of size 1 and in double, is the twin.
void FrameSpaceTest::an_object_answers_alike_wherever_it_lies() {
  QFETCH(double, size);
  QFETCH(double, x);
  for (const Algorithm algorithm : {Algorithm::generalized, Algorithm::natural_queue, Algorithm::exact}) {
    const auto here = dragged(algorithm, Precision::double_precision, 1, Point::Zero());
    const auto there = dragged(algorithm, Precision::single_precision, size, {x, x / 2, -x});
    const double apart = farthest_apart(here, there);
    QVERIFY2(apart < 1e-5, qPrintable(QString::number(apart)));
  }
}

void FrameSpaceTest::a_far_object_keeps_how_it_is_stored() {
  Simulation simulation(sphere(3, {4.5e6, 5.3e6, -1e6}), Algorithm::natural_queue, Precision::single_precision);
  simulation.apply(commands::Grab{{0}});
  simulation.apply(commands::Drag{Point(simulation.mesh().rest_position(0) + Point(1.5, 0.6, -0.3))});
  simulation.apply(commands::Release{});
  for (const Algorithm algorithm : {Algorithm::exact, Algorithm::generalized, Algorithm::natural_queue}) {
    simulation.apply(commands::SetAlgorithm{algorithm});
    const Snapshot before = simulation.snapshot();
    QVERIFY(before.from_rest);
    simulation.apply(commands::Reset{});
    simulation.apply(commands::SetPositions{std::make_shared<const Snapshot>(before)});
    QVERIFY(simulation.snapshot() == before);
  }
}

CHAINMAIL_TEST(FrameSpaceTest)

}  // namespace chainmail::test_frame_space

#include "test_frame_space.moc"
