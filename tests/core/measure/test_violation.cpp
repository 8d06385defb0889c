#include <QtTest>
#include <cmath>
#include <numeric>

#include "body/body_view.h"
#include "core/families.h"
#include "equilibrium/link_energy.h"
#include "measure/neighbour_regions.h"
#include "measure/violation.h"
#include "program.h"

namespace chainmail::test_violation {

using namespace chainmail::test;

/// Violation, energy and displacement, compared with figures computed by hand.
class ViolationTest : public QObject {
  Q_OBJECT

 private slots:
  void of_a_stretched_and_of_a_compressed_link();
  void is_the_norm_over_the_axes();
  void is_in_rest_lengths_of_the_link();
  void over_the_whole_mesh();
  void cut_links_do_not_count();
  void again_after_a_change();
  void costs_what_changed();
  void what_is_no_number_is_violated();
  void of_a_link_without_length();
  void counts_from_1e_4_on();
  void energy_by_hand();
  void axial_energy_by_hand();
  void corotated_energy_by_hand();
  void weights_of_a_link_without_length();
  void displacement_by_hand();
  void regions_of_neighbours_by_hand();
  void regions_agree_with_the_violation();
};

namespace {

// For positions and regions that are short decimals below 10: a few roundings.
constexpr double rounding = 1e-14;

/// Returns a solver with given positions.
std::unique_ptr<Deformer> at(const MeshPointer& mesh, const std::vector<double>& positions) {
  auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, Precision::double_precision);
  solver->body().set_positions(positions);
  return solver;
}

/// Two elements at one position, and a third 8 away: the mean rest length is 4.
MeshPointer with_link_without_length() {
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {0, 0, 0}, {8, 0, 0}};
  parts.links = {{0, 1}, {1, 2}};
  return build_mesh(std::move(parts));
}

bool close(double value, double expected) { return std::abs(value - expected) <= rounding; }

}  // namespace

void ViolationTest::of_a_stretched_and_of_a_compressed_link() {
  const auto mesh = make_mesh(MeshKind::line, {3, 1, 1});
  const auto solver = at(mesh, {0, 1.5, 2});
  QVERIFY(close(link_violation(*mesh, {}, solver->body().positions(), 0), 0.3));  // 1.5 − 1.2
  QVERIFY(close(link_violation(*mesh, {}, solver->body().positions(), 1), 0.3));  // 0.8 − 0.5
  QCOMPARE(link_violation(*mesh, {{0.5, 1.5, 0}, {}}, solver->body().positions(), 0), 0.0);
  QVERIFY(close(link_violation(*mesh, {{}, {{1, {1, 1, 0}}}}, solver->body().positions(), 1), 0.5));
}

void ViolationTest::is_the_norm_over_the_axes() {
  const auto mesh = make_mesh(MeshKind::line, {2, 1, 1}, 2);
  // 0.3 too far on x, 0.4 too far on y, where 0.1 is allowed.
  const auto solver = at(mesh, {0, 0, 1.5, -0.5});
  QVERIFY(close(link_violation(*mesh, {}, solver->body().positions(), 0), 0.5));
}

void ViolationTest::is_in_rest_lengths_of_the_link() {
  const auto mesh = make_mesh(MeshKind::line, {2, 1, 1}, {}, 4);
  const auto solver = at(mesh, {0, 6.8});  // 4.8 is allowed
  QVERIFY(close(link_violation(*mesh, {}, solver->body().positions(), 0), 0.5));
}

void ViolationTest::over_the_whole_mesh() {
  const auto mesh = make_mesh(MeshKind::line, {5, 1, 1});
  const auto solver = at(mesh, {0, 1.5, 2.5, 4.1, 5.1});  // violations 0.3, 0, 0.4, 0
  const Violation violation = measure_violation(*mesh, {}, solver->body().cuts(), solver->body().positions());
  QCOMPARE(violation.links, std::uint64_t{4});
  QVERIFY(close(violation.max, 0.4));
  QVERIFY(close(violation.rms, std::sqrt((0.09 + 0.16) / 4)));
  QCOMPARE(violation.fraction, 0.5);
  const auto rest = at(mesh, mesh->rest);
  QVERIFY(measure_violation(*mesh, {{1, 1, 0}, {}}, rest->body().cuts(), rest->body().positions()) ==
          (Violation{0, 0, 0, 4}));
}

void ViolationTest::cut_links_do_not_count() {
  const auto mesh = make_mesh(MeshKind::line, {5, 1, 1});
  const auto solver = at(mesh, {0, 1.5, 2.5, 4.1, 5.1});
  const LinkId worst = 2;
  solver->body().cut(std::span(&worst, 1));
  const Violation violation = measure_violation(*mesh, {}, solver->body().cuts(), solver->body().positions());
  QCOMPARE(violation.links, std::uint64_t{3});
  QVERIFY(close(violation.max, 0.3));
  const LinkId rest[] = {0, 1, 3};
  solver->body().cut(rest);
  QVERIFY(measure_violation(*mesh, {}, solver->body().cuts(), solver->body().positions()) == Violation{});
  QCOMPARE(elastic_energy(*mesh, {}, solver->body().cuts(), solver->body().positions()), 0.0);
}

/// Some elements move, links are cut, the softness changes: the sums are those of a new measurement.
void ViolationTest::again_after_a_change() {
  std::mt19937_64 random(7);
  for (const MeshFamily& family : families()) {
    const Mesh& mesh = *family.mesh;
    const auto solver = at(family.mesh, mesh.rest);
    std::vector<double> positions = mesh.rest;
    Softness softness;
    ViolationMeter meter;
    const auto agrees = [&] {
      solver->body().set_positions(positions);
      const Cuts& cuts = solver->body().cuts();
      const PositionView view = solver->body().positions();
      const MeasuredViolation again = meter.measure(mesh, softness, cuts, view, mesh.link_count());
      return again.is_whole && again == measure_violation(mesh, softness, cuts, view);
    };
    QVERIFY(agrees());
    for (int i = 0; i < 20; ++i) {
      ElementBlocks moved(mesh.element_count());
      const auto element = static_cast<ElementId>(random() % mesh.element_count());
      positions[std::size_t{element} * mesh.space_dimension] += uniform(random, -2, 2);
      moved.insert(element);
      meter.forget(mesh, moved);
      QVERIFY(agrees());
    }
    const LinkId cut = mesh.link_count() / 2;
    solver->body().cut(std::span(&cut, 1));
    meter.forget(std::span(&cut, 1));
    QVERIFY(agrees());
    softness.global = {1, 1, 0};
    meter.forget_all();
    QVERIFY(agrees());
  }
}

/// After a local change of a large object, only few links are measured. If that is not enough, the result says so, and
/// the links measured so far are from all parts.
void ViolationTest::costs_what_changed() {
  const auto mesh = make_mesh(MeshKind::grid, {200, 200, 1});
  std::vector<double> positions = mesh->rest;
  const auto solver = at(mesh, positions);
  ViolationMeter meter;
  const auto measure = [&](LinkId most) {
    return meter.measure(*mesh, {}, solver->body().cuts(), solver->body().positions(), most);
  };
  const MeasuredViolation first = measure(mesh->link_count());
  QVERIFY(first.is_whole && first.links == mesh->link_count());
  positions[2 * 20'100] += 3;
  solver->body().set_positions(positions);
  ElementBlocks moved(mesh->element_count());
  moved.insert(20'100);
  meter.forget(*mesh, moved);
  QVERIFY(!meter.is_complete());
  const MeasuredViolation second = measure(1000);
  QVERIFY(second.is_whole && second.links == mesh->link_count() && second.max > 1 && second.at >= first.at);
  // All elements on the right are far too far away: half of the links are stretched across.
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    positions[2 * std::size_t{e}] = mesh->rest_position(e).x() * (mesh->rest_position(e).y() < 100 ? 1 : 3);
  }
  solver->body().set_positions(positions);
  meter.forget_all();
  const MeasuredViolation part = measure(4000);
  QVERIFY(!part.is_whole && part.links >= 4000 && part.links < 5000);
  QVERIFY2(part.fraction > 0.2 && part.fraction < 0.3, std::to_string(part.fraction).c_str());
  MeasuredViolation whole;
  for (int i = 0; i < 20 && !whole.is_whole; ++i) {
    whole = measure(4000);
  }
  QVERIFY(whole.is_whole && whole == measure_violation(*mesh, {}, solver->body().cuts(), solver->body().positions()));
}

void ViolationTest::what_is_no_number_is_violated() {
  const auto mesh = make_mesh(MeshKind::line, {3, 1, 1});
  const auto solver = at(mesh, {0, 1, std::nan("")});
  const Violation violation = measure_violation(*mesh, {}, solver->body().cuts(), solver->body().positions());
  QCOMPARE(violation.fraction, 0.5);
  QVERIFY(std::isinf(violation.max));
}

void ViolationTest::of_a_link_without_length() {
  const auto mesh = with_link_without_length();
  const auto solver = at(mesh, {0, 0.5, 8.5});
  QVERIFY(close(link_violation(*mesh, {}, solver->body().positions(), 0), 0.5 / 4));
  QCOMPARE(measure_violation(*mesh, {}, solver->body().cuts(), solver->body().positions()).max, 0.5 / 4);
  const double zero = 0, half = 0.5;
  QCOMPARE(candidate_violation(*mesh, 1, &half, 0, &zero, Region<double, 1>{{0}, {0}}), 0.5 / 4);
}

void ViolationTest::counts_from_1e_4_on() {
  const auto mesh = make_mesh(MeshKind::line, {3, 1, 1});
  const auto solver = at(mesh, {0, 1.2 + 0.5e-4, 2.4 + 2e-4});  // beyond the limit by 0.5e-4 and by 1.5e-4
  const Violation violation = measure_violation(*mesh, {}, solver->body().cuts(), solver->body().positions());
  QCOMPARE(violation.fraction, 0.5);
  QVERIFY(violation.max > 1.4e-4 && violation.max < 1.6e-4);
}

void ViolationTest::energy_by_hand() {
  const Softness isotropic{{}, {}, EnergyKind::isotropic};
  const auto line = make_mesh(MeshKind::line, {3, 1, 1}, 2);
  const auto solver = at(line, {0, 0, 1.5, 0.5, 2.5, 0.25});
  // Deflections (0.5, 0.5) and (0, −0.25).
  QCOMPARE(elastic_energy(*line, isotropic, solver->body().cuts(), solver->body().positions()),
           (0.25 + 0.25 + 0.0625) / 2);
  // Translated without deformation, it has no energy.
  const auto carried = at(line, {8, 4, 9, 4, 10, 4});
  QCOMPARE(elastic_energy(*line, isotropic, carried->body().cuts(), carried->body().positions()), 0.0);
}

void ViolationTest::axial_energy_by_hand() {
  // One link with the rest vector (3, 4), whose second end is displaced by (0.5, 0): 0.3 along the link.
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {3, 4, 0}};
  parts.links = {{0, 1}};
  const auto mesh = build_mesh(std::move(parts));
  const auto solver = at(mesh, {0, 0, 3.5, 4});
  const auto energy = [&](const LinkSoftness& softness, EnergyKind kind) {
    return elastic_energy(*mesh, {softness, {}, kind}, solver->body().cuts(), solver->body().positions());
  };
  // ½ k |r|^p (0.3² + b 0.5²)
  QVERIFY(close(energy({}, EnergyKind::axial), (0.09 + 0.25) / 5 / 2));
  QVERIFY(close(energy({0.8, 1.2, 0.1, 0, 3, 0}, EnergyKind::axial), 3 * 0.09 / 2));
  QVERIFY(close(energy({0.8, 1.2, 0.1, 2, 0.5, 2}, EnergyKind::axial), 0.5 * 25 * (0.09 + 2 * 0.25) / 2));
  QVERIFY(close(energy({0.8, 1.2, 0.1, 2, 0.5, 2}, EnergyKind::isotropic), 0.25 / 2));
}

void ViolationTest::corotated_energy_by_hand() {
  // A link alone turns with its ends, so it has the energy of its length, and of its lateral stiffness on it.
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {3, 4, 0}};
  parts.links = {{0, 1}};
  const auto mesh = build_mesh(std::move(parts));
  const auto solver = at(mesh, {1, 1, 1, 7});  // turned, and 6 long instead of 5
  const Softness softness{{0.8, 1.2, 0.1, 0.5, 2, 0}, {}, EnergyKind::corotated};
  QVERIFY(close(elastic_energy(*mesh, softness, solver->body().cuts(), solver->body().positions()), 2 * 1.5 / 2));
  // A turned cube has none; a stretched one has that of its links along the axis, wherever it is turned.
  const auto block = make_mesh(MeshKind::block, {2, 2, 2});
  for (const double stretch : {1.0, 1.5}) {
    std::vector<double> positions;
    for (ElementId e = 0; e < 8; ++e) {
      const Point p = block->rest_position(e);
      const Point turned(-p.y(), stretch * p.x(), p.z());
      positions.insert(positions.end(), turned.data(), turned.data() + 3);
    }
    const auto moved = at(block, positions);
    const double energy = elastic_energy(*block, softness, moved->body().cuts(), moved->body().positions());
    QVERIFY(std::abs(energy - 4 * 2 * 1.5 * (stretch - 1) * (stretch - 1) / 2) < 1e-13);
  }
}

void ViolationTest::weights_of_a_link_without_length() {
  const auto mesh = with_link_without_length();
  const Softness softness{{0.8, 1.2, 0.1, 0.25, 3, -2}, {}};
  QCOMPARE(link_weights(*mesh, softness, 0).axial, 0.0);
  QCOMPARE(link_weights(*mesh, softness, 0).lateral, 3 / 16.0 / 4);
  QCOMPARE(link_weights(*mesh, softness, 1).axial, 3 / 64.0);
  QCOMPARE(link_weights(*mesh, softness, 1).lateral, 3 / 64.0 / 4);
  // The first link is pulled to 2, the second shortened by 1.
  const auto solver = at(mesh, {0, 2, 9});
  for (const EnergyKind kind : {EnergyKind::axial, EnergyKind::corotated}) {
    const double energy =
        elastic_energy(*mesh, {softness.global, {}, kind}, solver->body().cuts(), solver->body().positions());
    QVERIFY(close(energy, (4 * 3 / 64.0 + (3 + 0.75) / 64.0) / 2));
  }
}

void ViolationTest::displacement_by_hand() {
  const auto mesh = make_mesh(MeshKind::line, {4, 1, 1}, 2);
  const auto solver = at(mesh, {0, 0, 1, 0, 2, 0, 6, 4});  // the last one by (3, 4)
  const Displacement displacement = measure_displacement(*mesh, solver->body().positions());
  QCOMPARE(displacement.max, 5.0);
  QCOMPARE(displacement.rms, 2.5);
}

void ViolationTest::regions_of_neighbours_by_hand() {
  // The middle element of three in a plane is moved. Its link to the right is softer, and a cut neighbour has no
  // region.
  const auto mesh = make_mesh(MeshKind::grid, {3, 2, 1});
  std::vector<double> positions = mesh->rest;
  positions[2] = 1.5;  // element 1
  positions[3] = 0.25;
  const auto solver = at(mesh, positions);
  Cuts cuts(mesh);
  cuts.cut(*find_link(*mesh, 1, 4));
  const Softness softness{{0.75, 1.25, 0.125}, {{*find_link(*mesh, 1, 2), {0.5, 2, 0.25}}}};
  const auto regions = neighbour_regions(*mesh, softness, cuts, solver->body().positions(), 1, 10);
  QCOMPARE(regions.size(), std::size_t{2});
  const NeighbourRegion &left = regions[0], &right = regions[1];
  QCOMPARE(left.neighbour, 0U);
  QVERIFY(left.low == Point(0.25, 0.125, 0) && left.high == Point(0.75, 0.375, 0));
  QVERIFY(!left.inside && left.at == Point(0, 0, 0) && left.nearest == Point(0.25, 0.125, 0));
  QCOMPARE(right.neighbour, 2U);
  QVERIFY(right.low == Point(2, 0, 0) && right.high == Point(3.5, 0.5, 0));
  QVERIFY(right.inside && right.at == Point(2, 0, 0) && right.nearest == right.at);
  QCOMPARE(neighbour_regions(*mesh, softness, cuts, solver->body().positions(), 1, 1).size(), std::size_t{1});
}

void ViolationTest::regions_agree_with_the_violation() {
  std::mt19937_64 random(5);
  for (const MeshFamily& family : families()) {
    const Mesh& mesh = *family.mesh;
    std::vector<double> positions = mesh.rest;
    for (double& x : positions) {
      x += uniform(random, -0.3, 0.3);
    }
    const auto solver = at(family.mesh, positions);
    for (ElementId e = 0; e < mesh.element_count(); ++e) {
      const auto regions = neighbour_regions(mesh, {}, Cuts(family.mesh), solver->body().positions(), e, 1000);
      QCOMPARE(regions.size(), mesh.neighbours_of(e).size());
      for (const NeighbourRegion& region : regions) {
        const double apart = (region.at - region.nearest).norm() / rest_length(mesh, region.link);
        QVERIFY(std::abs(apart - link_violation(mesh, {}, solver->body().positions(), region.link)) < 1e-12);
        QCOMPARE(region.inside, apart <= counts_as_violated);
      }
    }
  }
}

CHAINMAIL_TEST(ViolationTest)

}  // namespace chainmail::test_violation

#include "test_violation.moc"
