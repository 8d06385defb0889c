// Tests files of users in a real window: voxel volumes, filled surfaces, and repairs.

#include <sys/stat.h>

#include <QDoubleSpinBox>
#include <QFile>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QTemporaryDir>
#include <QTextStream>
#include <QToolButton>
#include <cmath>

#include "document/edits.h"
#include "folders.h"
#include "io/file_actions.h"
#include "io/volumes.h"
#include "window.h"
#include "window/bars.h"

namespace chainmail::window_open {

class WindowOpen : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void aVolumeAsksForItsThresholdAndBecomesABlock() {
    Workbench bench;
    const MeshPointer before = bench.document().mesh();
    bench.open(sourceFile("tests/files/foreign/vtk.mha"));
    auto& bar = bench.window.findChild<FileActions*>()->volumes().bar();
    QVERIFY(bar.isVisible());
    QCOMPARE(bench.find<QLabel>("volumeAbout")->text(), QStringLiteral("vtk.mha: 6 × 5 × 4 voxels"));
    auto* threshold = bench.find<QDoubleSpinBox>("volumeThreshold");
    QCOMPARE(threshold->singleStep(), (threshold->maximum() - threshold->minimum()) / 100);
    threshold->setValue(-1000);
    QCOMPARE(bench.find<QLabel>("volumeResult")->text(), QStringLiteral("120 voxels"));
    auto* slider = bench.find<QSlider>("volumeSlider");  // follows the field, and the field follows it
    QCOMPARE(slider->value(), slider->minimum());
    threshold->setValue(1000);
    QCOMPARE(slider->value(), slider->maximum());
    slider->setValue(slider->minimum());
    QCOMPARE(threshold->value(), -1000.0);
    threshold->setValue(500);
    QCOMPARE(bench.find<QLabel>("volumeResult")->text(), QStringLiteral("24 voxels"));
    bench.find<QPushButton>("volumeAgree")->click();
    bench.settle();
    QVERIFY(!bar.isVisible());
    QCOMPARE(bench.document().mesh()->element_count(), 24U);
    QCOMPARE(bench.document().mesh()->hexahedra.size(), std::size_t{6});
    const auto stiff = bench.document().wholeSoftness()->links;
    QVERIFY(!stiff.empty());  // the links at the voxel of value 1000
    bench.trigger("undo");
    bench.settle();
    QCOMPARE(bench.document().mesh(), before);
    QVERIFY(bench.document().wholeSoftness()->links.empty());
    bench.trigger("redo");
    bench.settle();
    QCOMPARE(bench.document().wholeSoftness()->links, stiff);
  }

  void aClosedSurfaceIsFilled() {
    Workbench bench;
    auto* fill = bench.window.findChild<QAction*>(QStringLiteral("fillSurface"));
    QVERIFY(!fill->isEnabled());  // disabled for a plane grid
    bench.open(sourceFile("meshes/sphere.obj"));
    QVERIFY(fill->isEnabled());
    fill->trigger();
    auto* size = bench.find<QDoubleSpinBox>("fillSize");
    const QString coarse = bench.find<QLabel>("fillResult")->text();
    size->setValue(size->value() / 2);
    QVERIFY(bench.find<QLabel>("fillResult")->text() != coarse);
    bench.find<QPushButton>("fillAgree")->click();
    bench.settle();
    const Mesh& mesh = *bench.document().mesh();
    QVERIFY(mesh.tetrahedra.size() > 1000);
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("fill sphere.obj"));
    QVERIFY(!fill->isEnabled());
  }

  void theDefectsOfAFileAreNamedAndRepaired() {
    Workbench bench;
    bench.open(brokenCube());
    const auto* bar = bench.find<QFrame>("repairBar");
    QVERIFY(bar->isVisible());
    QCOMPARE(repairText(bench), QStringLiteral("1 duplicate vertex · 1 loose point · 1 hole (4 edges) · 1 non-manifold "
                                               "edge"));
    QVERIFY(!messages(bench).sentence().contains(QStringLiteral("position")));  // named once
    const MeshPointer broken = bench.document().mesh();
    bench.find<QPushButton>("repairWeld")->click();
    bench.settle();
    QCOMPARE(repairText(bench), QStringLiteral("1 loose point · 1 hole (4 edges) · 1 non-manifold edge"));
    QCOMPARE(bench.document().mesh()->element_count(), broken->element_count() - 1);
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("weld 1 duplicate vertex"));
    bench.trigger("undo");
    bench.settle();
    QCOMPARE(bench.document().mesh(), broken);
    bench.trigger("redo");
    bench.find<QPushButton>("repairLoose")->click();
    bench.settle();
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("remove 1 loose point"));
    bench.find<QPushButton>("repairHoles")->click();
    bench.settle();
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("close 1 hole"));
    QCOMPARE(bench.document().mesh()->triangles.size(), broken->triangles.size() + 2);
    QCOMPARE(repairText(bench), QStringLiteral("1 non-manifold edge"));
    QCOMPARE(bench.document().name(), QStringLiteral("broken.off"));
    QVERIFY(!bench.find<QPushButton>("repairLoose")->isVisible() &&
            !bench.find<QPushButton>("repairHoles")->isVisible());
  }

  void aRepairThatComesTooLateReplacesNothing() {
    Workbench bench;
    bench.open(brokenCube());
    bench.find<QPushButton>("repairHoles")->click();
    QVERIFY(bench.window.jobs().running());
    const auto other = generate({MeshKind::cloth, {4, 4, 1}, 1, {}});
    edits::replaceMesh(bench.document(), other, QStringLiteral("other"), QStringLiteral("build"));
    bench.settle();
    QCOMPARE(bench.document().mesh(), other);
    QCOMPARE(messages(bench).sentence(),
             QStringLiteral("broken.off: the object was changed while it was repaired. Start the repair again"));
  }

  void softnessThatIsSetDuringARepairStays() {
    Workbench bench;
    bench.open(brokenCube());
    const auto [from, to] = bench.document().mesh()->links.front();
    const LinkSoftness before = bench.document().softness(), own{0.5, 1.5, 0.3};
    QVERIFY(!(own == before));
    bench.find<QPushButton>("repairHoles")->click();
    QVERIFY(bench.window.jobs().running());
    edits::setSoftnessOf(bench.document(), {0}, own);
    bench.settle();
    QVERIFY(bench.document().wholeSoftness()->of(*find_link(*bench.document().mesh(), from, to)) == own);
  }

  void showSelectsOneDefectAfterAnother() {
    Workbench bench;
    bench.open(brokenCube());
    auto* show = bench.find<QPushButton>("repairShow");
    using Ids = std::vector<ElementId>;
    for (const auto& [ids, name] :
         {std::pair(Ids{8}, "duplicate vertices"), std::pair(Ids{9}, "loose points"),
          std::pair(Ids{4, 5, 6, 7}, "hole 1 of 1, 4 edges"), std::pair(Ids{1, 2}, "non-manifold edges"),
          std::pair(Ids{8}, "duplicate vertices")}) {
      show->click();
      QCOMPARE(bench.document().selection().elements(), ids);
      QCOMPARE(bench.find<QLabel>("repairShown")->text(), QStringLiteral("Selected: %1").arg(QLatin1String(name)));
    }
    bench.find<QPushButton>("repairLoose")->click();  // the bar forgets what it showed of the object before
    bench.settle();
    QVERIFY(!bench.find<QLabel>("repairShown")->isVisible() && bench.find<QLabel>("repairShown")->text().isEmpty());
    bench.trigger("undo");
    bench.settle();
    bench.find<QToolButton>("repairClose")->click();
    QVERIFY(!bench.find<QFrame>("repairBar")->isVisible());
    bench.open(sourceFile("meshes/sphere.obj"));
    bench.trigger("undo");
    bench.settle();
    QVERIFY(!bench.find<QFrame>("repairBar")->isVisible());  // it stays closed for this object
    bench.trigger("repairMesh");
    bench.settle();
    QVERIFY(bench.find<QFrame>("repairBar")->isVisible());
  }

  void aMeshWithoutDefectsIsSaidToHaveNone() {
    Workbench bench;
    bench.open(sourceFile("meshes/sphere.obj"));
    QVERIFY(!bench.find<QFrame>("repairBar")->isVisible());
    bench.trigger("repairMesh");
    bench.settle();
    QVERIFY(bench.find<QFrame>("repairBar")->isVisible());
    QCOMPARE(repairText(bench), QStringLiteral("sphere.obj has no defects to repair"));
  }

  void aSurfaceThatIsTooFineIsToldHowToGetCoarser() {
    Workbench bench;
    bench.open(sourceFile("meshes/sphere.obj"));
    bench.trigger("fillSurface");
    QCOMPARE(bench.find<QLabel>("fillAbout")->text(), QStringLiteral("Fill sphere.obj with tetrahedra"));
    bench.open(fineSphere(140, 250));  // 34,750 elements, more than linear FEM takes without any inside
    bench.trigger("fillSurface");
    const QString said = bench.find<QLabel>("fillAbout")->text();
    QVERIFY2(said.contains(QStringLiteral("The surface is too fine for linear FEM (at most 30,000 elements): make it "
                                          "coarser with 'chainmail simplify FILE --elements ")),
             qPrintable(said));
  }

 private:
  /// Writes a closed sphere, of 9,400 elements by default: so fine that linear FEM cannot take its volume.
  QString fineSphere(int rings = 72, int around = 132) const {
    QString path = folder_.filePath(QStringLiteral("fine.off"));
    QFile file(path);
    if (!file.open(QIODevice::WriteOnly)) {
      return {};
    }
    QTextStream out(&file);
    out << "OFF\n" << (rings - 1) * around + 2 << ' ' << 2 * (rings - 1) * around << " 0\n0 0 1\n0 0 -1\n";
    for (int ring = 1; ring < rings; ++ring) {
      for (int i = 0; i < around; ++i) {
        const double polar = M_PI * ring / rings, angle = 2 * M_PI * i / around;
        out << std::sin(polar) * std::cos(angle) << ' ' << std::sin(polar) * std::sin(angle) << ' ' << std::cos(polar)
            << '\n';
      }
    }
    const auto at = [around](int ring, int i) { return 2 + (ring - 1) * around + i % around; };
    for (int i = 0; i < around; ++i) {
      out << "3 0 " << at(1, i) << ' ' << at(1, i + 1) << '\n';
      out << "3 1 " << at(rings - 1, i + 1) << ' ' << at(rings - 1, i) << '\n';
      for (int ring = 1; ring + 1 < rings; ++ring) {
        out << "3 " << at(ring, i) << ' ' << at(ring + 1, i) << ' ' << at(ring + 1, i + 1) << '\n';
        out << "3 " << at(ring, i) << ' ' << at(ring + 1, i + 1) << ' ' << at(ring, i + 1) << '\n';
      }
    }
    return path;
  }
  /// Writes an open cube with a duplicate corner, a loose point, and a fin at one edge.
  QString brokenCube() const {
    QString path = folder_.filePath(QStringLiteral("broken.off"));
    QFile file(path);
    if (file.open(QIODevice::WriteOnly)) {
      file.write(
          "OFF\n11 11 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n0 0 2\n2 0 2\n2 2 2\n0 2 2\n0 0 0\n7 7 7\n3 3 0\n"
          "3 0 2 1\n3 8 3 2\n3 0 1 5\n3 8 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n3 1 2 10\n");
    }
    return path;
  }
  static QString repairText(Workbench& bench) {
    return bench.find<QLabel>("repairText")->text().replace(QChar::Nbsp, QLatin1Char(' '));
  }
  static MessageBar& messages(Workbench& bench) { return *bench.window.findChild<MessageBar*>(); }

  QTemporaryDir folder_;
};

CHAINMAIL_WINDOW_TEST(WindowOpen)

}  // namespace chainmail::window_open

#include "window_open.moc"
