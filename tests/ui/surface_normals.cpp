// Tests the smooth normals of surfaces, and that an update equals a new computation.

#include "drawing/surface_normals.h"

#include <QTest>

#include "core/families.h"
#include "mesh/generate.h"
#include "mesh/surface.h"
#include "program.h"

namespace chainmail::surface_normals {

namespace {

Frame frameOf(const MeshPointer& mesh) {
  Frame frame;
  frame.mesh = mesh;
  frame.positions.assign(mesh->rest.begin(), mesh->rest.end());
  frame.number = 1;
  frame.series = 1;
  frame.changed.assign((mesh->element_count() + Frame::block_elements - 1) / Frame::block_elements, 1);
  return frame;
}

std::vector<ElementId> cornersOf(const Mesh& mesh) {
  std::vector<ElementId> corners;
  for (const auto& triangle : mesh.triangles) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  return corners;
}

QVector3D positionOf(const Frame& frame, ElementId e) {
  return {frame.positions[3 * e], frame.positions[3 * e + 1], frame.positions[3 * e + 2]};
}

/// Moves elements away from the centre, and notes the change as a solver does.
void move(Frame& frame, ElementId first, ElementId end) {
  ++frame.number;
  for (ElementId e = first; e < end; ++e) {
    for (int k = 0; k < 3; ++k) {
      frame.positions[3 * e + k] *= 1.5F + 0.1F * float(e % 3);
    }
    frame.changed[e / Frame::block_elements] = frame.number;
  }
}

}  // namespace

class SurfaceNormalsTest : public QObject {
  Q_OBJECT

 private slots:
  void normalsOfASpherePointAwayFromItsCentre() {
    const auto mesh = test::sphere(48, 24);
    const Frame frame = frameOf(mesh);
    SurfaceNormals normals;
    normals.setFaces(cornersOf(*mesh), mesh->element_count());
    normals.follow(frame);
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      const QVector3D normal = normals.normals()[e].normalized();
      const float along = QVector3D::dotProduct(normal, positionOf(frame, e).normalized());
      QVERIFY2(along > 0.995F, qPrintable(QStringLiteral("element %1: %2").arg(e).arg(double(along))));
    }
  }

  void anUpdateEqualsANewComputation_data() {
    QTest::addColumn<unsigned>("first");
    QTest::addColumn<unsigned>("end");
    QTest::newRow("a few elements") << 700U << 720U;
    QTest::newRow("most elements") << 0U << 9'000U;
  }
  void anUpdateEqualsANewComputation() {
    QFETCH(unsigned, first);
    QFETCH(unsigned, end);
    const auto mesh = test::sphere(120, 80);
    Frame frame = frameOf(mesh);
    SurfaceNormals updated, fresh;
    updated.setFaces(cornersOf(*mesh), mesh->element_count());
    updated.follow(frame);
    move(frame, first, end);
    const auto before = updated.normals();
    updated.follow(frame);
    fresh.setFaces(cornersOf(*mesh), mesh->element_count());
    fresh.follow(frame);
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      QVERIFY((updated.normals()[e] - fresh.normals()[e]).length() <= 1e-5F * fresh.normals()[e].length());
      // What is sent to the graphics card must include every normal that changed.
      const auto inBlock = [&](const auto& range) {
        return range[0] * Frame::block_elements <= e && e < range[1] * Frame::block_elements;
      };
      QVERIFY(updated.normals()[e] == before[e] || std::ranges::any_of(updated.changedBlocks(), inBlock));
    }
    updated.follow(frame);
    QVERIFY(updated.changedBlocks().empty());
  }

  /// The graphics card gets no more of a large surface than has changed.
  void farFromWhatMovesNothingIsComputedAnew() {
    const auto mesh = test::sphere(120, 80);
    Frame frame = frameOf(mesh);
    SurfaceNormals normals;
    normals.setFaces(cornersOf(*mesh), mesh->element_count());
    normals.follow(frame);
    const ElementId last = mesh->element_count() - 1;  // a pole
    move(frame, last, last + 1);
    normals.follow(frame);
    QVERIFY(!normals.changedBlocks().empty());
    for (const auto& range : normals.changedBlocks()) {
      QVERIFY(range[0] > frame.changed.size() / 2);
    }
  }

  void elementsAtACreaseHaveNoNormal() {
    const auto block = generate({MeshKind::tetra, {5, 5, 5}, 1, {}});
    const Surface surface(std::make_shared<CellTable>(block));
    SurfaceNormals normals;
    normals.setFaces(surface.triangles(), block->element_count());
    normals.follow(frameOf(block));
    QCOMPARE(normals.normals()[0], QVector3D());                        // a corner
    QCOMPARE(normals.normals()[2], QVector3D());                        // on an edge
    QCOMPARE(normals.normals()[12].normalized(), QVector3D(0, 0, -1));  // the middle of a side
  }

  void anElementWithoutFacesHasNoNormal() {
    const auto mesh = test::sphere(12, 6);
    auto corners = cornersOf(*mesh);
    std::erase(corners, ElementId{5});
    corners.resize(corners.size() / 3 * 3);
    SurfaceNormals normals;
    normals.setFaces(corners, mesh->element_count());
    normals.follow(frameOf(mesh));
    QCOMPARE(normals.normals()[5], QVector3D());
  }
};

CHAINMAIL_TEST(SurfaceNormalsTest)

}  // namespace chainmail::surface_normals

#include "surface_normals.moc"
