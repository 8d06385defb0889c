#include <Eigen/Geometry>
#include <QtTest>
#include <cmath>
#include <numeric>

#include "core/scenarios.h"
#include "equilibrium/link_energy.h"
#include "equilibrium/small_quadratic.h"
#include "measure/violation.h"
#include "program.h"

namespace chainmail::test_relaxation {

using namespace chainmail::test;

/// Relaxation `mean`, limited to the valid regions of the neighbours.
class RelaxationTest : public QObject {
  Q_OBJECT

 private slots:
  void one_free_element_by_hand();
  void a_step_of_a_half_goes_half_the_way();
  void the_clamp_keeps_it_inside_the_intersection();
  void where_the_intersection_is_empty_it_stays_on_that_axis();
  void a_cut_link_does_not_pull();
  void the_held_element_stays();
  void the_rest_shape_stays();
  void an_energy_of_nothing_leaves_the_box_alone();
  void one_region_per_rest_vector_or_per_link_is_the_same();
  void from_a_valid_state_every_link_stays_valid();
  void from_a_valid_state_the_energy_never_rises();
  void axial_energy_by_hand();
  void inside_a_region_it_takes_the_least_energy();
  void without_lateral_stiffness_a_chain_stays_across();
  void it_ends_where_the_energy_has_no_slope();
  void isotropic_energy_is_axial_with_much_lateral_stiffness();
  void a_turned_object_has_no_corotated_energy_left();
  void it_ends_at_the_rest_shape_about_the_held_element();
  void a_local_move_wakes_few();
  void it_sleeps_when_nothing_moves();
  void a_slice_goes_on_where_the_last_one_stopped();
};

namespace {

constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();

void wake_all(Deformer& solver, const Mesh& mesh) {
  std::vector<ElementId> all(mesh.element_count());
  std::iota(all.begin(), all.end(), ElementId{0});
  solver.wake(all);
}

/// Returns the positions after one sweep over a chain along x, with isotropic energy, in double, from given positions.
std::vector<double> sweep_chain(const MeshPointer& mesh, Softness softness, const std::vector<double>& positions,
                                double step, ElementId held) {
  softness.energy = EnergyKind::isotropic;
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
  solver->body().set_softness(softness);
  solver->body().set_positions(positions);
  wake_all(*solver, *mesh);
  solver->relax_slice(step, no_limit, std::array{held});
  return positions_of(*solver, *mesh);
}

/// Draws a softness with isotropic or axial energy, whose numbers differ from link to link. A fifth of the links have
/// no lateral stiffness.
Softness draw_energy(const Mesh& mesh) {
  Softness softness = draw_softness(mesh);
  softness.energy = *rc::gen::element(EnergyKind::isotropic, EnergyKind::axial);
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const bool by_link = *rc::gen::arbitrary<bool>();
  const auto draw = [&](LinkSoftness one) {
    one.lateral = random() % 5 == 0 ? 0 : std::exp(uniform(random, -8, 1));
    one.stiffness = std::exp(uniform(random, -3, 3));
    one.exponent = uniform(random, -2, 2);
    return one;
  };
  softness.global = draw(softness.global);
  for (LinkId link = 0; link < mesh.link_count() && by_link; ++link) {
    softness.links.set(link, draw(softness.of(link)));
  }
  return softness;
}

/// Returns the largest derivative of the energy by a coordinate of an element that is neither held nor pinned, by
/// central differences.
double largest_slope(Deformer& solver, const Mesh& mesh, const Softness& softness, ElementId held) {
  const double h = 1e-4;
  const std::vector<double> positions = positions_of(solver, mesh);
  const auto energy_at = [&](std::size_t i, double by) {
    std::vector<double> moved = positions;
    moved[i] += by;
    solver.body().set_positions(moved);
    return elastic_energy(mesh, softness, solver.body().cuts(), solver.body().positions());
  };
  double largest = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto element = static_cast<ElementId>(i / std::size_t(mesh.space_dimension));
    if (element != held && !solver.body().is_pinned(element)) {
      largest = std::max(largest, std::abs(energy_at(i, h) - energy_at(i, -h)) / (2 * h));
    }
  }
  return largest;
}

/// Returns the elements and links of a mesh alone.
MeshPointer without_faces(const Mesh& mesh) {
  MeshParts parts;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    parts.rest.push_back(mesh.rest_position(e));
  }
  parts.links = mesh.links;
  return build_mesh(std::move(parts));
}

/// A random mesh in a random valid state with all elements active, and a random step.
struct ActiveState {
  ActiveState() : mesh(draw_family().mesh), softness(draw_energy(*mesh)), step(*rc::gen::inRange(1, 101) / 100.0) {
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
    solver->body().set_softness(softness);
    solver->body().set_positions(random_valid_state(*mesh, softness, 0.99, random));
    wake_all(*solver, *mesh);
    held = *rc::gen::inRange<ElementId>(0, mesh->element_count());
  }

  double violation() const {
    return measure_violation(*mesh, softness, solver->body().cuts(), solver->body().positions()).max;
  }
  double energy() const { return elastic_energy(*mesh, softness, solver->body().cuts(), solver->body().positions()); }

  MeshPointer mesh;
  Softness softness;
  double step;
  ElementId held = 0;
  std::unique_ptr<Deformer> solver;
};

const LinkSoftness soft{0.5, 1.5, 0.5};

}  // namespace

void RelaxationTest::one_free_element_by_hand() {
  // 0 is where its only neighbour implies. 1 moves to the mean of 0 + 1 and 2.5 − 1. 2 is held.
  const auto mesh = make_mesh(MeshKind::line, {3, 1, 1});
  QCOMPARE(sweep_chain(mesh, {soft, {}}, {0, 1, 2.5}, 1, 2), (std::vector<double>{0, 1.25, 2.5}));
  // In ascending id, each from the new positions of those before: 1 moves to the mean of 0.5 + 1 and 2 − 1, and then 2
  // to 1.25 + 1.
  QCOMPARE(sweep_chain(mesh, {soft, {}}, {0.5, 1, 2}, 1, 0), (std::vector<double>{0.5, 1.25, 2.25}));
}

void RelaxationTest::a_step_of_a_half_goes_half_the_way() {
  const auto mesh = make_mesh(MeshKind::line, {3, 1, 1});
  QCOMPARE(sweep_chain(mesh, {soft, {}}, {0, 1, 2.5}, 0.5, 2), (std::vector<double>{0, 1.125, 2.5}));
}

void RelaxationTest::the_clamp_keeps_it_inside_the_intersection() {
  // The mean of 0 + 1 and 3 − 1 is 1.5, but the link to 0 stretches to 1.0625 and no further.
  const auto mesh = make_mesh(MeshKind::line, {3, 1, 1});
  const Softness stiff_on_the_left{{0, 3, 0}, {{0, {1, 1.0625, 0}}}};
  QCOMPARE(sweep_chain(mesh, stiff_on_the_left, {0, 1, 3}, 1, 2), (std::vector<double>{0, 1.0625, 3}));
  const Softness stiff_on_the_right{{0, 3, 0}, {{1, {1, 1.75, 0}}}};
  QCOMPARE(sweep_chain(mesh, stiff_on_the_right, {0, 1.25, 3}, 1, 2), (std::vector<double>{0.25, 1.625, 3}));
  // 0 moves 0.25 to 1.25 − 1. Then the mean for 1 is 1.625, inside both regions. A tighter link limits it:
  const Softness tight_on_the_right{{0, 3, 0}, {{1, {1, 1.25, 0}}}};
  QCOMPARE(sweep_chain(mesh, tight_on_the_right, {0, 1.75, 3}, 1, 2), (std::vector<double>{0.75, 1.875, 3}));
}

void RelaxationTest::where_the_intersection_is_empty_it_stays_on_that_axis() {
  // The ends are 5 apart, and the links stretch to 1.5, so there is no valid position on x. On y there is.
  const auto mesh = make_mesh(MeshKind::line, {3, 1, 1}, 2);
  const auto after = sweep_chain(mesh, {soft, {}}, {0, 0, 1.25, 0.25, 5, 0}, 1, 2);
  QCOMPARE(after[2], 1.25);
  QCOMPARE(after[3], (0.25 + 0) / 2);  // 0 moved to 0.25 − 0 on y before, and 2 is at 0
}

void RelaxationTest::a_cut_link_does_not_pull() {
  const auto mesh = make_mesh(MeshKind::line, {3, 1, 1});
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
  const LinkId right = *find_link(*mesh, 1, 2);
  solver->body().cut(std::span(&right, 1));
  solver->body().set_positions(std::vector<double>{0, 1.25, 9});
  wake_all(*solver, *mesh);
  solver->relax_slice(1, no_limit, std::array{ElementId{0}});
  QCOMPARE(positions_of(*solver, *mesh), (std::vector<double>{0, 1, 9}));
}

void RelaxationTest::the_held_element_stays() {
  const auto holds = [] {
    const ActiveState state;
    const Point before = position_of(*state.solver, *state.mesh, state.held);
    for (int sweep = 0; sweep < 5; ++sweep) {
      state.solver->relax_slice(state.step, no_limit, std::array{state.held});
    }
    RC_ASSERT(position_of(*state.solver, *state.mesh, state.held) == before);
  };
  QVERIFY(check_property("the held element stays", holds));
}

void RelaxationTest::the_rest_shape_stays() {
  for (const MeshFamily& family : families()) {
    for (const Precision precision : precisions) {
      const auto solver = std::make_unique<Deformer>(family.mesh, Algorithm::natural_queue, precision);
      const auto before = positions_of(*solver, *family.mesh);
      wake_all(*solver, *family.mesh);
      const RelaxationResult result = solver->relax_slice(1, no_limit, {});
      QVERIFY(result.sweep_ended);
      QCOMPARE(result.visited, std::uint64_t{family.mesh->element_count()});
      QCOMPARE(result.largest_step, 0.0);
      QVERIFY(same_bits(before, positions_of(*solver, *family.mesh)));
      QCOMPARE(solver->relax_slice(1, no_limit, {}).visited, std::uint64_t{0});
    }
  }
}

/// Without a link that has stiffness, an element stays, or goes to the nearest position of its box.
void RelaxationTest::an_energy_of_nothing_leaves_the_box_alone() {
  using Vector = FixedMatrix<double, 2>;
  const SmallQuadratic<2> nothing;
  const Vector low(-1, -2), high(3, 1);
  QCOMPARE(nothing.least_inside(low, high), Vector(0, 0));
  QCOMPARE(nothing.least_inside({1, -2}, high), Vector(1, 0));
  QCOMPARE(nothing.least_inside(low, {-0.5, -0.25}), Vector(-0.5, -0.25));
}

void RelaxationTest::one_region_per_rest_vector_or_per_link_is_the_same() {
  // A link of another object, which nothing moves, has a softness of its own: then every link has its own region.
  const auto beside = make_mesh(MeshKind::line, {2, 1, 1}, 3);
  const std::vector<MeshPointer> objects{make_mesh(MeshKind::tetra, {4, 5, 4}), make_mesh(MeshKind::block, {5, 4, 4}),
                                         make_mesh(MeshKind::cloth, {7, 6, 1}, 3),
                                         make_mesh(MeshKind::line, {9, 1, 1}, 3)};
  const auto holds = [&] {
    const auto& object = objects[*rc::gen::inRange<std::size_t>(0, objects.size())];
    const auto mesh = side_by_side(*object, *beside, Point(40, 0, 0));
    const Precision precision = *any_precision();
    const Algorithm algorithm = *rc::gen::element(Algorithm::natural_queue, Algorithm::exact);
    Softness shared{*any_link_softness(), {}}, own = shared;
    shared.energy = own.energy = EnergyKind::isotropic;
    own.links.set(mesh->link_count() - 1, {0.123, 3.21, 0.77});
    const auto cuts = draw_links(*object);
    const auto drag_steps = *any_drag_steps(10);
    const double step = *rc::gen::element(1.0, 0.6);
    const auto relaxed = [&](const Softness& softness) {
      const auto solver = std::make_unique<Deformer>(mesh, algorithm, precision);
      solver->body().set_softness(softness);
      solver->body().cut(cuts);
      std::vector<double> positions;
      for (const DragStep& drag_step : drag_steps) {
        const ElementId held = drag_step.of(*object);
        move_by(*solver, *mesh, held, drag_step.by());
        solver->wake_all();
        for (int sweep = 0; sweep < 3; ++sweep) {
          solver->relax_slice(step, no_limit, std::array{held});
          const auto now = positions_of(*solver, *mesh);
          positions.insert(positions.end(), now.begin(), now.end());
        }
      }
      return positions;
    };
    RC_ASSERT(same_bits(relaxed(shared), relaxed(own)));
  };
  QVERIFY(check_property("regions per rest vector and per link give the same bits", holds));
}

void RelaxationTest::from_a_valid_state_every_link_stays_valid() {
  const auto holds = [] {
    const ActiveState state;
    // In rest lengths of the link. The shortest links are 0.05 long and coordinates stay below 100, so rounding is
    // below 1e-11 per sweep.
    RC_ASSERT(state.violation() <= 1e-10);
    for (int sweep = 0; sweep < 10; ++sweep) {
      state.solver->relax_slice(state.step, no_limit, std::array{state.held});
      RC_ASSERT(state.violation() <= 1e-10);
    }
  };
  QVERIFY(check_property("from a valid state every link stays valid", holds));
}

void RelaxationTest::from_a_valid_state_the_energy_never_rises() {
  const auto holds = [] {
    const ActiveState state;
    double before = state.energy();
    for (int visit = 0; visit < 300; ++visit) {
      state.solver->relax_slice(state.step, 1, std::array{state.held});
      const double after = state.energy();
      // E is a sum of some 100 squares of differences. Each difference has an error of an ulp of a coordinate (1e-14),
      // which changes E by that times a deflection: 1e-12 of E, and less than 1e-20 if E is almost 0.
      RC_ASSERT(after <= before * (1 + 1e-12) + 1e-20);
      before = after;
    }
  };
  QVERIFY(check_property("from a valid state the energy never rises", holds));
}

void RelaxationTest::axial_energy_by_hand() {
  // The middle of an L: its links run along x to 0 and along y to 2, with b = 1/4. Element 2 is 1 too far on x and on
  // y. On x, the link to 0 weighs 1 + b and the other one b; on y the other way round.
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  parts.links = {{0, 1}, {1, 2}};
  const auto mesh = build_mesh(std::move(parts));
  const LinkSoftness loose{0, 100, 100, 0.25};
  Deformer solver(mesh, Algorithm::natural_queue, Precision::double_precision);
  solver.body().pin(std::array<ElementId, 2>{0, 2});
  const auto after = [&](const Softness& softness) {
    solver.body().set_softness(softness);
    solver.body().set_positions(std::vector<double>{0, 0, 1, 0, 2, 2});
    wake_all(solver, *mesh);
    solver.relax_slice(1, no_limit, {});
    const auto all = positions_of(solver, *mesh);
    return Point(all[2], all[3], 0);
  };
  QVERIFY((after({loose, {}, EnergyKind::axial}) - Point(1 + 0.25 / 1.5, 1.25 / 1.5, 0)).norm() < 1e-14);
  // With a stiffness of 3 from now on, the link to 2 weighs 3b on x and 3(1 + b) on y.
  LinkSoftness stiff = loose;
  stiff.stiffness = 3;
  QVERIFY((after({loose, {{1, stiff}}, EnergyKind::axial}) - Point(1 + 0.75 / 2, 3.75 / 4, 0)).norm() < 1e-14);
}

void RelaxationTest::inside_a_region_it_takes_the_least_energy() {
  // An oblique link couples the axes: where the region limits x, y is the best one for this x, not that of the free
  // minimum.
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {1, 1, 0}, {2, 1, 0}};
  parts.links = {{0, 1}, {1, 2}};
  const auto mesh = build_mesh(std::move(parts));
  const LinkSoftness loose{0, 100, 100, 0.1, 1, 0};
  LinkSoftness tight = loose;
  tight.compression = tight.stretch = 1;
  tight.shear = 0.5;  // x of element 1 is exactly 1 less than that of element 2; y within 0.5
  const Softness softness{loose, {{1, tight}}, EnergyKind::axial};
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
  solver->body().set_softness(softness);
  solver->body().set_positions(std::vector<double>{0, 0, 1.5, 1, 2.5, 1});
  const std::array<ElementId, 2> ends{0, 2};
  solver->body().pin(ends);
  wake_all(*solver, *mesh);
  solver->relax_slice(1, no_limit, {});
  const auto all = positions_of(*solver, *mesh);
  QCOMPARE(all[2], 1.5);
  // The derivative by y is ½(0.5 + y) + 0.1 y + 0.1 y, with y from rest.
  QVERIFY(std::abs(all[3] - (1 - 0.25 / 0.7)) < 1e-14);
}

void RelaxationTest::without_lateral_stiffness_a_chain_stays_across() {
  for (const Precision precision : precisions) {
    const auto mesh = make_mesh(MeshKind::line, {3, 1, 1}, 2);
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, precision);
    solver->body().set_softness(Softness{{0, 100, 100, 0}, {}, EnergyKind::axial});
    solver->body().set_positions(std::vector<double>{0, 0, 1.5, 0.75, 2, 0});
    const std::array<ElementId, 2> ends{0, 2};
    solver->body().pin(ends);
    wake_all(*solver, *mesh);
    solver->relax_slice(1, no_limit, {});
    QCOMPARE(positions_of(*solver, *mesh), (std::vector<double>{0, 0, 1, 0.75, 2, 0}));
  }
}

void RelaxationTest::it_ends_where_the_energy_has_no_slope() {
  for (const auto& mesh :
       {jittered_triangles(6, 5, 3), make_mesh(MeshKind::grid, {5, 4, 1}), make_mesh(MeshKind::tetra, {3, 3, 3})}) {
    for (const EnergyKind kind : {EnergyKind::isotropic, EnergyKind::axial}) {
      const Softness softness{{0, 100, 100, 0.2, 2, -1.5}, {{1, {0, 100, 100, 0.4, 5, 1}}}, kind};
      const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
      solver->body().set_softness(softness);
      const std::array<ElementId, 3> pins{0, 1, mesh->element_count() - 1};
      solver->body().pin(pins);
      move_by(*solver, *mesh, 7, Point(0.5, -0.25, mesh->space_dimension == 3 ? 0.25 : 0));
      auto positions = positions_of(*solver, *mesh);
      positions.back() += 1;
      solver->body().set_positions(positions);
      wake_all(*solver, *mesh);
      int sweeps = 0;
      while (solver->relax_slice(1, no_limit, std::array{ElementId{7}}).visited != 0 && ++sweeps < 20'000) {
      }
      QVERIFY(sweeps > 10 && sweeps < 20'000);
      QVERIFY(elastic_energy(*mesh, softness, solver->body().cuts(), solver->body().positions()) > 0.01);
      // Steps below 1e-6 mean rest lengths are not taken; times the stiffness of an element, below 100.
      QVERIFY(largest_slope(*solver, *mesh, softness, 7) < 1e-4);
    }
  }
}

void RelaxationTest::isotropic_energy_is_axial_with_much_lateral_stiffness() {
  for (const RelaxationScheme scheme : {RelaxationScheme::mean, RelaxationScheme::link}) {
    const auto mesh = without_faces(*jittered_triangles(6, 5, 3));
    std::vector<std::vector<double>> ends;
    for (const Softness& softness : {Softness{{0, 100, 100}, {}, EnergyKind::isotropic},
                                     Softness{{0, 100, 100, 1e9, 1, 0}, {}, EnergyKind::axial}}) {
      const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
      solver->set_relaxation(scheme);
      solver->body().set_softness(softness);
      move_by(*solver, *mesh, 7, Point(0.5, -0.25, 0));
      auto positions = positions_of(*solver, *mesh);
      positions.back() += 1;
      solver->body().set_positions(positions);
      wake_all(*solver, *mesh);
      for (int sweep = 0; sweep < 5; ++sweep) {
        solver->relax_slice(0.75, no_limit, std::array{ElementId{7}});
      }
      ends.push_back(positions_of(*solver, *mesh));
    }
    QVERIFY(largest_step(ends[0], ends[1]) < 1e-8);
  }
}

void RelaxationTest::a_turned_object_has_no_corotated_energy_left() {
  // An object that is turned as a whole is at rest for corotated energy, and only for it.
  for (const auto& mesh : {jittered_triangles(6, 5, 3), make_mesh(MeshKind::tetra, {3, 3, 3})}) {
    const Point middle = mesh->rest_position(7);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Point(0, 0, 1)).toRotationMatrix();
    std::vector<double> turned = mesh->rest;
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      const Point at = turn * (mesh->rest_position(e) - middle) + middle;
      for (int k = 0; k < mesh->space_dimension; ++k) {
        turned[std::size_t{e} * mesh->space_dimension + k] = at[k];
      }
    }
    for (const EnergyKind kind : {EnergyKind::axial, EnergyKind::corotated}) {
      for (const RelaxationScheme scheme : {RelaxationScheme::mean, RelaxationScheme::link}) {
        const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
        const Softness softness{{0, 100, 100}, {}, kind};
        solver->body().set_softness(softness);
        solver->set_relaxation(scheme);
        solver->body().set_positions(turned);
        const double energy = elastic_energy(*mesh, softness, solver->body().cuts(), solver->body().positions());
        wake_all(*solver, *mesh);
        solver->relax_slice(1, no_limit, {});
        const double step = largest_step(turned, positions_of(*solver, *mesh));
        QVERIFY2(kind == EnergyKind::corotated ? energy < 1e-18 && step < 1e-8 : energy > 0.1 && step > 0.01,
                 qPrintable(QString("%1 %2").arg(energy).arg(step)));
      }
    }
  }
}

void RelaxationTest::it_ends_at_the_rest_shape_about_the_held_element() {
  // If no region limits it, the equilibrium about one held element is the rest shape, moved along.
  for (const auto& mesh : {make_mesh(MeshKind::cloth, {5, 5, 1}), make_mesh(MeshKind::tetra, {3, 3, 3})}) {
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
    solver->body().set_softness(Softness{{}, {}, EnergyKind::isotropic});
    const Point way(0.125, -0.0625, mesh->space_dimension == 3 ? 0.125 : 0);
    move_by(*solver, *mesh, 7, way);
    wake_all(*solver, *mesh);
    int sweeps = 0;
    while (solver->relax_slice(1, no_limit, std::array{ElementId{7}}).visited != 0 && ++sweeps < 10'000) {
    }
    QVERIFY(sweeps < 10'000);
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      // Steps below 1e-6 are not taken. A hundred sweeps of them would add less than 1e-3.
      QVERIFY((position_of(*solver, *mesh, e) - mesh->rest_position(e) - way).norm() < 1e-3);
    }
  }
}

void RelaxationTest::a_local_move_wakes_few() {
  const auto mesh = make_mesh(MeshKind::grid, {200, 200, 1});
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::single_precision);
  const ElementId centre = 100 * 200 + 100;
  QCOMPARE(move_by(*solver, *mesh, centre, Point(0.05, 0, 0)).moved, std::uint64_t{0});
  solver->wake(std::span(&centre, 1));
  const RelaxationResult first = solver->relax_slice(1, no_limit, std::array{centre});
  QVERIFY(first.visited >= 5);    // the element and its four neighbours
  QVERIFY(first.visited <= 400);  // of 40,000
}

void RelaxationTest::it_sleeps_when_nothing_moves() {
  const auto mesh = make_mesh(MeshKind::grid, {5, 5, 1});
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
  QCOMPARE(solver->relax_slice(1, no_limit, {}).visited, std::uint64_t{0});  // nothing is active at first
  move_by(*solver, *mesh, 0, Point(-3, -2, 0));
  wake_all(*solver, *mesh);
  solver->sleep();
  const RelaxationResult asleep = solver->relax_slice(1, no_limit, {});
  QCOMPARE(asleep.visited, std::uint64_t{0});
  QVERIFY(asleep.sweep_ended);
}

void RelaxationTest::a_slice_goes_on_where_the_last_one_stopped() {
  const auto mesh = jittered_triangles(8, 8, 6);
  const auto whole = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
  const auto sliced = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
  for (Deformer* solver : {whole.get(), sliced.get()}) {
    move_by(*solver, *mesh, 20, Point(3, 1, 0));
    wake_all(*solver, *mesh);
  }
  for (int sweep = 0; sweep < 10; ++sweep) {
    const RelaxationResult at_once = whole->relax_slice(0.7, no_limit, std::array{ElementId{20}});
    RelaxationResult slice = sliced->relax_slice(0.7, 7, std::array{ElementId{20}});
    std::uint64_t visited = slice.visited;
    while (!slice.sweep_ended) {
      QVERIFY(slice.visited <= 7);
      slice = sliced->relax_slice(0.7, 7, std::array{ElementId{20}});
      visited += slice.visited;
    }
    QCOMPARE(visited, at_once.visited);
    QCOMPARE(slice.largest_step, at_once.largest_step);
    QVERIFY(same_bits(positions_of(*whole, *mesh), positions_of(*sliced, *mesh)));
  }
}

CHAINMAIL_TEST(RelaxationTest)

}  // namespace chainmail::test_relaxation

#include "test_relaxation.moc"
