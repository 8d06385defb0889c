// Tests sections, and textures on the object, in a real window. Both move with the material.

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QPainter>
#include <QSlider>

#include "docks/section_dock.h"
#include "document/edits.h"
#include "io/sessions.h"
#include "window.h"

namespace chainmail::window_section {

namespace {

constexpr std::uint32_t width = 15, height = 9, depth = 5;
constexpr ElementId middle = 7 + width * 4;  // of a layer

/// Returns a block. Seen from the front, its near side (z = 4) fills the middle of the view.
MeshPointer tetraBlock() { return generate({MeshKind::tetra, {width, height, depth}, 1, {}}); }

ElementId inLayer(std::uint32_t z, ElementId element = middle) { return element + width * height * z; }

/// The block with a section through its middle, seen from the open side.
struct SectionBench : Workbench {
  explicit SectionBench(const MeshPointer& mesh = tetraBlock()) : Workbench(mesh) {
    trigger("viewFront");
    trigger("showSurface");
    find<QComboBox>("sectionAxis")->setCurrentIndex(2);
    settle();
  }

  QImage picture() {
    settle();
    document().highlight().set({});
    return view(0).grabFramebuffer();
  }
  QColor colourAt(QPointF place) { return picture().pixelColor(place.toPoint()); }
  QColor colourIn(const QImage& image, const Point& place) {
    return image.pixelColor(view(0).viewPosition(place).toPoint());
  }
};

/// Returns the view as it is drawn for print, with the same number of pixels.
QImage inLines(View& view) {
  QImage image(view.size(), QImage::Format_RGB32);
  QPainter painter(&image);
  view.drawIn(painter, colours::background);
  return image;
}

/// True if this is the colour of the inside, which contains more blue than the yellow of the panel, whatever the light.
bool isInside(const QColor& colour) { return colour.blueF() > 0.6F * colour.redF(); }

int apart(const QColor& a, const QColor& b) {
  return std::max({std::abs(a.red() - b.red()), std::abs(a.green() - b.green()), std::abs(a.blue() - b.blue())});
}

/// Returns a texture of four squares: red and green below, blue and white above.
std::shared_ptr<Texture> fourSquares(double size) {
  auto texture = std::make_shared<Texture>();
  texture->size = {64, 64, 1};
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool right = x >= 32, above = y >= 32;
      const auto on = [](bool lit) { return std::uint8_t(lit ? 255 : 0); };
      texture->texels.insert(texture->texels.end(), {on(right == above), on(right), on(above), 255});
    }
  }
  texture->box = {Point(0, 0, 0), Point(size, size, 0)};
  return texture;
}
const QColor lowLeft(255, 0, 0), lowRight(0, 255, 0), highLeft(0, 0, 255), highRight(255, 255, 255);

MeshPointer picturedSheet(const std::shared_ptr<Texture>& texture = fourSquares(8)) {
  const auto cloth = generate({MeshKind::cloth, {9, 9, 1}, 1, {}});
  MeshParts parts;
  for (ElementId e = 0; e < cloth->element_count(); ++e) {
    parts.rest.push_back(cloth->rest_position(e));
  }
  parts.links = cloth->links;
  parts.triangles = cloth->triangles;
  parts.texture = texture;
  return build_mesh(std::move(parts));
}

/// Returns a block with 4 × 2 × 2 voxels of 4 × 5 × 3 mesh units each. The voxels' box is larger than the block, by 1
/// on each side.
MeshPointer volumeOf(const std::function<int(int, int, int)>& grey) {
  const auto block = tetraBlock();
  MeshParts parts;
  for (ElementId e = 0; e < block->element_count(); ++e) {
    parts.rest.push_back(block->rest_position(e));
  }
  parts.links = block->links;
  parts.tetrahedra = block->tetrahedra;
  auto texture = std::make_shared<Texture>();
  texture->size = {4, 2, 2};
  texture->channels = 1;
  for (int i = 0; i < 16; ++i) {
    texture->texels.push_back(std::uint8_t(grey(i % 4, i / 4 % 2, i / 8)));
  }
  texture->box = {Point(-1, -1, -1), Point(width, height, depth)};
  parts.texture = texture;
  return build_mesh(std::move(parts));
}
Point middleOfVoxel(int x, int y, int z) { return {1 + 4.0 * x, 1.5 + 5.0 * y, 0.5 + 3.0 * z}; }

/// A section across z through the middle of a layer of voxels, on the screen and as drawn for print.
struct Slice {
  Slice(const MeshPointer& volume, int layer) : bench(volume) {
    bench.trigger("section");
    bench.find<QDoubleSpinBox>("sectionPlace")->setValue(middleOfVoxel(0, 0, layer).z());
    screen = bench.picture();
    print = inLines(bench.view(0));
  }

  SectionBench bench;
  QImage screen, print;
};

}  // namespace

class WindowSection : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QSettings().clear();
  }

  void itTakesAwayWhatLiesInFrontAndShowsTheInside() {
    SectionBench bench;
    const QImage whole = bench.picture();
    const QPoint at = bench.place(0, inLayer(2));
    bench.trigger("section");
    QVERIFY(bench.find<SectionDock>("sectionDock")->isVisible());
    bench.settle();
    // The panels are smaller now, because the dock is open.
    const QImage open = bench.picture();
    const QPoint now = bench.place(0, inLayer(2));
    QVERIFY(isInside(open.pixelColor(now)) && !isInside(whole.pixelColor(at)));
    bench.find<QSlider>("sectionSlider")->setValue(1000);  // the whole object is behind the plane
    const QImage closed = bench.picture();
    QVERIFY(closed.pixelColor(now) != open.pixelColor(now));
    bench.trigger("section");
    bench.settle();
    QCOMPARE(bench.picture(), whole);  // the dock has closed, too
  }

  void whatIsNotSeenIsNeitherPickedNorCut() {
    SectionBench bench;
    bench.trigger("viewRight");  // along x: every layer is visible
    bench.settle();
    const QPointF front = bench.view(0).viewPosition(inLayer(4, width - 1 + width * 4));
    QCOMPARE(bench.view(0).search().elementAt(front), std::optional(inLayer(4, width - 1 + width * 4)));
    bench.trigger("section");
    bench.settle();
    const QPointF now = bench.view(0).viewPosition(inLayer(4, width - 1 + width * 4));
    const auto found = bench.view(0).search().elementAt(now);
    QVERIFY(!found || bench.document().mesh()->rest_position(*found).z() <= 2);
    for (const ElementId e :
         bench.view(0).search().elementsWhere(QRectF(bench.view(0).rect()), [](QPointF) { return true; })) {
      QVERIFY(bench.document().mesh()->rest_position(e).z() <= 2);
    }
    bench.trigger("viewFront");
    bench.settle();
    const QPointF at = bench.view(0).viewPosition(inLayer(2));
    const auto crossed = bench.view(0).search().linksCrossing(QLineF(at - QPointF(40, 33), at + QPointF(40, 35)));
    QVERIFY(!crossed.empty());
    const Mesh& mesh = *bench.document().mesh();
    for (const LinkId link : crossed) {
      const auto [a, b] = mesh.links[link];
      QVERIFY(std::min(mesh.rest_position(a).z(), mesh.rest_position(b).z()) <= 2);
    }
  }

  void itGoesWithTheMaterialAndItsCuts() {
    SectionBench bench;
    bench.trigger("section");
    const QColor face = bench.colourAt(bench.place(0, inLayer(2)));
    const Mesh& mesh = *bench.document().mesh();
    const auto* row = mesh.entry_link.data();
    edits::cut(bench.document(), {row + mesh.first_entry[inLayer(2)], row + mesh.first_entry[inLayer(2) + 1]});
    QVERIFY(apart(bench.colourAt(bench.place(0, inLayer(2))), face) > 10);
    bench.document().undoStack().undo();
    QCOMPARE(bench.colourAt(bench.place(0, inLayer(2))), face);
    // Far to the side, where nothing was before, and still open.
    edits::setSoftness(bench.document(), {1, 1, 0}, QStringLiteral("rigid"));
    bench.document().handle().grab(inLayer(2));
    bench.document().handle().drag(mesh.rest_position(inLayer(2)) + Point(0, 3, 0));
    bench.document().handle().release();
    QVERIFY(apart(bench.colourAt(bench.view(0).viewPosition(inLayer(2, 7 + width * 8)) + QPointF(3, 8)), face) <= 2);
  }

  void printShowsTheSame() {
    SectionBench bench;
    bench.trigger("section");
    const QImage screen = bench.picture(), print = inLines(bench.view(0));
    for (const Point& place : {Point(7.3, 4.4, 2), Point(2.3, 2.6, 2), Point(12.4, 6.7, 2)}) {
      QVERIFY(apart(bench.colourIn(screen, place), bench.colourIn(print, place)) <=
              6);  // in print, fog has one colour per face
    }
  }

  void figuresAndSliderAgreeAndTellWhyTheyAreOff() {
    SectionBench bench;
    auto* spin = bench.find<QDoubleSpinBox>("sectionPlace");
    auto* slider = bench.find<QSlider>("sectionSlider");
    QVERIFY(!slider->isEnabled() && slider->toolTip().contains(QStringLiteral("off")));
    bench.trigger("section");
    QVERIFY(slider->isEnabled());
    slider->setValue(250);
    QCOMPARE(spin->value(), 1.0);
    spin->setValue(3);
    QCOMPARE(slider->value(), 750);
    QCOMPARE(bench.find<SectionDock>("sectionDock")->plane(), std::optional(SectionPlane{2, 3, false}));
    bench.find<QComboBox>("sectionAxis")->setCurrentIndex(0);
    QCOMPARE(spin->value(), 10.5);
    edits::replaceMesh(bench.document(), generate({MeshKind::grid, {4, 4, 1}, 1, {}}), QStringLiteral("flat"),
                       QStringLiteral("build"));
    QVERIFY(!bench.find<QAction>("section")->isEnabled());
    QVERIFY(slider->toolTip().contains(QStringLiteral("in 2D")));
    QVERIFY(!bench.find<SectionDock>("sectionDock")->plane());
    bench.document().undoStack().undo();
    QVERIFY(bench.find<SectionDock>("sectionDock")->plane().has_value());
    auto* dock = bench.find<SectionDock>("sectionDock");
    dock->close();
    QVERIFY(!bench.find<QAction>("section")->isChecked());
    bench.trigger("showSectionDock");
    QVERIFY(bench.find<QAction>("section")->isChecked() && dock->isVisible());
    QTRY_VERIFY(dock->height() < 100);
    bench.trigger("section");
    QVERIFY(dock->isHidden());
  }

  void aPictureLiesOnItsSheetAndIsWarpedWithIt() {
    Workbench bench(picturedSheet());
    const auto holds = [&](const QImage& image) {
      // Positions inside the outermost links of the squares, at their current positions.
      const auto colour = [&](ElementId e) { return image.pixelColor(bench.place(0, e) + QPoint(2, 1)); };
      return apart(colour(1 + 9), lowLeft) <= 3 && apart(colour(7 + 9), lowRight) <= 3 &&
             apart(colour(1 + 9 * 7), highLeft) <= 3 && apart(colour(7 + 9 * 7), highRight) <= 3;
    };
    const auto picture = [&](int panel) {
      bench.settle();
      bench.document().highlight().set({});
      return bench.view(panel).grabFramebuffer();
    };
    for (int panel = 0; panel < 2; ++panel) {
      QVERIFY(holds(picture(panel)));
    }
    const QPoint before = bench.place(0, 7 + 9 * 7);
    bench.document().handle().grab(8 + 9 * 8);
    bench.document().handle().drag(Point(11, 11, 0));
    bench.document().handle().release();
    QVERIFY(holds(picture(0)));
    QVERIFY(bench.place(0, 7 + 9 * 7) != before);
    QVERIFY(holds(inLines(bench.view(0))));
    bench.trigger("showLinks");
    QVERIFY(!holds(picture(0)));
    bench.trigger("showSurfaceAndLinks");
    bench.choose(0, "Natural Queue ChainMail");  // its blue differs from the red of this corner
    const QImage both = picture(0);
    QVERIFY(apart(both.pixelColor((bench.place(0, 20) + bench.place(0, 21)) / 2), lowLeft) > 40);  // a link
    QVERIFY(apart(both.pixelColor((bench.place(0, 20) * 3 + bench.place(0, 21) * 2 + bench.place(0, 30)) / 6),
                  lowLeft) <= 3);
  }

  /// The same test for voxels. The brightness also depends on the depth, so it is compared with volumes of one grey.
  void everyVoxelIsSeenWhereItLies_data() {
    QTest::addColumn<int>("layer");
    QTest::newRow("lower layer") << 0;
    QTest::newRow("upper layer") << 1;
  }
  void everyVoxelIsSeenWhereItLies() {
    QFETCH(int, layer);
    const auto grey = [](int x, int y, int z) { return 20 + 50 * x + 25 * y + 40 * z; };
    Slice slice(volumeOf(grey), layer);
    Slice black(volumeOf([](int, int, int) { return 0; }), layer);
    Slice white(volumeOf([](int, int, int) { return 255; }), layer);
    const auto isSeen = [&](QImage Slice::*image, const Point& place, int value) {
      const auto red = [&](Slice& of) { return of.bench.colourIn(of.*image, place).red(); };
      const double expected = red(black) + (red(white) - red(black)) * value / 255.0;
      return red(white) > red(black) + 100 && std::abs(red(slice) - expected) <= 3;
    };
    for (int x = 0; x < 4; ++x) {
      for (int y = 0; y < 2; ++y) {
        const QByteArray voxel = QByteArray::number(x) + ", " + QByteArray::number(y);
        const Point middle = middleOfVoxel(x, y, layer);
        QVERIFY2(isSeen(&Slice::screen, middle, grey(x, y, layer)), voxel);
        // On both sides of the centre, as near to the next voxel as the triangles allow.
        for (const double dx : {-1.6, 1.6}) {
          const Point place = middle + Point(dx, 0.2, 0);
          if (place.x() > 0 && place.x() < width - 1) {
            QVERIFY2(isSeen(&Slice::print, place, grey(x, y, layer)), voxel);
          }
        }
      }
    }
  }
};

CHAINMAIL_WINDOW_TEST(WindowSection)

}  // namespace chainmail::window_section

#include "window_section.moc"
