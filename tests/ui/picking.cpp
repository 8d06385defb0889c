// Which element lies under the cursor, and which links a stroke crosses.

#include "picking.h"

#include <QTest>

#include "camera.h"
#include "mesh/generate.h"

using namespace chainmail;

namespace {

struct Scene {
  explicit Scene(const MeshRecipe& recipe) {
    frame.mesh = generate(recipe);
    frame.positions.assign(frame.mesh->rest.begin(), frame.mesh->rest.end());
    camera.fit(bounds(*frame.mesh), std::span(frame.mesh->axes).first(std::size_t(frame.mesh->space_dimension)), view);
  }
  Projection projection() const { return {*frame.mesh, camera.toView(), camera.toClip(view), view}; }
  QPointF place(ElementId e) const {
    const auto at = projection()(frame.positions.data() + std::size_t{e} * frame.mesh->space_dimension);
    return {at.x, at.y};
  }

  QSizeF view{800, 600};
  Frame frame;
  Camera camera;
};

}  // namespace

class Picking : public QObject {
  Q_OBJECT

 private slots:
  void allElementsInAShape() {
    const Scene scene({MeshKind::block, {3, 3, 3}, 1, {}});
    const auto all = elementsWhere(scene.frame, scene.projection(), [](QPointF) { return true; });
    QCOMPARE(all.size(), 27U);  // those behind others too
    const QPointF at = scene.place(13);
    const auto one = elementsWhere(scene.frame, scene.projection(),
                                   [at](QPointF place) { return QLineF(at, place).length() < 1e-3; });
    QCOMPARE(one, std::vector<ElementId>{13});
  }

  void theDistanceFromASegment() {
    const QLineF segment(0, 0, 10, 0);
    QCOMPARE(distanceFrom(segment, {4, 3}), 3.0);
    QCOMPARE(distanceFrom(segment, {13, 4}), 5.0);  // from its end
    QCOMPARE(distanceFrom(segment, {-3, -4}), 5.0);
    QCOMPARE(distanceFrom({2, 2, 2, 2}, {2, 7}), 5.0);  // a point
  }

  void theNearestWithinReach() {
    const Scene scene({MeshKind::grid, {5, 4, 1}, 1, {}});
    const QPointF at = scene.place(7);
    QCOMPARE(nearestElement(scene.frame, scene.projection(), at + QPointF(6, 5), 14), std::optional<ElementId>(7));
    QCOMPARE(nearestElement(scene.frame, scene.projection(), at + QPointF(20, 0), 14), std::nullopt);
  }

  void theOneInFrontIsPreferred() {
    // Seen straight from the front, the elements of a column along z nearly cover each other.
    Scene scene({MeshKind::block, {2, 2, 9}, 1, {}});
    scene.camera.orbit({30 / 0.4, -25 / 0.4});
    const ElementId front = 4 * 8;
    QCOMPARE(nearestElement(scene.frame, scene.projection(), scene.place(front), 40), std::optional<ElementId>(front));
  }

  void aStrokeCrossesWhatLiesUnderIt() {
    const Scene scene({MeshKind::grid, {5, 4, 1}, 1, {}});
    const QPointF half = (scene.place(6) - scene.place(0)) / 2;
    // From the middle of the first square to the middle of the one above: across one link.
    const QLineF stroke(scene.place(0) + half, scene.place(5) + half);
    const auto link = find_link(*scene.frame.mesh, 5, 6);
    const Cuts none(scene.frame.mesh);
    QCOMPARE(crossedLinks(scene.frame, none, scene.projection(), stroke), std::vector<LinkId>{*link});
    Cuts cut(scene.frame.mesh);
    cut.cut(*link);
    QVERIFY(crossedLinks(scene.frame, cut, scene.projection(), stroke).empty());
    QVERIFY(crossedLinks(scene.frame, none, scene.projection(), QLineF(1, 1, 9, 1)).empty());
    // In line with the first row, and beside it.
    const double y = scene.place(0).y();
    QVERIFY(crossedLinks(scene.frame, none, scene.projection(), QLineF(0, y, scene.place(0).x() - 5, y)).empty());
  }

  void coordinatesThatAreNotCarriedStayInPlace() {
    MeshParts parts;
    parts.rest = {Point(0, 5, 1), Point(2, 5, 3)};
    parts.links = {{0, 1}};
    const auto mesh = build_mesh(std::move(parts));
    const QVector3D second = placement(*mesh).map(QVector3D(2, 3, 0));
    QCOMPARE(second, QVector3D(2, 5, 3));
  }
};

QTEST_GUILESS_MAIN(Picking)
#include "picking.moc"
