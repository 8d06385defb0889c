#include <QtTest>
#include <limits>
#include <string>

#include "files/mesh/mesh_arrays.h"
#include "mesh/error.h"
#include "mesh/generate.h"
#include "program.h"

namespace chainmail::test_mesh_arrays {

using Ids = std::vector<ElementId>;
using Reals = std::vector<double>;

/// Meshes from the arrays of a program.
class MeshArraysTest : public QObject {
  Q_OBJECT

 private slots:
  void arrays_make_a_mesh();
  void bad_arrays_are_refused_data();
  void bad_arrays_are_refused();
};

void MeshArraysTest::arrays_make_a_mesh() {
  const MeshPointer made = generate({MeshKind::tetra, {4, 3, 3}});
  Ids cells;
  for (const auto& cell : made->tetrahedra) {
    cells.insert(cells.end(), cell.begin(), cell.end());
  }
  const MeshPointer mesh = make_mesh({.positions = made->rest, .tetrahedra = cells});
  QCOMPARE(mesh->rest, made->rest);
  QCOMPARE(mesh->link_count(), made->link_count());
  QVERIFY(mesh->tetrahedra == made->tetrahedra);

  const Reals chain{0, 5, 0, 1, 5, 0, 3, 5, 0};
  const Ids links{2, 1, 0, 1};
  const MeshPointer line = make_mesh({.positions = chain, .links = links});
  QCOMPARE(line->space_dimension, 1);
  QCOMPARE(rest_length(*line, 1), 2.0);
  QVERIFY(line->rest_position(2) == Point(3, 5, 0));
  QCOMPARE(make_mesh({.positions = chain, .links = links, .space_dimension = 2})->space_dimension, 2);
}

void MeshArraysTest::bad_arrays_are_refused_data() {
  QTest::addColumn<Reals>("positions");
  QTest::addColumn<Ids>("links");
  QTest::addColumn<Ids>("triangles");
  QTest::addColumn<std::string>("reason");
  const Reals three{0, 0, 0, 1, 0, 0, 0, 1, 0};
  const auto row = [](const char* name, const Reals& positions, const Ids& links, const Ids& triangles,
                      const std::string& reason) { QTest::newRow(name) << positions << links << triangles << reason; };
  row("nothing", {}, {}, {}, "there are 0 numbers");
  row("not whole points", {0, 0, 0, 1}, {0, 1}, {}, "there are 4 numbers");
  row("NaN", {0, 0, 0, std::numeric_limits<double>::quiet_NaN(), 0, 0}, {0, 1}, {}, "positions, element 1");
  row("infinite", {0, 0, 0, 0, 0, std::numeric_limits<double>::infinity()}, {0, 1}, {}, "positions, element 1");
  row("no link", three, {}, {}, "there is no link");
  row("half a link", three, {0, 1, 2}, {}, "there are 3 ids");
  row("beyond the end", three, {0, 3}, {}, "uses element 3");
  row("to itself", three, {0, 1, 2, 2}, {}, "number 1 uses an element twice");
  row("a corner twice", three, {}, {0, 1, 1}, "number 0 uses an element twice");
  row("a face twice", three, {}, {0, 1, 2, 2, 1, 0}, "1 are there twice");
}

void MeshArraysTest::bad_arrays_are_refused() {
  QFETCH(Reals, positions);
  QFETCH(Ids, links);
  QFETCH(Ids, triangles);
  QFETCH(std::string, reason);
  std::string refusal;
  try {
    make_mesh({.positions = positions, .links = links, .triangles = triangles});
  } catch (const Error& error) {
    refusal = error.what();
  }
  QVERIFY2(refusal.find(reason) != std::string::npos, refusal.c_str());
}

CHAINMAIL_TEST(MeshArraysTest)

}  // namespace chainmail::test_mesh_arrays

#include "test_mesh_arrays.moc"
