#include <QtTest>

#include "core/hexahedra.h"
#include "core/spheres.h"
#include "core/support.h"
#include "mesh/layers.h"
#include "program.h"

namespace chainmail::test_layers {

using namespace chainmail::test;

namespace {

using Elements = std::vector<ElementId>;

/// Returns the elements for whose rest position `where` is true.
template <class Where>
Elements elements(const Mesh& mesh, Where where) {
  Elements found;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    if (where(mesh.rest_position(e))) {
      found.push_back(e);
    }
  }
  return found;
}

Elements side(const Mesh& mesh, std::string_view name) { return layer(mesh, *find_side(name)); }

/// Returns the elements of a lattice of spacing 1 that are at an end of one of the first axes.
Elements rim(const Mesh& mesh, int axes) {
  const auto& [low, high] = mesh.box;
  return elements(mesh, [&, low = low, high = high](const Point& at) {
    return ((at - low).head(axes).array() == 0).any() || ((high - at).head(axes).array() == 0).any();
  });
}

}  // namespace

/// The elements that a user can pin: sides and boundaries.
class LayersTest : public QObject {
  Q_OBJECT

 private slots:
  void sides_have_names();
  void a_layer_is_where_its_axis_ends_data();
  void a_layer_is_where_its_axis_ends();
  void a_layer_reaches_half_a_link_deep();
  void an_axis_that_is_not_there_has_no_layer();
  void a_volume_ends_at_its_outer_surface();
  void a_sheet_ends_at_its_open_edges();
  void a_grid_and_a_chain_end_at_their_rim();
  void a_closed_surface_ends_nowhere();
};

void LayersTest::sides_have_names() {
  for (const ObjectSide& one : object_sides) {
    QCOMPARE(find_side(one.name), &one);
  }
  QVERIFY(find_side("Left") == nullptr && find_side("") == nullptr && find_side("boundary") == nullptr);
}

void LayersTest::a_layer_is_where_its_axis_ends_data() {
  QTest::addColumn<int>("kind");
  QTest::newRow("block") << int(MeshKind::block);
  QTest::newRow("tetra") << int(MeshKind::tetra);
}

void LayersTest::a_layer_is_where_its_axis_ends() {
  QFETCH(const int, kind);
  const auto mesh = make_mesh(MeshKind(kind), {5, 4, 3}, {}, 0.5);
  const std::array<std::size_t, 3> counts{4 * 3, 5 * 3, 5 * 4};
  for (const ObjectSide& one : object_sides) {
    const double at = mesh->box[one.high ? 1 : 0][one.axis];
    QCOMPARE(layer(*mesh, one), elements(*mesh, [&](const Point& p) { return p[one.axis] == at; }));
    QCOMPARE(layer(*mesh, one).size(), counts[std::size_t(one.axis)]);
  }
}

/// An object whose end is not flat. The mean link length is 1.2.
void LayersTest::a_layer_reaches_half_a_link_deep() {
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {1, 0.4, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1.8, 0}, {2, 1, 0}};
  parts.links = {{0, 1}, {1, 2}, {3, 4}, {4, 5}, {0, 3}, {1, 4}, {2, 5}};
  const auto mesh = build_mesh(std::move(parts));
  QCOMPARE(side(*mesh, "bottom"), (Elements{0, 1, 2}));
  QCOMPARE(side(*mesh, "top"), Elements{4});
  QCOMPARE(side(*mesh, "left"), (Elements{0, 3}));
}

void LayersTest::an_axis_that_is_not_there_has_no_layer() {
  const auto grid = make_mesh(MeshKind::grid, {4, 3, 1});
  QVERIFY(side(*grid, "back").empty() && side(*grid, "front").empty());
  const auto in_space = make_mesh(MeshKind::grid, {4, 3, 1}, 3);
  QCOMPARE(side(*in_space, "back").size(), std::size_t(12));
  const auto chain = make_mesh(MeshKind::line, {6, 1, 1});
  QCOMPARE(side(*chain, "right"), Elements{5});
  QVERIFY(side(*chain, "top").empty());
}

void LayersTest::a_volume_ends_at_its_outer_surface() {
  const auto tetra = make_mesh(MeshKind::tetra, {5, 4, 4});
  QCOMPARE(boundary(*tetra), rim(*tetra, 3));
  QCOMPARE(boundary(*tetra).size(), std::size_t(5 * 4 * 4 - 3 * 2 * 2));
  const auto hexahedra = hexahedral_block({4, 3, 3});
  QCOMPARE(boundary(*hexahedra), rim(*hexahedra, 3));
}

void LayersTest::a_sheet_ends_at_its_open_edges() {
  const auto cloth = make_mesh(MeshKind::cloth, {5, 4, 1});
  QCOMPARE(boundary(*cloth), rim(*cloth, 2));
  MeshParts holed = sphere_parts(2);
  const auto [a, b, c] = holed.triangles.back();
  holed.triangles.pop_back();
  Elements corners{a, b, c};
  std::ranges::sort(corners);
  QCOMPARE(boundary(*build_mesh(std::move(holed))), corners);
}

void LayersTest::a_grid_and_a_chain_end_at_their_rim() {
  const auto grid = make_mesh(MeshKind::grid, {5, 4, 1});
  QCOMPARE(boundary(*grid), rim(*grid, 2));
  const auto block = make_mesh(MeshKind::block, {4, 4, 4});
  QCOMPARE(boundary(*block), rim(*block, 3));
  QCOMPARE(boundary(*make_mesh(MeshKind::line, {6, 1, 1})), (Elements{0, 5}));
}

void LayersTest::a_closed_surface_ends_nowhere() { QVERIFY(boundary(*octahedral_sphere(3)).empty()); }

CHAINMAIL_TEST(LayersTest)

}  // namespace chainmail::test_layers

#include "test_layers.moc"
