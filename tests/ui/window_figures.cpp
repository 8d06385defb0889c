// Tests that all displays of an object say the same about it, that they belong to the object shown, and that no number
// is cut.

#include <QComboBox>
#include <QDialog>
#include <QDockWidget>
#include <QLabel>
#include <cmath>

#include "common/plot_widget.h"
#include "document/edits.h"
#include "drawing/colour_map.h"
#include "io/picture_actions.h"
#include "io/pictures.h"
#include "panels/legend.h"
#include "panels/panel_area.h"
#include "panels/panel_state.h"
#include "window.h"

namespace chainmail::window_figures {

namespace {

/// A grid with a pin, which sequential algorithms violate. The handle stays grabbed.
struct DragBench : Workbench {
  explicit DragBench(const MeshPointer& mesh = generate({MeshKind::grid, {24, 16, 1}, 1, {}})) : Workbench(mesh) {
    trigger("colourBy-violation");
    edits::setPinned(document(), {0}, true);
    document().handle().grab(mesh->element_count() - 1);
    settleFigures();
  }
  ~DragBench() { document().handle().release(); }

  void drag(const Point& by) {
    document().handle().drag(document().mesh()->rest_position(document().mesh()->element_count() - 1) + by);
    settleFigures();
  }
  const MeasuredViolation& violation(int panel) { return document().solvers().frame(panel)->statistics.violation; }
  ViolationLine& line(int panel) { return *window.findChild<ViolationLine*>(QStringLiteral("violation%1").arg(panel)); }
};

}  // namespace

class WindowFigures : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QSettings().clear();
  }

  /// During the drag as at rest: of all links, and the same figures in sentence and legend.
  void aDragAndItsEndAreMeasuredAlike() {
    DragBench bench;
    bench.drag({-30, -10, 0});
    QStringList during;
    for (int panel = 0; panel < 2; ++panel) {
      const MeasuredViolation& violation = bench.violation(panel);
      QVERIFY(violation.is_whole);
      QCOMPARE(violation.links, std::uint64_t{bench.document().mesh()->link_count()});
      during << bench.line(panel).sentence();
    }
    const double worst = std::max(bench.violation(0).max, bench.violation(1).max);
    QVERIFY(worst > 0.1);
    QCOMPARE(bench.window.area().legend().highest(), QLocale().toString(worst, 'g', 3));
    bench.document().handle().release();
    bench.settleFigures();
    QCOMPARE((QStringList{bench.line(0).sentence(), bench.line(1).sentence()}), during);
    QCOMPARE(bench.window.area().legend().highest(), QLocale().toString(worst, 'g', 3));
  }

  void whileDraggingNoDockChangesItsWidth() {
    DragBench bench;
    for (auto* dock : bench.window.findChildren<QDockWidget*>()) {
      dock->show();
    }
    bench.trigger("colourBy-violation");
    bench.settleFigures();
    const auto widths = [&] {
      std::vector<int> all;
      for (auto* dock : bench.window.findChildren<QDockWidget*>()) {
        all.push_back(dock->width());
      }
      return all;
    };
    const auto before = widths();
    for (const double far : {0.001, 0.4, 3.0, 30.0, 123'456.0}) {
      bench.drag({-far, -far / 3, 0});
      QCOMPARE(widths(), before);
    }
  }

  void inLectureModeEachPanelHasOneLargeNumber() {
    DragBench bench;
    bench.trigger("addPanel");
    bench.trigger("addPanel");
    bench.trigger("lectureMode");
    bench.window.showNormal();
    bench.window.resize(1280, 720);
    bench.settleFigures();
    for (const double far : {0.0, 0.5, 30.0}) {
      bench.drag({-far, 0, 0});
      for (int panel = 0; panel < 4; ++panel) {
        const auto* number = bench.line(panel).findChild<QLabel*>(QStringLiteral("number"));
        QVERIFY(number->isVisible() && number->fontInfo().pixelSize() >= 48);
        QVERIFY(number->fontMetrics().horizontalAdvance(number->text()) <= number->width());
        QVERIFY(bench.window.panel(panel).rect().contains(bench.line(panel).geometry()));
      }
      QCOMPARE(bench.line(0).findChild<QLabel*>(QStringLiteral("number"))->width(),
               bench.line(3).findChild<QLabel*>(QStringLiteral("number"))->width());
    }
    bench.trigger("lectureMode");
    bench.settle();
    QVERIFY(!bench.line(0).findChild<QLabel*>(QStringLiteral("number"))->isVisible());
  }

  /// Before the solvers have the new object, nothing is left of the one before.
  void whatIsShownBelongsToTheObjectShown() {
    DragBench bench;
    bench.drag({-30, -10, 0});
    auto* median = bench.find<QLabel>("median0");
    QTRY_VERIFY(median->text() != QStringLiteral("–"));
    bench.document().handle().release();
    bench.settleFigures();
    QVERIFY(!bench.find<QLabel>("state0")->text().isEmpty());
    edits::replaceMesh(bench.document(), generate({MeshKind::grid, {5, 4, 1}, 1, {}}), QStringLiteral("other"),
                       QStringLiteral("build"));
    QVERIFY(bench.document().solvers().frame(0) == nullptr);
    QCOMPARE(bench.line(0).sentence(), QStringLiteral("No figures yet"));
    QCOMPARE(bench.find<QLabel>("state0")->text(), QString());
    QVERIFY(bench.window.panel(0).findChild<StateChips*>()->states().isEmpty());
    QCOMPARE(median->text(), QStringLiteral("–"));
    for (const report::PlotCurve& curve : bench.find<PlotWidget>("ratePlot")->plot().panels.front().curves) {
      QVERIFY(curve.points.empty());
    }
    bench.settleFigures();
    QCOMPARE(bench.line(0).sentence(), QStringLiteral("Nothing has moved yet"));
    QCOMPARE(median->text(), QStringLiteral("–"));
  }

  /// Every quantity of the table keeps within its range, and so does its legend.
  void everyColourHasADefinitionAndARange() {
    DragBench bench(generate({MeshKind::tetra, {6, 4, 3}, 1, {}}));
    bench.drag({40, 9, 5});  // links become more than twice as long
    for (const ColourModeInfo& mode : colourModes()) {
      QVERIFY(!mode.definition.empty());
      QVERIFY(mode.least <= mode.centre || !isDiverging(mode.mode));
      bench.trigger(QByteArray("colourBy-").append(mode.name.data()));
      bench.settleFigures();
      QCOMPARE(bench.window.colouring().mode(), mode.mode);
      for (const char* range : {"colourRange-automatic", "colourRange-logarithmic"}) {
        if (bench.find<QAction>(range)->isEnabled()) {
          bench.trigger(range);
          bench.settleFigures();
        }
        const ColourValues* values = bench.window.colouring().follow(1);
        if (values == nullptr) {
          QVERIFY(mode.mode == ColourMode::plain || mode.mode == ColourMode::physicsError);
          continue;
        }
        const ColourScale scale = bench.window.colouring().scale(1);
        QVERIFY2(scale.lowest >= mode.least && scale.highest <= mode.most, mode.name.data());
        for (const float value : values->values) {
          QVERIFY2(value >= mode.least && value <= mode.most, mode.name.data());
        }
        // In space, each corner of a face shows the one of its links that is furthest from rest.
        for (std::size_t link = 0; values->ofLinks && link < values->values.size(); ++link) {
          for (const ElementId end : values->mesh->links[link]) {
            QVERIFY(std::abs(values->atElements[end] - mode.centre) >= std::abs(values->values[link] - mode.centre));
          }
        }
      }
    }
  }

  /// Lengths above 2: the length 0 is the lower end, and 1 stays in the middle of the map.
  void lengthsAreNotNegative() {
    DragBench bench;
    bench.trigger("colourBy-length");
    bench.drag({40, 9, 0});
    const ColourScale scale = bench.window.colouring().scale(0);
    QVERIFY(scale.highest > 2);
    QCOMPARE(scale.lowest, 0.0F);
    QCOMPARE(colour_map::shareOf(1, scale), 0.5);
    QCOMPARE(colour_map::shareOf(0, scale), 0.0);
    QCOMPARE(colour_map::shareOf(0.5F, scale), 0.25);
    QCOMPARE(colour_map::shareOf(scale.highest, scale), 1.0);
    QCOMPARE(bench.window.area().legend().lowest(), QStringLiteral("0"));
  }

  void aWindowBeginsWithTheViolation() {
    MainWindow window(generate({MeshKind::grid, {5, 4, 1}, 1, {}}), QStringLiteral("own.dat"));
    QCOMPARE(window.colouring().mode(), ColourMode::violation);
  }

  /// The legend that the panels share is in a figure once, that of a single panel also.
  void aFigureHasItsLegendOnce() {
    DragBench bench;
    bench.drag({-30, -10, 0});
    const QTemporaryDir folder;
    const auto textOf = [&](const Drawing& drawing) {
      const QString path = folder.filePath(QStringLiteral("figure.svg"));
      writeDrawing(path, drawing);
      QFile file(path);
      return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
    };
    const auto legendsIn = [&](const Drawing& drawing) { return textOf(drawing).count("Violation, live"); };
    QCOMPARE(legendsIn(drawingOf(bench.window.area(), false)), qsizetype{1});
    QCOMPARE(legendsIn(drawingOf(bench.window.panel(0), false)), qsizetype{1});
    bench.trigger("linkColours");
    bench.settleFigures();
    QCOMPARE(legendsIn(drawingOf(bench.window.area(), false)), qsizetype{2});  // two scales
    bench.trigger("linkColours");
    bench.trigger("colourBy-length");  // of which 1 is neutral
    bench.settleFigures();
    const QByteArray lengths = textOf(drawingOf(bench.window.area(), false));
    QVERIFY(lengths.contains("1 ± ") && !lengths.contains("within ±"));
  }

  void aChosenSizeOfPicturesIsRememberedWithinItsLimits() {
    const QString key = QStringLiteral("picture/tested");
    for (const PictureSize& size : {PictureSize{}, PictureSize{1'000, false, 96}, PictureSize{85, true, 600}}) {
      size.remember(key);
      QCOMPARE(PictureSize::remembered(key), size);
    }
    PictureSize{1e6, false, 96}.remember(key);
    QCOMPARE(PictureSize::remembered(key).width, 12'000.0);
    PictureSize{1, true, 96}.remember(key);
    QCOMPARE(PictureSize::remembered(key).width, 10.0);
  }

  /// An ampersand marks the key of another widget; without one it would be visible.
  void noLabelShowsAnAmpersand() {
    Workbench bench;
    const PictureSizeDialog size(&bench.window, QStringLiteral("Size of the picture"), {}, {640, 480});
    const QList<QLabel*> labels = bench.window.findChildren<QLabel*>();  // the dialog is among them
    for (const QLabel* label : labels) {
      QVERIFY2(
          !label->text().contains(QLatin1Char('&')) || label->buddy() != nullptr || label->textFormat() == Qt::RichText,
          qPrintable(label->text()));
    }
  }

  void statesThatAreWiderThanTheViewHaveMoreLines() {
    Workbench bench;
    auto* chips = bench.window.panel(0).findChild<StateChips*>();
    chips->setStates({QStringLiteral("30 pinned elements of this object ").repeated(20)});
    QVERIFY(chips->height() >= 2 * chips->fontMetrics().height());
  }
};

CHAINMAIL_WINDOW_TEST(WindowFigures)

}  // namespace chainmail::window_figures

#include "window_figures.moc"
