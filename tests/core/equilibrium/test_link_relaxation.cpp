#include <QtTest>

#include "core/scenarios.h"
#include "core/simulations.h"
#include "measure/violation.h"
#include "program.h"

namespace chainmail::test_link_relaxation {

using namespace chainmail::test;

namespace {

constexpr auto no_limit = std::numeric_limits<std::uint64_t>::max();
constexpr LinkSoftness wide{0, 100, 100};  // regions have no effect

std::unique_ptr<Deformer> stretched_chain(std::uint32_t length, const std::vector<double>& positions) {
  auto solver = std::make_unique<Deformer>(make_mesh(MeshKind::line, {length, 1, 1}), Algorithm::natural_queue,
                                           Precision::double_precision);
  solver->body().set_softness({wide, {}});
  solver->set_relaxation(RelaxationScheme::link);
  solver->body().set_positions(positions);
  std::vector<ElementId> all(length);
  std::iota(all.begin(), all.end(), ElementId{0});
  solver->wake(all);
  return solver;
}

std::vector<double> positions_of_chain(const Deformer& solver, std::uint32_t length) {
  return positions_of(solver, *make_mesh(MeshKind::line, {length, 1, 1}));
}

}  // namespace

/// Relaxation by links (Schill 2001): the two ends of each link share its deflection.
class LinkRelaxationTest : public QObject {
  Q_OBJECT

 private slots:
  void two_ends_share_the_deflection();
  void a_step_is_that_share_of_the_way();
  void a_held_end_leaves_its_half_to_the_next_sweep();
  void links_come_in_their_order();
  void a_free_chain_comes_to_rest_in_its_shape();
  void a_chain_between_pins_ends_near_even();
  void valid_links_stay_valid();
  void displacements_relax_like_positions();
};

void LinkRelaxationTest::two_ends_share_the_deflection() {
  const auto solver = stretched_chain(2, {0, 3});
  solver->relax_slice(1, no_limit, {});
  QCOMPARE(positions_of_chain(*solver, 2), (std::vector<double>{1, 2}));
}

void LinkRelaxationTest::a_step_is_that_share_of_the_way() {
  const auto solver = stretched_chain(2, {0, 3});
  solver->relax_slice(0.5, no_limit, {});
  // Half steps: the first end moves a quarter of the way to 2, the second a quarter of the way to 1.
  QCOMPARE(positions_of_chain(*solver, 2), (std::vector<double>{0.5, 2.5}));
}

void LinkRelaxationTest::a_held_end_leaves_its_half_to_the_next_sweep() {
  const auto solver = stretched_chain(2, {0, 3});
  solver->relax_slice(1, no_limit, std::array{ElementId{0}});
  QCOMPARE(positions_of_chain(*solver, 2), (std::vector<double>{0, 2}));
  solver->relax_slice(1, no_limit, std::array{ElementId{0}});
  QCOMPARE(positions_of_chain(*solver, 2), (std::vector<double>{0, 1.5}));
}

void LinkRelaxationTest::links_come_in_their_order() {
  const auto solver = stretched_chain(3, {0, 3, 4});
  solver->relax_slice(1, no_limit, {});
  // Link 0-1 moves its ends to 1 and 2. Link 1-2 is then 2 long and moves its ends to 2.5 and 3.5.
  QCOMPARE(positions_of_chain(*solver, 3), (std::vector<double>{1, 2.5, 3.5}));
}

void LinkRelaxationTest::a_free_chain_comes_to_rest_in_its_shape() {
  const auto solver = stretched_chain(5, {0, 4, 4.5, 6, 9});
  int sweeps = 0;
  while (solver->relax_slice(1, no_limit, {}).visited != 0 && ++sweeps < 10'000) {
  }
  QVERIFY(sweeps < 10'000);
  const auto x = positions_of_chain(*solver, 5);
  for (int i = 1; i < 5; ++i) {
    QVERIFY(std::abs(x[i] - x[i - 1] - 1) < 1e-4);  // steps below 1e-6 are not taken, and they add up
  }
  QVERIFY(std::abs(std::accumulate(x.begin(), x.end(), 0.0) / 5 - 4.7) < 1e-9);  // the ends move by opposite amounts
}

void LinkRelaxationTest::a_chain_between_pins_ends_near_even() {
  const auto solver = stretched_chain(5, {0, 1, 2, 3, 8});
  const std::vector<ElementId> ends{0, 4};
  solver->body().pin(ends);
  for (int i = 0; i < 2000; ++i) {
    solver->relax_slice(0.1, no_limit, {});
  }
  const auto x = positions_of_chain(*solver, 5);
  QCOMPARE(x[0], 0.0);
  QCOMPARE(x[4], 8.0);
  for (int i = 1; i < 4; ++i) {
    QVERIFY(std::abs(x[i] - 2 * i) < 0.2);  // links that contradict each other pull it back and forth by one step
  }
}

void LinkRelaxationTest::valid_links_stay_valid() {
  const auto holds = [] {
    const auto& mesh = draw_family().mesh;
    const auto solver = std::make_unique<Deformer>(mesh, *rc::gen::element(Algorithm::natural_queue, Algorithm::exact),
                                                   Precision::double_precision);
    const Softness softness = draw_softness(*mesh);
    solver->body().set_softness(softness);
    solver->set_relaxation(RelaxationScheme::link);
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    solver->body().set_positions(random_valid_state(*mesh, softness, 0.9, random));
    std::vector<ElementId> all(mesh->element_count());
    std::iota(all.begin(), all.end(), ElementId{0});
    solver->wake(all);
    for (int i = 0; i < 5; ++i) {
      solver->relax_slice(*rc::gen::inRange(1, 101) / 100.0, no_limit, std::array{(*any_drag_step()).of(*mesh)});
      // In rest lengths: only rounding.
      RC_ASSERT(measure_violation(*mesh, softness, solver->body().cuts(), solver->body().positions()).max <= 1e-9);
    }
  };
  QVERIFY(check_property("from a valid state relaxation by links keeps every link valid", holds));
}

void LinkRelaxationTest::displacements_relax_like_positions() {
  // Exact stores displacements. The same sweeps must lead to the same positions, up to rounding.
  for (const RelaxationScheme scheme : {RelaxationScheme::mean, RelaxationScheme::link}) {
    const auto mesh = jittered_triangles(8, 8, 4);
    std::mt19937_64 random(9);
    const auto state = random_valid_state(*mesh, {}, 0.9, random);
    const auto absolute = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
    const auto from_rest = std::make_unique<Deformer>(mesh, Algorithm::exact, Precision::double_precision);
    std::vector<ElementId> all(mesh->element_count());
    std::iota(all.begin(), all.end(), ElementId{0});
    for (Deformer* solver : {absolute.get(), from_rest.get()}) {
      solver->set_relaxation(scheme);
      solver->body().set_positions(state);
      solver->wake(all);
      for (int i = 0; i < 5; ++i) {
        solver->relax_slice(0.8, no_limit, std::array{ElementId{20}});
      }
    }
    QVERIFY(largest_step(state, positions_of(*absolute, *mesh)) > 0.01);
    QVERIFY(largest_step(positions_of(*absolute, *mesh), positions_of(*from_rest, *mesh)) < 1e-12);
  }
}

CHAINMAIL_TEST(LinkRelaxationTest)

}  // namespace chainmail::test_link_relaxation

#include "test_link_relaxation.moc"
