// What is drawn of a mesh, finely and coarsely.

#include "drawn_indices.h"

#include <QTest>
#include <algorithm>
#include <numeric>

#include "mesh/generate.h"

using namespace chainmail;

class DrawnIndices : public QObject {
  Q_OBJECT

 private slots:
  void cutLinksAndTheirFacesGo() {
    const auto mesh = generate({MeshKind::cloth, {3, 2, 1}, 1, {}});
    Cuts cuts(mesh);
    QCOMPARE(uncutLinks(*mesh, cuts).size(), 2U * 9);
    QCOMPARE(uncutFaces(*mesh, cuts).size(), 3U * 4);
    cuts.cut(*find_link(*mesh, 1, 4));  // the middle upright, in two triangles
    QCOMPARE(uncutLinks(*mesh, cuts).size(), 2U * 8);
    QCOMPARE(uncutFaces(*mesh, cuts).size(), 3U * 2);
  }

  void thePolygonsDiagonalIsNoLink() {
    MeshParts parts;
    parts.rest = {Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0)};
    parts.links = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
    parts.polygons = {4, 0, 1, 2, 3};
    const auto mesh = build_mesh(std::move(parts));
    QCOMPARE(uncutLinks(*mesh, Cuts(mesh)).size(), 8U);
    QCOMPARE(uncutFaces(*mesh, Cuts(mesh)).size(), 6U);
  }

  void coarselyTheLastRowIsThereAndCutsShow() {
    const auto mesh = generate({MeshKind::grid, {6, 1, 1}, 1, {}});
    Cuts cuts(mesh);
    const std::vector<ElementId> whole{0, 2, 2, 4, 4, 5};
    QCOMPARE(coarseLinks(*mesh, cuts, 2), whole);
    cuts.cut(*find_link(*mesh, 3, 4));
    const std::vector<ElementId> parted{0, 2, 4, 5};
    QCOMPARE(coarseLinks(*mesh, cuts, 2), parted);
  }

  void scatteredElementsAreAboutOneInStepSquared() {
    const auto mesh = generate({MeshKind::line, {10'000, 1, 1}, 1, {}});
    const auto count = scattered(*mesh, 4).size();
    QVERIFY(count > 500 && count < 750);  // 625 on the mean; the hash is even to a few percent
  }

  void fewElementsAreAllKeptAndManyThinnedEvenly() {
    std::vector<ElementId> elements(10'000);
    std::iota(elements.begin(), elements.end(), ElementId{500});
    QCOMPARE(thinned(elements, 10'000), elements);
    const auto few = thinned(elements, 1'000);
    QVERIFY(few.size() > 800 && few.size() < 1'200);
    const auto half = std::lower_bound(few.begin(), few.end(), ElementId{5'500}) - few.begin();
    QVERIFY(half > std::ptrdiff_t(few.size()) * 4 / 10 && half < std::ptrdiff_t(few.size()) * 6 / 10);
  }
};

QTEST_GUILESS_MAIN(DrawnIndices)
#include "drawn_indices.moc"
