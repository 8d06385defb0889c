// Tests which element is under the cursor, and which links a stroke crosses.

#include "drawing/picking.h"

#include <QTest>
#include <numeric>
#include <random>

#include "drawing/mesh_level.h"
#include "drawing/mesh_levels.h"
#include "program.h"
#include "property.h"
#include "scene.h"

namespace chainmail::picking {

namespace {

/// Returns elements at random positions in space or in a plane, with links between random elements.
MeshPointer disorder(std::mt19937_64& random, ElementId count) {
  MeshParts parts;
  std::uniform_real_distribution<double> along(-20, 20);
  const bool flat = random() % 2 == 0;
  for (ElementId e = 0; e < count; ++e) {
    parts.rest.push_back(Point(along(random), along(random), flat ? 3 : along(random)));
  }
  for (ElementId e = 1; e < count; ++e) {
    parts.links.push_back({e, ElementId(random() % e)});
  }
  return build_mesh(std::move(parts));
}

MeshPointer randomMesh(std::mt19937_64& random) {
  const auto kind = *rc::gen::inRange(0, 6);
  const auto size = [&random](std::uint32_t highest) { return std::uint32_t(2 + random() % (highest - 1)); };
  switch (kind) {
    case 0:
      return generate({MeshKind::line, {size(1500), 1, 1}, 1, {}});
    case 1:
      return generate({MeshKind::grid, {size(60), size(60), 1}, 1, {}});
    case 2:
      return generate({MeshKind::cloth, {size(40), size(40), 1}, 0.01, 3});
    case 3:
      return generate({MeshKind::block, {size(14), size(14), size(14)}, 30, {}});
    case 4:
      return generate({MeshKind::tetra, {size(10), size(10), size(10)}, 1, {}});
    default:
      return disorder(random, size(6000));
  }
}

/// Moves some elements with similar ids, as a drag does, or sometimes all elements.
void deform(Scene& scene, std::mt19937_64& random) {
  const ElementId count = scene.frame.mesh->element_count();
  const bool all = random() % 4 == 0;
  const auto first = all ? 0 : ElementId(random() % count);
  const ElementId end = all ? count : std::min<ElementId>(count, first + ElementId(random() % 40));
  std::normal_distribution<float> by(0, float(5 * scene.frame.mesh->mean_link_length));
  ++scene.frame.number;
  for (ElementId e = first; e < end; ++e) {
    for (int k = 0; k < scene.frame.mesh->space_dimension; ++k) {
      scene.frame.positions[std::size_t{e} * scene.frame.mesh->space_dimension + k] += by(random);
    }
    scene.frame.changed[e / Frame::block_elements] = scene.frame.number;
  }
}

void moveCamera(Scene& scene, std::mt19937_64& random) {
  std::uniform_real_distribution<double> pixels(-300, 300), notches(-3, 18);
  scene.camera.orbit({pixels(random), pixels(random)});
  scene.camera.zoom(std::pow(1.2, notches(random)), {400 + pixels(random), 300 + pixels(random)}, scene.view);
  scene.camera.pan({pixels(random), pixels(random)}, scene.view);
}

/// Returns a position on a link. `share` is 0 at one end and 1 at the other.
Projection::Place along(const Scene& scene, const MeshLevel::Link& link, float share) {
  const int dimension = scene.frame.mesh->space_dimension;
  std::array<float, 3> at{};
  for (int k = 0; k < dimension; ++k) {
    const auto end = [&](ElementId e) { return scene.frame.positions[std::size_t{e} * dimension + k]; };
    at[k] = (1 - share) * end(link[0]) + share * end(link[1]);
  }
  return scene.projection()(at.data());
}

}  // namespace

class Picking : public QObject {
  Q_OBJECT

 private slots:
  void allElementsInAShape() {
    const Scene scene({MeshKind::block, {3, 3, 3}, 1, {}});
    const auto all = scene.elementsIn(QRectF(0, 0, 800, 600));
    QCOMPARE(all.size(), 27U);  // also the elements behind others
    const QPointF at = scene.place(13);
    QCOMPARE(scene.elementsIn(QRectF(at - QPointF(1, 1), at + QPointF(1, 1))), std::vector<ElementId>{13});
  }

  void preparedLevelsAreTheOnesThatAreUsed() {
    const MeshPointer mesh = generate({MeshKind::grid, {400, 400, 1}, 1, {}});
    const MeshPointer other = generate({MeshKind::grid, {400, 400, 1}, 1, {}});
    prepareLevels(mesh, {});
    const auto prepared = takePreparedLevels(mesh);
    QVERIFY(!prepared.empty());
    QVERIFY(takePreparedLevels(mesh).empty());  // they are handed over once
    for (const auto& level : prepared) {
      const auto own = level->step == 1 ? wholeLevel(mesh) : coarseLattice(mesh, level->step);
      QCOMPARE(level->elements, own->elements);
      QVERIFY(level->mesh == mesh);
    }
    prepareLevels(mesh, {});
    QVERIFY(takePreparedLevels(other).empty());
    MeshLevels levels;
    const auto first = levels.at(mesh, 1);
    QVERIFY(takePreparedLevels(mesh).empty());  // they have been taken
    QVERIFY(levels.at(mesh, 1) == first);
    const Progress job = Progress::watched();
    job.cancel();
    QVERIFY_THROWS_EXCEPTION(Cancelled, prepareLevels(mesh, job));
    QVERIFY(takePreparedLevels(mesh).empty());
  }

  void thereAreLevelsOfManyParts() {
    MeshParts parts;
    for (ElementId e = 0; e < 120'000; ++e) {
      parts.rest.emplace_back(e % 400, e / 400, 0);
    }
    parts.links = {{0, 1}};
    const MeshPointer mesh = build_mesh(std::move(parts));
    prepareLevels(mesh, {});
    QVERIFY(takePreparedLevels(mesh).size() <= 7);  // steps 1 to 64
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
    QCOMPARE(scene.nearest(at + QPointF(6, 5), 14), std::optional<ElementId>(7));
    QCOMPARE(scene.nearest(at + QPointF(20, 0), 14), std::nullopt);
  }

  void theOneInFrontIsPreferred() {
    // Seen from the front, the elements of a column along z nearly cover each other.
    Scene scene({MeshKind::block, {2, 2, 9}, 1, {}});
    scene.camera.orbit({30 / 0.4, -25 / 0.4});
    const ElementId front = 4 * 8;
    QCOMPARE(scene.nearest(scene.place(front), 40), std::optional<ElementId>(front));
  }

  void aStrokeCrossesWhatLiesUnderIt() {
    const Scene scene({MeshKind::grid, {5, 4, 1}, 1, {}});
    const QPointF half = (scene.place(6) - scene.place(0)) / 2;
    // From the middle of the first square to the middle of the square above, across one link.
    const QLineF stroke(scene.place(0) + half, scene.place(5) + half);
    const auto link = find_link(*scene.frame.mesh, 5, 6);
    const Cuts none(scene.frame.mesh);
    QCOMPARE(scene.crossed(none, stroke), std::vector<LinkId>{*link});
    Cuts cut(scene.frame.mesh);
    cut.cut(*link);
    QVERIFY(scene.crossed(cut, stroke).empty());
    QVERIFY(scene.crossed(none, QLineF(1, 1, 9, 1)).empty());
    // In line with the first row, and next to it.
    const double y = scene.place(0).y();
    QVERIFY(scene.crossed(none, QLineF(0, y, scene.place(0).x() - 5, y)).empty());
  }

  void theAnswersAreThoseOfLookingAtEverything() {
    const auto holds = [] {
      std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
      Scene scene(randomMesh(random));
      Cuts cuts(scene.frame.mesh);
      std::uniform_real_distribution<double> x(-20, 820), y(-20, 620), near(-40, 40);
      for (int i = 0; i < 6; ++i) {
        deform(scene, random);
        moveCamera(scene, random);
        cuts.cut(LinkId(random() % scene.frame.mesh->link_count()));
        scene.boxes.follow(scene.level, scene.frame);
        const QPointF from(x(random), y(random));
        const QPointF to = i % 2 == 0 ? from + QPointF(near(random), near(random)) : QPointF(x(random), y(random));
        const QRectF rectangle = QRectF(from, to).normalized();
        RC_ASSERT(scene.nearest(from, 14) == plain::nearestElement(scene.frame, scene.projection(), from, 14));
        RC_ASSERT(scene.elementsIn(rectangle) == plain::elementsIn(scene.frame, scene.projection(), rectangle));
        const auto crossed = plain::crossedLinks(scene.frame, cuts, scene.projection(), {from, to});
        RC_ASSERT(scene.crossed(cuts, {from, to}) == crossed);
      }
    };
    QVERIFY(test::check_property("clusters that are passed over hold nothing of the answer", holds));
  }

  /// Uses boxes of every element, and of coarse links, which are larger.
  void nothingThatIsSeenIsPassedOver() {
    const auto holds = [] {
      std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
      Scene scene(randomMesh(random));
      const auto whole = scene.level;
      const auto level = *rc::gen::arbitrary<bool>() ? whole
                         : scene.frame.mesh->lattice ? coarseLattice(scene.frame.mesh, 3)
                                                     : coarser(*coarser(*whole));
      deform(scene, random);
      moveCamera(scene, random);
      scene.boxes.follow(level, scene.frame);
      const QRectF view(QPointF(), scene.view);
      const auto seen = clustersSeen(scene.boxes, scene.projection());
      for (std::uint32_t cluster = 0; cluster < level->clusterCount(); ++cluster) {
        if (std::binary_search(seen.begin(), seen.end(), cluster)) {
          continue;
        }
        for (const std::uint32_t link : level->clusterLinks[cluster]) {
          for (int step = 0; step <= 16; ++step) {
            const auto at = along(scene, level->links[link], float(step) / 16);
            RC_ASSERT(!(at.visible() && view.contains(QPointF(at.x, at.y))));
          }
        }
      }
    };
    QVERIFY(test::check_property("what is not drawn is out of the view", holds));
  }

  void coordinatesThatAreNotCarriedStayInPlace() {
    MeshParts parts;
    parts.rest = {Point(0, 5, 1), Point(2, 5, 3)};
    parts.links = {{0, 1}};
    const auto mesh = build_mesh(std::move(parts));
    const QVector3D second = meshToWorld(*mesh).map(QVector3D(2, 3, 0));
    QCOMPARE(second, QVector3D(2, 5, 3));
  }
};

CHAINMAIL_TEST(Picking)

}  // namespace chainmail::picking

#include "picking.moc"
