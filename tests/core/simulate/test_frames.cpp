#include <QtTest>
#include <set>

#include "core/any_command.h"
#include "core/simulate/frame_reader.h"
#include "core/threads.h"
#include "mesh/error.h"
#include "program.h"
#include "simulate/frame_writer.h"

namespace chainmail::test_frames {

using namespace chainmail::test;

/// A frame of a simulation: all positions, and the blocks that changed.
class FramesTest : public QObject {
  Q_OBJECT

 private slots:
  void whoever_copies_what_changed_has_it_all();
  void what_stays_is_not_copied();
  void an_undone_reset_changes_what_it_brings_back();
  void turned_axes_round_what_is_at_rest();
};

namespace {

/// A simulation and a reader that draws it.
struct Scene {
  explicit Scene(const MeshPointer& mesh, Algorithm algorithm = Algorithm::natural_queue)
      : simulation(mesh, algorithm, Precision::single_precision) {
    show();
  }

  const Frame& show() {
    writer.publish(simulation);
    return frames.latest();
  }
  /// Returns the blocks that changed according to the next frame.
  std::set<std::size_t> changed() {
    const Frame& frame = show();
    std::set<std::size_t> blocks;
    for (std::size_t block = 0; block < frame.changed.size(); ++block) {
      if (frame.changed[block] == frame.number) {
        blocks.insert(block);
      }
    }
    return blocks;
  }

  Simulation simulation;
  FrameExchange frames;
  FrameWriter writer{frames};
};

/// Returns the blocks of the last dragged element and of those that it moved.
std::set<std::size_t> blocks_of_last_pass(const Simulation& simulation) {
  std::set<std::size_t> blocks{simulation.grabbed()[0] / Frame::block_elements};
  for (const ElementId element : simulation.deformer().moved()) {
    blocks.insert(element / Frame::block_elements);
  }
  return blocks;
}

void carry_out_if_it_fits(Simulation& simulation, const Command& command) {
  try {
    simulation.apply(command);
  } catch (const Error&) {
  }
}

}  // namespace

void FramesTest::whoever_copies_what_changed_has_it_all() {
  // From 11 blocks to more than the 64 bits of a word. The last block is not full.
  const std::vector<MeshPointer> meshes{make_mesh(MeshKind::grid, {70, 70, 1}), jittered_triangles(30, 30, 5),
                                        make_mesh(MeshKind::tetra, {9, 9, 9}),
                                        make_mesh(MeshKind::line, {700, 1, 1}, 3)};
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    AnyCommand any(seed, true, meshes, 700, 690);
    Scene scene(meshes[seed % 4], seed % 2 == 0 ? Algorithm::natural_queue : Algorithm::exact);
    FrameReader reader;
    for (int i = 0; i < 100; ++i) {
      carry_out_if_it_fits(scene.simulation, any.draw());
      if (any.below(3) == 0) {
        scene.simulation.continue_relaxation();
      }
      if (any.below(20) == 0) {
        carry_out_if_it_fits(scene.simulation, commands::Relax{1, 0.5, scene.simulation.relaxation().scheme});
      }
      if (any.below(2) == 0) {
        scene.writer.publish(scene.simulation);  // the reader may miss frames
      }
      if (any.below(2) == 0) {
        const Frame& frame = scene.show();
        QVERIFY(frame.mesh == scene.simulation.mesh_pointer());
        QVERIFY(frame.positions == floats_of(scene.simulation));
        QVERIFY2(reader.take(frame), qPrintable(QString("seed %1, command %2").arg(seed).arg(i)));
      }
    }
  }
}

void FramesTest::what_stays_is_not_copied() {
  Scene scene(make_mesh(MeshKind::grid, {64, 64, 1}));  // one block per row
  Simulation& simulation = scene.simulation;
  QCOMPARE(scene.frames.latest().changed.size(), std::size_t{64});
  const std::vector<Command> still{
      commands::Grab{0},         commands::Cut{{5}},        commands::Pin{{9}},
      commands::Unpin{{9}},      commands::Uncut{{5}},      commands::SetSoftness{},
      commands::KeepState{1},    commands::RestoreState{1}, commands::Reset{},
      commands::SetRelaxation{}, commands::Release{},       commands::SetAlgorithm{Algorithm::exact}};
  for (const Command& command : still) {
    carry_out(simulation, command);
    QVERIFY(scene.changed().empty());
  }
  drag_by(simulation, 0, Point(-1, -1, 0));
  QVERIFY(simulation.statistics().last_pass.moved > 10);
  const auto blocks = blocks_of_last_pass(simulation);
  QVERIFY(scene.changed() == blocks && blocks.size() < 32);
  drag_by(simulation, 64 * 63, Point(0, 1, 0));
  QVERIFY(scene.changed() == blocks_of_last_pass(simulation));
  QVERIFY(scene.changed().empty());
}

void FramesTest::an_undone_reset_changes_what_it_brings_back() {
  Scene scene(make_mesh(MeshKind::grid, {64, 64, 1}));
  drag_by(scene.simulation, 0, Point(-1, -1, 0));
  const auto away = scene.changed();
  const auto positions = scene.frames.latest().positions;
  QVERIFY(away.size() < 32);
  carry_out(scene.simulation, commands::KeepState{1});
  carry_out(scene.simulation, commands::Reset{});
  QVERIFY(scene.changed() == away);
  const auto& rest = scene.simulation.mesh().rest;
  QVERIFY(std::equal(rest.begin(), rest.end(), scene.frames.latest().positions.begin()));
  exchange(scene.simulation, 1);
  QVERIFY(scene.changed() == away);
  QVERIFY(scene.frames.latest().positions == positions);
  exchange(scene.simulation, 1);
  QVERIFY(scene.changed() == away);
  // A second reset changes nothing.
  carry_out(scene.simulation, commands::Reset{});
  QVERIFY(scene.changed().empty());
}

void FramesTest::turned_axes_round_what_is_at_rest() {
  const RegionAxes turned(AxesKind::given, Point(0, 0, 0.3));
  for (const AlgorithmInfo& one : algorithms()) {
    const MeshPointer mesh = jittered_triangles(9, 8, 2);
    if (!fits(one.algorithm, *mesh)) {
      continue;
    }
    Scene scene(mesh, one.algorithm);
    for (const Command& command : std::vector<Command>{
             commands::SetSoftness{Softness{{}, {}, standard_energy, turned}}, commands::SetAlgorithm{Algorithm::exact},
             commands::SetAlgorithm{Algorithm::spiral}, commands::SetSoftness{Softness{}}}) {
      scene.simulation.apply(command);
      std::vector<float> positions(mesh->rest.size());
      scene.simulation.body().copy_positions(0, positions);
      QVERIFY2(scene.show().positions == positions, one.name.data());
    }
  }
}

CHAINMAIL_TEST(FramesTest)

}  // namespace chainmail::test_frames

#include "test_frames.moc"
