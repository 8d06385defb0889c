// Tests the contents of the Report dock and its files in a real window.

#include <QDir>
#include <QHeaderView>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QScrollBar>

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

  void savingAReport() {
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

    // It asks before it replaces a report.
    const QTemporaryDir target;
    bench.results().askAndSaveTo(target.path());  // without a question
    QFile old(target.filePath(QStringLiteral("report.csv")));
    QVERIFY(old.open(QIODevice::WriteOnly) && old.write("mine") == 4 && old.flush());
    {
      const Answer cancel(QStringLiteral("Cancel"));
      bench.results().askAndSaveTo(target.path());
      QCOMPARE(cancel.questions, 1);
      QVERIFY2(cancel.said.contains(QStringLiteral("report.html, report.json, report.csv")), qPrintable(cancel.said));
      QCOMPARE(read(target, "report.csv"), QByteArray("mine"));
    }
    const Answer replace(QStringLiteral("Replace"));
    bench.results().askAndSaveTo(target.path());
    QVERIFY(read(target, "report.csv").size() > 100);

    // A report that cannot be saved is not saved by halves.
    const QTemporaryDir full;
    QVERIFY(QDir(full.path()).mkdir(QStringLiteral("report.csv")));  // a folder with the name of a file
    bench.results().saveTo(full.path());
    QVERIFY(bench.window.messages().isVisible());
    QVERIFY(QDir(full.path()).entryList(QDir::Files | QDir::Hidden).isEmpty());
    bench.window.messages().hide();
    bench.results().saveTo(full.filePath(QStringLiteral("missing")));
    QVERIFY(bench.window.messages().isVisible());
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
