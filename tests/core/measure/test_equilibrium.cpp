#include <QtTest>
#include <cmath>
#include <numeric>

#include "core/simulations.h"
#include "measure/equilibrium.h"
#include "program.h"

namespace chainmail::test_equilibrium {

using namespace chainmail::test;

/// The relaxed equilibrium: known answers, left-out elements, and convergence of relaxation to it.
class EquilibriumTest : public QObject {
  Q_OBJECT

 private slots:
  void a_chain_held_at_both_ends_is_stretched_evenly();
  void one_fixed_element_carries_all_along();
  void axes_are_solved_each_for_itself();
  void components_without_a_fixed_element_are_undefined();
  void cut_links_are_left_out();
  void without_fixed_elements_there_is_none();
  void a_far_origin_costs_no_digits();
  void regions_that_bind();
  void relaxation_comes_to_it_data();
  void relaxation_comes_to_it();
  void axial_energy_by_hand();
  void corotated_energy_follows_a_turned_side();
  void corotated_energy_ends_at_a_cut();
  void gradients_agree_with_cholesky();
  void gradients_come_back_to_rest();
};

namespace {

const Softness wide{{0, 1000, 1000}, {}, EnergyKind::isotropic};
const Softness wide_axial{{0, 1000, 1000, 0.2, 2, -1.5}, {{5, {0, 1000, 1000, 0.05, 7, 1}}}, EnergyKind::axial};

/// A state of a mesh: from rest, some elements displaced.
std::unique_ptr<Deformer> displaced(const MeshPointer& mesh, const std::vector<std::pair<ElementId, Point>>& by) {
  auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
  std::vector<double> positions = mesh->rest;
  for (const auto& [element, displacement] : by) {
    for (int k = 0; k < mesh->space_dimension; ++k) {
      positions[std::size_t{element} * mesh->space_dimension + k] += displacement[mesh->axes[k]];
    }
  }
  solver->body().set_positions(positions);
  return solver;
}

Equilibrium solve(const Mesh& mesh, const Deformer& solver, const std::vector<ElementId>& fixed,
                  const Softness& softness = wide, std::uint64_t limit = cholesky_limit) {
  auto result = equilibrium(mesh, softness, solver.body().cuts(), fixed, solver.body().positions(), {}, limit);
  if (!result) {
    throw std::runtime_error("there is no equilibrium");
  }
  return *result;
}

// A direct solve loses up to the condition number, about the square of a chain's length: here 1e2.
constexpr double rounding = 1e-13;

}  // namespace

void EquilibriumTest::a_chain_held_at_both_ends_is_stretched_evenly() {
  const auto mesh = make_mesh(MeshKind::line, {11, 1, 1});
  const auto solver = displaced(mesh, {{10, {5, 0, 0}}, {4, {-3, 0, 0}}});
  const auto result = solve(*mesh, *solver, {0, 10});
  for (ElementId e = 0; e < 11; ++e) {
    QVERIFY(std::abs(result.displacements[e] - 0.5 * e) < rounding);
    QVERIFY(std::abs(result.positions(*mesh)(e, 0) - 1.5 * e) < rounding);
    QVERIFY(result.defined[e]);
  }
  QVERIFY(!result.binds);
}

void EquilibriumTest::one_fixed_element_carries_all_along() {
  for (const MeshFamily& family : families()) {
    const auto solver = displaced(family.mesh, {{2, {0.5, -0.25, 2}}, {0, {1, 1, 1}}});
    const auto result = solve(*family.mesh, *solver, {2, 2});
    const int n = family.mesh->space_dimension;
    for (ElementId e = 0; e < family.mesh->element_count(); ++e) {
      for (int k = 0; k < n && result.defined[e]; ++k) {
        const double by = std::array{0.5, -0.25, 2.0}[family.mesh->axes[k]];
        QVERIFY2(std::abs(result.displacements[std::size_t{e} * n + k] - by) < rounding, family.name.c_str());
      }
    }
    QVERIFY2(!result.binds, family.name.c_str());
  }
}

void EquilibriumTest::axes_are_solved_each_for_itself() {
  // A plus of five elements: the middle one is at the mean of the four around it.
  const auto mesh = make_mesh(MeshKind::grid, {3, 3, 1});
  const auto solver = displaced(mesh, {{1, {0, 0.4, 0}}, {3, {0.8, 0, 0}}, {5, {-0.4, 0.2, 0}}, {7, {0, 0.2, 0}}});
  const auto result = solve(*mesh, *solver, {0, 1, 2, 3, 5, 6, 7, 8});
  QVERIFY(std::abs(result.displacements[8] - 0.1) < rounding);
  QVERIFY(std::abs(result.displacements[9] - 0.2) < rounding);
  QVERIFY(std::abs(result.displacements[6] - 0.8) < rounding);  // fixed, so it stays
}

void EquilibriumTest::components_without_a_fixed_element_are_undefined() {
  const auto line = make_mesh(MeshKind::line, {4, 1, 1});
  const auto mesh = side_by_side(*line, *line, Point(10, 0, 0));
  const auto solver = displaced(mesh, {{5, {1, 0, 0}}, {6, {0.25, 0, 0}}, {2, {0.125, 0, 0}}});
  const auto result = solve(*mesh, *solver, {5});
  QVERIFY(result.defined == (std::vector<bool>{false, false, false, false, true, true, true, true}));
  for (ElementId e = 0; e < 8; ++e) {
    const double expected = e >= 4 ? 1 : e == 2 ? 0.125 : 0;  // elements that are left out stay
    QVERIFY(std::abs(result.displacements[e] - expected) < rounding);
  }
}

void EquilibriumTest::cut_links_are_left_out() {
  const auto mesh = make_mesh(MeshKind::line, {7, 1, 1});
  const auto solver = displaced(mesh, {{6, {3, 0, 0}}});
  solver->body().cut(std::array{LinkId{2}});  // 2-3
  const auto result = solve(*mesh, *solver, {0, 6});
  for (ElementId e = 0; e < 7; ++e) {
    QVERIFY(std::abs(result.displacements[e] - (e < 3 ? 0 : 3)) < rounding);
  }
  const auto one_side = solve(*mesh, *solver, {6});
  QVERIFY(one_side.defined == (std::vector<bool>{false, false, false, true, true, true, true}));
}

void EquilibriumTest::without_fixed_elements_there_is_none() {
  const auto mesh = make_mesh(MeshKind::line, {3, 1, 1});
  const auto solver = displaced(mesh, {});
  QVERIFY(!equilibrium(*mesh, wide, solver->body().cuts(), {}, solver->body().positions()));
  const std::vector<ElementId> all{0, 1, 2};
  QVERIFY(equilibrium(*mesh, wide, solver->body().cuts(), all, solver->body().positions())->displacements ==
          std::vector<double>(3, 0));
}

void EquilibriumTest::a_far_origin_costs_no_digits() {
  const auto far = build_mesh(
      placed(*make_mesh(MeshKind::line, {5, 1, 1}), [](const Point& p) { return Point(p + Point(0x1p40, 0, 0)); }));
  const auto solver = displaced(far, {{4, {1, 0, 0}}});
  const auto result = solve(*far, *solver, {0, 4});
  for (ElementId e = 0; e < 5; ++e) {
    QVERIFY(std::abs(result.displacements[e] - 0.25 * e) < rounding);
  }
}

void EquilibriumTest::regions_that_bind() {
  const auto mesh = make_mesh(MeshKind::line, {5, 1, 1});
  const auto pulled = displaced(mesh, {{4, {1, 0, 0}}});  // each link 1.25 long
  QVERIFY(solve(*mesh, *pulled, {0, 4}, {}).binds);
  QVERIFY(!solve(*mesh, *pulled, {0, 4}, {{0.8, 1.26, 0.1}, {}}).binds);
  QVERIFY(solve(*mesh, *pulled, {0, 4}, {{0.8, 1.26, 0.1}, {{3, {1, 1, 0}}}}).binds);
  // Links that are cut or not defined do not count.
  pulled->body().cut(std::array{LinkId{3}});
  QVERIFY(!solve(*mesh, *pulled, {0}, {}).binds);
}

void EquilibriumTest::relaxation_comes_to_it_data() {
  QTest::addColumn<bool>("axial");
  QTest::newRow("isotropic") << false;
  QTest::newRow("axial") << true;
}

void EquilibriumTest::relaxation_comes_to_it() {
  QFETCH(bool, axial);
  const Softness& softness = axial ? wide_axial : wide;
  const auto mesh = jittered_triangles(7, 6, 5);
  Simulation simulation(mesh, Algorithm::natural_queue, Precision::double_precision);
  simulation.apply(Command(commands::SetSoftness{softness}));
  simulation.apply(Command(commands::Pin{{0, 41}}));
  drag_by(simulation, 17, {1.5, -0.75, 0});
  simulation.apply(Command(commands::SetRelaxation{true, 1, RelaxationScheme::mean}));  // wakes all elements
  const auto result = solve(*mesh, simulation.deformer(), {0, 17, 41}, softness);
  QVERIFY(!result.binds);
  const auto distance = [&] {
    double largest = 0;
    const auto positions = positions_of(simulation);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      largest = std::max(largest, std::abs(positions[i] - mesh->rest[i] - result.displacements[i]));
    }
    return largest;
  };
  QVERIFY(distance() > 0.1);
  simulation.relax(2000, {1, simulation.relaxation().scheme});
  // Steps below 1e-6 mean rest lengths are not taken. The remaining distance is some tens of such steps.
  QVERIFY2(distance() < 1e-4, qPrintable(QString::number(distance())));
}

void EquilibriumTest::axial_energy_by_hand() {
  // The middle of a plus, with b = 1/4. On x, the links along x weigh 1 + b and those along y b.
  const auto mesh = make_mesh(MeshKind::grid, {3, 3, 1});
  const auto solver = displaced(mesh, {{1, {0, 0.4, 0}}, {3, {0.8, 0, 0}}, {5, {-0.4, 0.2, 0}}, {7, {0, 0.2, 0}}});
  const auto result = solve(*mesh, *solver, {0, 1, 2, 3, 5, 6, 7, 8}, {{0, 1000, 1000, 0.25}, {}, EnergyKind::axial});
  QVERIFY(std::abs(result.displacements[8] - 1.25 * 0.4 / 3) < rounding);
  QVERIFY(std::abs(result.displacements[9] - (1.25 * 0.6 + 0.25 * 0.2) / 3) < rounding);
}

void EquilibriumTest::corotated_energy_follows_a_turned_side() {
  // A square of which one side is turned by 90 degrees: all of it turns, without energy. Valid regions do not count.
  const auto mesh = make_mesh(MeshKind::cloth, {4, 4, 1});
  std::vector<double> positions = mesh->rest;
  const std::vector<ElementId> side{0, 1, 2, 3};
  for (const ElementId e : side) {
    positions[2 * e] = 0;
    positions[2 * e + 1] = e;
  }
  Deformer solver(mesh, Algorithm::natural_queue, Precision::double_precision);
  solver.body().set_positions(positions);
  const Softness corotated{{}, {}, EnergyKind::corotated};
  const auto found = equilibrium(*mesh, corotated, solver.body().cuts(), side, solver.body().positions());
  QVERIFY(found && found->binds);
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    const Point rest = mesh->rest_position(e), turned(-rest[1], rest[0], 0);
    QVERIFY((point_of(*mesh, found->positions(*mesh), e) - turned).norm() < 1e-5);
  }
}

/// A square that is cut in two between its rows: one half stays, the other one turns with its side, without energy.
void EquilibriumTest::corotated_energy_ends_at_a_cut() {
  const auto mesh = make_mesh(MeshKind::cloth, {4, 4, 1});
  const auto turned = [&](ElementId e) { return Point(-mesh->rest_position(e)[1], mesh->rest_position(e)[0], 0); };
  std::vector<std::pair<ElementId, Point>> by;
  for (const ElementId e : {12U, 13U, 14U, 15U}) {
    by.emplace_back(e, turned(e) - mesh->rest_position(e));
  }
  const auto solver = displaced(mesh, by);
  for (LinkId link = 0; link < mesh->link_count(); ++link) {
    if ((mesh->links[link][0] < 8) != (mesh->links[link][1] < 8)) {
      solver->body().cut(std::span(&link, 1));
    }
  }
  const Softness corotated{{}, {}, EnergyKind::corotated};
  const auto found = solve(*mesh, *solver, {0, 1, 2, 3, 12, 13, 14, 15}, corotated);
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    const Point expected = e < 8 ? mesh->rest_position(e) : turned(e);
    QVERIFY((point_of(*mesh, found.positions(*mesh), e) - expected).norm() < 1e-5);
    QVERIFY(found.defined[e]);
  }
}

void EquilibriumTest::gradients_agree_with_cholesky() {
  const auto mesh = make_mesh(MeshKind::cloth, {40, 30, 1}, 3);
  const auto solver = displaced(mesh, {{0, {-3, 1, 2}}, {1199, {2, 5, -4}}, {600, {0, 0, 7}}, {77, {1, 1, 1}}});
  solver->body().cut(std::array{LinkId{100}, LinkId{101}, LinkId{2000}});
  const auto direct = solve(*mesh, *solver, {0, 600, 1199});
  const auto iterated = solve(*mesh, *solver, {0, 600, 1199}, wide, 0);
  // The residual of 1e-12 times the condition number (about 1e4 here) times the deflection.
  QVERIFY(largest_step(direct.displacements, iterated.displacements) < 1e-7);
  const auto direct_axial = solve(*mesh, *solver, {0, 600, 1199}, wide_axial);
  const auto iterated_axial = solve(*mesh, *solver, {0, 600, 1199}, wide_axial, 0);
  QVERIFY(largest_step(direct_axial.displacements, iterated_axial.displacements) < 1e-6);
  QVERIFY(largest_step(direct_axial.displacements, direct.displacements) > 0.1);
  QVERIFY(largest_coordinate(direct.displacements) > 5);
}

/// Nothing fixed moves along y, so all elements come back along y, however far away they start.
void EquilibriumTest::gradients_come_back_to_rest() {
  const auto mesh = make_mesh(MeshKind::cloth, {12, 9, 1});
  const auto solver = displaced(mesh, {{0, {1, 0, 0}}, {50, {0.5, 0.75, 0}}, {31, {0, -0.25, 0}}});
  const auto result = solve(*mesh, *solver, {0, 107}, wide, 0);
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    QVERIFY(std::abs(result.displacements[2 * std::size_t{e} + 1]) < rounding);
  }
}

CHAINMAIL_TEST(EquilibriumTest)

}  // namespace chainmail::test_equilibrium

#include "test_equilibrium.moc"
