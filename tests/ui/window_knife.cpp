// Tests the cut tool on objects in 3D, in a real window: through the whole object, or only its front layer.

#include <QSettings>
#include <QToolButton>

#include "core/families.h"
#include "core/hexahedra.h"
#include "docks/replay_dock.h"
#include "document/edits.h"
#include "tools/cut_tool.h"
#include "window.h"
#include "window/bars.h"

namespace chainmail::window_knife {

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
  const QPoint middle = bench.view(0).viewPosition(Point::Zero()).toPoint();
  return {middle + QPoint(-60, 6), middle + QPoint(60, -6)};  // well inside the outline
}

/// Returns a vertical stroke across a sheet of 9 x 7 elements.
QList<QPoint> acrossColumns(Workbench& bench) {
  const QPoint top = (bench.place(0, 57) + bench.place(0, 58)) / 2;
  const QPoint bottom = (bench.place(0, 3) + bench.place(0, 4)) / 2;
  return {top - QPoint(0, 20), bottom + QPoint(0, 20)};
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
  void init() {
    failOnWarnings();
    QSettings().clear();
  }

  void aStrokeSplitsTheTrianglesOfASheetInAllPanels() {
    Workbench bench(test::jittered_triangles(9, 7, 3));
    const MeshPointer whole = bench.document().mesh();
    edits::setPinned(bench.document(), {0}, true);
    const QPoint from = bench.place(0, 40);
    bench.stroke(0, {from, from + QPoint(15, 20)});
    const Point moved = bench.position(1, 40);
    const Camera before = *bench.view(0).camera();
    bench.trigger("toolCut");
    bench.find<QAction>("cutSplits")->setChecked(true);
    bench.stroke(0, acrossColumns(bench));

    const MeshPointer split = bench.document().mesh();
    QVERIFY(split->element_count() > whole->element_count());
    QCOMPARE(bench.document().cuts().count(), 0U);
    QCOMPARE(bench.document().parts(), 2U);
    QCOMPARE(bench.document().pins(), std::vector<ElementId>{0});
    QCOMPARE(bench.position(1, 40), moved);
    QVERIFY(bench.view(0).camera()->toView() == before.toView());
    QVERIFY(bench.view(0).camera()->toClip(QSizeF(9, 9)) == before.toClip(QSizeF(9, 9)));

    // The parts move apart.
    bench.trigger("toolDrag");
    const QPoint right = bench.place(1, 44);
    const std::array<Point, 2> left{bench.position(0, 27), bench.position(1, 27)};
    bench.stroke(1, {right, right + QPoint(60, 10)});
    for (int panel = 0; panel < 2; ++panel) {
      QVERIFY(bench.position(panel, 44) != whole->rest_position(44));
      QCOMPARE(bench.position(panel, 27), left[std::size_t(panel)]);
    }

    bench.trigger("undo");
    bench.trigger("undo");
    bench.settle();
    QCOMPARE(bench.document().mesh(), whole);
    QCOMPARE(bench.position(1, 40), moved);
    bench.trigger("redo");
    bench.settle();
    QCOMPARE(bench.document().mesh(), split);
  }

  void linksBesideFacesAreCutWithTheStroke() {
    MeshParts parts;
    parts.rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}, {1, 2, 0}};
    test::add_triangle(parts, 0, 1, 2);
    test::add_triangle(parts, 1, 3, 2);
    parts.links.push_back({4, 5});  // above the faces
    Workbench bench(build_mesh(std::move(parts)));
    const LinkId beside = *find_link(*bench.document().mesh(), 4, 5);
    bench.trigger("toolCut");
    bench.find<QAction>("cutSplits")->setChecked(true);
    const QPoint top = (bench.place(0, 4) + bench.place(0, 5)) / 2,
                 middle = (bench.place(0, 2) + bench.place(0, 3)) / 2;
    const QPoint bottom = (bench.place(0, 0) + bench.place(0, 1)) / 2;
    bench.stroke(0, {top + QPoint(3, -20), (top + middle) / 2 + QPoint(3, 0)});  // crosses only this link
    QCOMPARE(bench.document().cuts().links(), std::vector{beside});
    bench.trigger("undo");
    bench.settle();
    bench.stroke(0, {top + QPoint(3, -20), bottom + QPoint(3, 20)});
    const Mesh& split = *bench.document().mesh();
    QVERIFY(split.element_count() > 6);
    QCOMPARE(bench.document().cuts().links(), std::vector{*find_link(split, 4, 5)});
    const auto states = bench.document().solvers().snapshots()[0].get();
    QVERIFY(states.is_at_rest());
    bench.trigger("undo");
    bench.settle();
    QVERIFY(bench.document().cuts().links().empty() && bench.document().mesh()->element_count() == 6);
  }

  void linksAreCutWhereOnlyLinksAreDrawnAndOnRequest() {
    Workbench bench(test::jittered_triangles(9, 7, 3));
    const MeshPointer whole = bench.document().mesh();
    bench.trigger("toolCut");
    bench.find<QAction>("cutSplits")->setChecked(true);
    const auto cutLinks = [&] {
      bench.stroke(0, acrossColumns(bench));
      const bool cut = bench.document().cuts().count() > 6 && bench.document().mesh() == whole;
      bench.trigger("undo");
      bench.settle();
      return cut;
    };
    QVERIFY(!cutLinks());
    bench.trigger("showLinks");
    QVERIFY(cutLinks());
    bench.trigger("showSurfaceAndLinks");
    QVERIFY(!cutLinks());
    auto* button = bench.find<QToolButton>("cutSplitsButton");
    QVERIFY(button->isVisible() && button->isChecked());
    {
      Workbench later(test::jittered_triangles(9, 7, 3));
      QVERIFY(later.find<QAction>("cutSplits")->isChecked());  // it is remembered
    }
    button->click();
    QVERIFY(cutLinks());
    Workbench later(test::jittered_triangles(9, 7, 3));
    QVERIFY(!later.find<QAction>("cutSplits")->isChecked());
    edits::replaceMesh(later.document(), generate({MeshKind::cloth, {5, 5, 1}, 1, {}}), QStringLiteral("cloth"),
                       QStringLiteral("cloth"));
    QVERIFY(!later.find<QAction>("cutSplits")->isEnabled());
  }

  void aStrokeOverASphereCutsItsNearHalfAloneOrBoth() {
    Workbench bench(test::sphere(24, 12));
    bench.trigger("toolCut");
    bench.find<QAction>("cutSplits")->setChecked(false);
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

  void aStrokeDividesTheCellsOfAVolume() {
    Workbench bench(test::make_mesh(MeshKind::tetra, {5, 5, 5}));
    const MeshPointer whole = bench.document().mesh();
    bench.trigger("toolCut");
    QVERIFY(bench.find<QAction>("cutSplits")->isChecked() && bench.find<QAction>("cutSplits")->isEnabled());
    const QPoint middle = bench.view(0).viewPosition(Point(2, 2, 2)).toPoint();
    const QList<QPoint> across{middle - QPoint(250, 7), middle + QPoint(250, 7)};
    bench.stroke(0, across);
    const MeshPointer split = bench.document().mesh();
    QVERIFY(split->tetrahedra.size() > whole->tetrahedra.size());
    QCOMPARE(bench.document().cuts().count(), 0U);
    QCOMPARE(bench.document().parts(), 2U);
    bench.trigger("undo");
    bench.settle();
    QCOMPARE(bench.document().mesh(), whole);
    bench.trigger("redo");
    bench.settle();
    QCOMPARE(bench.document().mesh(), split);
    bench.trigger("undo");
    bench.settle();
    // The front layer alone.
    bench.trigger("cutFrontOnly");
    bench.stroke(0, across);
    const std::size_t front = bench.document().mesh()->tetrahedra.size();
    QVERIFY(front > whole->tetrahedra.size() && front < split->tetrahedra.size());
    QCOMPARE(bench.document().parts(), 1U);
  }

  /// The stroke is beside the object, so that no link lights up.
  void otherViewsArePaintedAgainWithTheRibbonAndWithoutIt() {
    Workbench bench(test::make_mesh(MeshKind::tetra, {5, 5, 5}));
    bench.trigger("linkCameras");
    bench.view(1).orbit(QPointF(150, 0));
    bench.trigger("toolCut");
    const QList<QPoint> beside{{4, bench.view(0).height() / 2}, {4, bench.view(0).height() / 2 + 40}};
    const auto cancel = [&] {
      QTest::keyClick(&bench.window, Qt::Key_Escape);
      QTest::mouseRelease(&bench.view(0), Qt::LeftButton, {}, beside.last());
    };
    bench.stroke(0, beside.first(1), false);  // moves the keyboard focus
    cancel();
    bench.settle();
    View& other = bench.view(1);
    const QImage before = other.grabFramebuffer();

    QTRY_COMPARE(other.meter().framesPerSecond(), 0);
    bench.stroke(0, beside, false);
    QTRY_VERIFY(other.meter().framesPerSecond() > 0);
    QVERIFY(bench.document().highlight().marks().links.empty());
    QVERIFY(other.grabFramebuffer() != before);
    QTRY_COMPARE(other.meter().framesPerSecond(), 0);
    cancel();
    QTRY_VERIFY(other.meter().framesPerSecond() > 0);
    QVERIFY(other.grabFramebuffer() == before);
  }

  void theRibbonLiesUnderItsStrokeAndInFrontOfTheEye() {
    Workbench bench(test::make_mesh(MeshKind::tetra, {5, 5, 5}));
    View& view = bench.view(0);
    const QPointF from(20, 30), to(90, 110);
    CutTool tool(bench.document());
    for (const double closer : {1.0, 20.0}) {  // then the eye is inside the object
      view.zoom(closer);
      tool.press(view, from, {});
      tool.move(view, to, {});
      const auto ribbon = tool.ribbon(bench.view(1));
      QVERIFY(tool.ribbon(view).empty());
      QCOMPARE(ribbon.size(), std::size_t{4});
      for (std::size_t i = 0; i < ribbon.size(); ++i) {
        const auto &end = ribbon[i], &nearEnd = ribbon[i / 2 * 2];
        const auto depth = [&view](const QVector3D& at) { return -view.camera()->toView().map(at).z(); };
        QVERIFY(depth(nearEnd) > 0 && (i % 2 == 0 || depth(end) > depth(nearEnd)));
        const QPointF seen = view.viewPosition(Point(double(end.x()), double(end.y()), double(end.z())));
        QVERIFY(QLineF(seen, i < 2 ? from : to).length() < 1);
      }
      tool.cancel();
      QVERIFY(tool.ribbon(bench.view(1)).empty());
    }
  }

  void aStrokeThatAnAlgorithmCannotFollowIsRefused() {
    MeshParts parts = test::hexahedral_parts({3, 3, 3}, 1);
    parts.lattice = Lattice{{4, 4, 4}};
    Workbench bench(build_mesh(std::move(parts)));
    const MeshPointer whole = bench.document().mesh();
    edits::setAlgorithm(bench.document(), 1, Algorithm::chainmail_3d);
    bench.trigger("toolCut");
    const QPoint middle = bench.view(0).viewPosition(Point(1.5, 1.5, 1.5)).toPoint();
    bench.stroke(0, {middle - QPoint(250, 7), middle + QPoint(250, 7)});
    QCOMPARE(bench.document().mesh(), whole);
    QVERIFY(bench.window.messages().sentence().contains(QStringLiteral("works only on grids")));
    bench.find<QAction>("cutSplits")->setChecked(false);
    bench.stroke(0, {middle - QPoint(250, 7), middle + QPoint(250, 7)});
    QVERIFY(bench.document().cuts().count() > 0);
  }

  void aVolumeIsOpenedLayerByLayer() {
    Workbench bench(test::make_mesh(MeshKind::tetra, {5, 5, 5}));
    bench.trigger("toolCut");
    bench.find<QAction>("cutSplits")->setChecked(false);
    bench.trigger("cutFrontOnly");
    const QPoint middle = bench.view(0).viewPosition(Point(2, 2, 2)).toPoint();
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
};

CHAINMAIL_WINDOW_TEST(WindowKnife)

}  // namespace chainmail::window_knife

#include "window_knife.moc"
