#include <Eigen/Geometry>
#include <QtTest>
#include <map>
#include <numeric>
#include <set>

#include "body/snapshot.h"
#include "core/families.h"
#include "core/simulations.h"
#include "mesh/divide_cells.h"
#include "mesh/error.h"
#include "mesh/parts.h"
#include "mesh/split_along.h"
#include "program.h"
#include "property.h"
#include "simulate/move_history.h"

namespace chainmail::test_split {

using namespace chainmail::test;

/// Splits faces along strokes.
class SplitTest : public QObject {
  Q_OBJECT

 private slots:
  void a_stroke_across_a_sheet_makes_two_parts();
  void a_stroke_through_elements_and_along_links_makes_two_parts();
  void a_stroke_that_ends_inside_leaves_one_part_and_a_tip();
  void a_stroke_around_a_loop_takes_a_piece_out();
  void a_short_stroke_opens_the_side_that_it_crosses();
  void a_stroke_beside_the_object_changes_nothing();
  void a_stroke_inside_a_triangle_changes_nothing();
  void any_stroke_keeps_the_surface_sound();
  void a_sphere_is_cut_in_two_or_in_front_alone();
  void polygons_stay_polygons();
  void perspective_places_elements_on_the_stroke();
  void nothing_at_or_behind_the_eye_is_split();
  void cuts_pins_and_softness_go_over();
  void every_number_and_the_frame_of_a_softness_go_over();
  void positions_go_over_data();
  void positions_go_over();
  void a_simulation_is_split_and_undone_exactly();
  void a_solid_is_split_and_undone_exactly();
  void the_parts_move_apart();
  void a_split_does_not_stop_relaxation();
  void a_drag_after_a_split_needs_a_grab();
  void recorded_splits_are_replayed();
  void splits_keep_no_mesh();
  void many_splits_are_made_and_freed();
  void a_history_keeps_the_meshes_of_the_last_splits();
  void links_beside_faces_are_told_apart();
  void edits_that_do_not_fit_are_refused();
};

namespace {

using Stroke = std::vector<Eigen::Vector2d>;

/// Views a mesh along z: one mesh unit is 20 pixels. `depth` makes things nearer that have a larger z; 0: parallel.
std::vector<ViewPlace> seen(const Mesh& mesh, double depth = 0) {
  std::vector<ViewPlace> places;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    const Point at = mesh.rest_position(e);
    const double distance = 1 - depth * at.z();
    places.push_back({Eigen::Vector2d(at.x(), at.y()) * 20 / distance, distance});
  }
  return places;
}

std::vector<LinkId> every_link(const Mesh& mesh) {
  std::vector<LinkId> links(mesh.link_count());
  std::iota(links.begin(), links.end(), LinkId{0});
  return links;
}

SplitPointer split_of(const MeshPointer& mesh, const Stroke& stroke) {
  return make_split(mesh, split_along(*mesh, seen(*mesh), stroke, every_link(*mesh)));
}

/// Returns a line across a mesh, at an offset from its middle (pixels).
Stroke line_across(double offset) { return {{-100, 45 + offset}, {300, 55 + offset}}; }

/// Returns a vector as long as the area, to the side on which the corners are counterclockwise.
Point facing(const Mesh& mesh, const std::array<ElementId, 3>& t) {
  const Point a = mesh.rest_position(t[0]);
  return (mesh.rest_position(t[1]) - a).cross(mesh.rest_position(t[2]) - a) / 2;
}
double area(const Mesh& mesh, const std::array<ElementId, 3>& t) { return facing(mesh, t).norm(); }

double total_area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& triangle : mesh.triangles) {
    sum += area(mesh, triangle);
  }
  return sum;
}
Point total_facing(const Mesh& mesh) {
  Point sum = Point::Zero();
  for (const auto& triangle : mesh.triangles) {
    sum += facing(mesh, triangle);
  }
  return sum;
}

double least_area(const Mesh& mesh) {
  double least = std::numeric_limits<double>::max();
  for (const auto& triangle : mesh.triangles) {
    least = std::min(least, area(mesh, triangle));
  }
  return least;
}

/// Number of sides of triangles in each direction.
std::map<std::array<ElementId, 2>, int> directed_sides(const Mesh& mesh) {
  std::map<std::array<ElementId, 2>, int> sides;
  for (const auto& [a, b, c] : mesh.triangles) {
    ++sides[{a, b}];
    ++sides[{b, c}];
    ++sides[{c, a}];
  }
  return sides;
}

/// Returns what is wrong with the surface after a split; empty if nothing is.
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
  if (std::abs(total_area(after) - total_area(before)) > 1e-12 * total_area(before)) {
    return "the area has changed";
  }
  if ((total_facing(after) - total_facing(before)).norm() > 1e-12 * total_area(before)) {
    return "triangles were turned over";
  }
  // Each of a few strokes through the same triangle may take its share.
  if (least_area(after) < 1e-6 * least_area(before)) {
    return "a triangle is a sliver";
  }
  const auto sides = directed_sides(after);
  if (std::ranges::any_of(sides, [](const auto& one) { return one.second > 1; })) {
    return "a side belongs to two triangles in the same direction";
  }
  std::set<std::array<ElementId, 2>> links(after.links.begin(), after.links.end()), from_faces;
  std::set<ElementId> used;
  for (const auto& [side, count] : sides) {
    from_faces.insert({std::min(side[0], side[1]), std::max(side[0], side[1])});
    used.insert(side[0]);
  }
  if (links != from_faces) {
    return "links and sides of triangles differ";
  }
  return used.size() == after.element_count() ? "" : "an element belongs to no triangle";
}

/// Jittered triangles whose triangles all turn the same way.
MeshPointer sheet(std::uint64_t seed = 5) { return jittered_triangles(9, 7, seed); }

/// A plane of triangles on whole numbers, without a lattice.
MeshPointer regular_sheet(std::uint32_t width, std::uint32_t height) {
  MeshParts parts;
  for (std::uint32_t i = 0; i < width * height; ++i) {
    parts.rest.emplace_back(i % width, i / width, 0);
  }
  for (std::uint32_t y = 0; y + 1 < height; ++y) {
    for (std::uint32_t x = 0; x + 1 < width; ++x) {
      const ElementId a = x + width * y;
      add_triangle(parts, a, a + 1, a + width + 1);
      add_triangle(parts, a, a + width + 1, a + width);
    }
  }
  return build_mesh(std::move(parts));
}

}  // namespace

void SplitTest::a_stroke_across_a_sheet_makes_two_parts() {
  for (int seed = 0; seed < 50; ++seed) {
    const MeshPointer mesh = sheet(std::uint64_t(seed));
    const auto split = split_of(mesh, line_across(seed - 25));
    const MeshPointer divided = split->after();
    QCOMPARE(flaw_of(*split), std::string());
    QCOMPARE(divided->part_count, 2U);
    // Both sides of the cut lie on the stroke, or at most snap_share of a side away from it.
    for (ElementId e = mesh->element_count(); e < divided->element_count(); ++e) {
      const Point at = 20 * divided->rest_position(e);
      const double on_line = 45 + (seed - 25) + (at.x() + 100) / 40;
      QVERIFY(std::abs(at.y() - on_line) < 3);
    }
  }
}

void SplitTest::a_stroke_through_elements_and_along_links_makes_two_parts() {
  const MeshPointer mesh = regular_sheet(6, 5);
  const std::vector<std::pair<const char*, Stroke>> strokes{
      {"along a row", {{-50, 40}, {150, 40}}},
      {"along a column", {{60, -20}, {60, 200}}},
      {"along diagonals", {{-20, -20}, {120, 120}}},
      {"across diagonals", {{-20, 100}, {120, -40}}},
      {"through every second", {{-40, 0}, {160, 100}}},
      {"beside a row", {{-50, 40.3}, {150, 39.7}}},
      {"bent at elements", {{-20, 40}, {40, 40}, {60, 60}, {60, 120}}}};
  for (const auto& [name, stroke] : strokes) {
    const auto split = split_of(mesh, stroke);
    QVERIFY2(flaw_of(*split).empty(), name);
    const MeshPointer divided = split->after();
    QVERIFY2(divided->part_count == 2, name);
  }
  // Nothing new is needed along a row except copies of its elements.
  const auto along = split_of(mesh, {{-50, 40}, {150, 40}});
  QCOMPARE(along->edit().elements.size(), 6U);
  QVERIFY(std::ranges::all_of(along->edit().elements, &SplitPoint::is_copy));
  QCOMPARE(along->after()->triangles.size(), mesh->triangles.size());
}

void SplitTest::a_stroke_that_ends_inside_leaves_one_part_and_a_tip() {
  const MeshPointer mesh = sheet();
  const auto split = split_of(mesh, {{-30, 60}, {79, 62}});
  const MeshPointer divided = split->after();
  QCOMPARE(flaw_of(*split), std::string());
  QCOMPARE(divided->part_count, 1U);
  QVERIFY(split->edit().elements.size() > 6);
  // The sheet has one boundary still: as many elements as sides on it.
  const auto sides = directed_sides(*divided);
  std::set<ElementId> on_boundary;
  std::size_t boundary = 0;
  for (const auto& [side, count] : sides) {
    if (!sides.contains({side[1], side[0]})) {
      ++boundary;
      on_boundary.insert(side.begin(), side.end());
    }
  }
  QCOMPARE(on_boundary.size(), boundary);
}

void SplitTest::a_stroke_around_a_loop_takes_a_piece_out() {
  for (int seed = 0; seed < 20; ++seed) {
    Stroke loop;
    for (int i = 0; i <= 26; ++i) {  // further than once around, so that the stroke crosses itself
      const double angle = 2 * std::numbers::pi * (i + seed) / 24;
      const double radius = 38 + 3 * std::abs(i - 13.3) / 13;
      loop.emplace_back(80 + radius * std::cos(angle), 60 + radius * std::sin(angle));
    }
    const auto split = split_of(sheet(std::uint64_t(seed)), loop);
    const MeshPointer divided = split->after();
    QCOMPARE(flaw_of(*split), std::string());
    QVERIFY(divided->part_count >= 2);
  }
}

void SplitTest::a_short_stroke_opens_the_side_that_it_crosses() {
  const MeshPointer mesh = regular_sheet(4, 4);
  // Between the middles of the two triangles of a square.
  const auto split = split_of(mesh, {{20 + 13.3, 20 + 6.7}, {20 + 6.7, 20 + 13.3}});
  const MeshPointer divided = split->after();
  QCOMPARE(flaw_of(*split), std::string());
  QCOMPARE(split->edit().elements.size(), 4U);  // two tips, and two elements on the diagonal
  QCOMPARE(split->edit().removed.size(), 2U);
  QCOMPARE(divided->part_count, 1U);
}

void SplitTest::a_stroke_beside_the_object_changes_nothing() {
  const MeshPointer mesh = sheet();
  const auto links = every_link(*mesh);
  QVERIFY(split_along(*mesh, seen(*mesh), Stroke{{-50, -50}, {200, -40}}, links).empty());
  QVERIFY(split_along(*mesh, seen(*mesh), Stroke{{-50, 60}, {200, 60}}, std::span<const LinkId>()).empty());
  QVERIFY(split_along(*mesh, seen(*mesh), Stroke{{50, 50}}, links).empty());
  const MeshPointer grid = generate({MeshKind::cloth, {5, 5, 1}, 1, {}});
  QVERIFY(split_along(*grid, seen(*grid), line_across(0), every_link(*grid)).empty());
}

/// Nor does one that only reaches the side of another: it separates nothing, so that no face is divided.
void SplitTest::a_stroke_inside_a_triangle_changes_nothing() {
  const MeshPointer mesh = regular_sheet(4, 4);
  const auto links = every_link(*mesh);
  for (const Stroke& stroke :
       {Stroke{{22, 22}, {24, 23}}, Stroke{{29, 25}, {29.4, 30.1}}, Stroke{{35, 28.4}, {29.5, 30}}}) {
    QVERIFY(split_along(*mesh, seen(*mesh), stroke, links).empty());
  }
}

void SplitTest::any_stroke_keeps_the_surface_sound() {
  QVERIFY(check_property("a split keeps area, sides and elements", [] {
    const auto seed = *rc::gen::inRange(0, 1 << 20);
    std::mt19937_64 random{std::uint64_t(seed)};
    const bool closed = *rc::gen::inRange(0, 3) == 0;
    MeshPointer mesh = closed                         ? sphere(9, 5)
                       : *rc::gen::inRange(0, 2) == 0 ? regular_sheet(6, 5)
                                                      : sheet(std::uint64_t(seed));
    const bool whole = *rc::gen::inRange(0, 2) == 0;  // points of the stroke at elements and between them
    for (int stroke = *rc::gen::inRange(1, 4); stroke > 0; --stroke) {
      Stroke points;
      for (int i = *rc::gen::inRange(2, 9); i > 0; --i) {
        Eigen::Vector2d at(uniform(random, -20, 180), uniform(random, -20, 140));
        at = closed ? Eigen::Vector2d(at.x() - 80, at.y() - 60) : at;
        points.push_back(whole ? Eigen::Vector2d((at / 10).array().round() * 10) : at);
      }
      std::vector<LinkId> reached = every_link(*mesh);
      if (*rc::gen::inRange(0, 3) == 0) {
        std::erase_if(reached, [&](LinkId) { return random() % 3 == 0; });
      }
      const auto places = seen(*mesh, closed ? 0.05 : 0);
      SplitEdit edit = split_along(*mesh, places, points, reached);
      if (edit.empty()) {
        continue;
      }
      const auto split = make_split(mesh, std::move(edit));
      RC_ASSERT(flaw_of(*split) == "");
      const MeshPointer divided = split->after();
      RC_ASSERT(divided->element_count() > mesh->element_count());
      mesh = divided;
    }
  }));
}

void SplitTest::a_sphere_is_cut_in_two_or_in_front_alone() {
  const MeshPointer mesh = sphere(24, 12);
  const Stroke stroke{{-100, 7}, {100, -11}};
  const auto through = split_of(mesh, stroke);
  QCOMPARE(flaw_of(*through), std::string());
  QCOMPARE(through->after()->part_count, 2U);
  std::vector<LinkId> front = every_link(*mesh);
  std::erase_if(front, [&](LinkId link) {
    return mesh->rest_position(mesh->links[link][0]).z() < 0 || mesh->rest_position(mesh->links[link][1]).z() < 0;
  });
  const auto half = make_split(mesh, split_along(*mesh, seen(*mesh), stroke, front));
  QCOMPARE(flaw_of(*half), std::string());
  QCOMPARE(half->after()->part_count, 1U);
  QVERIFY(half->edit().elements.size() > 10 && half->edit().elements.size() < through->edit().elements.size());
}

void SplitTest::polygons_stay_polygons() {
  MeshParts parts;
  for (ElementId i = 0; i < 12; ++i) {
    parts.rest.emplace_back(i % 4, i / 4, 0);
  }
  for (const ElementId a : {0U, 1U, 2U, 4U, 5U, 6U}) {
    parts.polygons.insert(parts.polygons.end(), {4, a, a + 1, a + 5, a + 4});
    parts.links.insert(parts.links.end(), {{a, a + 1}, {a + 1, a + 5}, {a + 5, a + 4}, {a + 4, a}});
  }
  parts.texture = std::make_shared<Texture>();
  const MeshPointer mesh = build_mesh(std::move(parts));
  const auto split = split_of(mesh, {{-20, 26}, {100, 34}});
  const MeshPointer divided = split->after();
  QCOMPARE(divided->part_count, 2U);
  QCOMPARE(split->edit().removed_polygons, (std::vector<std::uint32_t>{3, 4, 5}));
  QVERIFY(split->edit().triangles.empty());
  QVERIFY(mesh->texture != nullptr && divided->texture == mesh->texture);
  QCOMPARE(split->edit().polygons.size(), 6U * 5);
  QVERIFY(std::abs(total_area(*divided) - 6) < 1e-12);
  QCOMPARE(divided->link_count(), mesh->link_count() + 2 * 3 + 4);  // along the cut on both sides; sides in two
  QVERIFY_THROWS_EXCEPTION(Error, make_split(mesh, SplitEdit{{}, {}, {}, {6}, {}}));  // the last one is number 5
}

void SplitTest::perspective_places_elements_on_the_stroke() {
  MeshParts parts;
  parts.rest = {{0, -1, 0}, {0, 1, 2}, {3, -1, 0}, {3, 1, 2}};
  add_triangle(parts, 0, 2, 1);
  add_triangle(parts, 1, 2, 3);
  const MeshPointer mesh = build_mesh(std::move(parts));
  const double depth = 0.3;
  const Stroke stroke{{-50, 12}, {300, 12}};
  const auto split = make_split(mesh, split_along(*mesh, seen(*mesh, depth), stroke, every_link(*mesh)));
  const MeshPointer divided = split->after();
  QCOMPARE(divided->part_count, 2U);
  for (ElementId e = 4; e < divided->element_count(); ++e) {
    const Point at = divided->rest_position(e);
    QVERIFY(std::abs(at.y() * 20 / (1 - depth * at.z()) - 12) < 1e-4);
  }
}

/// The eye does not see such an element, so the stroke crosses none of its sides. Of both faces, it then crosses only
/// one side, and does not divide them.
void SplitTest::nothing_at_or_behind_the_eye_is_split() {
  const MeshPointer mesh = regular_sheet(2, 2);
  const auto links = every_link(*mesh);
  const Stroke stroke{{10.3, -10}, {9.7, 30}};
  QCOMPARE(split_along(*mesh, seen(*mesh), stroke, links).removed.size(), std::size_t{2});
  for (const ElementId corner : {0U, 3U}) {  // both faces have it
    for (const double distance : {0.0, -1.0}) {
      auto places = seen(*mesh);
      places[corner].distance = distance;
      QVERIFY(split_along(*mesh, places, stroke, links).empty());
    }
  }
}

void SplitTest::cuts_pins_and_softness_go_over() {
  const MeshPointer mesh = regular_sheet(3, 3);
  const auto split = split_of(mesh, {{-20, 8}, {60, 12}});  // across the three columns of the lower row, and diagonals
  const SplitLinks old_links(*split);
  const Mesh& after = *old_links.after;
  const LinkId side = *find_link(*mesh, 0, 3), row = *find_link(*mesh, 4, 5);
  const auto cut = cuts_after(*split, std::vector{std::min(side, row), std::max(side, row)});
  // The halves of the side keep its ends, and new links inside the faces at cut links are cut.
  for (LinkId link = 0; link < after.link_count(); ++link) {
    if (old_links.parents[link] != SplitLinks::none) {
      QCOMPARE(std::ranges::binary_search(cut, link), old_links.parents[link] == row);
    }
  }
  QVERIFY(cut.size() > 1);
  QVERIFY(std::ranges::find(cut, *find_link(after, 4, 5)) != cut.end());

  const auto pins = pins_after(*split, std::vector<ElementId>{0, 3, 8});
  QCOMPARE(pins.size(), 5U);  // and both elements on the side between two pins
  for (const ElementId pin : pins) {
    QVERIFY(pin == 8 || after.rest_position(pin).x() == 0);
  }

  // The tip of a stroke is inside a face: it is pinned where all three corners are.
  const auto tip = split_of(mesh, {{-20, 12}, {8, 12}});
  const auto inside = std::ranges::find_if(
      tip->edit().elements, [](const auto& one) { return std::set(one.of.begin(), one.of.end()).size() == 3; });
  QVERIFY(inside != tip->edit().elements.end());
  const ElementId id = tip->old_count() + ElementId(inside - tip->edit().elements.begin());
  for (std::size_t left_out = 0; left_out <= 3; ++left_out) {
    std::vector<ElementId> corners(inside->of.begin(), inside->of.end());
    if (left_out < 3) {
      corners.erase(corners.begin() + std::ptrdiff_t(left_out));
    }
    std::ranges::sort(corners);
    QCOMPARE(std::ranges::binary_search(pins_after(*tip, corners), id), left_out == 3);
  }

  LinkSoftness soft{0.5, 2, 0.5};
  const auto softness =
      object_after(*split, {mesh, {}, {}, std::make_shared<const Softness>(Softness{{0.9, 1.2, 0.1}, {{side, soft}}})})
          .softness;
  std::size_t own = 0, mixed = 0;
  for (LinkId link = 0; link < after.link_count(); ++link) {
    if (old_links.parents[link] == side) {
      QCOMPARE(softness->of(link), soft);
      ++own;
    } else if (softness->links.contains(link)) {
      // The mean of both ends; or the end that is on a link, if the other is an old element.
      const double compression = softness->of(link).compression;
      QVERIFY(compression == 0.5 || std::abs(compression - 0.7) < 1e-12);
      ++mixed;
    } else if (old_links.parents[link] != SplitLinks::none) {
      QCOMPARE(softness->of(link), softness->global);
    }
  }
  QCOMPARE(own, 2U);
  QVERIFY(mixed >= 2);
}

namespace {

const RegionAxes turned_frame(AxesKind::given, {0, 0, 0.4});

}  // namespace

void SplitTest::every_number_and_the_frame_of_a_softness_go_over() {
  const MeshPointer mesh = regular_sheet(3, 3);
  const auto split = split_of(mesh, {{-20, 8}, {60, 12}});
  const SplitLinks old_links(*split);
  const LinkId side = *find_link(*mesh, 0, 3);
  const LinkSoftness global{0.9, 1.2, 0.1, 0.3, 2, -1}, own{0.5, 2, 0.5, 0.1, 5, 1};
  for (const OwnSoftness& links : {OwnSoftness{{side, own}}, OwnSoftness()}) {
    Simulation simulation(mesh, Algorithm::natural_queue, Precision::double_precision);
    simulation.apply(commands::SetSoftness{{global, links, EnergyKind::axial, turned_frame}});
    simulation.apply(commands::Split{split});
    const Softness& after = simulation.softness();
    QCOMPARE(after.global, global);
    QVERIFY(after.energy == EnergyKind::axial);
    QVERIFY(after.axes == turned_frame);
    QVERIFY(simulation.body().region_axes() == turned_frame);
    for (const auto& [link, softness] : after.links) {
      for (const auto& [parameter, value] : softness_numbers) {
        const double mean = (global.*value + own.*value) / 2;
        const bool is_mixed = old_links.parents[link] == SplitLinks::none && std::abs(softness.*value - mean) < 1e-12;
        QVERIFY2(softness.*value == own.*value || is_mixed, parameter->name.data());
      }
    }
    QCOMPARE(after.links.empty(), links.empty());
  }
}

void SplitTest::positions_go_over_data() {
  QTest::addColumn<bool>("turned");
  QTest::newRow("axes of the world") << false;
  QTest::newRow("turned axes") << true;
}

void SplitTest::positions_go_over() {
  QFETCH(const bool, turned);
  const MeshPointer mesh = jittered_triangles(20, 14, 5);  // of several blocks
  const auto split = split_of(mesh, {{100, -30}, {110, 320}});
  const MeshPointer divided = split->after();
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    for (const Algorithm algorithm : {Algorithm::natural_queue, Algorithm::exact}) {
      Simulation simulation(mesh, algorithm, precision);
      simulation.apply(
          commands::SetSoftness{{{0.3, 2, 0.5}, {}, standard_energy, turned ? turned_frame : RegionAxes()}});
      QVERIFY(positions_after(*split, simulation.snapshot(), precision).is_at_rest());
      drag_by(simulation, 45, Point(2, 1, 0));
      QVERIFY(simulation.snapshot().blocks.front() != nullptr && simulation.snapshot().blocks.back() == nullptr);
      const auto at = [&](ElementId e) { return point_of(simulation.mesh(), simulation.body().positions(), e); };
      std::vector<Point> before;
      for (ElementId e = 0; e < mesh->element_count(); ++e) {
        before.push_back(at(e));
      }
      simulation.apply(commands::Split{split});
      QCOMPARE(simulation.mesh_pointer(), divided);
      for (ElementId e = 0; e < mesh->element_count(); ++e) {
        QCOMPARE(at(e), before[e]);
      }
      for (const SplitPoint& point : split->edit().elements) {
        before.push_back(point.mix<Point>(before[point.of[0]], before[point.of[1]], before[point.of[2]]));
        const Point is = at(static_cast<ElementId>(before.size() - 1));
        QVERIFY((is - before.back()).norm() < 1e-5);
        if (point.is_copy()) {
          QCOMPARE(is, at(point.of[0]));
        }
      }
    }
  }
}

void SplitTest::a_simulation_is_split_and_undone_exactly() {
  const MeshPointer mesh = sheet();
  for (const Algorithm algorithm : {Algorithm::natural_queue, Algorithm::exact}) {
    Simulation simulation(mesh, algorithm, Precision::single_precision);
    simulation.apply(commands::SetSoftness{{{0.7, 1.3, 0.2}, {{2, {1, 1, 0}}}}});
    simulation.apply(commands::Pin{{0, 1}});
    drag_by(simulation, 40, Point(2, 1, 0));
    const Snapshot before = simulation.snapshot();
    simulation.apply(commands::KeepState{1});
    simulation.apply(commands::Split{split_of(mesh, line_across(3))});
    drag_by(simulation, 44, Point(-1, 3, 0));
    const Snapshot split = simulation.snapshot();
    simulation.apply(commands::KeepState{2});
    simulation.apply(commands::RestoreState{1});
    QCOMPARE(simulation.mesh_pointer(), mesh);
    QCOMPARE(simulation.snapshot(), before);
    QCOMPARE(simulation.softness().links.size(), 1U);
    simulation.apply(commands::RestoreState{2});
    QCOMPARE(simulation.snapshot(), split);
  }
}

/// All that a body has goes over to the cells of both parts, which then move apart.
void SplitTest::a_solid_is_split_and_undone_exactly() {
  const MeshPointer mesh = generate({MeshKind::tetra, {5, 5, 5}, 1, {}});
  const auto split = make_split(mesh, divide_cells(*mesh, seen(*mesh), Stroke{{-20, 47}, {120, 31}}));
  const SplitLinks old_links(*split);
  const MeshPointer divided = split->after();
  QCOMPARE(divided->part_count, 2U);
  const LinkId side = *find_link(*mesh, 10, 10 + 25);  // along z, so that the blade crosses it nowhere
  for (const Algorithm algorithm : {Algorithm::natural_queue, Algorithm::exact}) {
    Simulation simulation(mesh, algorithm, Precision::double_precision);
    simulation.apply(commands::SetSoftness{{{0.7, 1.3, 0.2}, {{side, {1, 1, 0}}}}});
    simulation.apply(commands::Pin{{0, 1}});
    drag_by(simulation, 62, Point(0.4, 0.3, 0.5));
    const Snapshot before = simulation.snapshot();
    std::vector<Point> at;
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      at.push_back(point_of(*mesh, simulation.body().positions(), e));
    }
    simulation.apply(commands::KeepState{1});
    simulation.apply(commands::Split{split});
    QCOMPARE(simulation.mesh_pointer(), divided);
    for (const SplitPoint& point : split->edit().elements) {
      at.push_back(point.mix<Point>(at[point.of[0]], at[point.of[1]], at[point.of[2]]));
    }
    for (ElementId e = 0; e < at.size(); ++e) {
      QVERIFY((point_of(*divided, simulation.body().positions(), e) - at[e]).norm() < 1e-12);
    }
    const auto is_own = [&](const auto& one) { return old_links.parents[one.first] == side; };
    QVERIFY(std::ranges::any_of(simulation.softness().links, is_own));
    drag_by(simulation, 124, Point(0, 6, 0));  // the last element, in the part without pins
    // The part with the pins stays. Exact ChainMail may make its new links valid, but does not move the pins.
    for (ElementId e = 0; e < (algorithm == Algorithm::exact ? 2U : 10U); ++e) {
      QVERIFY(point_of(*divided, simulation.body().positions(), e) == at[e]);
    }
    const Snapshot after = simulation.snapshot();
    simulation.apply(commands::KeepState{2});
    simulation.apply(commands::RestoreState{1});
    QCOMPARE(simulation.mesh_pointer(), mesh);
    QCOMPARE(simulation.snapshot(), before);
    simulation.apply(commands::RestoreState{2});
    QCOMPARE(simulation.mesh_pointer(), divided);
    QCOMPARE(simulation.snapshot(), after);
  }
}

void SplitTest::the_parts_move_apart() {
  const MeshPointer mesh = regular_sheet(6, 5);
  const auto split = split_of(mesh, {{-50, 50}, {150, 50}});
  const MeshPointer divided = split->after();
  Simulation simulation(mesh, Algorithm::natural_queue, Precision::single_precision);
  simulation.apply(commands::SetSoftness{{{1, 1, 0}, {}}});
  simulation.apply(commands::Split{split});
  drag_by(simulation, 28, Point(0, 5, 0));
  for (ElementId e = 0; e < divided->element_count(); ++e) {
    const Point rest = divided->rest_position(e);
    const Point at = point_of(*divided, simulation.body().positions(), e);
    QCOMPARE(at != rest, rest.y() > 2.5 || (rest.y() == 2.5 && at.y() > 2.5));
  }
  simulation.measure_all();
  QVERIFY(simulation.statistics().violation.max < 1e-4);
}

void SplitTest::a_split_does_not_stop_relaxation() {
  const MeshPointer mesh = regular_sheet(20, 3);
  Simulation simulation(mesh, Algorithm::natural_queue, Precision::double_precision);
  simulation.apply(commands::SetRelaxation{true});
  drag_by(simulation, 0, Point(40, 0, 0));
  QVERIFY(simulation.statistics().relaxing);
  simulation.apply(commands::Split{split_of(mesh, {{175, -20}, {175, 80}})});
  const Point before = point_of(simulation.mesh(), simulation.body().positions(), 1);
  while (simulation.continue_relaxation()) {
  }
  QVERIFY(point_of(simulation.mesh(), simulation.body().positions(), 1) != before);  // far from the split
}

/// The handle was of the object before.
void SplitTest::a_drag_after_a_split_needs_a_grab() {
  const MeshPointer mesh = sheet();
  Simulation simulation(mesh, Algorithm::natural_queue, Precision::single_precision);
  drag_by(simulation, 40, Point(2, 1, 0));
  simulation.apply(commands::Split{split_of(mesh, line_across(3))});
  QVERIFY(simulation.grabbed().empty());
  const Snapshot before = simulation.snapshot();
  QVERIFY_THROWS_EXCEPTION(Error, simulation.apply(commands::Drag{{9, 9, 0}}));
  QCOMPARE(simulation.snapshot(), before);
}

/// Splits take memory in proportion to what they change: they keep no mesh, and make it again to the bit.
void SplitTest::splits_keep_no_mesh() {
  const MeshPointer mesh = sheet();
  const auto first = split_of(mesh, line_across(3));
  MeshPointer divided = first->after();
  const auto second =
      make_split(divided, SplitEdit{{SplitPoint::copy(0)}, {0}, {{divided->element_count(), 1, 9}}, {}, {}});
  MeshPointer last = second->after();
  QCOMPARE(second->before(), divided);
  QCOMPARE(second->after(), last);
  QCOMPARE(MeshSource(last).mesh(), last);

  const Mesh copy = *last;
  const std::weak_ptr<const Mesh> middle = divided, end = last;
  divided.reset();
  last.reset();
  QVERIFY(middle.expired() && end.expired());
  last = second->after();
  QVERIFY(middle.expired());  // nobody needs it
  QCOMPARE(last->rest, copy.rest);
  QCOMPARE(last->links, copy.links);
  QCOMPARE(last->neighbours, copy.neighbours);
  QCOMPARE(last->triangles, copy.triangles);
  QCOMPARE(second->after(), last);
  QCOMPARE(second->before()->links, first->after()->links);
  QCOMPARE(MeshSource(std::make_shared<const Mesh>(copy)).mesh()->split, last->split);  // a copy is another mesh
  QVERIFY(MeshSource(std::make_shared<const Mesh>(copy)).mesh() != last);
}

/// One after another, not one within the other: a stack is not deep enough for that.
void SplitTest::many_splits_are_made_and_freed() {
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  test::add_triangle(parts, 0, 1, 2);
  const MeshPointer mesh = build_mesh(std::move(parts));
  SplitPointer last;
  MeshPointer divided = mesh;
  for (int i = 0; i < 50'000; ++i) {
    last = make_split(divided, SplitEdit{{}, {0}, {{0, 1, 2}}, {}, {}});
    divided = last->after();
  }
  divided.reset();
  QCOMPARE(last->after()->triangles, mesh->triangles);
  last.reset();
}

/// Undo and redo over the last splits make no mesh again.
void SplitTest::a_history_keeps_the_meshes_of_the_last_splits() {
  const MeshPointer mesh = sheet();
  MoveHistory history;
  std::weak_ptr<const Mesh> divided;
  {
    const auto split = split_of(mesh, line_across(3));
    const MeshPointer after = split->after();
    history.note(commands::KeepState{1});
    history.note(commands::Split{split});
    history.note(commands::KeepState{2});
    divided = after;
  }
  history.note(commands::RestoreState{1});
  QCOMPARE(history.object().mesh, mesh);
  history.note(commands::RestoreState{2});  // redo
  QVERIFY(!divided.expired());
  QCOMPARE(history.object().mesh, divided.lock());
  history.note(commands::DropState{1});
  history.note(commands::DropState{2});
  history.note(commands::ReplaceMesh{mesh});
  QVERIFY(divided.expired());
}

void SplitTest::links_beside_faces_are_told_apart() {
  MeshParts parts;
  parts.rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {5, 5, 0}, {6, 5, 0}, {6, 6, 0}, {5, 6, 0}};
  test::add_triangle(parts, 0, 1, 2);
  parts.polygons = {4, 4, 5, 6, 7};
  for (ElementId a = 4; a < 8; ++a) {
    parts.links.push_back({a, a == 7 ? 4 : a + 1});
  }
  parts.links.push_back({2, 3});
  parts.links.push_back({3, 4});
  const auto mesh = build_mesh(std::move(parts));
  std::vector<LinkId> all(mesh->link_count());
  std::iota(all.begin(), all.end(), 0U);
  QCOMPARE(links_without_faces(*mesh, all), (std::vector{*find_link(*mesh, 2, 3), *find_link(*mesh, 3, 4)}));
  const std::vector some{*find_link(*mesh, 0, 1), *find_link(*mesh, 3, 4)};
  QCOMPARE(links_without_faces(*mesh, some), std::vector{*find_link(*mesh, 3, 4)});
}

void SplitTest::recorded_splits_are_replayed() {
  const MeshPointer mesh = sheet();
  const auto first = split_of(mesh, line_across(3));
  const auto second = split_of(first->after(), {{60, -20}, {80, 200}});
  const std::vector<Command> all{commands::Cut{{5, 9}},
                                 commands::Pin{{3}},
                                 commands::Grab{40},
                                 commands::Drag{{5, 6, 0}},
                                 commands::Release{},
                                 commands::Split{first},
                                 commands::Grab{mesh->element_count()},
                                 commands::Drag{{3, 1, 0}},
                                 commands::Release{},
                                 commands::Split{second}};
  MoveHistory history;
  Simulation simulation(mesh, Algorithm::natural_queue, Precision::single_precision);
  for (const Command& command : all) {
    history.note(command);
    simulation.apply(command);
    QCOMPARE(history.object().mesh ? history.object().mesh : mesh, simulation.mesh_pointer());
    QCOMPARE(history.object().cuts, simulation.body().cuts().links());
    QVERIFY(std::ranges::equal(history.object().pins, simulation.body().pins()));
  }
  QCOMPARE(history.object(0).mesh, mesh);
  QCOMPARE(history.object(7).mesh, first->after());
  QCOMPARE(first_mesh(history.commands()), mesh);
  QCOMPARE(last_mesh(mesh, all), second->after());
}

void SplitTest::edits_that_do_not_fit_are_refused() {
  const MeshPointer mesh = regular_sheet(3, 3);
  const auto refused = [&](const SplitEdit& edit) {
    try {
      make_split(mesh, edit);
    } catch (const Error&) {
      return true;
    }
    return false;
  };
  QVERIFY(!refused({{SplitPoint::copy(4)}, {0}, {{0, 1, 9}}, {}, {}}));
  QVERIFY(refused({{SplitPoint::copy(9)}, {0}, {{0, 1, 9}}, {}, {}}));
  QVERIFY(refused({{SplitPoint::between(0, 1, 1.5)}, {0}, {{0, 1, 9}}, {}, {}}));
  QVERIFY(refused({{SplitPoint::between(0, 1, std::nan(""))}, {0}, {{0, 1, 9}}, {}, {}}));
  QVERIFY(refused({}));
  QVERIFY(refused({{}, {8}, {}, {}, {}}));
  QVERIFY(refused({{}, {1, 1}, {}, {}, {}}));
  QVERIFY(refused({{}, {}, {{0, 1, 9}}, {}, {}}));
  QVERIFY(refused({{}, {}, {{0, 1, 1}}, {}, {}}));
  QVERIFY(refused({{}, {}, {}, {0}, {}}));
  QVERIFY(refused({{}, {}, {}, {}, {4, 0, 1, 2}}));
  Simulation other(sheet(), Algorithm::natural_queue, Precision::single_precision);
  QVERIFY_THROWS_EXCEPTION(Error, other.apply(commands::Split{split_of(mesh, {{-20, 8}, {60, 12}})}));
  QVERIFY_THROWS_EXCEPTION(Error, other.apply(commands::Split{}));
}

CHAINMAIL_TEST(SplitTest)

}  // namespace chainmail::test_split

#include "test_split.moc"
