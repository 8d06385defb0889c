// Solids whose cells were divided, against the same shape meshed beforehand.

#include <Eigen/Core>
#include <QtTest>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "body/handle.h"
#include "mesh/cells.h"
#include "mesh/generate.h"
#include "mesh/layers.h"
#include "mesh/split_along.h"
#include "program.h"
#include "solver/deformer.h"

namespace chainmail::test_divided_solids {

class DividedSolidsTest : public QObject {
  Q_OBJECT

 private slots:
  void a_divided_notch_opens_as_one_meshed_beforehand_data();
  void a_divided_notch_opens_as_one_meshed_beforehand();
  void relaxation_takes_as_many_iterations_as_before();
};

namespace {

constexpr double bar_length = 16, bar_width = 6;

/// A bar of tetrahedra, `columns` wide cells along its length. It begins at the origin.
MeshPointer bar(std::uint32_t columns) {
  const MeshPointer regular = generate({MeshKind::tetra, {columns + 1, 7, 7}, 1, {}});
  MeshParts parts;
  for (ElementId e = 0; e < regular->element_count(); ++e) {
    parts.rest.push_back(regular->rest_position(e).cwiseProduct(Point(bar_length / columns, 1, 1)));
  }
  parts.tetrahedra = regular->tetrahedra;
  add_links_along_edges(parts);
  return build_mesh(std::move(parts));
}

/// Opens a bar from above to the middle of its height, between two columns of cells: elements are doubled.
MeshPointer notched_bar() {
  const MeshPointer whole = bar(std::uint32_t(bar_length));
  MeshParts parts;
  std::vector<ElementId> copy(whole->element_count());
  for (ElementId e = 0; e < whole->element_count(); ++e) {
    parts.rest.push_back(whole->rest_position(e));
  }
  for (ElementId e = 0; e < whole->element_count(); ++e) {
    const Point at = whole->rest_position(e);
    copy[e] = e;
    if (at.x() == bar_length / 2 && at.y() > bar_width / 2) {
      copy[e] = ElementId(parts.rest.size());
      parts.rest.push_back(at);
    }
  }
  for (auto cell : whole->tetrahedra) {
    if (std::ranges::any_of(cell, [&](ElementId e) { return whole->rest_position(e).x() > bar_length / 2; })) {
      std::ranges::transform(cell, cell.begin(), [&](ElementId e) { return copy[e]; });
    }
    parts.tetrahedra.push_back(cell);
  }
  add_links_along_edges(parts);
  return build_mesh(std::move(parts));
}

/// A blade through the middle of the length, from above to the middle of the height, along z.
SplitPointer notch(const MeshPointer& mesh) {
  std::vector<ViewPlace> places;
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    places.push_back({mesh->rest_position(e).head<2>()});
  }
  const std::vector<Eigen::Vector2d> stroke{{bar_length / 2, 2 * bar_width}, {bar_length / 2, bar_width / 2 - 1e-3}};
  return make_split(mesh, split_along(*mesh, places, stroke));
}

/// Returns where the two lips of the notch are along x, in the middle of the width (mesh units).
std::array<double, 2> lips(const Mesh& mesh, std::span<const double> positions) {
  std::array<double, 2> lip{-1, 2 * bar_length};
  double left = -1, right = 2 * bar_length;  // at rest
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    const Point rest = mesh.rest_position(e);
    const double x = positions[3 * e];
    if (rest.y() != bar_width || rest.z() != bar_width / 2) {
      continue;
    }
    // Of two elements at the same place, the right one is on the right.
    if (rest.x() <= bar_length / 2 && (rest.x() > left || x < lip[0])) {
      left = rest.x();
      lip[0] = x;
    }
    if (rest.x() >= bar_length / 2 && (rest.x() < right || x > lip[1])) {
      right = rest.x();
      lip[1] = x;
    }
  }
  return {lip[0] - left, lip[1] - right};
}

/// Pulls the right end of a bar by a tenth of its length; the left one is held.
double opening(const MeshPointer& mesh, Algorithm algorithm, std::span<const LinkId> cuts = {}) {
  Deformer deformer(mesh, algorithm);
  deformer.cut(cuts);
  deformer.pin(layer(*mesh, *find_side("left")));
  Handle handle(deformer.body(), layer(*mesh, *find_side("right")));
  Pose target = handle.grabbed();
  target.pivot.x() += bar_length / 10;
  deformer.move(handle, target);
  std::vector<double> positions(mesh->rest.size());
  deformer.body().copy_positions(positions);
  const auto [left, right] = lips(*mesh, positions);
  return right - left;
}

/// The links that a blade at the notch crosses.
std::vector<LinkId> links_at_notch(const Mesh& mesh) {
  std::vector<LinkId> result;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    const Point a = mesh.rest_position(mesh.links[link][0]), b = mesh.rest_position(mesh.links[link][1]);
    const bool crosses = (a.x() < bar_length / 2) != (b.x() < bar_length / 2);
    if (crosses && (a + b).y() / 2 >= bar_width / 2) {
      result.push_back(link);
    }
  }
  return result;
}

}  // namespace

void DividedSolidsTest::a_divided_notch_opens_as_one_meshed_beforehand_data() {
  QTest::addColumn<Algorithm>("algorithm");
  for (const Algorithm one : {Algorithm::linear_fem, Algorithm::corotational, Algorithm::neo_hookean}) {
    QTest::newRow(std::string(info(one).name).c_str()) << one;
  }
}

/// Both notches lie between cells of the same width, within 6 %.
void DividedSolidsTest::a_divided_notch_opens_as_one_meshed_beforehand() {
  QFETCH(Algorithm, algorithm);
  const double right = opening(notched_bar(), algorithm);
  const MeshPointer whole = bar(std::uint32_t(bar_length) + 1);
  const double divided = opening(notch(whole)->after(), algorithm);
  const double removed = opening(whole, algorithm, links_at_notch(*whole));
  qInfo("opening of the notch: meshed beforehand %.4f, divided %.4f, cells removed %.4f", right, divided, removed);
  QVERIFY(right > 0.5);
  QVERIFY(std::abs(divided / right - 1) <= 0.02);
  QVERIFY(std::abs(removed / right - 1) > 0.02);
}

/// Iterations to the equilibrium of the material after a pull, and after a division of what is pulled.
void DividedSolidsTest::relaxation_takes_as_many_iterations_as_before() {
  const MeshPointer whole = bar(std::uint32_t(bar_length) + 1);
  Deformer deformer(whole, Algorithm::natural_queue);
  deformer.set_softness({{0, 1000, 1000}, {}, EnergyKind::material});
  deformer.set_relaxation(RelaxationScheme::equilibrium);
  deformer.pin(layer(*whole, *find_side("left")));
  const std::vector<ElementId> end = layer(*whole, *find_side("right"));
  Handle handle(deformer.body(), end);
  Pose target = handle.grabbed();
  target.pivot.x() += bar_length / 10;
  deformer.move(handle, target);
  const RelaxOptions options{.scheme = RelaxationScheme::equilibrium};
  const int before = deformer.relax(1000, options).sweeps;
  deformer.split(notch(whole), deformer.body().snapshot());
  deformer.hold(end);
  const int after = deformer.relax(1000, options).sweeps;
  qInfo("iterations: %d whole, %d divided", before, after);
  QVERIFY(before > 0 && after > 0);
  QVERIFY(after <= 1.5 * before);
  const Mesh& mesh = deformer.body().mesh();
  std::vector<double> at(mesh.rest.size());
  deformer.body().copy_positions(at);
  const auto place = [&](ElementId e) { return Point(at[3 * e], at[3 * e + 1], at[3 * e + 2]); };
  for (const auto& [a, b, c, d] : mesh.tetrahedra) {
    const Point from = place(a);
    QVERIFY((place(b) - from).cross(place(c) - from).dot(place(d) - from) > 0);
  }
  QVERIFY(lips(mesh, at)[1] - lips(mesh, at)[0] > 0.5);  // it has opened
}

CHAINMAIL_TEST(DividedSolidsTest)

}  // namespace chainmail::test_divided_solids

#include "test_divided_solids.moc"
