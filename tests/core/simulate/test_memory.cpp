#include <QtTest>

#include "core/allocations.h"
#include "core/threads.h"
#include "simulate/frame_writer.h"

using namespace chainmail;
using namespace chainmail::test;

/// After warm-up, a simulation that is dragged and shown allocates no memory.
class MemoryTest : public QObject {
  Q_OBJECT

 private slots:
  void passes_and_frames_take_none_data();
  void passes_and_frames_take_none();
};

namespace {

/// Moves a handle back and forth, with all figures and a frame for each move.
void drag_and_show(Simulation& simulation, FrameWriter& writer, FrameExchange& frames) {
  for (int i = 0; i < 40; ++i) {
    simulation.apply(commands::Drag{Point(i % 2 == 0 ? -30 : 5, i % 3, 0)});
    simulation.measure();
    simulation.measure_all();
    writer.publish(simulation);
    if (i % 4 != 0) {
      frames.latest();
    }
  }
}

}  // namespace

void MemoryTest::passes_and_frames_take_none_data() {
  QTest::addColumn<int>("algorithm");
  for (const AlgorithmInfo& one : algorithms()) {
    QTest::newRow(std::string(one.name).c_str()) << int(one.algorithm);
  }
}

void MemoryTest::passes_and_frames_take_none() {
  QFETCH(int, algorithm);
  Simulation simulation(make_mesh(MeshKind::grid, {40, 40, 1}), Algorithm(algorithm), Precision::single_precision);
  FrameExchange frames;
  FrameWriter writer(frames);
  simulation.apply(commands::Cut{{7, 100}});
  simulation.apply(commands::Grab{0});
  drag_and_show(simulation, writer, frames);
  const std::size_t before = allocations.load();
  drag_and_show(simulation, writer, frames);
  QCOMPARE(allocations.load() - before, std::size_t{0});
  QVERIFY(simulation.statistics().last_pass.moved > 0);
}

QTEST_APPLESS_MAIN(MemoryTest)
#include "test_memory.moc"
