#include <QtTest>
#include <cstdlib>
#include <set>

#include "core/any_command.h"
#include "core/invariants.h"
#include "core/simulations.h"
#include "mesh/error.h"
#include "program.h"
#include "property.h"

namespace chainmail::test_simulation_life {

using namespace chainmail::test;

namespace {

std::vector<MeshPointer> some_meshes() {
  return {make_mesh(MeshKind::grid, {6, 5, 1}), make_mesh(MeshKind::tetra, {3, 3, 2}),
          make_mesh(MeshKind::line, {9, 1, 1}), shuffled_neighbours(*jittered_triangles(5, 5, 3), 8)};
}

/// Carries out a command. Returns what it says: the reason of a refusal, or the remark of the pass.
std::string outcome(Simulation& simulation, const Command& command) {
  try {
    simulation.apply(command);
    return simulation.statistics().remark;
  } catch (const Error& error) {
    return error.what();
  }
}

/// True for methods whose answer depends on those before, beyond rounding.
bool follows_path(Algorithm algorithm) { return info(algorithm).elastic || algorithm == Algorithm::exact; }

bool same_settings(const Simulation& a, const Simulation& b) {
  return a.softness() == b.softness() && a.elastic() == b.elastic() && a.relaxation() == b.relaxation() &&
         std::ranges::equal(a.grabbed(), b.grabbed()) && std::ranges::equal(a.body().pins(), b.body().pins()) &&
         a.body().cuts().links() == b.body().cuts().links() && a.mesh_pointer() == b.mesh_pointer() &&
         a.statistics().algorithm == b.statistics().algorithm;
}

/// An object, held and deformed, with a pin, a cut and its state at rest kept as state 0.
struct Deformed {
  Deformed(const MeshPointer& mesh, Algorithm algorithm)
      : simulation(mesh, algorithm, Precision::double_precision), followed(simulation) {
    const LinkId last = mesh->link_count() - 1;
    for (const Command& command : std::initializer_list<Command>{
             commands::KeepState{0}, commands::Pin{{mesh->element_count() - 1}}, commands::Cut{{last}},
             commands::Grab{5}, commands::Drag{Point(0.5, 0.25, 0), {}, true}}) {
      flaw += followed.apply(command);
    }
  }
  Simulation simulation;
  FollowedSimulation followed;
  std::string flaw;
};

/// Carries out two commands, then undoes both, redoes the last one, and undoes everything. Returns what is wrong.
std::string flaw_of_pair(Deformed& object, const Command& first, const Command& second) {
  constexpr commands::StateId before_first = 10, before_second = 11;
  Simulation& simulation = object.simulation;
  const ObjectFacts initial(simulation);
  carry_out(simulation, commands::KeepState{before_first});
  std::string flaw = object.flaw + object.followed.apply(first);
  const ObjectFacts between(simulation);
  carry_out(simulation, commands::KeepState{before_second});
  flaw += object.followed.apply(second);
  const ObjectFacts last(simulation);
  exchange(simulation, before_second);
  flaw += difference(ObjectFacts(simulation), between);
  exchange(simulation, before_second);
  flaw += difference(ObjectFacts(simulation), last);
  carry_out(simulation, commands::RestoreState{before_first});
  return flaw + difference(ObjectFacts(simulation), initial);
}

}  // namespace

/// A simulation that goes through a long random life does the same as a new one that continues from its state.
class SimulationLifeTest : public QObject {
  Q_OBJECT

 private slots:
  void it_goes_on_as_a_new_one();
  void after_any_two_commands_it_is_what_they_say();
};

void SimulationLifeTest::it_goes_on_as_a_new_one() {
  const char* given = std::getenv("CHAINMAIL_LIFE_STEPS");
  const int steps = given == nullptr ? 2000 : std::atoi(given);
  const auto seed = drawn_once.seed;
  qInfo("%d steps, seed %llu", steps, static_cast<unsigned long long>(seed));
  AnyCommand any(seed, false, some_meshes(), 30, 60);
  Simulation lived(some_meshes()[0], Algorithm::natural_queue, Precision::double_precision);
  for (int step = 0; step < steps; ++step) {
    const Algorithm before = lived.statistics().algorithm;
    const std::uint64_t passes = lived.statistics().passes;
    Simulation fresh(lived.mesh_pointer(), before, Precision::double_precision);
    fresh.take(lived.hand_over(), before);
    QVERIFY(same_settings(fresh, lived) && same_bits(positions_of(fresh), positions_of(lived)));
    const Command command = any.draw();
    const std::string said = outcome(lived, command), again = outcome(fresh, command);
    const QByteArray where =
        "step " + QByteArray::number(step) + ", command " + QByteArray::number(int(command.index()));
    QVERIFY2(same_settings(fresh, lived), where);
    if (!follows_path(before)) {
      QCOMPARE(again, said);
      QVERIFY2(same_bits(positions_of(fresh), positions_of(lived)), where);
      QVERIFY2(fresh.valid() == lived.valid(), where);
      QVERIFY(lived.statistics().passes == passes ||
              fresh.statistics().last_pass.moved == lived.statistics().last_pass.moved);
    }
  }
}

void SimulationLifeTest::after_any_two_commands_it_is_what_they_say() {
  const MeshPointer surface = jittered_triangles(4, 4, 3), solid = make_mesh(MeshKind::tetra, {3, 3, 2});
  const SplitPointer split = split_of_first_triangle(surface);
  for (const auto& [mesh, other] : {std::pair(surface, solid), std::pair(solid, surface)}) {
    const std::vector<Command> all = every_command(mesh, other, split);
    std::set<std::size_t> kinds;
    for (const Algorithm algorithm : {Algorithm::natural_queue, Algorithm::exact}) {
      for (std::size_t i = 0; i < all.size() * all.size(); ++i) {
        const std::size_t first = i / all.size(), second = i % all.size();
        Deformed object(mesh, algorithm);
        const std::string flaw = flaw_of_pair(object, all[first], all[second]);
        QVERIFY2(flaw.empty(), (std::string(info(algorithm).name) + ", commands " + std::to_string(first) + " and " +
                                std::to_string(second) + ": " + flaw)
                                   .c_str());
        kinds.insert(all[first].index());
      }
    }
    QCOMPARE(kinds.size(), std::variant_size_v<Command>);  // a new command has its place in every_command()
  }
}

CHAINMAIL_TEST(SimulationLifeTest)

}  // namespace chainmail::test_simulation_life

#include "test_simulation_life.moc"
