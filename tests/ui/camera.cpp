// Where things appear, and what lies under a place of the view.

#include "camera.h"

#include <QTest>

#include "mesh/generate.h"
#include "picking.h"

using namespace chainmail;

class CameraTest : public QObject {
  Q_OBJECT

 private slots:
  void whatFitsIsSeen_data() {
    QTest::addColumn<int>("kind");
    QTest::addColumn<QSizeF>("view");
    for (const QSizeF view : {QSizeF(800, 600), QSizeF(300, 900), QSizeF(900, 200)}) {
      for (const auto kind : {MeshKind::line, MeshKind::grid, MeshKind::tetra}) {
        QTest::addRow("%d %gx%g", int(kind), view.width(), view.height()) << int(kind) << view;
      }
    }
  }
  void whatFitsIsSeen() {
    QFETCH(int, kind);
    QFETCH(QSizeF, view);
    const auto mesh = generate({MeshKind(kind), {7, 5, 3}, 2, {}});
    Camera camera;
    camera.fit(bounds(*mesh), mesh->space_dimension == 3, view);
    const Projection projection(*mesh, camera.toView(), camera.toClip(view), view);
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      float carried[3]{};
      for (int k = 0; k < mesh->space_dimension; ++k) {
        carried[k] = float(mesh->rest[e * mesh->space_dimension + k]);
      }
      const auto at = projection(carried);
      QVERIFY(at.visible);
      QVERIFY(at.x > 0 && at.x < view.width() && at.y > 0 && at.y < view.height());
    }
  }

  void thePointUnderAPlaceAppearsThere_data() {
    QTest::addColumn<bool>("spatial");
    QTest::newRow("plane") << false;
    QTest::newRow("space") << true;
  }
  void thePointUnderAPlaceAppearsThere() {
    QFETCH(bool, spatial);
    const QSizeF view(640, 480);
    Camera camera;
    camera.fit({Point(0, 0, 0), Point(6, 4, spatial ? 3 : 0)}, spatial, view);
    camera.orbit({40, 25});
    camera.zoom(1.7, {200, 100}, view);
    camera.pan({-30, 12}, view);
    const QPointF place(411, 93);
    const QVector3D point = camera.pointAt(place, {1, 2, 0}, view);
    const QVector3D device = (camera.toClip(view) * camera.toView()).map(point);
    // Half a pixel: the matrices are in float.
    QVERIFY(std::abs((device.x() + 1) / 2 * 640 - place.x()) < 0.5);
    QVERIFY(std::abs((1 - device.y()) / 2 * 480 - place.y()) < 0.5);
  }

  void zoomKeepsThePlaceUnderTheCursor() {
    const QSizeF view(640, 480);
    Camera camera;
    camera.fit({Point(0, 0, 0), Point(6, 4, 0)}, false, view);
    const QVector3D before = camera.pointAt({500, 111}, {0, 0, 0}, view);
    const double units = camera.unitsPerPixel(view);
    camera.zoom(2, {500, 111}, view);
    QVERIFY((camera.pointAt({500, 111}, {0, 0, 0}, view) - before).length() < 0.5F * float(units));
    QCOMPARE(camera.unitsPerPixel(view), units / 2);
  }
};

QTEST_GUILESS_MAIN(CameraTest)
#include "camera.moc"
