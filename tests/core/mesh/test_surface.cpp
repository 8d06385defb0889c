#include <Eigen/Geometry>
#include <QtTest>
#include <map>
#include <numeric>
#include <set>

#include "core/hexahedra.h"
#include "core/support.h"
#include "mesh/surface.h"
#include "program.h"

namespace chainmail::test_surface {

using namespace chainmail::test;

namespace {

/// Tetrahedra next to hexahedra, with common elements but no common side, a link that is not the edge of a cell, and a
/// chain.
MeshPointer mixed() {
  MeshParts parts = hexahedral_parts({3, 2, 2});
  const auto tetra = make_mesh(MeshKind::tetra, {3, 3, 3});
  const auto first = static_cast<ElementId>(parts.rest.size());
  for (ElementId e = 0; e < tetra->element_count(); ++e) {
    parts.rest.push_back(tetra->rest_position(e) + Point(3, 0, 0));
  }
  for (auto cell : tetra->tetrahedra) {
    std::for_each(cell.begin(), cell.end(), [first](ElementId& e) { e += first; });
    parts.tetrahedra.push_back(cell);
  }
  parts.links.clear();
  add_links_along_edges(parts);
  parts.links.push_back({0, 5});  // across a side of the first hexahedron
  parts.rest.emplace_back(-1, 0, 0);
  parts.links.push_back({0, static_cast<ElementId>(parts.rest.size() - 1)});
  return build_mesh(std::move(parts));
}

std::vector<MeshPointer> volumes() {
  return {make_mesh(MeshKind::tetra, {4, 3, 3}), hexahedral_block({3, 2, 4}), mixed()};
}

struct Sight {
  std::set<SideId> sides;
  std::set<LinkId> links;
  bool operator==(const Sight&) const = default;
};

Sight sight_of(const Surface& surface) {
  return {{surface.sides().begin(), surface.sides().end()}, {surface.links().begin(), surface.links().end()}};
}

std::set<ElementId> corners_of(const CellTable& table, SideId side) {
  const Side corners = table.side(side);
  return {corners.corners().begin(), corners.corners().end()};
}

bool is_whole(const CellTable& table, const Cuts& cuts, CellId cell) {
  const auto corners = table.corners_of(cell);
  return std::none_of(table.edges_of(cell).begin(), table.edges_of(cell).end(), [&](const CellEdge& edge) {
    return is_cut_between(*table.mesh(), cuts, corners[edge[0]], corners[edge[1]]);
  });
}

/// Returns what is visible by the definition alone: compares every side with every other.
Sight plainly(const CellTable& table, const Cuts& cuts) {
  Sight sight;
  std::map<std::set<ElementId>, std::vector<SideId>> whole_by_corners;
  for (SideId side = 0; side < table.side_count(); ++side) {
    if (is_whole(table, cuts, table.cell_of(side))) {
      whole_by_corners[corners_of(table, side)].push_back(side);
    }
  }
  for (const auto& [corners, sides] : whole_by_corners) {
    if (sides.size() == 1) {
      sight.sides.insert(sides.front());
    }
  }
  for (LinkId link = 0; link < table.mesh()->link_count(); ++link) {
    const auto [a, b] = table.mesh()->links[link];
    bool in_cell = false, in_whole = false, on_side = false;
    for (CellId cell = 0; cell < table.cell_count(); ++cell) {
      const auto corners = table.corners_of(cell);
      for (const auto& [i, j] : table.edges_of(cell)) {
        if (std::minmax(corners[i], corners[j]) == std::minmax(a, b)) {
          in_cell = true;
          in_whole = in_whole || is_whole(table, cuts, cell);
          for (const SideId side : sight.sides) {
            const auto of_side = corners_of(table, side);
            on_side = on_side || (table.cell_of(side) == cell && of_side.count(a) != 0 && of_side.count(b) != 0);
          }
        }
      }
    }
    if (in_cell && !cuts.is_cut(link) && (on_side || !in_whole)) {
      sight.links.insert(link);
    }
  }
  return sight;
}

}  // namespace

/// The outer surface of cells, and its local changes by cuts.
class SurfaceTest : public QObject {
  Q_OBJECT

 private slots:
  void a_block_has_its_outer_sides();
  void sides_look_outward();
  void links_in_no_cell_are_told_apart();
  void a_mesh_without_cells_has_nothing();
  void cuts_show_what_a_look_at_everything_shows();
  void uncutting_restores_it();
  void three_cells_on_one_side_and_collapsed_ones_do_no_harm();
  void a_side_is_parted_alike_from_both_cells();
};

void SurfaceTest::a_block_has_its_outer_sides() {
  const auto outer = [](std::uint32_t x, std::uint32_t y, std::uint32_t z) { return 2 * (x * y + y * z + z * x); };
  const Surface tetra(std::make_shared<CellTable>(make_mesh(MeshKind::tetra, {6, 5, 4})));
  QCOMPARE(tetra.sides().size(), 2 * outer(5, 4, 3));
  QCOMPARE(tetra.triangles().size(), 3 * tetra.sides().size());
  // Euler's formula: the number of links is the number of corners and faces, minus two.
  QCOMPARE(tetra.links().size(), tetra.sides().size() + (6 * 5 * 4 - 4 * 3 * 2) - 2);
  const Surface hexa(std::make_shared<CellTable>(hexahedral_block({5, 4, 3})));
  QCOMPARE(hexa.sides().size(), outer(5, 4, 3));
  QCOMPARE(hexa.triangles().size(), 6 * hexa.sides().size());
  QCOMPARE(hexa.links().size(), 2 * outer(5, 4, 3));
}

void SurfaceTest::sides_look_outward() {
  MeshParts mirrored = hexahedral_parts({2, 2, 2});
  for (Point& at : mirrored.rest) {
    at.x() = -at.x();  // every cell is inverted now
  }
  auto meshes = volumes();
  meshes.push_back(build_mesh(std::move(mirrored)));
  for (const auto& mesh : {meshes[0], meshes[1], meshes[3]}) {
    const Surface surface(std::make_shared<CellTable>(mesh));
    const auto corners = surface.triangles();
    const Point middle = (mesh->box[0] + mesh->box[1]) / 2;
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      const Point a = mesh->rest_position(corners[i]), b = mesh->rest_position(corners[i + 1]),
                  c = mesh->rest_position(corners[i + 2]);
      QVERIFY((b - a).cross(c - a).dot(a - middle) > 0);
    }
  }
}

void SurfaceTest::links_in_no_cell_are_told_apart() {
  const auto mesh = mixed();
  const auto last = mesh->element_count() - 1;
  const CellTable table(mesh);
  QCOMPARE(table.loose_links(), (std::vector<LinkId>{*find_link(*mesh, 0, 5), *find_link(*mesh, 0, last)}));
}

void SurfaceTest::a_mesh_without_cells_has_nothing() {
  const auto mesh = make_mesh(MeshKind::cloth, {5, 5, 1});
  Surface surface(std::make_shared<CellTable>(mesh));
  QVERIFY(surface.table().empty() && surface.table().loose_links().empty());
  surface.cut(3);
  surface.uncut(3);
  QVERIFY(surface.sides().empty() && surface.links().empty() && surface.triangles().empty());
}

void SurfaceTest::cuts_show_what_a_look_at_everything_shows() {
  std::mt19937_64 random(7);
  for (const auto& mesh : volumes()) {
    const auto table = std::make_shared<CellTable>(mesh);
    Surface surface(table);
    Cuts cuts(mesh);
    QCOMPARE(sight_of(surface), plainly(*table, cuts));
    for (int step = 0; step < 60; ++step) {
      const auto link = static_cast<LinkId>(random() % mesh->link_count());
      // Uncuts rarely, so that parts come loose and cells have several cut links.
      if (cuts.is_cut(link) && random() % 2 == 0) {
        cuts.uncut(link);
        surface.uncut(link);
      } else {
        cuts.cut(link);
        surface.cut(link);
      }
      if (step % 6 == 5) {
        QCOMPARE(sight_of(surface), plainly(*table, cuts));
      }
    }
    QCOMPARE(sight_of(Surface(table, cuts)), sight_of(surface));
  }
}

void SurfaceTest::uncutting_restores_it() {
  for (const auto& mesh : volumes()) {
    Surface surface(std::make_shared<CellTable>(mesh));
    const Sight before = sight_of(surface);
    std::vector<LinkId> links(mesh->link_count());
    std::iota(links.begin(), links.end(), LinkId{0});
    std::shuffle(links.begin(), links.end(), std::mt19937_64(3));
    for (const LinkId link : links) {
      surface.cut(link);
      surface.cut(link);  // it was already cut
    }
    QVERIFY(surface.sides().empty() && surface.links().empty());
    std::shuffle(links.begin(), links.end(), std::mt19937_64(4));
    for (const LinkId link : links) {
      surface.uncut(link);
    }
    QCOMPARE(sight_of(surface), before);
  }
}

void SurfaceTest::three_cells_on_one_side_and_collapsed_ones_do_no_harm() {
  MeshParts parts;
  parts.rest = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1), Point(0, 0, -1), Point(1, 1, 2)};
  parts.tetrahedra = {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 1, 2, 5}, {0, 1, 2, 3}, {3, 3, 4, 5}};
  parts.hexahedra = {{0, 1, 2, 2, 3, 4, 5, 5}};
  parts.links = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}, {0, 4}, {1, 4}, {2, 4}, {3, 4}, {4, 5}, {5, 3}};
  Surface surface(std::make_shared<CellTable>(build_mesh(std::move(parts))));
  const Sight before = sight_of(surface);
  QVERIFY(!before.sides.empty());
  for (LinkId link = 0; link < surface.table().mesh()->link_count(); ++link) {
    surface.cut(link);
  }
  for (LinkId link = 0; link < surface.table().mesh()->link_count(); ++link) {
    surface.uncut(link);
  }
  QCOMPARE(sight_of(surface), before);
}

void SurfaceTest::a_side_is_parted_alike_from_both_cells() {
  const CellTable table(hexahedral_block({2, 1, 1}));
  const auto diagonals = [&](SideId side) {
    std::vector<ElementId> corners;
    append_triangles(table.side(side), corners);
    return std::set<ElementId>{corners[0], corners[2]};
  };
  int inner = 0;
  for (SideId side = 0; side < table.side_count(); ++side) {
    if (table.twin(side) != CellTable::none) {
      QCOMPARE(diagonals(side), diagonals(table.twin(side)));
      ++inner;
    }
  }
  QCOMPARE(inner, 2);
}

CHAINMAIL_TEST(SurfaceTest)

}  // namespace chainmail::test_surface

#include "test_surface.moc"
