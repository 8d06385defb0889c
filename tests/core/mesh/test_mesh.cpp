#include <QtTest>
#include <algorithm>

#include "core/families.h"
#include "mesh/error.h"
#include "mesh/large_pages.h"
#include "program.h"

namespace chainmail::test_mesh {

using namespace chainmail::test;

/// What a mesh guarantees: the neighbours of each element, their order, and the axes that exist.
class MeshTest : public QObject {
  Q_OBJECT

 private slots:
  void neighbours_ascend_and_double_links_are_one();
  void a_files_own_neighbour_order_is_kept();
  void links_are_numbered_by_first_element();
  void every_link_stands_in_both_rows();
  void find_link_finds_links_and_nothing_else();
  void polygons_are_split_but_their_diagonals_are_no_links();
  void object_dimension_follows_what_is_there();
  void a_grid_has_links_of_one_step_along_an_axis();
  void lengths_and_bounds();
  void a_plane_grid_carries_no_third_coordinate();
  void an_object_in_the_xz_plane_keeps_its_y();
  void a_higher_space_dimension_adds_axes_in_order();
  void a_space_dimension_too_small_is_refused();
  void an_element_alone_is_an_object();
  void kinds_of_rows_are_the_rows();
  void an_irregular_mesh_has_no_kinds_of_rows();
  void large_vectors_begin_a_large_page();
};

namespace {

std::vector<ElementId> row(const Mesh& mesh, ElementId element) {
  const auto neighbours = mesh.neighbours_of(element);
  return {neighbours.begin(), neighbours.end()};
}

MeshParts square() {
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  parts.links = {{0, 1}, {1, 2}, {3, 2}, {0, 3}};
  return parts;
}

/// True if the kinds say the same as the neighbour table and the shapes of its entries.
bool kinds_agree(const Mesh& mesh) {
  const RowKinds& kinds = mesh.row_kinds;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    const std::size_t first = kinds.first[kinds.of[e]], end = kinds.first[kinds.of[e] + std::size_t{1}];
    if (end - first != mesh.neighbours_of(e).size()) {
      return false;
    }
    for (std::size_t i = first; i < end; ++i) {
      const std::size_t entry = mesh.first_entry[e] + i - first;
      if (e + kinds.offset[i] != mesh.neighbours[entry] ||
          (!mesh.entry_shape.empty() && kinds.shape[i] != mesh.entry_shape[entry])) {
        return false;
      }
    }
  }
  return kinds.of.size() == mesh.element_count();
}

/// Element 0 has a link to each other element, so that no two of these have rows of one kind.
MeshPointer star(ElementId elements) {
  MeshParts parts;
  for (ElementId e = 0; e < elements; ++e) {
    parts.rest.emplace_back(e, 0, 0);
    if (e > 0) {
      parts.links.push_back({0, e});
    }
  }
  return build_mesh(std::move(parts));
}

}  // namespace

void MeshTest::neighbours_ascend_and_double_links_are_one() {
  MeshParts parts = square();
  parts.links = {{3, 2}, {1, 0}, {2, 1}, {0, 3}, {1, 2}, {0, 1}};
  const auto mesh = build_mesh(std::move(parts));
  QCOMPARE(mesh->element_count(), 4u);
  QCOMPARE(mesh->link_count(), 4u);
  QCOMPARE(row(*mesh, 0), (std::vector<ElementId>{1, 3}));
  QCOMPARE(row(*mesh, 1), (std::vector<ElementId>{0, 2}));
  QCOMPARE(row(*mesh, 2), (std::vector<ElementId>{1, 3}));
  QCOMPARE(row(*mesh, 3), (std::vector<ElementId>{0, 2}));
}

void MeshTest::a_files_own_neighbour_order_is_kept() {
  MeshParts parts = square();
  parts.links.clear();
  parts.first_entry = {0, 2, 4, 6, 8};
  parts.neighbours = {3, 1, 0, 2, 3, 1, 2, 0};
  const auto mesh = build_mesh(std::move(parts));
  QCOMPARE(row(*mesh, 0), (std::vector<ElementId>{3, 1}));
  QCOMPARE(row(*mesh, 1), (std::vector<ElementId>{0, 2}));
  QCOMPARE(row(*mesh, 2), (std::vector<ElementId>{3, 1}));
  QCOMPARE(row(*mesh, 3), (std::vector<ElementId>{2, 0}));
}

void MeshTest::links_are_numbered_by_first_element() {
  using Links = std::vector<std::array<ElementId, 2>>;
  QVERIFY(build_mesh(square())->links == (Links{{0, 1}, {0, 3}, {1, 2}, {2, 3}}));
  MeshParts parts = square();
  parts.first_entry = {0, 2, 4, 6, 8};
  parts.neighbours = {3, 1, 0, 2, 3, 1, 2, 0};
  // Then in the order of that element's neighbours.
  QVERIFY(build_mesh(std::move(parts))->links == (Links{{0, 3}, {0, 1}, {1, 2}, {2, 3}}));
}

void MeshTest::every_link_stands_in_both_rows() {
  for (const MeshFamily& family : families()) {
    const Mesh& mesh = *family.mesh;
    QCOMPARE(mesh.entry_link.size(), mesh.neighbours.size());
    QCOMPARE(mesh.neighbours.size(), 2 * mesh.links.size());
    for (ElementId e = 0; e < mesh.element_count(); ++e) {
      for (EntryId entry = mesh.first_entry[e]; entry < mesh.first_entry[e + 1]; ++entry) {
        const ElementId other = mesh.neighbours[entry];
        QVERIFY(mesh.links[mesh.entry_link[entry]] == (std::array{std::min(e, other), std::max(e, other)}));
      }
    }
  }
}

void MeshTest::find_link_finds_links_and_nothing_else() {
  for (const MeshFamily& family : families()) {
    const Mesh& mesh = *family.mesh;
    std::size_t found = 0;
    for (ElementId a = 0; a < mesh.element_count(); ++a) {
      for (ElementId b = a + 1; b < mesh.element_count(); ++b) {
        const auto link = find_link(mesh, a, b);
        QVERIFY(link == find_link(mesh, b, a));
        QVERIFY(!link || mesh.links[*link] == (std::array{a, b}));
        found += link ? 1 : 0;
      }
    }
    QCOMPARE(found, mesh.links.size());
  }
}

void MeshTest::polygons_are_split_but_their_diagonals_are_no_links() {
  MeshParts parts = square();
  parts.rest.emplace_back(3, 0.5, 0);
  parts.links.insert(parts.links.end(), {{1, 4}, {2, 4}});
  parts.triangles = {{1, 4, 2}};
  parts.polygons = {4, 0, 1, 2, 3};
  const auto mesh = build_mesh(std::move(parts));
  QCOMPARE(mesh->own_triangles, std::size_t{1});
  QCOMPARE(mesh->triangles.size(), std::size_t{3});
  QVERIFY(mesh->triangles[0] == (std::array<ElementId, 3>{1, 4, 2}));
  QCOMPARE(mesh->link_count(), 6u);
  QVERIFY(!find_link(*mesh, 0, 2) && !find_link(*mesh, 1, 3));
}

void MeshTest::object_dimension_follows_what_is_there() {
  QCOMPARE(make_mesh(MeshKind::line, {5, 1, 1}, 3)->object_dimension, 1);
  QCOMPARE(make_mesh(MeshKind::grid, {5, 4, 1}, 3)->object_dimension, 2);
  QCOMPARE(make_mesh(MeshKind::cloth, {5, 4, 1})->object_dimension, 2);
  QCOMPARE(make_mesh(MeshKind::block, {3, 3, 3})->object_dimension, 3);
  QCOMPARE(make_mesh(MeshKind::tetra, {3, 3, 3})->object_dimension, 3);
  QCOMPARE(sphere(6, 3)->object_dimension, 2);
}

void MeshTest::a_grid_has_links_of_one_step_along_an_axis() {
  using Size = std::array<std::uint32_t, 3>;
  for (const Size& size : {Size{4, 3, 2}, Size{1, 3, 2}, Size{4, 1, 2}, Size{1, 1, 5}}) {
    QVERIFY(make_mesh(MeshKind::block, size)->is_grid);
  }
  QVERIFY(!make_mesh(MeshKind::cloth, {3, 3, 1})->is_grid);
  QVERIFY(!build_mesh(square())->is_grid);  // it is not in a lattice
  const auto with_link = [](ElementId a, ElementId b) {
    const auto grid = make_mesh(MeshKind::block, {3, 2, 2});
    MeshParts parts = placed(*grid, [](const Point& p) { return p; });
    parts.lattice = grid->lattice;
    parts.links.push_back({a, b});
    return build_mesh(std::move(parts));
  };
  QVERIFY(with_link(0, 6)->is_grid);   // this link exists already
  QVERIFY(!with_link(2, 3)->is_grid);  // from the end of a row to the start of the next
  QVERIFY(!with_link(4, 7)->is_grid);  // from the last row of a plane to the first row of the next plane
  QVERIFY(!with_link(0, 2)->is_grid);
  QVERIFY(!with_link(0, 4)->is_grid);
}

void MeshTest::lengths_and_bounds() {
  const auto mesh = build_mesh(square());  // 2 by 1
  QCOMPARE(rest_length(*mesh, *find_link(*mesh, 0, 1)), 2.0);
  QCOMPARE(rest_length(*mesh, *find_link(*mesh, 1, 2)), 1.0);
  QCOMPARE(mesh->mean_link_length, 1.5);
  QVERIFY(bounds(*mesh)[0] == Point(0, 0, 0));
  QVERIFY(bounds(*mesh)[1] == Point(2, 1, 0));
}

void MeshTest::a_plane_grid_carries_no_third_coordinate() {
  const auto mesh = make_mesh(MeshKind::grid, {4, 3, 1});
  QCOMPARE(mesh->space_dimension, 2);
  QCOMPARE(mesh->rest.size(), std::size_t{2 * 12});
  QCOMPARE(make_mesh(MeshKind::line, {7, 1, 1})->rest.size(), std::size_t{7});
}

void MeshTest::an_object_in_the_xz_plane_keeps_its_y() {
  const auto grid = make_mesh(MeshKind::grid, {4, 3, 1});
  const auto mesh = build_mesh(placed(*grid, [](const Point& p) { return Point(p[0], 2.5, p[1]); }));
  QCOMPARE(mesh->space_dimension, 2);
  QCOMPARE(mesh->axes[0], 0);
  QCOMPARE(mesh->axes[1], 2);
  QVERIFY(mesh->rest_position(5) == Point(1, 2.5, 1));
  for (const Precision precision : precisions) {
    const auto solver = std::make_unique<Deformer>(mesh, Algorithm::natural_queue, precision);
    solver->move(5, Point(4, -7, 3));  // there is no y axis here
    QVERIFY(position_of(*solver, *mesh, 5) == Point(4, 2.5, 3));
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      QCOMPARE(position_of(*solver, *mesh, e)[1], 2.5);
    }
  }
}

void MeshTest::a_higher_space_dimension_adds_axes_in_order() {
  const auto line = make_mesh(MeshKind::line, {4, 1, 1}, 2);
  QCOMPARE(line->rest.size(), std::size_t{8});
  QCOMPARE(line->axes[1], 1);
  MeshParts upright = placed(*line, [](const Point& p) { return Point(7, 8, p[0]); });
  upright.space_dimension = 2;
  const auto mesh = build_mesh(std::move(upright));
  QCOMPARE(mesh->axes[0], 0);  // the axes are x and z, and y is constant
  QCOMPARE(mesh->axes[1], 2);
  QVERIFY(mesh->rest_position(3) == Point(7, 8, 3));
}

void MeshTest::a_space_dimension_too_small_is_refused() {
  QVERIFY_EXCEPTION_THROWN(make_mesh(MeshKind::grid, {3, 3, 1}, 1), Error);
  QVERIFY_EXCEPTION_THROWN(make_mesh(MeshKind::block, {2, 2, 2}, 2), Error);
  QVERIFY_EXCEPTION_THROWN(make_mesh(MeshKind::line, {2, 1, 1}, 0), Error);
  QCOMPARE(make_mesh(MeshKind::grid, {3, 1, 1}, 1)->space_dimension, 1);  // a grid of height 1
}

void MeshTest::an_element_alone_is_an_object() {
  const auto mesh = make_mesh(MeshKind::line, {1, 1, 1});
  QCOMPARE(mesh->link_count(), 0u);
  QCOMPARE(mesh->space_dimension, 1);
  const auto solver = std::make_unique<Deformer>(mesh, Algorithm::generalized, Precision::double_precision);
  const PassCount count = solver->move(0, Point(3, 0, 0));
  QCOMPARE(count.checked, std::uint64_t{0});
  QCOMPARE(solver->body().positions()(0, 0), 3.0);
}

void MeshTest::kinds_of_rows_are_the_rows() {
  // A corner, an edge or the inside: three kinds per axis.
  for (const auto& [mesh, kinds] : {std::pair(make_mesh(MeshKind::grid, {6, 5, 1}), 9u),
                                    {make_mesh(MeshKind::block, {4, 5, 6}), 27u},
                                    {make_mesh(MeshKind::line, {7, 1, 1}), 3u}}) {
    QCOMPARE(mesh->row_kinds.first.size(), std::size_t{kinds} + 1);
    QVERIFY(kinds_agree(*mesh));
  }
  for (const MeshKind kind : {MeshKind::cloth, MeshKind::tetra}) {
    const auto mesh = make_mesh(kind, {5, 4, kind == MeshKind::tetra ? 3u : 1u});
    QVERIFY(mesh->row_kinds.known() && kinds_agree(*mesh));
  }
}

void MeshTest::an_irregular_mesh_has_no_kinds_of_rows() {
  const auto few = star(RowKinds::limit), many = star(RowKinds::limit + 1);
  QVERIFY(few->row_kinds.known() && kinds_agree(*few));
  QVERIFY(!many->row_kinds.known());
  QCOMPARE(many->row_kinds.first.size(), std::size_t{0});
}

void MeshTest::large_vectors_begin_a_large_page() {
  LargeVector<int> numbers(2 * large_page / sizeof(int), 7);
  QCOMPARE(reinterpret_cast<std::uintptr_t>(numbers.data()) % large_page, std::uintptr_t{0});
  numbers.push_back(8);
  QCOMPARE(reinterpret_cast<std::uintptr_t>(numbers.data()) % large_page, std::uintptr_t{0});
  QVERIFY(numbers.front() == 7 && numbers[numbers.size() - 2] == 7 && numbers.back() == 8);
  std::vector<int> moved(3 * large_page / sizeof(int), 9);
  move_to_large_pages(std::span<const int>(moved));
  QVERIFY(std::ranges::count(moved, 9) == std::ptrdiff_t(moved.size()));
}

CHAINMAIL_TEST(MeshTest)

}  // namespace chainmail::test_mesh

#include "test_mesh.moc"
