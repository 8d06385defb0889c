// Tests which elements, links and faces of a mesh are drawn, in full detail and coarsely.

#include <QTest>
#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "drawing/drawn_parts.h"
#include "drawing/mesh_level.h"
#include "mesh/generate.h"
#include "program.h"
#include "scene.h"

namespace chainmail::drawn_indices {

namespace {

std::vector<std::uint32_t> allClusters(const MeshLevel& level) {
  std::vector<std::uint32_t> clusters(level.clusterCount());
  std::iota(clusters.begin(), clusters.end(), 0U);
  return clusters;
}

/// Returns the ends of the drawn links, in the order of drawing.
std::vector<ElementId> ends(const MeshLevelPointer& level, const Cuts& cuts) {
  return drawnLinks(*level, cuts, allClusters(*level)).ends;
}

std::size_t faceCount(const MeshLevelPointer& level, const Cuts& cuts) {
  return drawnFaces(*level, cuts, allClusters(*level)).size() / 3;
}

/// True if drawn links connect two elements.
bool joined(const MeshLevelPointer& level, const Cuts& cuts, ElementId from, ElementId to) {
  const auto links = ends(level, cuts);
  std::set<ElementId> found{from};
  for (std::size_t before = 0; before != found.size();) {
    before = found.size();
    for (std::size_t i = 0; i < links.size(); i += 2) {
      if (found.count(links[i]) + found.count(links[i + 1]) == 1) {
        found.insert({links[i], links[i + 1]});
      }
    }
  }
  return found.count(to) != 0;
}

/// Returns a cloth without a lattice, with its elements in random order.
MeshPointer plainCloth(ElementId width, ElementId height) {
  const auto cloth = generate({MeshKind::cloth, {width, height, 1}, 1, {}});
  std::vector<ElementId> place(cloth->element_count());
  std::iota(place.begin(), place.end(), ElementId{0});
  std::shuffle(place.begin(), place.end(), std::mt19937(5));
  MeshParts parts;
  parts.rest.resize(place.size());
  for (ElementId e = 0; e < place.size(); ++e) {
    parts.rest[place[e]] = cloth->rest_position(e);
  }
  for (const auto& [a, b] : cloth->links) {
    parts.links.push_back({place[a], place[b]});
  }
  for (const auto& [a, b, c] : cloth->triangles) {
    parts.triangles.push_back({place[a], place[b], place[c]});
  }
  return build_mesh(std::move(parts));
}

/// Chooses the parts of an object to draw.
void choose(DrawnParts& parts, const Scene& in, const DrawOptions& options = {}, std::size_t maxShapes = 100'000) {
  ObjectDrawing::Scene scene{in.camera.toView(), in.camera.toClip(in.view), in.view, {}, {}};
  scene.maxShapes = maxShapes;
  parts.choose(scene, {.colour = {}, .scale = {}, .options = options}, 1 / in.camera.unitsPerPixel(in.view));
}

}  // namespace

class DrawnIndices : public QObject {
  Q_OBJECT

 private slots:
  void cutLinksAndTheirFacesGo() {
    const auto mesh = generate({MeshKind::cloth, {3, 2, 1}, 1, {}});
    const auto level = wholeLevel(mesh);
    Cuts cuts(mesh);
    QCOMPARE(ends(level, cuts).size(), 2U * 9);
    QCOMPARE(faceCount(level, cuts), 4U);
    cuts.cut(*find_link(*mesh, 1, 4));  // the middle vertical link, which is a side of two triangles
    QCOMPARE(ends(level, cuts).size(), 2U * 8);
    QCOMPARE(faceCount(level, cuts), 2U);
  }

  void thePolygonsDiagonalIsNoLink() {
    MeshParts parts;
    parts.rest = {Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0)};
    parts.links = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
    parts.polygons = {4, 0, 1, 2, 3};
    const auto mesh = build_mesh(std::move(parts));
    QCOMPARE(ends(wholeLevel(mesh), Cuts(mesh)).size(), 8U);
    QCOMPARE(faceCount(wholeLevel(mesh), Cuts(mesh)), 2U);
  }

  /// Without links, there is nothing else to see, however many elements there are and however far away.
  void pointsWithoutLinksAreMarked() {
    MeshParts parts;
    for (int i = 0; i < 30'000; ++i) {
      parts.rest.emplace_back(i % 200, i / 200, 0);
    }
    const auto points = build_mesh(std::move(parts));
    for (const double pixelsPerUnit : {0.01, 1.0, 100.0}) {
      QVERIFY(ObjectDrawing::marksElements(*points, pixelsPerUnit));
    }
  }

  void everyLinkAndFaceIsInOneCluster() {
    for (const auto& mesh : {generate({MeshKind::cloth, {70, 33, 1}, 1, {}}), plainCloth(70, 33),
                             generate({MeshKind::tetra, {13, 14, 15}, 1, {}})}) {
      const auto level = wholeLevel(mesh);
      QVERIFY(level->clusterCount() > 4);
      auto numbers = drawnLinks(*level, Cuts(mesh), allClusters(*level)).numbers;
      std::sort(numbers.begin(), numbers.end());
      QCOMPARE(numbers.size(), mesh->links.size());
      QVERIFY(std::adjacent_find(numbers.begin(), numbers.end()) == numbers.end());
      QCOMPARE(faceCount(level, Cuts(mesh)), mesh->triangles.size());
    }
  }

  void coarselyTheLastRowIsThereAndCutsShow() {
    const auto mesh = generate({MeshKind::grid, {6, 1, 1}, 1, {}});
    Cuts cuts(mesh);
    const auto level = coarseLattice(mesh, 2);
    const std::vector<ElementId> whole{0, 2, 2, 4, 4, 5};
    QCOMPARE(ends(level, cuts), whole);
    cuts.cut(*find_link(*mesh, 3, 4));
    const std::vector<ElementId> parted{0, 2, 4, 5};
    QCOMPARE(ends(level, cuts), parted);
    cuts.uncut(*find_link(*mesh, 3, 4));
    QCOMPARE(ends(level, cuts), whole);
  }

  void coarseFacesCoverTheLatticeAndGoWithTheirSides() {
    const auto mesh = generate({MeshKind::cloth, {10, 7, 1}, 1, {}});
    Cuts cuts(mesh);
    const auto level = coarseLattice(mesh, 4);  // columns 0 4 8 9, rows 0 4 6
    QCOMPARE(faceCount(level, cuts), 2U * 3 * 2);
    // In the side from (4, 0) to (4, 4), which a face on the left and one on the right share.
    cuts.cut(*find_link(*mesh, 4 + 10, 4 + 20));
    QCOMPARE(faceCount(level, cuts), 2U * 3 * 2 - 2);
  }

  void aPlainMeshThinsOutAndHangsTogether() {
    const auto mesh = plainCloth(60, 50);
    const Cuts none(mesh);
    auto level = wholeLevel(mesh);
    for (unsigned step = 2; step <= 8; step *= 2) {
      const auto next = coarser(*level);
      QCOMPARE(next->step, step);
      QVERIFY(next->elements.size() * 3 < level->elements.size());
      QVERIFY(next->links.size() * 2 < level->links.size());
      QVERIFY(!next->faces.empty());
      const ElementId first = next->elements.front();
      for (const ElementId e : {next->elements[next->elements.size() / 2], next->elements.back()}) {
        QVERIFY(joined(next, none, first, e));
      }
      level = next;
    }
  }

  void aCutThroughAPlainMeshShowsCoarsely() {
    const auto mesh = plainCloth(40, 40);
    const auto level = coarser(*coarser(*wholeLevel(mesh)));
    const auto x = [&](ElementId e) { return mesh->rest_position(e).x(); };
    const auto side = [&](bool right) {
      return *std::ranges::find_if(level->elements, [&](ElementId e) { return (x(e) > 19.5) == right; });
    };
    Cuts cuts(mesh);
    QVERIFY(joined(level, cuts, side(false), side(true)));
    for (LinkId link = 0; link < mesh->link_count(); ++link) {
      if ((x(mesh->links[link][0]) > 19.5) != (x(mesh->links[link][1]) > 19.5)) {
        cuts.cut(link);
      }
    }
    QVERIFY(!joined(level, cuts, side(false), side(true)));
    QVERIFY(faceCount(level, cuts) < level->faces.size());
  }

  void facesAndLinksAreLeftOutAlone() {
    for (const unsigned dimensions : {2U, 3U}) {
      const Scene scene({MeshKind::cloth, {5, 4, 1}, 1, dimensions});
      const Cuts none(scene.frame.mesh);
      DrawnParts parts(std::make_shared<MeshLevels>());
      parts.setFrame(scene.frame, none);
      const auto drawn = [&](bool faces, bool links) {
        DrawOptions options;
        options.faces = faces;
        options.links = links;
        choose(parts, scene, options);
        return std::pair(parts.faces().size() / 3, parts.links().ends.size() / 2);
      };
      const std::size_t all = scene.frame.mesh->triangles.size(), links = scene.frame.mesh->link_count();
      QCOMPARE(drawn(true, true), std::pair(all, links));
      QCOMPARE(drawn(false, true), std::pair(std::size_t{0}, links));
      QCOMPARE(drawn(true, false), std::pair(all, std::size_t{0}));
    }
  }

  /// The whole cloth has 111,303 links and faces, its next coarser level about a quarter of them.
  void aPartInViewIsDrawnInFullDetail() {
    Scene scene({MeshKind::cloth, {150, 150, 1}, 1, {}});
    const Cuts none(scene.frame.mesh);
    DrawnParts parts(std::make_shared<MeshLevels>());
    parts.setFrame(scene.frame, none);
    choose(parts, scene);
    QVERIFY(parts.step() > 1);
    scene.camera.zoom(4, {400, 300}, scene.view);
    choose(parts, scene);
    QCOMPARE(parts.step(), 1U);
  }

  void nearlyAsMuchIsDrawnAsTheSceneAllows() {
    Scene scene({MeshKind::cloth, {150, 150, 1}, 1, {}});
    const Cuts none(scene.frame.mesh);
    DrawnParts parts(std::make_shared<MeshLevels>());
    parts.setFrame(scene.frame, none);
    for (const std::size_t most : {std::size_t{60'000}, std::size_t{20'000}, std::size_t{5'000}, std::size_t{1'200}}) {
      choose(parts, scene, {}, most);
      const std::size_t drawn = parts.faces().size() / 3 + parts.links().ends.size() / 2;
      QVERIFY2(drawn <= most && drawn >= most / 5, qPrintable(QStringLiteral("%1 of %2").arg(drawn).arg(most)));
    }
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

CHAINMAIL_TEST(DrawnIndices)

}  // namespace chainmail::drawn_indices

#include "drawn_indices.moc"
