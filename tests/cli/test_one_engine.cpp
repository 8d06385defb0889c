#include <fstream>
#include <future>

#include "cli/chainmail_program.h"
#include "core/simulations.h"
#include "core/threads.h"
#include "files/mesh/mesh_file.h"
#include "files/session/moves.h"
#include "mesh/layers.h"
#include "program.h"
#include "report/run/runner.h"

namespace chainmail::test_one_engine {

using namespace chainmail::test;

/// The same recorded moves by the window's thread, a comparison and `chainmail deform --script` end at the same bits.
/// tests/python/test_first_drag.py has the same for Python.
class OneEngineTest : public QObject {
  Q_OBJECT

 private slots:
  void all_ways_give_the_same_bits_data();
  void all_ways_give_the_same_bits();
};

namespace {

/// Pins, a handle of many that turns, a cut, an element, and relaxation after each move.
std::vector<Command> moves_of(const Mesh& mesh, const commands::Relax& relax) {
  using namespace commands;
  const std::vector<ElementId> right = layer(mesh, *find_side("right"));
  return {SetSoftness{std::make_shared<const Softness>(standard_softness())},
          Pin{layer(mesh, *find_side("left"))},
          Grab{right},
          Drag{{3.5, 1.25, 1}, {{1, 0, 0}, 20}},
          relax,
          Drag{{4.25, 1.5, 0.75}, {{1, 0, 0}, 40}},
          relax,
          Release{},
          Cut{{2, 5, 11}},
          Grab{right.front()},
          Drag{{5, 0.5, 0.25}},
          relax,
          Release{}};
}

std::vector<double> by_thread(const MeshPointer& mesh, Algorithm algorithm, const std::vector<Command>& moves) {
  SolverThread thread(mesh, algorithm, [] {});
  for (const Command& move : moves) {
    thread.post(move);
  }
  std::promise<std::vector<double>> positions;
  thread.ask([&](const Simulation& simulation) { positions.set_value(positions_of(simulation)); });
  return positions.get_future().get();
}

std::vector<double> by_comparison(const MeshPointer& mesh, Algorithm algorithm, const std::vector<Command>& moves) {
  const report::Case object{"bar", "", mesh, {}, {}, Softness(), {}};
  report::Runner runner(object, algorithm, Precision::single_precision, {});
  runner.run({"moves", "", moves}, {}, {});
  return positions_of(runner.simulation());
}

}  // namespace

void OneEngineTest::all_ways_give_the_same_bits_data() {
  QTest::addColumn<int>("algorithm");
  QTest::addColumn<int>("scheme");
  const MeshPointer mesh = make_mesh(MeshKind::tetra, {4, 3, 3});
  for (const AlgorithmInfo& one : algorithms()) {
    for (const RelaxationSchemeInfo& scheme : relaxation_schemes) {
      // Methods of elasticity are not relaxed.
      if (fits(one.algorithm, *mesh) && (!one.elastic || scheme.scheme == RelaxationScheme::mean)) {
        QTest::addRow("%s, %s", one.name.data(), scheme.name.data()) << int(one.algorithm) << int(scheme.scheme);
      }
    }
  }
}

void OneEngineTest::all_ways_give_the_same_bits() {
  QFETCH(int, algorithm);
  QFETCH(int, scheme);
  const auto which = Algorithm(algorithm);
  const Program program;
  QCOMPARE(program.run("generate tetra 4x3x3 -o bar.msh").code, 0);
  const MeshPointer mesh = read_mesh(program.path("bar.msh").toStdString());
  const std::vector<Command> moves = moves_of(*mesh, {4, 1, RelaxationScheme(scheme)});
  {
    std::ofstream file(program.path("moves.json").toStdString());
    write_moves(file, moves, *mesh);
  }
  const auto outcome = program.run({"deform", "bar.msh", "--algorithm", info(which).name.data(), "--precision", "float",
                                    "--script", "moves.json", "--positions", "out.csv"});
  QVERIFY2(outcome.code == 0, outcome.error);
  std::vector<double> by_program;
  for (const auto& row : rows_of(program.read("out.csv"))) {
    by_program.insert(by_program.end(), {row[1].toDouble(), row[2].toDouble(), row[3].toDouble()});
  }
  const std::vector<double> seen = by_thread(mesh, which, moves);
  QVERIFY(seen != mesh->rest);
  QVERIFY(same_bits(seen, by_comparison(mesh, which, moves)));
  QVERIFY(same_bits(seen, by_program));
}

CHAINMAIL_TEST(OneEngineTest)

}  // namespace chainmail::test_one_engine

#include "test_one_engine.moc"
