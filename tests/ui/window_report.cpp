// Tests the contents of the Report dock and its files in a real window.

#include <QDir>
#include <QHeaderView>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QScrollBar>
#include <QSplitter>
#include <set>

#include "document/edits.h"
#include "report_bench.h"
#include "safe_bench.h"

namespace chainmail::window_report {

class WindowReport : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QSettings().clear();
  }

  void itOpensAsAWindowAndRunsAtOnce() {
    Workbench bench;
    bench.window.resize(1280, 800);
    bench.settle();
    auto* dock = bench.find<ReportDock>("reportDock");
    QVERIFY(!dock->isVisible());
    const int view = bench.view(0).height();
    bench.find<QDoubleSpinBox>("reportSeconds")->setValue(0.1);
    QTest::keyClick(&bench.window, Qt::Key_E);
    QTRY_VERIFY(dock->isVisible());
    QVERIFY(dock->isFloating());
    QVERIFY(bench.window.findChild<ReportThread*>()->running());
    QVERIFY(bench.find<QPushButton>("reportCancel")->isEnabled());
    QTRY_VERIFY_WITH_TIMEOUT(!bench.window.findChild<ReportThread*>()->running(), 60'000);
    auto* table = bench.find<ReportTable>("reportTable");
    QTRY_VERIFY(table->isVisible() && table->rowCount() > 0);
    bench.settle();
    QVERIFY(!table->horizontalScrollBar()->isVisible());
    QVERIFY(table->viewport()->width() >= table->horizontalHeader()->length());
    QVERIFY(dock->screen()->availableGeometry().contains(dock->geometry()));
    QCOMPARE(bench.view(0).height(), view);
    QCOMPARE(bench.window.size(), QSize(1280, 800));
  }

  void itRunsByItselfOnlyWhileItIsEmpty() {
    ReportBench bench;
    auto* dock = bench.find<ReportDock>("reportDock");
    QVERIFY(bench.find<QLabel>("reportEmpty")->isVisible());  // cancelled
    bench.run();
    bench.trigger("showReport");
    QTRY_VERIFY(!dock->isVisible());
    bench.trigger("showReport");
    QVERIFY(dock->isVisible());
    QVERIFY(!bench.thread().running());
    QVERIFY(bench.results().isVisible());
  }

  void aRunFillsPlotAndTable() {
    ReportBench bench;
    bench.run();
    QCOMPARE(bench.find<QComboBox>("reportDrag")->count(), 3);
    for (int drag = 0; drag < 3; ++drag) {
      bench.choose("reportDrag", drag);
      QCOMPARE(bench.table().rowCount(), 12);  // six algorithms, with and without sweeps
      QCOMPARE(bench.marks().size(), std::size_t{12});
      for (int row = 0; row < bench.table().rowCount(); ++row) {
        QVERIFY(bench.table().item(row, msColumn)->text().toDouble() > 0);
      }
    }
    const std::vector<std::string>& notes = bench.plot().plot().legend_notes;
    QVERIFY(std::ranges::find(notes, std::string("filled: no sweeps")) != notes.end());
    QVERIFY(bench.find<QLabel>("reportTimesNote")->isVisible());
    QVERIFY(!bench.find<QLabel>("reportRefusals")->isVisible());
  }

  void theTableIsBesideThePlotOnlyWhereBothHaveRoom() {
    ReportBench bench;
    bench.choose("reportSweeps", 0);
    bench.run();
    const auto* split = bench.find<QSplitter>("reportSplitter");
    const int table = bench.results().tableWidth();
    QVERIFY(table > 300);
    bench.results().resize(4 * table, 300);
    QCOMPARE(split->orientation(), Qt::Horizontal);
    bench.results().resize(table + 50, 100);  // beside the table, the plot would have 50 pixels
    QCOMPARE(split->orientation(), Qt::Vertical);
    bench.results().resize(4 * table, 4 * table);  // both have their full width below each other
    QCOMPARE(split->orientation(), Qt::Vertical);
  }

  void aLongNameDoesNotWidenTheDock() {
    ReportBench bench;
    edits::replaceMesh(bench.document(), generate({MeshKind::grid, {9, 7, 1}, 1, {}}), QString(400, QLatin1Char('x')),
                       {});
    bench.settle();
    bench.choose("reportSweeps", 0);
    bench.run();
    const auto* heading = bench.find<QLabel>("reportHeading");
    QVERIFY(heading->text().startsWith(bench.document().name()));
    const int words = heading->fontMetrics().horizontalAdvance(heading->text());
    QVERIFY(bench.results().minimumSizeHint().width() < words / 2);
  }

  void errorsOfZeroStandOnALineOfTheirOwn() {
    ReportBench bench;
    bench.choose("reportPrecision", 1);
    bench.choose("reportSweeps", 0);
    bench.choose("reportError", 2);
    bench.run();
    QCOMPARE(bench.cell(QStringLiteral("Exact"), exactColumn), QStringLiteral("0"));
    const report::PlotAxes axes(bench.plot().plot());
    QVERIFY(axes.y.has_zero());
    const double zero = bench.plot().positionOf(1, 0).y();
    int above = 0;
    for (const report::PlotMark& one : bench.marks()) {
      // Errors from rounding count as 0, as in the report's files.
      const QString name = QString::fromStdString(bench.plot().plot().series[one.series].label);
      const bool isZero = bench.cell(name, exactColumn).toDouble() < 1e-12;
      QCOMPARE(bench.plot().positionOf(one.x, one.y).y() == zero, isZero);
      above += isZero ? 0 : 1;
    }
    QVERIFY(above > 0);  // Generalized has another result
    bench.choose("reportError", 0);
    QCOMPARE(bench.marks().size(), std::size_t{6});
  }

  void pointingAtAMarkReadsIt() {
    ReportBench bench;
    bench.choose("reportSweeps", 0);
    QVERIFY(bench.plot().readingAt({10, 10}).isEmpty());  // before the first run
    bench.run();
    for (const report::PlotMark& one : bench.marks()) {
      const QPointF there = bench.plot().positionOf(one.x, one.y);
      QVERIFY(bench.plot().rect().contains(there.toPoint()));
      const QString reading = bench.plot().readingAt(there);
      // Another mark may have the same position.
      QVERIFY2(std::ranges::any_of(bench.marks(),
                                   [&](const auto& mark) { return QString::fromStdString(mark.title) == reading; }),
               qPrintable(reading));
    }
    QVERIFY(bench.plot().readingAt({0, 0}).isEmpty());
  }

  void theTableSortsByNumbers() {
    ReportBench bench;
    bench.run();
    bench.table().sortByColumn(msColumn, Qt::DescendingOrder);
    double last = 1e300;
    for (int row = 0; row < bench.table().rowCount(); ++row) {
      const double ms = bench.table().item(row, msColumn)->text().toDouble();
      QVERIFY(ms <= last);
      last = ms;
    }
  }

  void whoIsRefusedIsListedWithTheReason() {
    ReportBench bench;
    const QPoint from = bench.place(0, 31);
    bench.stroke(0, {from, from + QPoint(70, -60)});
    edits::setPinned(bench.document(), {31}, true);
    bench.choose("reportDrags", 1);
    bench.run();
    auto* refusals = bench.find<QLabel>("reportRefusals");
    QVERIFY(refusals->isVisible());
    QVERIFY2(refusals->text().contains(QStringLiteral("Natural Queue ChainMail")) &&
                 refusals->text().contains(QStringLiteral("pinned")),
             qPrintable(refusals->text()));
    QCOMPARE(bench.table().rowCount(), 0);
  }

  void algorithmsThatDoNotFitCannotBeChosen() {
    ReportBench bench;
    auto* list = bench.find<QListWidget>("reportAlgorithms");
    QListWidgetItem* original = list->findItems(QStringLiteral("3D ChainMail"), Qt::MatchExactly).value(0);
    QVERIFY((original->flags() & Qt::ItemIsEnabled) != 0);
    edits::replaceMesh(bench.document(), generate({MeshKind::cloth, {5, 4, 1}, 1, {}}), QStringLiteral("cloth"), {});
    bench.settle();
    QVERIFY((original->flags() & Qt::ItemIsEnabled) == 0);
    QVERIFY(original->toolTip().contains(QStringLiteral("grid")));
    bench.choose("reportSweeps", 1);
    bench.run();
    QCOMPARE(bench.table().rowCount(), 5);
    for (int row = 0; row < list->count(); ++row) {
      list->item(row)->setCheckState(Qt::Unchecked);
    }
    QVERIFY(!bench.find<QPushButton>("reportRun")->isEnabled());
  }

  void savingWritesThreeFilesThatParse() {
    ReportBench bench;
    bench.run();
    QTemporaryDir folder;
    bench.results().saveTo(folder.path());
    QCOMPARE(QDir(folder.path()).entryList(QDir::Files),
             (QStringList{QStringLiteral("report.csv"), QStringLiteral("report.html"), QStringLiteral("report.json")}));
    const QJsonObject json = QJsonDocument::fromJson(read(folder, "report.json")).object();
    const QJsonArray drags = json[QStringLiteral("objects")][0][QStringLiteral("drags")].toArray();
    QVERIFY2(drags.size() == 3, read(folder, "report.json").left(600));
    const QList<QByteArray> rows = read(folder, "report.csv").trimmed().split('\n');
    QCOMPARE(rows.size(), 1 + 3 * 12);
    for (const QByteArray& row : rows) {
      QCOMPARE(row.count(','), rows.first().count(','));
    }
    QVERIFY(read(folder, "report.html").contains("</html>"));
  }

  void savingAsksBeforeItReplacesAReport() {
    ReportBench bench;
    bench.run();
    const QTemporaryDir folder;
    bench.results().askAndSaveTo(folder.path());  // without a question
    QFile old(folder.filePath(QStringLiteral("report.csv")));
    QVERIFY(old.open(QIODevice::WriteOnly) && old.write("mine") == 4 && old.flush());
    {
      const Answer cancel(QStringLiteral("Cancel"));
      bench.results().askAndSaveTo(folder.path());
      QCOMPARE(cancel.questions, 1);
      QVERIFY2(cancel.said.contains(QStringLiteral("report.html, report.json, report.csv")), qPrintable(cancel.said));
      QCOMPARE(read(folder, "report.csv"), QByteArray("mine"));
    }
    const Answer replace(QStringLiteral("Replace"));
    bench.results().askAndSaveTo(folder.path());
    QVERIFY(read(folder, "report.csv").size() > 100);
  }

  void thePlotIsSavedAsADrawing() {
    ReportBench bench;
    bench.run();
    const QTemporaryDir folder;
    for (const auto& [name, begin] :
         {std::pair("plot.svg", "<?xml"), std::pair("plot.pdf", "%PDF"), std::pair("plot.png", "\x89PNG")}) {
      bench.results().savePlotTo(folder.filePath(QLatin1String(name)));
      QVERIFY2(read(folder, name).startsWith(begin), name);
    }
    QVERIFY(read(folder, "plot.svg").contains("Natural Queue"));
  }

  void decimalPointsStandBelowEachOther() {
    ReportBench bench;
    bench.run();
    std::set<int> fromTheRight;
    for (int row = 0; row < bench.table().rowCount(); ++row) {
      const QString words = bench.table().item(row, violationColumn)->text();
      if (words.contains(QLatin1Char('.')) && !words.contains(QLatin1Char('e'))) {
        fromTheRight.insert(int(words.size() - words.indexOf(QLatin1Char('.'))));
      }
    }
    QCOMPARE(fromTheRight.size(), std::size_t{1});
  }

  void aReportThatCannotBeSavedIsNotSavedByHalves() {
    ReportBench bench;
    bench.run();
    QTemporaryDir folder;
    QVERIFY(QDir(folder.path()).mkdir(QStringLiteral("report.csv")));  // a folder with the name of a file
    bench.results().saveTo(folder.path());
    QVERIFY(bench.window.messages().isVisible());
    QVERIFY(QDir(folder.path()).entryList(QDir::Files | QDir::Hidden).isEmpty());
    bench.window.messages().hide();
    bench.results().saveTo(folder.filePath(QStringLiteral("missing")));
    QVERIFY(bench.window.messages().isVisible());
  }

  void everyWidgetIsNamed() {
    ReportBench bench;
    bench.run();
    for (const char* name : {"reportDrags", "reportAlgorithms", "reportSweeps", "reportPrecision", "reportSeconds",
                             "reportRun", "reportCancel", "reportProgress", "reportDrag", "reportError", "reportSave",
                             "reportSavePlot", "reportPlot", "reportLegend", "reportTable", "reportHeading"}) {
      auto* widget = bench.find<QWidget>(name);
      QVERIFY2(widget != nullptr, name);
      QVERIFY2(!widget->accessibleName().isEmpty() && !widget->toolTip().isEmpty(), name);
    }
  }

 private:
  static QByteArray read(const QTemporaryDir& folder, const char* name) {
    QFile file(folder.filePath(QLatin1String(name)));
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
  }
};

CHAINMAIL_WINDOW_TEST(WindowReport)

}  // namespace chainmail::window_report

#include "window_report.moc"
