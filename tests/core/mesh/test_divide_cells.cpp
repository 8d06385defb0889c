#include <Eigen/Geometry>
#include <QtTest>
#include <map>
#include <random>
#include <set>

#include "mesh/cells.h"
#include "mesh/divide_cells.h"
#include "mesh/error.h"
#include "mesh/generate.h"
#include "mesh/parts.h"
#include "mesh/surface.h"
#include "program.h"
#include "property.h"

namespace chainmail::test_divide_cells {

using namespace chainmail::test;

/// Divides cells along strokes.
class DivideCellsTest : public QObject {
  Q_OBJECT

 private slots:
  void a_stroke_across_makes_two_parts_data();
  void a_stroke_across_makes_two_parts();
  void a_stroke_that_ends_inside_leaves_one_part();
  void only_cells_with_a_reached_link_are_crossed();
  void a_stroke_along_faces_only_doubles_elements();
  void a_stroke_through_elements_makes_two_parts();
  void a_stroke_beside_the_object_changes_nothing();
  void a_stroke_that_leaves_and_enters_again_makes_three_parts();
  void a_stroke_across_an_earlier_cut_makes_four_parts();
  void the_wound_has_the_area_of_the_blade_twice();
  void ten_strokes_keep_the_cells_good_data();
  void ten_strokes_keep_the_cells_good();
  void perspective_places_elements_on_the_stroke();
  void nothing_behind_the_eye_is_divided();
  void only_hexahedra_at_the_stroke_become_tetrahedra();
  void faces_are_divided_with_their_cells_data();
  void faces_are_divided_with_their_cells();
  void cells_that_are_gone_stay_gone_data();
  void cells_that_are_gone_stay_gone();
  void edits_that_do_not_fit_are_refused();
};

namespace {

using Stroke = std::vector<Eigen::Vector2d>;
using Triangle = std::array<ElementId, 3>;
using Tetrahedron = std::array<ElementId, 4>;

constexpr std::array<std::uint32_t, 3> size{9, 7, 7};

double random_between(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Returns a block of tetrahedra or hexahedra of edge length 1. Elements inside are moved by up to `jitter` along each
/// axis.
MeshPointer block(bool hexahedra, double jitter, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const MeshPointer regular = generate({MeshKind::tetra, size, 1, {}});
  MeshParts parts;
  for (ElementId e = 0; e < regular->element_count(); ++e) {
    Point at = regular->rest_position(e);
    const bool inside = (at.array() > 0).all() && at.x() < size[0] - 1 && at.y() < size[1] - 1 && at.z() < size[2] - 1;
    for (int k = 0; k < 3 && inside; ++k) {
      at[k] += random_between(random, -jitter, jitter);
    }
    parts.rest.push_back(at);
    if (hexahedra && (regular->rest_position(e).array() + 1 < Eigen::Array3d(size[0], size[1], size[2])).all()) {
      const ElementId up = size[0], back = size[0] * size[1];
      parts.hexahedra.push_back(
          {e, e + 1, e + up + 1, e + up, e + back, e + back + 1, e + back + up + 1, e + back + up});
    }
  }
  if (!hexahedra) {
    parts.tetrahedra = regular->tetrahedra;
  }
  add_links_along_edges(parts);
  return build_mesh(std::move(parts));
}

/// Views a mesh along a direction. One mesh unit is 20 pixels. `depth` makes things nearer that are further along it.
std::vector<ViewPlace> seen(const Mesh& mesh, const Point& along, double depth = 0) {
  const Point to = along.normalized(), right = to.unitOrthogonal(), up = to.cross(right);
  std::vector<ViewPlace> places;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    const Point at = mesh.rest_position(e) - Point(4, 3, 3);
    const double distance = 1 - depth * at.dot(to);
    places.push_back({Eigen::Vector2d(at.dot(right), at.dot(up)) * 20 / distance, distance});
  }
  return places;
}

/// Views a mesh along z, with the first element at the origin. One mesh unit is 20 pixels.
std::vector<ViewPlace> seen_along_z(const Mesh& mesh) {
  std::vector<ViewPlace> places;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    places.push_back({20 * mesh.rest_position(e).head<2>(), 1});
  }
  return places;
}

SplitPointer split_of(const MeshPointer& mesh, const std::vector<ViewPlace>& places, const Stroke& stroke) {
  SplitEdit edit = divide_cells(*mesh, places, stroke);
  return edit.empty() ? nullptr : make_split(mesh, std::move(edit));
}
SplitPointer split_of(const MeshPointer& mesh, const Stroke& stroke) {
  return split_of(mesh, seen_along_z(*mesh), stroke);
}

/// Returns the tetrahedra for which the cells of a mesh stand.
std::vector<Tetrahedron> all_tetrahedra(const Mesh& mesh) {
  std::vector<Tetrahedron> all = mesh.tetrahedra;
  for (const auto& cell : mesh.hexahedra) {
    for_each_tetrahedron(mesh, cell, [&](const Tetrahedron& one) { all.push_back(one); });
  }
  return all;
}

/// Six times the volume.
double volume(const Mesh& mesh, const Tetrahedron& t) {
  const Point at = mesh.rest_position(t[0]);
  return (mesh.rest_position(t[1]) - at).cross(mesh.rest_position(t[2]) - at).dot(mesh.rest_position(t[3]) - at);
}

/// Returns the radius of the inscribed sphere relative to that of the circumscribed one, times 3.
double quality(const Mesh& mesh, const Tetrahedron& t) {
  Eigen::Matrix3d edges;
  Eigen::Vector3d half;
  for (int i = 0; i < 3; ++i) {
    edges.row(i) = mesh.rest_position(t[std::size_t(i) + 1]) - mesh.rest_position(t[0]);
    half[i] = edges.row(i).squaredNorm() / 2;
  }
  double area = 0;
  for (const auto& [i, j, k] : tetrahedron_sides) {
    const Point a = mesh.rest_position(t[std::size_t(i)]);
    area += (mesh.rest_position(t[std::size_t(j)]) - a).cross(mesh.rest_position(t[std::size_t(k)]) - a).norm() / 2;
  }
  return 3 * (std::abs(edges.determinant()) / 2 / area) / edges.colPivHouseholderQr().solve(half).norm();
}

double worst_quality(const Mesh& mesh) {
  double worst = 1;
  for (const Tetrahedron& one : all_tetrahedra(mesh)) {
    worst = std::min(worst, quality(mesh, one));
  }
  return worst;
}

double total_volume(const Mesh& mesh) {
  double sum = 0;
  for (const Tetrahedron& one : all_tetrahedra(mesh)) {
    sum += volume(mesh, one);
  }
  return sum;
}

/// Returns the faces of tetrahedra that have no other tetrahedron across, counterclockwise as seen from outside. Empty
/// if a face belongs to more than two tetrahedra, or to two on the same side of it.
std::vector<Triangle> boundary(const Mesh& mesh) {
  std::map<Triangle, std::vector<Triangle>> faces;
  for (const Tetrahedron& one : all_tetrahedra(mesh)) {
    for (const auto& [i, j, k] : tetrahedron_sides) {
      const Triangle face{one[std::size_t(i)], one[std::size_t(j)], one[std::size_t(k)]};
      Triangle key = face;
      std::ranges::sort(key);
      faces[key].push_back(face);
    }
  }
  std::vector<Triangle> result;
  for (const auto& [key, all] : faces) {
    const auto is_even = [key = key](Triangle face) {
      std::rotate(face.begin(), std::ranges::min_element(face), face.end());
      return face == key;
    };
    if (all.size() > 2 || (all.size() == 2 && is_even(all[0]) == is_even(all[1]))) {
      return {};
    }
    if (all.size() == 1) {
      result.push_back(all[0]);
    }
  }
  return result;
}

/// True if at each edge as many triangles run in one direction as in the other.
bool is_closed(const std::vector<Triangle>& surface) {
  std::map<std::array<ElementId, 2>, int> sum;
  for (const auto& [a, b, c] : surface) {
    for (const auto& [from, to] : {std::array{a, b}, std::array{b, c}, std::array{c, a}}) {
      sum[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
    }
  }
  return !surface.empty() && std::ranges::all_of(sum, [](const auto& one) { return one.second == 0; });
}

/// Returns the links that the cells of a mesh have as edges.
std::set<std::array<ElementId, 2>> edges_of_cells(const Mesh& mesh) {
  std::set<std::array<ElementId, 2>> edges;
  const auto add = [&](const auto& cell) {
    for (const auto& [i, j] : edges_of(cell)) {
      const ElementId a = cell[std::size_t(i)], b = cell[std::size_t(j)];
      edges.insert({std::min(a, b), std::max(a, b)});
    }
  };
  std::ranges::for_each(mesh.tetrahedra, add);
  std::ranges::for_each(mesh.hexahedra, add);
  return edges;
}

/// True if all corners lie on one of the six planes around the block.
bool is_outside(const Mesh& mesh, std::span<const ElementId> corners) {
  bool result = false;
  for (Eigen::Index k = 0; k < 3; ++k) {
    for (const double plane : {0.0, size[std::size_t(k)] - 1.0}) {
      result = result || std::ranges::all_of(corners, [&](ElementId e) { return mesh.rest_position(e)[k] == plane; });
    }
  }
  return result;
}

/// Returns what is wrong with the cells after a split; empty if nothing is.
std::string flaw_of(const Split& split) {
  const MeshPointer divided = split.after(), whole = split.before();
  const Mesh &before = *whole, &after = *divided;
  if (!std::equal(before.rest.begin(), before.rest.end(), after.rest.begin())) {
    return "an old element has moved";
  }
  double lengths = 0;
  for (LinkId link = 0; link < after.link_count(); ++link) {
    lengths += rest_length(after, link);
  }
  if (std::abs(after.mean_link_length * after.link_count() - lengths) > 1e-12 * lengths) {
    return "the mean link length is that of other links";
  }
  const double sum = total_volume(before);
  if (std::abs(total_volume(after) - sum) > 1e-12 * sum) {
    return "the volume has changed";
  }
  const auto all = all_tetrahedra(after);
  if (std::ranges::any_of(all, [&](const Tetrahedron& one) { return volume(after, one) <= 0; })) {
    return "a cell is flat or inside out";
  }
  if (!is_closed(boundary(after))) {
    return "the surface is not closed";
  }
  // Sides of hexahedra coincide with those of tetrahedra.
  const Surface surface(std::make_shared<CellTable>(divided));
  if (surface.triangles().size() != 3 * boundary(after).size()) {
    return "sides inside the object have no twin";
  }
  if (std::ranges::any_of(surface.sides(), [&](SideId side) {
        return surface.is_inner(side) == is_outside(after, surface.table().side(side).corners());
      })) {
    return "skin and inner sides are mixed up";
  }
  if (edges_of_cells(after) != std::set(after.links.begin(), after.links.end())) {
    return "links and edges of cells differ";
  }
  std::set<ElementId> used;
  for (const Tetrahedron& one : all) {
    used.insert(one.begin(), one.end());
  }
  return used.size() == after.element_count() ? "" : "an element belongs to no cell";
}

/// Returns the area of the inner sides at rest.
double inner_area(const MeshPointer& mesh) {
  const Surface surface(std::make_shared<CellTable>(mesh));
  double area = 0;
  for (const SideId side : surface.sides()) {
    std::vector<ElementId> corners;
    if (surface.is_inner(side)) {
      append_triangles(surface.table().side(side), corners);
    }
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      const Point at = mesh->rest_position(corners[i]);
      area += (mesh->rest_position(corners[i + 1]) - at).cross(mesh->rest_position(corners[i + 2]) - at).norm() / 2;
    }
  }
  return area;
}

Cuts cuts_of(const MeshPointer& mesh, const std::vector<LinkId>& links) {
  Cuts cuts(mesh);
  std::ranges::for_each(links, [&](LinkId link) { cuts.cut(link); });
  return cuts;
}

/// Returns six times the volume of the cells that are not gone.
double whole_volume(const MeshPointer& mesh, const std::vector<LinkId>& cut) {
  const Cuts cuts = cuts_of(mesh, cut);
  double sum = 0;
  const auto add = [&](const Tetrahedron& one) { sum += volume(*mesh, one); };
  for (const auto& cell : mesh->tetrahedra) {
    if (is_whole(*mesh, cuts, cell)) {
      add(cell);
    }
  }
  for (const auto& cell : mesh->hexahedra) {
    if (is_whole(*mesh, cuts, cell)) {
      for_each_tetrahedron(*mesh, cell, add);
    }
  }
  return sum;
}

double new_tetrahedra_per_old_one(const Split& split) {
  std::size_t old = 0;
  for (const CellId cell : split.edit().removed_cells) {
    old += cell < split.before()->tetrahedra.size() ? 1 : 6;
  }
  return double(split.edit().tetrahedra.size() + 6 * split.edit().hexahedra.size()) /
         double(std::max<std::size_t>(old, 1));
}

void add_objects() {
  QTest::addColumn<bool>("hexahedra");
  QTest::addColumn<double>("jitter");
  QTest::newRow("regular tetrahedra") << false << 0.0;
  QTest::newRow("jittered tetrahedra") << false << 0.2;
  QTest::newRow("regular hexahedra") << true << 0.0;
  QTest::newRow("jittered hexahedra") << true << 0.15;
}

Point random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> one;
  return {one(random), one(random), one(random)};
}

}  // namespace

void DivideCellsTest::a_stroke_across_makes_two_parts_data() { add_objects(); }

void DivideCellsTest::a_stroke_across_makes_two_parts() {
  QFETCH(const bool, hexahedra);
  QFETCH(const double, jitter);
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    std::mt19937_64 random(seed);
    const MeshPointer mesh = block(hexahedra, jitter, seed);
    const auto places = seen(*mesh, random_direction(random));
    const double angle = random_between(random, 0, 6), offset = random_between(random, -25, 25);
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle)), middle(-offset * along.y(), offset * along.x());
    const auto split = split_of(mesh, places, {middle - 300 * along, middle + 10 * along, middle + 300 * along});
    QVERIFY(split != nullptr);
    const MeshPointer divided = split->after();
    QCOMPARE(flaw_of(*split), std::string());
    QCOMPARE(divided->part_count, 2U);
    QVERIFY(new_tetrahedra_per_old_one(*split) <= 6);
    QVERIFY(worst_quality(*divided) >= std::min(worst_quality(*mesh), least_piece_quality) - 1e-12);
    // New elements between two are on the stroke.
    for (ElementId i = 0; i < split->edit().elements.size(); ++i) {
      const SplitPoint& point = split->edit().elements[i];
      if (!point.is_copy()) {
        const auto at = point.mix<Eigen::Vector2d>(places[point.of[0]].at, places[point.of[1]].at, {0, 0});
        QVERIFY(std::abs(along.x() * (at - middle).y() - along.y() * (at - middle).x()) < 1e-4);
      }
    }
  }
}

void DivideCellsTest::a_stroke_that_ends_inside_leaves_one_part() {
  for (const bool hexahedra : {false, true}) {
    for (int i = 0; i < 12; ++i) {
      const MeshPointer mesh = block(hexahedra, hexahedra ? 0.15 : 0.2, std::uint64_t(i));
      const Stroke slit{{-40, 50 + i}, {20 + 7.3 * i, 60}};
      const auto split = split_of(mesh, slit);
      QVERIFY(split != nullptr);
      const MeshPointer divided = split->after();
      QCOMPARE(flaw_of(*split), std::string());
      QCOMPARE(divided->part_count, 1U);
      // The cut is about as long as the stroke: no copy lies beyond its end.
      double furthest = 0;
      for (ElementId e = mesh->element_count(); e < divided->element_count(); ++e) {
        if (split->edit().elements[e - mesh->element_count()].is_copy()) {
          furthest = std::max(furthest, 20 * divided->rest_position(e).x());
        }
      }
      QVERIFY(furthest <= slit[1].x() + 10 && furthest >= slit[1].x() - 50);
    }
  }
}

void DivideCellsTest::only_cells_with_a_reached_link_are_crossed() {
  for (const bool hexahedra : {false, true}) {
    const MeshPointer mesh = block(hexahedra, 0.15, 5);
    const double top = size[2] - 1;
    std::vector<LinkId> reached;
    for (LinkId link = 0; link < mesh->link_count(); ++link) {
      const auto& [a, b] = mesh->links[link];
      if (mesh->rest_position(a).z() == top && mesh->rest_position(b).z() == top) {
        reached.push_back(link);
      }
    }
    const auto stroke = Stroke{{-40, 50}, {300, 64}};
    SplitEdit edit = divide_cells(*mesh, seen_along_z(*mesh), stroke, reached);
    QVERIFY(!edit.empty());
    const auto split = make_split(mesh, std::move(edit));
    const MeshPointer divided = split->after();
    QCOMPARE(flaw_of(*split), std::string());
    QCOMPARE(divided->part_count, 1U);
    // The wound is one cell deep; the elements of the next layer are moved by up to 0.15.
    for (ElementId e = mesh->element_count(); e < divided->element_count(); ++e) {
      QVERIFY(divided->rest_position(e).z() >= top - 1.15);
    }
    QVERIFY(divide_cells(*mesh, seen_along_z(*mesh), stroke, std::span<const LinkId>()).empty());
  }
}

void DivideCellsTest::a_stroke_along_faces_only_doubles_elements() {
  for (const bool hexahedra : {false, true}) {
    const MeshPointer mesh = block(hexahedra, 0, 1);
    const auto split = split_of(mesh, {{60, -30}, {60, 200}});
    const MeshPointer divided = split->after();
    QCOMPARE(flaw_of(*split), std::string());
    QCOMPARE(divided->part_count, 2U);
    QCOMPARE(split->edit().elements.size(), std::size_t{size[1]} * size[2]);
    QVERIFY(std::ranges::all_of(split->edit().elements, &SplitPoint::is_copy));
    QCOMPARE(divided->tetrahedra.size(), mesh->tetrahedra.size());
    QCOMPARE(divided->hexahedra.size(), mesh->hexahedra.size());
  }
}

void DivideCellsTest::a_stroke_through_elements_makes_two_parts() {
  const std::vector<std::pair<const char*, Stroke>> strokes{
      {"along diagonals", {{-20, -20}, {160, 160}}},          {"across diagonals", {{-20, 120}, {160, -60}}},
      {"through every second", {{-40, 0}, {200, 120}}},       {"beside a layer", {{-50, 60.3}, {200, 59.7}}},
      {"bent at elements", {{60, -20}, {60, 60}, {200, 60}}}, {"within the snap", {{-50, 42}, {200, 43}}}};
  for (const auto& [name, stroke] : strokes) {
    for (const bool hexahedra : {false, true}) {
      const auto split = split_of(block(hexahedra, 0, 1), stroke);
      QVERIFY2(split != nullptr && flaw_of(*split).empty(), name);
      const MeshPointer divided = split->after();
      QVERIFY2(divided->part_count == 2, name);
      QVERIFY2(worst_quality(*divided) >= least_piece_quality - 1e-12, name);
    }
  }
}

void DivideCellsTest::a_stroke_beside_the_object_changes_nothing() {
  for (const bool hexahedra : {false, true}) {
    const MeshPointer mesh = block(hexahedra, 0, 1);
    for (const Stroke& stroke : std::vector<Stroke>{{{-50, -50}, {300, -40}},
                                                    {{-50, 0}, {300, 0}},      // along a side
                                                    {{160, -50}, {160, 300}},  // along another
                                                    {{-50, -3}, {300, 2}},     // nearer to a side than the snap
                                                    {{50, 50}},
                                                    {{50, 50}, {50, 50}},
                                                    {{45, 45}, {46, 45}},  // inside one cell
                                                    {}}) {
      QVERIFY(split_of(mesh, stroke) == nullptr);
    }
  }
}

void DivideCellsTest::a_stroke_that_leaves_and_enters_again_makes_three_parts() {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const MeshPointer mesh = block(seed % 2 == 1, 0.15, seed);
    const auto split = split_of(mesh, {{47, -30}, {49, 150}, {90, 160}, {111, -30}});
    QVERIFY(split != nullptr);
    const MeshPointer divided = split->after();
    QCOMPARE(flaw_of(*split), std::string());
    QCOMPARE(divided->part_count, 3U);
  }
}

void DivideCellsTest::a_stroke_across_an_earlier_cut_makes_four_parts() {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const MeshPointer mesh = block(seed % 2 == 1, 0.15, seed);
    const auto first = split_of(mesh, {{71, -30}, {79, 150}});
    const auto second = split_of(first->after(), {{-30, 52}, {200, 69}});
    QCOMPARE(flaw_of(*second), std::string());
    QCOMPARE(second->after()->part_count, 4U);
  }
}

void DivideCellsTest::the_wound_has_the_area_of_the_blade_twice() {
  for (const bool hexahedra : {false, true}) {
    const MeshPointer mesh = block(hexahedra, 0, 1);
    QCOMPARE(inner_area(mesh), 0.0);
    const auto first = split_of(mesh, {{70, -30}, {70, 200}});
    QVERIFY(std::abs(inner_area(first->after()) - 2 * 6 * 6) < 1e-9);
    const auto second = split_of(first->after(), {{-30, 50}, {200, 50}});
    QVERIFY(std::abs(inner_area(second->after()) - 2 * (6 * 6 + 8 * 6)) < 1e-9);
  }
}

void DivideCellsTest::ten_strokes_keep_the_cells_good_data() { add_objects(); }

void DivideCellsTest::ten_strokes_keep_the_cells_good() {
  QFETCH(const bool, hexahedra);
  QFETCH(const double, jitter);
  QVERIFY(check_property(
      "strokes keep the volume, the surface and good cells",
      [&] {
        std::mt19937_64 random(std::uint64_t(*rc::gen::inRange(0, 1 << 20)));
        MeshPointer mesh = block(hexahedra, jitter, random());
        const double uncut = worst_quality(*mesh);
        int splits = 0;
        for (int cut = 0; cut < 10; ++cut) {
          Stroke stroke;
          for (std::uint64_t i = 2 + random() % 4; i > 0; --i) {
            stroke.emplace_back(random_between(random, -110, 110), random_between(random, -110, 110));
            if (random() % 4 == 0) {  // at elements of a regular block, if it is seen along an axis
              stroke.back() = (stroke.back() / 10).array().round() * 10;
            }
          }
          Point along = random_direction(random);
          if (random() % 3 == 0) {
            along = Point::Unit(Eigen::Index(random() % 3));
          }
          const auto split = split_of(mesh, seen(*mesh, along, random() % 2 == 0 ? 0.05 : 0), stroke);
          if (split == nullptr) {
            continue;
          }
          const MeshPointer divided = split->after();
          RC_ASSERT(flaw_of(*split) == "");
          RC_ASSERT(divided->part_count >= mesh->part_count);
          RC_ASSERT(new_tetrahedra_per_old_one(*split) <= 6);
          RC_ASSERT(worst_quality(*divided) >= std::min(uncut, least_piece_quality) - 1e-12);
          mesh = divided;
          ++splits;
        }
        RC_ASSERT(splits > 0);
      },
      4));
}

void DivideCellsTest::perspective_places_elements_on_the_stroke() {
  const MeshPointer mesh = block(false, 0.2, 4);
  const auto places = seen(*mesh, Point(1, 2, 3), 0.1);
  const auto split = split_of(mesh, places, {{-300, 12}, {300, 12}});
  const MeshPointer divided = split->after();
  QCOMPARE(divided->part_count, 2U);
  const auto after = seen(*divided, Point(1, 2, 3), 0.1);
  for (ElementId i = 0; i < split->edit().elements.size(); ++i) {
    if (!split->edit().elements[i].is_copy()) {
      QVERIFY(std::abs(after[mesh->element_count() + i].at.y() - 12) < 1e-4);
    }
  }
}

void DivideCellsTest::nothing_behind_the_eye_is_divided() {
  const MeshPointer mesh = block(false, 0, 1);
  auto places = seen_along_z(*mesh);
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    places[e].distance = mesh->rest_position(e).z() > 2.5 ? -1 : 1;
  }
  const auto split = split_of(mesh, places, {{70, -30}, {70, 200}});
  const MeshPointer divided = split->after();
  QCOMPARE(flaw_of(*split), std::string());
  QCOMPARE(divided->part_count, 1U);
  for (const SplitPoint& point : split->edit().elements) {
    QVERIFY(point.is_copy() || mesh->rest_position(point.of[0]).z() < 2.5);
  }
}

void DivideCellsTest::only_hexahedra_at_the_stroke_become_tetrahedra() {
  const MeshPointer mesh = block(true, 0, 1);
  const auto split = split_of(mesh, {{70, -30}, {70, 200}});
  const MeshPointer divided = split->after();
  QCOMPARE(flaw_of(*split), std::string());
  const std::size_t layer = (size[1] - 1) * (size[2] - 1);
  QCOMPARE(split->edit().removed_cells.size(), layer);
  QCOMPARE(divided->hexahedra.size(), mesh->hexahedra.size() - layer);
}

void DivideCellsTest::faces_are_divided_with_their_cells_data() { add_objects(); }

/// The object has its surface as faces.
void DivideCellsTest::faces_are_divided_with_their_cells() {
  QFETCH(const bool, hexahedra);
  QFETCH(const double, jitter);
  const MeshPointer cells = block(hexahedra, jitter, 1);
  MeshParts parts;
  for (ElementId e = 0; e < cells->element_count(); ++e) {
    parts.rest.push_back(cells->rest_position(e));
  }
  parts.tetrahedra = cells->tetrahedra;
  parts.hexahedra = cells->hexahedra;
  const CellTable table(cells);
  for (SideId side = 0; side < table.side_count(); ++side) {
    if (const Side corners = table.side(side); table.twin(side) == CellTable::none && corners.count == 3) {
      parts.triangles.push_back({corners.corner[0], corners.corner[1], corners.corner[2]});
    } else if (table.twin(side) == CellTable::none) {
      parts.polygons.push_back(4);
      parts.polygons.insert(parts.polygons.end(), corners.corner.begin(), corners.corner.end());
    }
  }
  add_links_along_edges(parts);
  const MeshPointer mesh = build_mesh(std::move(parts));
  const auto split = split_of(mesh, {{-30, 42}, {200, 87}});
  const MeshPointer divided = split->after();
  QCOMPARE(flaw_of(*split), std::string());
  QCOMPARE(divided->part_count, 2U);
  std::set<Triangle> surface;
  for (Triangle one : boundary(*divided)) {
    std::ranges::sort(one);
    surface.insert(one);
  }
  double area = 0;
  for (Triangle one : std::span(divided->triangles).first(divided->own_triangles)) {
    const Point a = divided->rest_position(one[0]);
    area += (divided->rest_position(one[1]) - a).cross(divided->rest_position(one[2]) - a).norm() / 2;
    std::ranges::sort(one);
    QVERIFY(surface.contains(one));
  }
  for (std::size_t i = 0; i < divided->polygons.size(); i += 5) {
    std::array<Point, 4> at;
    std::array<ElementId, 4> ring;
    std::copy_n(divided->polygons.begin() + std::ptrdiff_t(i) + 1, 4, ring.begin());
    std::ranges::transform(ring, at.begin(), [&](ElementId e) { return divided->rest_position(e); });
    area += (at[2] - at[0]).cross(at[3] - at[1]).norm() / 2;
    QVERIFY(is_outside(*divided, ring));
  }
  QVERIFY(std::abs(area - 2 * (8 * 6 + 8 * 6 + 6 * 6)) < 1e-9);
}

void DivideCellsTest::cells_that_are_gone_stay_gone_data() { add_objects(); }

/// Cuts links, so that cells are gone, and then splits across the gap, which no cell fills again.
void DivideCellsTest::cells_that_are_gone_stay_gone() {
  QFETCH(const bool, hexahedra);
  QFETCH(const double, jitter);
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    std::mt19937_64 random(seed);
    const MeshPointer mesh = block(hexahedra, jitter, seed);
    std::vector<LinkId> cut;
    for (LinkId link = 0; link < mesh->link_count(); ++link) {
      const double a = mesh->rest_position(mesh->links[link][0]).x(), b = mesh->rest_position(mesh->links[link][1]).x();
      if ((seed % 2 == 0 && (a < 4.4) != (b < 4.4)) || (seed % 2 == 1 && random() % 50 == 0)) {
        cut.push_back(link);
      }
    }
    const auto split = split_of(mesh, {{-30, 20 + 7.0 * double(seed)}, {200, 90 - 3.0 * double(seed)}});
    QVERIFY(split != nullptr);
    const MeshPointer divided = split->after();
    const auto after = cuts_after(*split, cut);
    const double grown = whole_volume(divided, after) - whole_volume(mesh, cut);
    QVERIFY(grown < 1e-9);
    QVERIFY(grown > -1e-9 || (hexahedra && jitter > 0));  // a diagonal may be that of a bent hexahedron that is gone
    // What remains is on one of the two sides of the blade.
    const std::uint32_t parts = count_parts(*mesh, cuts_of(mesh, cut));
    QCOMPARE(count_parts(*divided, cuts_of(divided, after)), 2 * parts);
  }
  // One cell with all links at one element cut, which a blade separates from the others.
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  parts.tetrahedra = {{0, 1, 2, 3}};
  add_links_along_edges(parts);
  const MeshPointer mesh = build_mesh(std::move(parts));
  const std::vector<Eigen::Vector2d> alone{{0, 0}, {10, -9}, {10, 1}, {10, 9}},
      paired{{0, 0}, {0, 5}, {10, 0}, {10, 5}};
  for (const auto& at : {alone, paired}) {
    std::vector<ViewPlace> places;
    std::ranges::for_each(at, [&](const Eigen::Vector2d& one) { places.push_back({one}); });
    const auto split = split_of(mesh, places, {{5, -90}, {5, 90}});
    QVERIFY(split != nullptr);
    const MeshPointer divided = split->after();
    const auto after = cuts_after(*split, std::vector<LinkId>{0, 1, 2});
    QCOMPARE(whole_volume(divided, after), 0.0);
    QCOMPARE(count_parts(*divided, cuts_of(divided, after)), at == alone ? 2U : 3U);
  }
}

void DivideCellsTest::edits_that_do_not_fit_are_refused() {
  const MeshPointer mesh = block(false, 0, 1);
  const auto problem_of = [](const MeshPointer& of, SplitEdit edit) {
    try {
      make_split(of, std::move(edit));
    } catch (const Error& error) {
      return error.problem();
    }
    return std::string();
  };
  const auto problem = [&](std::vector<std::uint32_t> removed, std::vector<Tetrahedron> tetrahedra,
                           std::vector<std::array<ElementId, 8>> hexahedra = {}) {
    return problem_of(
        mesh, {{SplitPoint::copy(0)}, {}, {}, {}, {}, std::move(removed), std::move(tetrahedra), std::move(hexahedra)});
  };
  const ElementId next = mesh->element_count();
  const auto cells = static_cast<std::uint32_t>(mesh->tetrahedra.size());
  const std::string order = "the cells to replace are not ascending numbers below " + std::to_string(cells),
                    corners = "a new face or cell does not have three or more different corners that exist";
  QCOMPARE(problem({0}, {{next, 1, 9, 70}}), std::string());
  QCOMPARE(problem({cells}, {{next, 1, 9, 70}}), order);
  QCOMPARE(problem({1, 0}, {{next, 1, 9, 70}}), order);
  QCOMPARE(problem({0, 0}, {{next, 1, 9, 70}}), order);
  QCOMPARE(problem({0}, {{next + 1, 1, 9, 70}}), corners);
  QCOMPARE(problem({0}, {{next, 1, 1, 70}}), corners);
  QCOMPARE(problem({0}, {}, {{next, 1, 2, 3, 4, 5, 6, next + 1}}), corners);
  QCOMPARE(problem({0}, {}, {{next, 1, 2, 3, 4, 5, 6, 1}}), corners);
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  parts.triangles = {{0, 1, 2}};
  add_links_along_edges(parts);
  const MeshPointer triangle = build_mesh(std::move(parts));
  const std::string no_cells = "it adds cells to an object without cells";
  QCOMPARE(problem_of(triangle, {{SplitPoint::copy(0)}, {}, {}, {}, {}, {}, {{0, 1, 2, 3}}, {}}), no_cells);
  QCOMPARE(problem_of(triangle, {{SplitPoint::copy(0)}, {}, {}, {}, {}, {}, {}, {{0, 1, 2, 3, 0, 1, 2, 3}}}), no_cells);
}

CHAINMAIL_TEST(DivideCellsTest)

}  // namespace chainmail::test_divide_cells

#include "test_divide_cells.moc"
