#include <QtTest>
#include <cmath>
#include <limits>

#include "body/blade.h"
#include "body/snapshot.h"
#include "core/hexahedra.h"
#include "mesh/error.h"
#include "mesh/generate.h"
#include "program.h"

namespace chainmail::test_blade {

using namespace chainmail::test;

/// Splits along a line that is swept along a direction.
class BladeTest : public QObject {
  Q_OBJECT

 private slots:
  void a_blade_makes_two_parts_data();
  void a_blade_makes_two_parts();
  void only_the_line_of_the_direction_matters();
  void the_unit_of_length_does_not_matter();
  void a_blade_meets_elements_where_they_are();
  void a_plane_needs_no_direction();
  void the_ends_of_a_blade_may_be_far_away();
  void new_links_have_the_softness_around_them();
  void what_a_blade_misses_stays_whole();
  void blades_that_do_not_fit_are_refused_data();
  void blades_that_do_not_fit_are_refused();
};

namespace {

MeshPointer tetrahedra(double spacing = 1) { return generate({MeshKind::tetra, {5, 4, 4}, spacing, {}}); }

/// Two squares of two triangles each: x from 0 to 2, and y from 0 to 1.
MeshPointer squares(int space_dimension) {
  MeshParts parts;
  parts.rest = {{0, 0, 5}, {1, 0, 5}, {2, 0, 5}, {0, 1, 5}, {1, 1, 5}, {2, 1, 5}};
  parts.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  parts.space_dimension = space_dimension;
  add_links_along_edges(parts);
  return build_mesh(std::move(parts));
}

/// Across the objects above.
const Blade across{{{1.3, -1, 0}, {1.6, 9, 0}}, Point(0, 0, 1)};

SplitPointer split_of(const MeshPointer& mesh, const Blade& blade) {
  return split_along(blade, Body(mesh, Precision::double_precision));
}

MeshPointer named(const QString& name) {
  return name == "tetrahedra"  ? tetrahedra()
         : name == "hexahedra" ? hexahedral_block({4, 3, 3})
         : name == "plane"     ? squares(2)
         : name == "surface"   ? squares(3)
                               : generate({MeshKind::grid, {5, 4, 1}, 1, {}});
}

}  // namespace

void BladeTest::a_blade_makes_two_parts_data() {
  QTest::addColumn<QString>("mesh");
  for (const char* name : {"tetrahedra", "hexahedra", "plane", "surface"}) {
    QTest::newRow(name) << name;
  }
}

void BladeTest::a_blade_makes_two_parts() {
  QFETCH(QString, mesh);
  const MeshPointer before = named(mesh);
  const SplitPointer split = split_of(before, across);
  QVERIFY(split && split->before() == before);
  const MeshPointer divided = split->after();
  QCOMPARE(divided->part_count, std::uint32_t{2});
}

void BladeTest::only_the_line_of_the_direction_matters() {
  Blade blade = across;
  blade.along = Point(0.1, 0.2, -1);
  const SplitPointer split = split_of(tetrahedra(), blade);
  QVERIFY(split->edit() != split_of(tetrahedra(), across)->edit());
  for (const double length : {-1.0, 1e-300, 1e300}) {
    blade.along = length * Point(0.1, 0.2, -1);
    QCOMPARE(split_of(tetrahedra(), blade)->edit().elements.size(), split->edit().elements.size());
  }
  // Along the direction, the line may be anywhere.
  blade.line[0] += 7 * Point(0.1, 0.2, -1);
  blade.line[1] -= 3 * Point(0.1, 0.2, -1);
  QCOMPARE(split_of(tetrahedra(), blade)->edit().tetrahedra, split->edit().tetrahedra);
}

void BladeTest::the_unit_of_length_does_not_matter() {
  const SplitPointer split = split_of(tetrahedra(), across);
  for (const double unit : {std::ldexp(1.0, -40), std::ldexp(1.0, 40)}) {
    const SplitPointer other =
        split_of(tetrahedra(unit), {{unit * across.line[0], unit * across.line[1]}, across.along});
    QVERIFY(other);
    QCOMPARE(other->edit().tetrahedra, split->edit().tetrahedra);
  }
}

void BladeTest::a_blade_meets_elements_where_they_are() {
  const MeshPointer mesh = tetrahedra();
  const SplitPointer split = split_of(mesh, across);
  Body body(mesh, Precision::double_precision);
  std::vector<double> turned;  // by a quarter about z, and moved
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    const Point at = mesh->rest_position(e);
    turned.insert(turned.end(), {20 - at.y(), at.x(), at.z()});
  }
  body.set_positions(turned);
  QVERIFY(!split_along(across, body));
  const SplitPointer same = split_along({{{21, 1.3, 0}, {11, 1.6, 0}}, across.along}, body);
  QVERIFY(same);
  QCOMPARE(same->edit().tetrahedra, split->edit().tetrahedra);
}

void BladeTest::a_plane_needs_no_direction() {
  const SplitPointer split = split_of(squares(2), across);
  for (const double z : {0.0, 5.0}) {  // the plane has z = 5
    const SplitPointer same = split_of(squares(2), {{{1.3, -1, z}, {1.6, 9, z}}, {}});
    QCOMPARE(same->edit().triangles, split->edit().triangles);
    // The line is in the plane, whatever the direction.
    const SplitPointer leaning = split_of(squares(2), {{{1.3, -1, z}, {1.6, 9, z}}, Point(1, 1, 1)});
    QCOMPARE(leaning->edit().triangles, split->edit().triangles);
  }
}

void BladeTest::the_ends_of_a_blade_may_be_far_away() {
  const auto from_to = [](double y) { return Blade{{{1.3, -y, 0}, {1.3, y, 0}}, Point(0, 0, 1)}; };
  const SplitPointer near = split_of(tetrahedra(), from_to(9));
  QVERIFY(near);
  for (const double y : {1e5, 1e18, 1e100}) {
    const SplitPointer far = split_of(tetrahedra(), from_to(y));
    QVERIFY(far);
    QCOMPARE(far->edit().tetrahedra, near->edit().tetrahedra);
  }
  // A line that goes far away and comes back elsewhere cuts twice.
  const SplitPointer twice =
      split_of(tetrahedra(), {{{1.3, -9, 0}, {1.3, 1e6, 0}, {2.6, 1e6, 0}, {2.6, -9, 0}}, Point(0, 0, 1)});
  QVERIFY(twice);
  QCOMPARE(twice->after()->part_count, std::uint32_t{3});
}

void BladeTest::new_links_have_the_softness_around_them() {
  const LinkSoftness soft{0.5, 2, 0.5};
  for (const char* name : {"tetrahedra", "hexahedra", "surface"}) {
    const MeshPointer mesh = named(name);
    const auto softness = std::make_shared<Softness>(Softness{{0.9, 1.2, 0.1}, {}});
    for (LinkId link = 0; link < mesh->link_count(); ++link) {
      softness->links.set(link, soft);
    }
    const SplitPointer split = split_of(mesh, across);
    const MeshPointer divided = split->after();
    const auto after = object_after(*split, {mesh, {}, {}, softness}).softness;
    for (LinkId link = 0; link < divided->link_count(); ++link) {
      for (const auto& [parameter, value] : softness_numbers) {
        QVERIFY2(std::abs(after->of(link).*value - soft.*value) < 1e-12, name);
      }
    }
  }
}

void BladeTest::what_a_blade_misses_stays_whole() {
  const Point up(0, 0, 1);
  QVERIFY(!split_of(tetrahedra(), {{{9, -1, 0}, {9, 9, 0}}, up}));
  QVERIFY(!split_of(tetrahedra(), {{{1, 1, 1}, {1, 1, 1}}, up}));
  QVERIFY(!split_of(tetrahedra(), {{{1.3, 1.3, -1}, {1.3, 1.3, 9}}, up}));  // the line runs along the direction
  QVERIFY(!split_of(squares(3), {{{9, -1, 0}, {9, 9, 0}}, up}));
}

void BladeTest::blades_that_do_not_fit_are_refused_data() {
  QTest::addColumn<QString>("mesh");
  QTest::addColumn<Blade>("blade");
  QTest::addColumn<QString>("problem");
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  int rows = 0;
  const auto row = [&rows](const char* mesh, const Blade& blade, const char* problem) {
    QTest::addRow("%d, %s", ++rows, mesh) << mesh << blade << problem;
  };
  const auto along = [](const std::optional<Point>& direction) { return Blade{across.line, direction}; };
  row("tetrahedra", {{{1, 1, 1}}, across.along}, "its line has fewer than two points");
  row("tetrahedra", {{{1, 1, 1}, {1, nan, 1}}, across.along}, "a coordinate is not a finite number");
  for (const double far : {1e101, 1e300, -1e308}) {
    row("tetrahedra", {{{1, 1, 1}, {1, far, 1}}, across.along}, "a coordinate is too large");
  }
  row("tetrahedra", {std::vector<Point>(blade_point_limit + 1, Point(1, 1, 1)), across.along},
      "its line has more than 10000 points");
  row("tetrahedra", along({}), "it has no direction");
  row("surface", along({}), "it has no direction");
  for (const Point& wrong : {Point(0, 0, 0), Point(0, nan, 1), Point(0, 0, infinity)}) {
    row("tetrahedra", along(wrong), "its direction is not finite or has the length 0");
  }
  row("plane", along(Point(1, 0, 0)), "its direction lies in the plane of the object");
  row("plane", along(Point(1e9, 0, 1)), "its direction lies in the plane of the object");
  row("plane", {{{1, -1, 1}, {1, 9, 5}}, {}}, "the object does not extend along z");
  row("grid", along({}), "the object has neither cells nor faces, or it is a lattice of faces");
}

void BladeTest::blades_that_do_not_fit_are_refused() {
  QFETCH(QString, mesh);
  QFETCH(Blade, blade);
  QFETCH(QString, problem);
  try {
    split_of(named(mesh), blade);
    QFAIL("it is not refused");
  } catch (const Error& error) {
    QCOMPARE(QString::fromStdString(error.problem()), problem);
  }
}

CHAINMAIL_TEST(BladeTest)

}  // namespace chainmail::test_blade

#include "test_blade.moc"
