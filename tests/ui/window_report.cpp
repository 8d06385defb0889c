// Tests the contents of the Report dock and its files in a real window.

#include <QDir>
#include <QHeaderView>
#include <QImage>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QMap>
#include <QRegularExpression>
#include <QScrollBar>

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
        const QString time = bench.cellOf(row, msColumn);  // with a unit that fits
        QVERIFY2(time.section(QLatin1Char(' '), 0, 0).toDouble() > 0 && time.endsWith(QLatin1Char('s')),
                 qPrintable(time));
      }
    }
    const std::vector<std::string>& notes = bench.plot().plot().legend_notes;
    QVERIFY(std::ranges::find(notes, std::string("filled: without relaxation")) != notes.end());
    QCOMPARE(bench.find<QComboBox>("reportError")->count(), 4);
    QVERIFY(bench.find<QLabel>("reportTimesNote")->isVisible());
    QVERIFY(!bench.find<QLabel>("reportRefusals")->isVisible());
    QVERIFY(bench.table().isColumnHidden(bench.table().columnCount() - 1));
    bench.find<QCheckBox>("reportAllFigures")->click();
    QVERIFY(!bench.table().isColumnHidden(bench.table().columnCount() - 1));
  }

  /// A second run fills a table that is sorted by a figure.
  void eachRowKeepsItsOwnFigures() {
    ReportBench bench;
    bench.run();
    const auto figures = [&] {
      QMap<QString, QStringList> all;
      for (int row = 0; row < bench.table().rowCount(); ++row) {
        for (int column = 1; column < bench.table().columnCount(); ++column) {
          const QTableWidgetItem* item = bench.table().item(row, column);
          all[bench.cellOf(row, 0)] << (item == nullptr ? QString() : item->text());
        }
      }
      return all;
    };
    bench.table().sortByColumn(0, Qt::AscendingOrder);
    const auto first = figures();
    for (const Qt::SortOrder order : {Qt::AscendingOrder, Qt::DescendingOrder}) {
      for (int column = 0; column < bench.table().columnCount(); ++column) {
        bench.table().sortByColumn(column, order);
        bench.choose("reportDrag", 1);
        bench.choose("reportDrag", 0);
        QCOMPARE(figures(), first);
      }
    }
  }

  void aMarkIsReadWithContestantTimeAndError() {
    ReportBench bench;
    bench.run();
    const QStringList all = readings(bench);
    static const QRegularExpression whole(QStringLiteral(
        "^[A-Z3].* ChainMail.*: [0-9.,]+ (µs|ms|s) per move \\(.*\\), largest violation .* rest lengths$"));
    QVERIFY2(!all.filter(whole).isEmpty(), qPrintable(all.join(QLatin1Char('\n'))));
  }

  void physicsNeedsPinsAndSaysSo() {
    ReportBench bench(generate({MeshKind::tetra, {4, 2, 2}, 1, {}}));
    auto* against = bench.find<QComboBox>("reportAgainst");
    auto* reason = bench.find<QLabel>("reportNoPhysics");
    const auto isOffered = [&] {
      return (against->model()->flags(against->model()->index(1, 0)) & Qt::ItemIsEnabled) != 0;
    };
    QVERIFY(!isOffered() && reason->isVisible());
    QVERIFY2(reason->text().contains(QStringLiteral("pin a side")), qPrintable(reason->text()));
    edits::setPinned(bench.document(), {0, 1}, true);
    QVERIFY(isOffered() && !reason->isVisible());
    against->setCurrentIndex(1);
    edits::cut(bench.document(), {0});
    QVERIFY(!isOffered());
    QCOMPARE(against->currentIndex(), 0);
    QVERIFY2(reason->text().contains(QStringLiteral("cut")), qPrintable(reason->text()));
    MeshParts surface;
    surface.rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    surface.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    surface.links = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    edits::replaceMesh(bench.document(), build_mesh(std::move(surface)), QStringLiteral("surface"), {});
    edits::setPinned(bench.document(), {0}, true);
    QVERIFY(!isOffered());
    QVERIFY2(reason->text().contains(QStringLiteral("not a solid")), qPrintable(reason->text()));
  }

  void againstPhysicsErrorsAreOverTime() {
    PinnedBench bench;
    bench.run();
    QCOMPARE(bench.find<QComboBox>("reportDrag")->currentText(), QStringLiteral("all drags"));
    QVERIFY(bench.find<QComboBox>("reportDrag")->findText(QStringLiteral("far bend")) > 0);
    const double linear = bench.numberOf(QStringLiteral("Linear FEM"), report::figures::relative);
    const double nothing = bench.numberOf(QStringLiteral("Nothing moves"), report::figures::relative);
    QVERIFY2(linear > 0 && linear < nothing && nothing < 1.5, qPrintable(QString::number(linear)));
    const double material = bench.numberOf(QStringLiteral("Material"), report::figures::relative);
    QVERIFY2(material > 0 && material < linear, qPrintable(QString::number(material)));
    QCOMPARE(bench.find<QComboBox>("reportError")->currentText(), QStringLiteral("Later move"));
    QVERIFY(bench.find<QComboBox>("reportError")->findText(QStringLiteral("Fresh grab")) > 0);
    const auto isLinear = [](const report::PlotMark& mark) { return mark.title.starts_with("Linear FEM"); };
    const auto mark = std::ranges::find_if(bench.marks(), isLinear);
    QVERIFY(mark != bench.marks().end());
    QVERIFY(mark->x > 0 && std::abs(mark->y - linear) < 1e-9);
    bench.find<QComboBox>("reportDrag")->setCurrentText(QStringLiteral("pull"));
    QVERIFY(bench.find<QLabel>("reportHeading")->text().contains(QStringLiteral("away from the pins; 24 moves")));
    QVERIFY(bench.numberOf(QStringLiteral("Linear FEM"), report::figures::relative) != linear);
  }

  /// Of a drag with a cut, the time is that of the move after the cut: in the window, and in the file of the plot.
  void aDragWithACutHasTheTimeOfItsCut() {
    ReportBench bench;
    report::Results results{.kind = report::ReportKind::physics};
    results.objects = {{.name = "bar", .drags = {{.name = "bend", .moves = 12}, {.name = "cut", .moves = 12}}}};
    results.objects[0].drags[1].has_cut = true;
    for (const auto drag : {std::size_t{0}, std::size_t{1}}) {
      report::Row row{.drag = drag, .contestant = {.algorithm = Algorithm::natural_queue}};
      row.set(report::figures::relative, 0.25);
      row.set(report::figures::later_ms, 3);
      row.set(report::figures::fresh_ms, 5);
      row.set(report::figures::after_cut_ms, drag == 1 ? std::optional(7.0) : std::nullopt);
      results.rows.push_back(row);
    }
    emit bench.thread().arrived(std::make_shared<const report::Results>(results));
    const auto times = [&](const char* plot) {
      bench.find<QComboBox>("reportError")->setCurrentText(QLatin1String(plot));
      bench.settle();
      return readings(bench);
    };
    QCOMPARE(times("Later move"),
             QStringList{QStringLiteral("Natural Queue ChainMail: 3 ms per later move, relative error 0.25")});
    const QStringList ofCut{QStringLiteral("Natural Queue ChainMail: 7 ms per move after a cut, relative error 0.25")};
    QCOMPARE(times("Move after a cut"), ofCut);
    bench.find<QComboBox>("reportDrag")->setCurrentText(QStringLiteral("cut"));
    QCOMPARE(times("Move after a cut"), ofCut);
    const QTemporaryDir folder;
    bench.results().saveTo(folder.path());
    const QByteArray file = read(folder, "object-1.svg");
    for (const char* title : {"Natural Queue ChainMail: 3 ms per move, ", "Natural Queue ChainMail: 7 ms per move, "}) {
      QVERIFY2(file.contains(title), file);
    }
    QVERIFY(!file.contains("5 ms per"));
  }

  void whoIsRefusedIsListedWithTheReason() {
    ReportBench bench;
    const QPoint from = bench.place(0, 31);
    bench.stroke(0, {from, from + QPoint(70, -60)});
    edits::setPinned(bench.document(), {31}, true);
    bench.check("reportDrags", {myLastDrag});
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
    edits::setRelaxation(bench.document(), {false, 0.5});
    bench.run();
    QTemporaryDir folder;
    bench.results().saveTo(folder.path());
    QCOMPARE(QDir(folder.path()).entryList(QDir::Files),
             (QStringList{QStringLiteral("distance-1.svg"), QStringLiteral("report.csv"), QStringLiteral("report.html"),
                          QStringLiteral("report.json"), QStringLiteral("violation-1.svg")}));
    bench.results().savePlotTo(folder.filePath(QStringLiteral("plot.png")), {127, 63.5, 100});
    QCOMPARE(QImage(folder.filePath(QStringLiteral("plot.png"))).size(), QSize(500, 250));
    const QJsonObject json = QJsonDocument::fromJson(read(folder, "report.json")).object();
    const QJsonArray drags = json[QStringLiteral("objects")][0][QStringLiteral("drags")].toArray();
    QVERIFY2(drags.size() == 3, read(folder, "report.json").left(600));
    QCOMPARE(json[QStringLiteral("options")][QStringLiteral("relax_step")].toDouble(), 0.5);
    const QList<QByteArray> rows = read(folder, "report.csv").trimmed().split('\n');
    QCOMPARE(rows.size(), 1 + 3 * 12);
    static const QRegularExpression quoted(QStringLiteral("\"[^\"]*\""));  // labels contain commas
    for (const QByteArray& row : rows) {
      QCOMPARE(QString::fromUtf8(row).remove(quoted).count(QLatin1Char(',')), rows.first().count(','));
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
      QVERIFY2(cancel.said.contains(QStringLiteral("report.html, report.json, report.csv, violation-1.svg")),
               qPrintable(cancel.said));
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
  /// Returns what the plot says under the pointer, wherever that is.
  static QStringList readings(ReportBench& bench) {
    QSet<QString> all;
    for (int x = 0; x < bench.plot().width(); x += 4) {
      for (int y = 0; y < bench.plot().height(); y += 4) {
        all << bench.plot().readingAt(QPointF(x, y));
      }
    }
    all.remove({});
    return all.values();
  }
  static QByteArray read(const QTemporaryDir& folder, const char* name) {
    QFile file(folder.filePath(QLatin1String(name)));
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
  }
};

CHAINMAIL_WINDOW_TEST(WindowReport)

}  // namespace chainmail::window_report

#include "window_report.moc"
