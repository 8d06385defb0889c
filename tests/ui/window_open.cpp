// Tests files of users in a real window: the texts about them, voxel volumes, and filled surfaces.

#include <sys/stat.h>

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QTextStream>
#include <QToolButton>
#include <cmath>

#include "document/edits.h"
#include "folders.h"
#include "io/file_actions.h"
#include "io/volume_bar.h"
#include "io/volumes.h"
#include "window.h"
#include "window/message_bar.h"

namespace chainmail::window_open {

class WindowOpen : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void whatIsOpenedIsToldWithItsFlaws() {
    Workbench bench;
    const QString path = folder_.filePath(QStringLiteral("flawed.off"));
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("OFF\n5 4 0\n0 0 0\n2 0 0\n0 1 0\n9 9 9\n9 9 8\n3 0 1 2\n3 2 1 0\n3 0 3 3\n3 0 3 4\n");
    file.close();
    bench.open(path);
    QCOMPARE(
        messages(bench).sentence(),
        QStringLiteral("flawed.off: 5 elements, 6 links, 2 triangles, 1 part, 9 × 9 × 9 units. 1 face or cell with "
                       "a point used twice or fewer than 3, 1 duplicate face or cell left out"));
    QCOMPARE(messages(bench).severity(), Severity::info);
  }

  void aFileOfAnotherProgramThatIsDamagedLosesNothing() {
    Workbench bench;
    const MeshPointer before = bench.document().mesh();
    const QString path = folder_.filePath(QStringLiteral("damaged.msh"));
    QFile whole(sourceFile("tests/files/foreign/gmsh41_binary.msh")), file(path);
    QVERIFY(whole.open(QIODevice::ReadOnly) && file.open(QIODevice::WriteOnly));
    file.write(whole.read(4000));
    file.close();
    bench.open(path);
    QVERIFY2(messages(bench).sentence().startsWith(path), qPrintable(messages(bench).sentence()));
    QCOMPARE(bench.document().mesh(), before);
  }

  void aScriptThatIsNamedAsAMeshIsNotRun() {
    Workbench bench;
    const MeshPointer before = bench.document().mesh();
    const QString path = folder_.filePath(QStringLiteral("script.msh")),
                  trace = folder_.filePath(QStringLiteral("trace"));
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("SystemCall \"touch " + trace.toUtf8() + "\";\n");
    file.close();
    bench.open(path);
    const QString sentence = messages(bench).sentence();
    QVERIFY2(sentence.startsWith(path + ": it does not begin as a Gmsh mesh"), qPrintable(sentence));
    QVERIFY(!QFile::exists(trace));
    QCOMPARE(bench.document().mesh(), before);
  }

  void aPipeIsRefusedAndTheNextFileOpens() {
    Workbench bench;
    for (const char* name : {"pipe.obj", "pipe.png", "pipe.chainmail"}) {
      const QString path = folder_.filePath(QLatin1String(name));
      QCOMPARE(mkfifo(qPrintable(path), 0600), 0);
      bench.open(path);
      QCOMPARE(messages(bench).sentence(),
               path + QStringLiteral(": it is a pipe; save its content as a file, and use that"));
    }
    bench.open(sourceFile("meshes/sphere.obj"));
    QCOMPARE(bench.document().name(), QStringLiteral("sphere.obj"));
  }

  void coordinatesBeyondSinglePrecisionAreRefused() {
    Workbench bench;
    const auto before = bench.document().mesh();
    const QString path = folder_.filePath(QStringLiteral("far.obj"));
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("v 0 0 0\nv 1e60 0 0\nv 0 1e60 0\nf 1 2 3\n");
    file.close();
    bench.open(path);
    QVERIFY2(bench.window.messages().sentence().contains(QStringLiteral("scale the object down")),
             qPrintable(bench.window.messages().sentence()));
    QCOMPARE(bench.document().mesh(), before);
  }

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

  void nothingDenseEnoughIsNoAnswer() {
    Workbench bench;
    bench.open(sourceFile("tests/files/foreign/vtk.mha"));
    auto* every = bench.find<QSpinBox>("volumeEvery");
    every->setValue(2);
    QCOMPARE(bench.find<QLabel>("volumeResult")->text(), QStringLiteral("24 voxels, about 3 elements"));
    bench.find<QCheckBox>("volumeStiff")->setChecked(false);
    QVERIFY(bench.find<QPushButton>("volumeAgree")->isEnabled());
    bench.find<QPushButton>("volumeCancel")->click();
    QVERIFY(!bench.window.findChild<FileActions*>()->volumes().bar().isVisible());
  }

  /// One voxel per element is a choice as any other: a large volume then keeps all its voxels.
  void theChosenNumberOfVoxelsPerElementCounts() {
    Workbench bench;
    bench.open(sourceFile("tests/files/foreign/vtk.mha"));
    const auto& bar = bench.window.findChild<FileActions*>()->volumes().bar();
    auto* every = bench.find<QSpinBox>("volumeEvery");
    QCOMPARE(every->text(), QStringLiteral("auto"));
    QVERIFY(!bar.options().every);
    for (const int voxels : {1, 2}) {
      every->setValue(voxels);
      QVERIFY(bar.options().every == std::uint32_t(voxels));
    }
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

  void aRepairKeepsTheSoftnessOfLinksInTheSolvers() {
    Workbench bench;
    bench.open(brokenCube());
    const LinkId link = *find_link(*bench.document().mesh(), 0, 1);
    edits::setSoftnessOf(bench.document(), {link}, LinkSoftness{1, 1, 0});
    bench.find<QPushButton>("repairLoose")->click();
    bench.settle();
    QVERIFY(bench.document().wholeSoftness()->links.contains(link));
    QCOMPARE(*bench.document().moves().history().object().softness,
             *bench.document().wholeSoftness());  // what the solvers got
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

  void anObjectWithoutDefectsHasABarOnlyWhenAsked() {
    Workbench bench;
    bench.open(brokenCube());
    bench.open(sourceFile("meshes/sphere.obj"));
    const auto* bar = bench.find<QFrame>("repairBar");
    QVERIFY(!bar->isVisible());
    bench.trigger("repairMesh");
    bench.settle();
    QVERIFY(bar->isVisible());
    QCOMPARE(repairText(bench), QStringLiteral("sphere.obj has no defects to repair"));
    for (const char* name : {"repairShow", "repairLoose", "repairHoles"}) {
      QVERIFY(!bench.find<QPushButton>(name)->isVisible());
    }
    const MeshPointer cloth = generate({MeshKind::cloth, {20, 20, 1}, 1, {}});
    edits::replaceMesh(bench.document(), cloth, QStringLiteral("cloth"), QStringLiteral("build"));
    QVERIFY(!bar->isVisible());
    bench.trigger("repairMesh");
    bench.settle();
    QVERIFY(repairText(bench).contains(QStringLiteral("outline of an open surface")));
  }

  void verticesWithinADistanceAreWelded() {
    Workbench bench;
    const MeshPointer cloth = generate({MeshKind::cloth, {4, 1, 1}, 1, {}});
    edits::replaceMesh(bench.document(), cloth, QStringLiteral("cloth"), QStringLiteral("build"));
    bench.trigger("repairMesh");
    bench.settle();
    auto* weld = bench.find<QPushButton>("repairWeld");
    auto* distance = bench.find<QLineEdit>("repairDistance");
    distance->setText(QStringLiteral("1e"));
    QVERIFY(!weld->isEnabled());
    distance->setText(QStringLiteral("0.5"));
    weld->click();
    bench.settle();
    QCOMPARE(bench.document().mesh(), cloth);
    QCOMPARE(messages(bench).sentence(),
             QStringLiteral("cloth: no two of its vertices are as close as 0.5; choose a larger distance"));
    distance->setText(QStringLiteral("1.2"));
    QTest::keyClick(distance, Qt::Key_Return);
    bench.settle();
    QCOMPARE(bench.document().mesh()->element_count(), std::size_t{2});
    QCOMPARE(bench.document().undoStack().undoText(), QStringLiteral("weld 2 duplicate vertices"));
  }

  void theFillOfferedSuitsLinearFem() {
    Workbench bench;
    bench.open(sourceFile("meshes/sphere.obj"));
    const double mean = bench.document().mesh()->mean_link_length;
    bench.trigger("fillSurface");
    QVERIFY(std::abs(bench.find<QDoubleSpinBox>("fillSize")->value() - mean) < 0.01 * mean);
    QVERIFY(!bench.find<QLabel>("fillAbout")->text().contains(QStringLiteral("coarser")));
    bench.open(fineSphere());
    bench.trigger("fillSurface");
    auto* size = bench.find<QDoubleSpinBox>("fillSize");
    QVERIFY(size->value() > 1.1 * bench.document().mesh()->mean_link_length);
    QVERIFY(bench.find<QLabel>("fillAbout")->text().contains(QStringLiteral("coarser")));
    const auto* limits = bench.find<QLabel>("fillDetails");
    QCOMPARE(limits->text(), QStringLiteral("Few enough for Linear FEM, Quasi-Newton FEM (30,000), ARAP, XPBD, "
                                            "Projective Dynamics, Neo-Hookean XPBD (100,000). Too many for "
                                            "BEM (5,000), Neo-Hookean FEM, Corotational FEM (6,000)"));
    size->setValue(bench.document().mesh()->mean_link_length);
    QVERIFY2(limits->text().endsWith(QStringLiteral("Corotational FEM (6,000), Linear FEM, Quasi-Newton FEM (30,000)")),
             qPrintable(limits->text()));
    QVERIFY(bench.find<QPushButton>("fillAgree")->isEnabled());
  }

  void aRefusedLengthSaysWhyAndWhatToDo() {
    Workbench bench;
    bench.open(fineSphere(240, 440));
    bench.trigger("fillSurface");
    auto* size = bench.find<QDoubleSpinBox>("fillSize");
    size->setValue(size->minimum());
    QVERIFY(!bench.find<QPushButton>("fillAgree")->isEnabled());
    QCOMPARE(bench.find<QLabel>("fillDetails")->text(),
             QStringLiteral("More than 2,000,000 elements would take minutes and could not be dragged: choose longer "
                            "edges"));
    size->setValue(size->maximum());
    QVERIFY(bench.find<QPushButton>("fillAgree")->isEnabled());
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

  void anOpenSurfaceSaysWhereItIsOpen() {
    Workbench bench;
    const QString path = folder_.filePath(QStringLiteral("open.off"));
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("OFF\n4 3 0\n0 0 0\n2 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n");
    file.close();
    bench.open(path);
    const MeshPointer before = bench.document().mesh();
    bench.trigger("fillSurface");
    bench.find<QPushButton>("fillAgree")->click();
    bench.settle();
    QVERIFY2(messages(bench).sentence().contains(
                 QStringLiteral("the surface is open: it has 1 hole, the first at element 0")),
             qPrintable(messages(bench).sentence()));
    QCOMPARE(bench.document().mesh(), before);
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
