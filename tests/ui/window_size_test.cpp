// Tests the size test in a real window.

#include <QClipboard>
#include <QDoubleSpinBox>
#include <QFile>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>

#include "common/plot_widget.h"
#include "docks/size_test/size_test_dock.h"
#include "docks/size_test/size_test_view.h"
#include "fair_timer.h"
#include "report/page/format.h"
#include "window.h"
#include "window/message_bar.h"

namespace chainmail::window_size_test {

namespace {

struct SizeBench : Workbench {
  SizeBench() : Workbench(generate({MeshKind::grid, {9, 7, 1}, 1, {}})) {
    trigger("showSizeTest");
    settle();
    find<QSpinBox>("sizeTestFirst")->setValue(4);
    find<QSpinBox>("sizeTestLargest")->setValue(64);
    find<QSpinBox>("sizeTestDrags")->setValue(1);
    budget(1000);
  }

  SizeTestDock& dock() { return *window.findChild<SizeTestDock*>(); }
  QTableWidget& table() { return *find<QTableWidget>("sizeTestTable"); }
  QWidget* stage() { return find<QWidget>("sizeTestStage"); }
  QString verdicts() { return find<QLabel>("sizeTestVerdicts")->text(); }
  QString cell(int row, int column) { return table().item(row, column)->text(); }
  void budget(double ms) { find<QDoubleSpinBox>("sizeTestBudget")->setValue(ms); }
  void begin() { QTest::mouseClick(find<QPushButton>("sizeTestRun"), Qt::LeftButton); }
  void end() { QTRY_VERIFY_WITH_TIMEOUT(!dock().running(), 60'000); }
};

constexpr int contestants = 2;
constexpr int columnsOfAPanel = 4;

}  // namespace

class WindowSizeTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QSettings().clear();
  }

  void sizes() {
    SizeTestOptions options;
    options.first = 16;
    options.largest = 2500;
    QCOMPARE(widthsOf(options), (std::vector<std::uint32_t>{16, 23, 33, 47}));
    options.growth = 0;  // the sizes of the ramp on the command line
    for (std::size_t i = 1; i < widthsOf(options).size(); ++i) {
      QCOMPARE(widthsOf(options)[i], report::next_width(widthsOf(options)[i - 1]));
    }
    options.first = 100;
    QVERIFY(widthsOf(options).empty());
  }

  void aTableThatIsStillEmptyFollowsThePanels() {
    SizeBench bench;
    QVERIFY(!bench.verdicts().contains(QStringLiteral("<b>C: ")));
    bench.trigger("addPanel");
    bench.choose(2, "Spiral");
    QTRY_VERIFY(bench.verdicts().contains(QStringLiteral("C: Spiral</b>")));
    QCOMPARE(bench.table().columnCount(), 2 + 3 * columnsOfAPanel);
  }

  void aTableThatIsStillEmptyFollowsTheAlgorithms() {
    SizeBench bench;
    QVERIFY(bench.dock().isVisible());
    const QString before = bench.verdicts();
    QVERIFY(before.contains(QStringLiteral("B: ")) && !before.contains(QStringLiteral("B: Spiral</b>")));
    bench.choose(1, "Spiral");
    QVERIFY2(bench.verdicts().contains(QStringLiteral("B: Spiral</b>")), qPrintable(bench.verdicts()));
    QCOMPARE(bench.table().columnCount(), 2 + contestants * columnsOfAPanel);
    bench.choose(0, "Free-form deformation");  // takes no part
    QVERIFY2(!bench.verdicts().contains(QStringLiteral("A: ")), qPrintable(bench.verdicts()));
    QVERIFY(bench.find<QPushButton>("sizeTestRun")->isEnabled());
    bench.choose(1, "Free-form deformation");
    QVERIFY(!bench.find<QPushButton>("sizeTestRun")->isEnabled());
  }

  void aTestFillsTheTableAndTheOwnObjectIsBackAsItWas() {
    SizeBench bench;
    const QPoint from = bench.place(0, 31);
    bench.stroke(0, {from, from + QPoint(60, -40)});
    const MeshPointer mesh = bench.document().mesh();
    const int steps = bench.document().undoStack().count();
    std::vector<Point> before;
    for (ElementId i = 0; i < mesh->element_count(); ++i) {
      before.push_back(bench.position(0, i));
      before.push_back(bench.position(1, i));
    }
    bench.begin();
    QVERIFY(bench.stage()->isVisible() && !bench.view(0).isVisible());
    QTRY_VERIFY_WITH_TIMEOUT(bench.table().rowCount() == 1, 30'000);  // the table grows during the test
    QVERIFY(bench.dock().running());
    QVERIFY(bench.verdicts().contains(QStringLiteral("so far")));
    bench.end();

    // 4, 6 and 8 elements per side, all in real time, because the limit is a second.
    QCOMPARE(bench.table().rowCount(), 3);
    QCOMPARE(bench.table().columnCount(), 2 + contestants * columnsOfAPanel);
    QCOMPARE(bench.cell(2, 0), QStringLiteral("8×8"));
    QCOMPARE(bench.cell(2, 1), QStringLiteral("64"));
    for (int row = 0; row < 3; ++row) {
      for (int panel = 0; panel < contestants; ++panel) {
        const int column = 2 + panel * columnsOfAPanel;
        QVERIFY(bench.cell(row, column).toDouble() > 0);
        QVERIFY(bench.cell(row, column + 1).toDouble() >= bench.cell(row, column).toDouble());
        QVERIFY(bench.cell(row, column + 2).toInt() > 0);
        QCOMPARE(bench.cell(row, column + 3), QStringLiteral("yes"));
      }
    }
    QVERIFY(bench.verdicts().contains(QStringLiteral("real time up to 8×8, 64 elements or more")));
    checkThePlotShowsTheTable(bench);

    QVERIFY(bench.view(0).isVisible() && bench.view(1).isVisible());
    QCOMPARE(bench.document().mesh(), mesh);
    QCOMPARE(bench.document().undoStack().count(), steps);
    for (ElementId i = 0; i < mesh->element_count(); ++i) {
      QCOMPARE(bench.position(0, i), before[2 * i]);
      QCOMPARE(bench.position(1, i), before[2 * i + 1]);
    }
    QTRY_VERIFY(bench.stage() == nullptr);  // nothing of the test is left
    checkTheTableLeavesTheWindow(bench);
  }

  void whoMissesTheBudgetTwiceIsOut() {
    SizeBench bench;
    // Too short for a pass of any panel: in 1 µs, a pass moves about 100 elements.
    bench.budget(0.001);
    bench.find<QSpinBox>("sizeTestFirst")->setValue(60);
    bench.find<QSpinBox>("sizeTestLargest")->setValue(1'000'000);
    bench.begin();
    bench.end();
    QCOMPARE(bench.table().rowCount(), 1);
    for (int panel = 0; panel < contestants; ++panel) {
      const int column = 2 + panel * columnsOfAPanel;
      QCOMPARE(bench.cell(0, column + 3), QStringLiteral("no"));
      // The tool tip says that these are separate drags.
      QVERIFY(!bench.table().item(0, column + 1)->toolTip().isEmpty());
    }
    QCOMPARE(bench.verdicts().count(QStringLiteral("never in real time")), contestants);
    QCOMPARE(bench.find<PlotWidget>("sizeTestPlot")->plot().good_below, 0.001);  // ms: the chosen limit
  }

  void cancellingBringsThePanelsBackAtOnce() {
    SizeBench bench;
    bench.find<QSpinBox>("sizeTestFirst")->setValue(300);
    bench.find<QSpinBox>("sizeTestLargest")->setValue(1'000'000);
    bench.begin();
    QTRY_VERIFY(bench.find<QProgressBar>("sizeTestProgress")->format().contains(QStringLiteral("300×300")));
    QTRY_VERIFY(bench.stage() != nullptr && bench.stage()->isVisible());
    const test::FairTimer timer;
    QTest::keyClick(&bench.window, Qt::Key_Escape);
    QVERIFY(!bench.dock().running());
    QVERIFY(bench.view(0).isVisible());
    QVERIFY2(timer.within(1000), qPrintable(timer.inWords()));
    QTRY_VERIFY_WITH_TIMEOUT(bench.stage() == nullptr, 10'000);
    bench.settle();
    bench.begin();  // a second test can start
    QVERIFY(bench.dock().running());
    QTest::mouseClick(bench.find<QPushButton>("sizeTestCancel"), Qt::LeftButton);
    QVERIFY(!bench.dock().running());
    bench.begin();
    bench.dock().close();
    QVERIFY(!bench.dock().running());
    QVERIFY(bench.view(0).isVisible());
    bench.dock().show();
    bench.begin();
    QTRY_VERIFY(bench.stage() != nullptr && bench.stage()->isVisible());
    QVERIFY(bench.dock().running());  // the window closes during the test
  }

  void aViewThatCannotDrawEndsTheTestWithASentence() {
    SizeBench bench;
    bench.find<QSpinBox>("sizeTestFirst")->setValue(300);
    bench.find<QSpinBox>("sizeTestLargest")->setValue(1'000'000);
    bench.begin();
    QTRY_VERIFY(bench.stage() != nullptr && bench.stage()->isVisible());
    const QString sentence = QStringLiteral("the view cannot draw");
    emit bench.find<SizeTestView>("sizeTestView0")->failed(sentence);
    QVERIFY(!bench.dock().running());
    QVERIFY(bench.view(0).isVisible());
    QVERIFY2(bench.window.messages().sentence().contains(sentence), qPrintable(bench.window.messages().sentence()));
  }

  void nothingElseActsMeanwhile() {
    SizeBench bench;
    bench.find<QDoubleSpinBox>("stretchSpin")->setValue(1.5);
    QVERIFY(bench.document().undoStack().canUndo());
    const bool unpin = bench.find<QAction>("unpinAll")->isEnabled();
    bench.begin();
    QVERIFY(!bench.find<QDoubleSpinBox>("stretchSpin")->isEnabled());
    QVERIFY(!bench.find<QAction>("resetObject")->isEnabled());
    QTest::keyClick(&bench.window, Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(bench.document().softness().stretch, 1.5);
    QVERIFY(bench.find<QAction>("quit")->isEnabled());
    QTest::keyClick(&bench.window, Qt::Key_Escape);
    QVERIFY(bench.find<QDoubleSpinBox>("stretchSpin")->isEnabled());
    QVERIFY(bench.find<QAction>("resetObject")->isEnabled());
    QCOMPARE(bench.find<QAction>("unpinAll")->isEnabled(), unpin);
    QTest::keyClick(&bench.window, Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(bench.document().softness(), LinkSoftness());
  }

 private:
  static void checkThePlotShowsTheTable(SizeBench& bench) {
    auto* widget = bench.find<PlotWidget>("sizeTestPlot");
    const report::PlotPanel& panel = widget->plot().panels.front();
    QCOMPARE(panel.curves.size(), std::size_t{contestants});
    QCOMPARE(panel.marks.size(), std::size_t{3 * contestants});
    const report::PlotMark& last = panel.marks.back();  // of panel B
    QCOMPARE(last.x, 64.0);
    QCOMPARE(QString::fromStdString(report::figure(last.y)), bench.cell(2, 2 + columnsOfAPanel + 1));
    const QString reading = widget->readingAt(widget->positionOf(last.x, last.y));
    QVERIFY2(reading.contains(QStringLiteral("8×8")), qPrintable(reading));
  }
  static void checkTheTableLeavesTheWindow(SizeBench& bench) {
    bench.table().setFocus();
    QTest::keyClick(&bench.table(), Qt::Key_C, Qt::ControlModifier);
    const QStringList lines = QApplication::clipboard()->text().split(QLatin1Char('\n'), Qt::SkipEmptyParts);
    QCOMPARE(lines.size(), 4);
    QCOMPARE(lines.last().count(QLatin1Char('\t')), bench.table().columnCount() - 1);
    const QTemporaryDir folder;
    bench.dock().saveTablePath(folder.filePath(QStringLiteral("sizes.csv")));
    QFile file(folder.filePath(QStringLiteral("sizes.csv")));
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QList<QByteArray> rows = file.readAll().trimmed().split('\n');
    QCOMPARE(rows.size(), 1 + 3 * contestants);
    QVERIFY(rows[1].startsWith("4,16,24,A,generalized,30,"));  // 30 moves, without the warm-up drag
    for (const QByteArray& row : rows) {
      QCOMPARE(row.count(','), rows[0].count(','));
    }
    bench.dock().saveTablePath(folder.filePath(QStringLiteral("missing/sizes.csv")));
    QVERIFY(bench.window.messages().sentence().contains(QStringLiteral("missing")));
  }
};

CHAINMAIL_WINDOW_TEST(WindowSizeTest)

}  // namespace chainmail::window_size_test

#include "window_size_test.moc"
