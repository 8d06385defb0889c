// Tests the display of volumes in a real window: outer surface, links, and what a cut uncovers.

#include <QFile>
#include <QTemporaryDir>

#include "common/colours.h"
#include "document/edits.h"
#include "io/pictures.h"
#include "io/sessions.h"
#include "mesh/split.h"
#include "window.h"

namespace chainmail::window_surface {

namespace {

constexpr ElementId middleOfTheFront = 7 + 15 * 3 + 15 * 9 * 4;  // of the block below

/// Returns a block. Seen from the front, its near side fills the middle of the view.
MeshPointer tetraBlock() { return generate({MeshKind::tetra, {15, 9, 5}, 1, {}}); }

bool isGround(QRgb pixel) {
  const QColor ground = colours::background;
  return std::max({std::abs(qRed(pixel) - ground.red()), std::abs(qGreen(pixel) - ground.green()),
                   std::abs(qBlue(pixel) - ground.blue())}) < 6;
}

/// Returns the share of the pixels around an element that show the ground.
double groundAbout(Workbench& bench, ElementId element, int reach = 60) {
  bench.settle();
  const QImage picture = bench.view(0).grabFramebuffer();
  const QPoint centre = bench.place(0, element);
  int ground = 0;
  for (int dx = -reach; dx < reach; ++dx) {
    for (int dy = -reach; dy < reach; ++dy) {
      ground += isGround(picture.pixel(centre + QPoint(dx, dy)));
    }
  }
  return double(ground) / (4.0 * reach * reach);
}

/// Returns the number of shapes in a vector picture of the first panel.
qsizetype vectorShapes(Workbench& bench) {
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("panel.svg"));
  writeDrawing(path, drawingOf(bench.window.panel(0), false));
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) {
    return 0;
  }
  const QByteArray text = file.readAll();
  return text.count("<polyline") + text.count("<path") + text.count("<polygon") + text.count("<line");
}

QImage picture(Workbench& bench) {
  bench.settle();
  return bench.view(0).grabFramebuffer();
}

/// Cuts every link of an element, which removes the cells around it.
void cutOut(Workbench& bench, ElementId element) {
  const Mesh& mesh = *bench.document().mesh();
  const auto* row = mesh.entry_link.data();
  edits::cut(bench.document(), {row + mesh.first_entry[element], row + mesh.first_entry[element + 1]});
}

/// Returns the block without the cells beyond x = 7, which a split has removed.
MeshPointer openBlock() {
  const MeshPointer whole = tetraBlock();
  SplitEdit edit;
  for (CellId cell = 0; cell < whole->tetrahedra.size(); ++cell) {
    if (std::ranges::any_of(whole->tetrahedra[cell], [&](ElementId e) { return whole->rest_position(e).x() > 7; })) {
      edit.removed_cells.push_back(cell);
    }
  }
  return make_split(whole, std::move(edit))->after();
}

}  // namespace

class WindowSurface : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QSettings().clear();
  }

  void aVolumeIsSolidUnlessItsLinksAreChosen() {
    Workbench bench(tetraBlock());
    bench.trigger("viewFront");
    QVERIFY(bench.find<QAction>("showSurfaceAndLinks")->isChecked());
    QCOMPARE(groundAbout(bench, middleOfTheFront), 0.0);
    const QImage both = picture(bench);
    bench.trigger("showSurface");
    QCOMPARE(groundAbout(bench, middleOfTheFront), 0.0);
    const QImage surface = picture(bench);
    QVERIFY(surface != both);
    QVERIFY(isGround(surface.pixel(8, 8)));  // next to the object
    bench.trigger("showLinks");
    QVERIFY(groundAbout(bench, middleOfTheFront) > 0.2);  // between links, squares of about 20 pixels are empty
    bench.trigger("showSurface");
    QCOMPARE(picture(bench), surface);
  }

  void aCutShowsTheInsideAtOnceAndUndoClosesIt() {
    Workbench bench(tetraBlock());
    bench.trigger("viewFront");
    bench.trigger("showSurface");
    const QImage whole = picture(bench);
    const QPoint at = bench.place(0, middleOfTheFront);
    // The front is flat and evenly lit, so an area around one of its elements has one colour.
    const QRect about(at - QPoint(8, 8), QSize(16, 16));
    const QRgb face = whole.pixel(at + QPoint(5, 2));
    const auto ofTheFace = [&](const QImage& now) {
      int alike = 0;
      for (int x = about.left(); x <= about.right(); ++x) {
        for (int y = about.top(); y <= about.bottom(); ++y) {
          alike += now.pixel(x, y) == face;
        }
      }
      return double(alike) / (about.width() * about.height());
    };
    QVERIFY(ofTheFace(whole) > 0.95);
    cutOut(bench, middleOfTheFront);
    const QImage open = picture(bench);
    QVERIFY(ofTheFace(open) < 0.5);                           // slanted sides inside have another brightness
    QVERIFY(groundAbout(bench, middleOfTheFront, 8) < 0.01);  // and they cover everything behind them
    bench.document().undoStack().undo();
    QCOMPARE(picture(bench), whole);
    bench.document().undoStack().redo();
    QCOMPARE(picture(bench), open);
    // The same picture if the object is drawn again after the cut.
    edits::replaceMesh(bench.document(), tetraBlock(), QStringLiteral("other"), QStringLiteral("build"));
    bench.settle();
    bench.document().undoStack().undo();
    bench.settle();
    bench.trigger("viewFront");
    QCOMPARE(picture(bench), open);
  }

  void aSplitShowsTheInsideInItsOwnColourUnlessValuesColourIt() {
    Workbench bench(openBlock());
    bench.trigger("showSurface");
    const auto seenAlong = [&](const char* direction, const Point& at) {
      bench.trigger(direction);
      bench.settleFigures();
      return bench.view(0).grabFramebuffer().pixelColor(bench.view(0).viewPosition(at).toPoint());
    };
    const auto skin = [&] { return seenAlong("viewFront", {3.3, 4.4, 4}); };
    const auto inside = [&] { return seenAlong("viewRight", {7, 4.4, 2.3}); };
    const auto isInside = [](const QColor& colour) { return colour.blueF() > 0.6F * colour.redF(); };  // not yellow
    QVERIFY(isInside(inside()) && !isInside(skin()));
    bench.trigger("colourBy-distance");
    const QColor one = inside(), other = skin();  // both face the viewer, so they have the same light
    QVERIFY(std::abs(one.red() - other.red()) <= 2 && std::abs(one.green() - other.green()) <= 2 &&
            std::abs(one.blue() - other.blue()) <= 2);
  }

  void aLargeVolumesSurfaceIsMadeMeanwhile() {
    Workbench bench(generate({MeshKind::tetra, {60, 30, 12}, 1, {}}));
    bench.trigger("viewFront");
    const ElementId front = 30 + 60 * 15 + 60 * 30 * 11;
    QTRY_COMPARE(groundAbout(bench, front), 0.0);
    QVERIFY(!bench.view(0).leavesLinksOut());
    // If the mesh is replaced before its surface is ready, the surface is dropped. It returns with the mesh and its
    // cuts.
    cutOut(bench, front);
    const QImage open = picture(bench);
    edits::replaceMesh(bench.document(), generate({MeshKind::tetra, {50, 30, 14}, 1, {}}), QStringLiteral("other"),
                       QStringLiteral("build"));
    bench.document().undoStack().undo();
    bench.settle();
    bench.trigger("viewFront");
    QTRY_COMPARE(picture(bench), open);
  }

  void linksThatWouldHideTheSurfaceWaitForANearerLook() {
    Workbench bench(generate({MeshKind::tetra, {140, 140, 3}, 1, {}}));  // about 120,000 visible links
    bench.trigger("viewFront");
    bench.view(0).zoom(0.5);
    QTRY_VERIFY(bench.view(0).leavesLinksOut());
    bench.view(0).zoom(8);
    QTRY_VERIFY(!bench.view(0).leavesLinksOut());
    bench.view(0).zoom(1.0 / 8);
    QTRY_VERIFY(bench.view(0).leavesLinksOut());
    const qsizetype facesAlone = vectorShapes(bench);
    QVERIFY(facesAlone > 0);
    bench.trigger("colourBy-shear");  // this colour mode needs the links
    QTRY_VERIFY(!bench.view(0).leavesLinksOut());
    const qsizetype all = vectorShapes(bench);
    QVERIFY2(all > facesAlone + 10'000, qPrintable(QStringLiteral("%1, without links %2").arg(all).arg(facesAlone)));
  }
};

CHAINMAIL_WINDOW_TEST(WindowSurface)

}  // namespace chainmail::window_surface

#include "window_surface.moc"
