// Tests the cut tool on objects in 3D, in a real window: through the whole object, or only its front layer.

#include <QToolButton>

#include "core/families.h"
#include "window.h"

using namespace chainmail;

namespace {

/// True if both ends of a link are nearer to the viewer than the centre.
bool isNear(Workbench& bench, LinkId link) {
  const auto depth = [&bench](const Point& at) {
    const Camera& camera = *bench.view(0).camera();
    return (camera.toView()).map(asVector(at)).z();
  };
  const Mesh& mesh = *bench.document().mesh();
  const auto [a, b] = mesh.links[link];
  const float middle = depth(Point::Zero());
  return depth(mesh.rest_position(a)) > middle && depth(mesh.rest_position(b)) > middle;
}

QList<QPoint> strokeAcross(Workbench& bench) {
  const QPoint middle = bench.view(0).placeOf(Point::Zero()).toPoint();
  return {middle + QPoint(-60, 6), middle + QPoint(60, -6)};  // well inside the outline
}

std::vector<LinkId> cutBy(Workbench& bench) {
  bench.stroke(0, strokeAcross(bench));
  const auto cuts = bench.document().cuts().links();
  bench.trigger("undo");
  bench.settle();
  return cuts;
}

}  // namespace

class WindowKnife : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void aStrokeOverASphereCutsItsNearHalfAloneOrBoth() {
    Workbench bench(test::sphere(24, 12));
    bench.trigger("toolCut");
    auto* button = bench.find<QToolButton>("cutFrontOnlyButton");
    QVERIFY(button->isVisible() && button->isEnabled());
    QVERIFY(!button->isChecked());
    const auto through = cutBy(bench);
    button->click();
    const auto front = cutBy(bench);
    const auto near = [&](LinkId link) { return isNear(bench, link); };
    QVERIFY(!front.empty());
    QVERIFY(std::ranges::all_of(front, near));
    QCOMPARE(std::ranges::count_if(through, near), std::ptrdiff_t(front.size()));
    QVERIFY(through.size() > front.size() + 3);
    QVERIFY(std::ranges::includes(through, front));
    QTest::keyClick(&bench.window, Qt::Key_K, Qt::ShiftModifier);
    QCOMPARE(cutBy(bench), through);
  }

  void aVolumeIsOpenedLayerByLayer() {
    Workbench bench(test::make_mesh(MeshKind::tetra, {5, 5, 5}));
    bench.trigger("toolCut");
    bench.trigger("cutFrontOnly");
    const QPoint middle = bench.view(0).placeOf(Point(2, 2, 2)).toPoint();
    const QList<QPoint> across{middle - QPoint(90, 4), middle + QPoint(90, 4)};
    bench.stroke(0, across);
    const auto first = bench.document().cuts().count();
    QVERIFY(first > 0);
    bench.stroke(0, across);
    const auto second = bench.document().cuts().count();
    QVERIFY(second > first);  // the links that the first cut uncovered
    bench.trigger("cutFrontOnly");
    bench.stroke(0, across);
    QVERIFY(bench.document().cuts().count() > second);
  }

  void inAPlaneThereIsNothingToChooseAndItSaysWhy() {
    Workbench bench;
    bench.trigger("toolCut");
    auto* button = bench.find<QToolButton>("cutFrontOnlyButton");
    QVERIFY(button->isVisible() && !button->isEnabled());
    QVERIFY(button->toolTip().contains(QStringLiteral("Not available in 2D")));
    bench.trigger("toolDrag");
    QVERIFY(!button->isVisible());
    bench.document().replaceMesh(test::sphere(8, 4), QStringLiteral("sphere"), QStringLiteral("sphere"));
    bench.settle();
    QVERIFY(bench.find<QAction>("cutFrontOnly")->isEnabled());
  }
};

int main(int argc, char** argv) { return runWindowTest<WindowKnife>(argc, argv); }
#include "window_knife.moc"
