// Tests which links of the front layer a stroke crosses.

#include "drawing/front_links.h"

#include <QTest>

#include "core/families.h"
#include "program.h"
#include "scene.h"

namespace chainmail::front_links {

namespace {

/// An object seen with parallel rays, from +z or at an angle.
struct Front : Scene {
  explicit Front(const MeshPointer& mesh, double yaw = 0, double pitch = 0) : Scene(mesh), cuts(mesh) {
    camera.setParallel(true);
    camera.lookFrom(yaw, pitch);
  }
  std::vector<LinkId> crossedHere() const { return crossed(cuts, stroke); }
  std::vector<LinkId> unhidden(const std::vector<Face>& faces) const {
    return unhiddenLinks(frame, projection(), stroke, crossedHere(), faces);
  }
  std::vector<LinkId> unhidden() const {
    return unhidden(wholeFaces(frame, boxes, cuts, projection(), QRectF(stroke.p1(), stroke.p2()).normalized()));
  }
  /// Returns the crossed links with both ends at positions for which `holds` is true.
  template <class Holds>
  std::vector<LinkId> crossedWhere(Holds holds) const {
    std::vector<LinkId> links;
    for (const LinkId link : crossedHere()) {
      const auto [a, b] = frame.mesh->links[link];
      if (holds(frame.mesh->rest_position(a)) && holds(frame.mesh->rest_position(b))) {
        links.push_back(link);
      }
    }
    return links;
  }

  Cuts cuts;
  QLineF stroke{330, 310, 480, 290};  // near the middle of the view
};

/// Returns two sheets of triangles, the second 3 units behind the first. Both fill the middle of the view.
MeshPointer twoSheets() {
  MeshParts parts;
  const auto sheet = test::make_mesh(MeshKind::cloth, {6, 6, 1}, 3);
  for (const double z : {0.0, -3.0}) {
    const auto first = ElementId(parts.rest.size());
    for (ElementId e = 0; e < sheet->element_count(); ++e) {
      parts.rest.push_back(sheet->rest_position(e) + Point(z / 10, z / 20, z));
    }
    for (const auto& [a, b, c] : sheet->triangles) {
      test::add_triangle(parts, first + a, first + b, first + c);
    }
  }
  return build_mesh(std::move(parts));
}

}  // namespace

class FrontLinks : public QObject {
  Q_OBJECT

 private slots:
  void aSphereIsCrossedOnItsNearHalf_data() {
    QTest::addColumn<bool>("parallel");
    QTest::newRow("parallel rays") << true;
    QTest::newRow("perspective") << false;
  }
  void aSphereIsCrossedOnItsNearHalf() {
    QFETCH(bool, parallel);
    Front scene(test::sphere(24, 12), 20, 35);
    scene.camera.setParallel(parallel);
    const Projection projection = scene.projection();
    const float centre[3]{};
    const float middle = projection.depth(projection(centre));
    std::vector<LinkId> near;
    for (const LinkId link : scene.crossedHere()) {
      const auto [a, b] = scene.frame.mesh->links[link];
      if (projection.depth(plain::viewPosition(scene.frame, projection, a)) < middle &&
          projection.depth(plain::viewPosition(scene.frame, projection, b)) < middle) {
        near.push_back(link);  // by depth only, because the stroke ends well inside the outline
      }
    }
    QVERIFY(near.size() > 4 && near.size() < scene.crossedHere().size());
    QCOMPARE(scene.unhidden(), near);
  }

  void facesHideTheElementsBehindThem() {
    const Front scene(twoSheets());
    const QRectF part(330, 230, 140, 140);
    const FrontFaces front(scene.frame, scene.projection(),
                           wholeFaces(scene.frame, scene.boxes, scene.cuts, scene.projection(), part), part);
    int hidden = 0;
    for (const ElementId element : scene.elementsIn(part)) {
      const bool behind = scene.frame.mesh->rest_position(element).z() < 0;
      QCOMPARE(front.hides(element), behind);
      hidden += behind ? 1 : 0;
    }
    QVERIFY(hidden > 0 && hidden < int(scene.elementsIn(part).size()));
  }

  /// The corners of a face may be in any order, and far from each other. This one covers the rows 1 and 2 of four.
  void aFaceHidesWhatIsFarFromItsFirstCorners() {
    MeshParts parts;
    parts.rest = {{199, 1.5, 3}, {0, -0.5, 3}, {0, 3.5, 3}};
    test::add_triangle(parts, 2, 1, 0);
    const auto at = [](ElementId column, ElementId row) { return 3 + 4 * column + row; };
    for (int column = 0; column < 200; ++column) {
      for (int row = 0; row < 4; ++row) {
        parts.rest.emplace_back(column, row, 0);
      }
    }
    const Front scene(build_mesh(std::move(parts)));
    const QRectF part =
        QRectF(scene.place(at(80, 0)), scene.place(at(110, 3))).normalized().adjusted(-0.5, -0.5, 0.5, 0.5);
    const FrontFaces front(scene.frame, scene.projection(),
                           wholeFaces(scene.frame, scene.boxes, scene.cuts, scene.projection(), part), part);
    const std::vector<ElementId> elements = scene.elementsIn(part);
    QCOMPARE(elements.size(), std::size_t{31 * 4});
    for (const ElementId element : elements) {
      const double row = scene.frame.mesh->rest_position(element).y();
      QCOMPARE(front.hides(element), row == 1 || row == 2);
    }
  }

  void aPositionInAFaceHasTheCornerNearestToIt() {
    const Front scene(twoSheets());
    const QRectF part(330, 230, 140, 140);
    const FrontFaces front(scene.frame, scene.projection(),
                           wholeFaces(scene.frame, scene.boxes, scene.cuts, scene.projection(), part), part);
    int faces = 0;
    for (const auto& face : scene.frame.mesh->triangles) {
      std::array<QPointF, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto place = plain::viewPosition(scene.frame, scene.projection(), face[k]);
        corners[k] = {place.x, place.y};
      }
      const QPointF inside = 0.6 * corners[0] + 0.2 * corners[1] + 0.2 * corners[2];
      const bool second = QLineF(inside, corners[1]).length() < QLineF(inside, corners[2]).length();
      if (scene.frame.mesh->rest_position(face[0]).z() == 0 && part.contains(inside)) {
        QCOMPARE(front.cornerAt(inside), std::optional(face[0]));
        QCOMPARE(front.cornerAt(inside, [&](ElementId e) { return e != face[0]; }),
                 std::optional(second ? face[1] : face[2]));
        ++faces;
      }
    }
    QVERIFY(faces > 0);
    QVERIFY(!front.cornerAt({-1000, -1000}));
  }

  void whatAHoleShowsIsInFront() {
    Front scene(twoSheets());
    const auto first = scene.crossedWhere([](const Point& p) { return p.z() == 0; });
    const auto second = scene.crossedWhere([](const Point& p) { return p.z() < 0; });
    QVERIFY(!first.empty() && !second.empty());
    QCOMPARE(scene.unhidden(), first);
    for (const LinkId link : first) {
      scene.cuts.cut(link);  // the faces go with the links
    }
    QCOMPARE(scene.unhidden(), second);
  }

  void ofAVolumeOnlyItsSurfaceInSight() {
    Front scene(test::make_mesh(MeshKind::tetra, {4, 4, 4}));
    const auto table = std::make_shared<CellTable>(scene.frame.mesh);
    const auto facesOf = [](const Surface& surface) {
      std::vector<Face> faces;
      appendFaces(surface, faces);
      return faces;
    };
    const auto front = scene.unhidden(facesOf(Surface(table)));
    QCOMPARE(front, scene.crossedWhere([](const Point& p) { return p.z() == 3; }));
    for (const LinkId link : front) {
      scene.cuts.cut(link);
    }
    // The cut uncovers the inside, so a second stroke cuts deeper.
    const auto deeper = scene.unhidden(facesOf(Surface(table, scene.cuts)));
    QVERIFY(!deeper.empty());
    QVERIFY(deeper.size() < scene.crossedHere().size());
  }

  void ofLinksAloneTheNearestLayer() {
    const Front scene(test::make_mesh(MeshKind::block, {5, 5, 5}), 12, 8);
    const auto nearest = nearestLinks(scene.frame, scene.boxes, scene.projection(), scene.stroke, scene.crossedHere());
    const auto first = scene.crossedWhere([](const Point& p) { return p.z() == 4; });
    QVERIFY(!first.empty());
    QVERIFY(std::ranges::includes(nearest, first));
    const auto behind = scene.crossedWhere([](const Point& p) { return p.z() <= 3; });
    QVERIFY(std::ranges::none_of(nearest, [&](LinkId link) { return std::ranges::binary_search(behind, link); }));
  }
};

CHAINMAIL_TEST(FrontLinks)

}  // namespace chainmail::front_links

#include "front_links.moc"
