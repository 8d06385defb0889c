#include <QElapsedTimer>
#include <QtTest>

#include "core/simulations.h"
#include "program.h"

namespace chainmail::test_relaxation_deadline {

using namespace chainmail::test;

/// Relaxation stops after 10 s, because a large object would take minutes to come to rest.
class RelaxationDeadlineTest : public QObject {
  Q_OBJECT

 private slots:
  void relaxation_sleeps_after_ten_seconds();
};

void RelaxationDeadlineTest::relaxation_sleeps_after_ten_seconds() {
  Simulation simulation(make_mesh(MeshKind::grid, {512, 512, 1}), Algorithm::natural_queue,
                        Precision::single_precision);
  carry_out(simulation, commands::SetRelaxation{true, 1});
  drag_by(simulation, 0, Point(-200, -100, 0));
  QElapsedTimer timer;
  timer.start();
  // A slice takes some milliseconds, also with a sanitizer. The limit of a minute is for a busy machine.
  while (simulation.continue_relaxation() && timer.elapsed() < 60'000) {
  }
  QVERIFY(!simulation.statistics().relaxing);
  QVERIFY2(timer.elapsed() >= 9'900, "it came to rest before the deadline: the object is too small for this test");
}

CHAINMAIL_TEST(RelaxationDeadlineTest)

}  // namespace chainmail::test_relaxation_deadline

#include "test_relaxation_deadline.moc"
