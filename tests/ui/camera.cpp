// Tests the positions of points in the view, and the points under a position of the view.

#include "drawing/camera.h"

#include <QTest>

#include "drawing/picking.h"
#include "mesh/generate.h"
#include "program.h"

namespace chainmail::camera {

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
    camera.fit(bounds(*mesh), std::span(mesh->axes).first(std::size_t(mesh->space_dimension)), view);
    const Projection projection(*mesh, camera.toView(), camera.toClip(view), view);
    for (ElementId e = 0; e < mesh->element_count(); ++e) {
      float coordinates[3]{};
      for (int k = 0; k < mesh->space_dimension; ++k) {
        coordinates[k] = float(mesh->rest[e * mesh->space_dimension + k]);
      }
      const auto at = projection(coordinates);
      QVERIFY(at.visible());
      QVERIFY(at.x > 0 && at.x < view.width() && at.y > 0 && at.y < view.height());
    }
  }

  void aFramedObjectFillsTheView_data() {
    QTest::addColumn<bool>("parallel");
    QTest::addColumn<QSizeF>("view");
    for (const bool parallel : {false, true}) {
      for (const QSizeF view : {QSizeF(800, 600), QSizeF(300, 900), QSizeF(900, 200)}) {
        QTest::addRow("%s %gx%g", parallel ? "parallel" : "perspective", view.width(), view.height())
            << parallel << view;
      }
    }
  }
  /// The points touch a margin at two opposite sides of the view, and no other margin is smaller.
  void aFramedObjectFillsTheView() {
    QFETCH(bool, parallel);
    QFETCH(QSizeF, view);
    std::vector<QVector3D> points;
    for (int i = 0; i < 200; ++i) {
      const float angle = 0.4F * float(i), up = float(i % 17);
      points.emplace_back(100 + 7 * std::cos(angle), up, -40 + 3 * std::sin(angle));
    }
    Camera camera;
    camera.fit({Point(0, 0, 0), Point(1, 1, 1)}, std::array{0, 1, 2}, view);
    camera.setParallel(parallel);
    camera.lookFrom(-50, 35);
    camera.frame(points, view);
    const QMatrix4x4 matrix = camera.toClip(view) * camera.toView();
    float left = 1, right = -1, bottom = 1, top = -1;
    for (const QVector3D& point : points) {
      const QVector3D at = matrix.map(point);
      left = std::min(left, at.x());
      right = std::max(right, at.x());
      bottom = std::min(bottom, at.y());
      top = std::max(top, at.y());
    }
    const float most = std::max(std::max(right, -left), std::max(top, -bottom));
    QVERIFY2(most > 0.85F && most < 0.95F, qPrintable(QString::number(double(most))));
    const bool byWidth = std::max(right, -left) > std::max(top, -bottom);
    QVERIFY(std::abs(byWidth ? right + left : top + bottom) < 0.01F);
  }

  void aPlaneOfAnyTwoAxesIsSeenFlat_data() {
    QTest::addColumn<int>("first");
    QTest::addColumn<int>("second");
    QTest::addColumn<float>("right");  // 1 or -1: where the larger coordinates are
    QTest::addColumn<float>("up");
    QTest::newRow("xy") << 0 << 1 << 1.F << 1.F;
    QTest::newRow("xz, from above") << 0 << 2 << 1.F << -1.F;
    QTest::newRow("yz, from the side") << 1 << 2 << -1.F << 1.F;
  }
  void aPlaneOfAnyTwoAxesIsSeenFlat() {
    QFETCH(int, first);
    QFETCH(int, second);
    QFETCH(float, right);
    QFETCH(float, up);
    const QSizeF view(640, 480);
    Point far = Point::Zero();
    far[first] = 4;
    far[second] = 3;
    Camera camera;
    camera.fit({Point::Zero(), far}, std::array{first, second}, view);
    const QMatrix4x4 matrix = camera.toClip(view) * camera.toView();
    const QVector3D corner = matrix.map(QVector3D(0, 0, 0)),
                    opposite = matrix.map(QVector3D(far.x(), far.y(), far.z()));
    QVERIFY(right * (opposite.x() - corner.x()) > 0.5F);
    QVERIFY(up * (opposite.y() - corner.y()) > 0.5F);
    for (const QVector3D& place : {corner, opposite}) {
      QVERIFY(std::abs(place.x()) < 1 && std::abs(place.y()) < 1);
    }
  }

  void anAxisIsSeenFromItsSide_data() {
    QTest::addColumn<bool>("isUpZ");
    QTest::newRow("y is up") << false;
    QTest::newRow("z is up") << true;
  }
  /// Where the camera looks from an axis, what is on this side is nearer.
  void anAxisIsSeenFromItsSide() {
    QFETCH(bool, isUpZ);
    const std::array axes{0, 1, 2};
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool positive : {false, true}) {
        Camera camera;
        camera.setUp(isUpZ ? Camera::Up::z : Camera::Up::y);
        camera.fit({Point::Constant(-1), Point::Constant(1)}, axes, QSizeF(640, 480));
        camera.lookFromAxis(axis, positive);
        QVector3D place;
        place[axis] = positive ? 1 : -1;
        const QVector3D near = camera.toView().map(place), far = camera.toView().map(-place);
        QVERIFY2(near.z() > far.z() + 1.9F, qPrintable(QStringLiteral("%1 %2").arg(axis).arg(positive)));
        QVERIFY(std::abs(near.x() - far.x()) < 1e-3 && std::abs(near.y() - far.y()) < 1e-3);
      }
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
    const std::array axes{0, 1, 2};
    camera.fit({Point(0, 0, 0), Point(6, 4, spatial ? 3 : 0)}, std::span(axes).first(spatial ? 3 : 2), view);
    camera.orbit({40, 25});
    camera.zoom(1.7, {200, 100}, view);
    camera.pan({-30, 12}, view);
    const QPointF place(411, 93);
    const QVector3D point = camera.pointAt(place, {1, 2, 0}, view);
    const QVector3D device = (camera.toClip(view) * camera.toView()).map(point);
    // Tolerance of half a pixel, because the matrices are in float.
    QVERIFY(std::abs((device.x() + 1) / 2 * 640 - place.x()) < 0.5);
    QVERIFY(std::abs((1 - device.y()) / 2 * 480 - place.y()) < 0.5);
  }

  void zoomKeepsThePlaceUnderTheCursor() {
    const QSizeF view(640, 480);
    Camera camera;
    const std::array axes{0, 1};
    camera.fit({Point(0, 0, 0), Point(6, 4, 0)}, axes, view);
    const QVector3D before = camera.pointAt({500, 111}, {0, 0, 0}, view);
    const double units = camera.unitsPerPixel(view);
    camera.zoom(2, {500, 111}, view);
    QVERIFY((camera.pointAt({500, 111}, {0, 0, 0}, view) - before).length() < 0.5F * float(units));
    QCOMPARE(camera.unitsPerPixel(view), units / 2);
  }
};

CHAINMAIL_TEST(CameraTest)

}  // namespace chainmail::camera

#include "camera.moc"
