// Tests the runs of the Report dock in a real window: the compared object, cancelling, and edits during a run.

#include <QFile>

#include "fair_timer.h"
#include "files/results/results_json.h"
#include "report_bench.h"

namespace chainmail::window_report_run {

class WindowReportRun : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QSettings().clear();
  }

  // Passes over such a large object take longer than 0.1 s, and the thread checks its stop token only between passes.
  // The test measures the window: it waits for no thread, takes a lock that is held only for an assignment, and is
  // ready before the click handler returns. So it is fast even on a busy machine.
  void cancelAnswersAtOnce() {
    ReportBench bench;
    bench.click("reportRun");
    ReportThread::Order order{
        .object = {"large", "", generate({MeshKind::grid, {800, 800, 1}, 1, {}}), {}, {}, {}, {}}};
    order.object.drags = {{"far", "", {commands::Grab{0}, commands::Drag{Point(-900, -900, 0)}}}};
    order.options.algorithms = {Algorithm::enhanced};
    order.options.sweeps = {0};
    order.options.seconds = 60;
    bench.thread().start(std::move(order));
    QTRY_VERIFY(bench.thread().atWork());
    const test::FairTimer timer;
    emit bench.find<QPushButton>("reportCancel")->clicked();  // click() would paint first
    QVERIFY2(timer.within(100), qPrintable(timer.inWords()));
    bench.isReady();
    QTRY_VERIFY_WITH_TIMEOUT(!bench.thread().atWork(), 20'000);
    qInfo("until the thread ended, %s", qPrintable(timer.inWords()));
  }

  /// A run that is cancelled before it has results shows nothing, and not those of the run before.
  void whatARunBeforeFoundIsNotShownAgain() {
    ReportBench bench;
    bench.choose("reportSweeps", 0);
    bench.run();
    QTRY_VERIFY(!bench.thread().atWork());
    bench.effort(60);
    const QSignalSpy arrived(&bench.thread(), &ReportThread::arrived);
    emit bench.find<QPushButton>("reportRun")->clicked();
    QVERIFY(bench.thread().running());
    bench.thread().cancel();
    QTRY_VERIFY(!bench.thread().atWork());
    bench.settle();
    QCOMPARE(arrived.count(), 0);
  }

  void aRunRightAfterACancelledOneCounts() {
    ReportBench bench(generate({MeshKind::grid, {64, 64, 1}, 1, {}}));
    bench.runForLong();
    bench.click("reportCancel");
    bench.effort(0.1);
    bench.choose("reportSweeps", 0);
    bench.run();
    QCOMPARE(bench.table().rowCount(), 6);
    QTRY_VERIFY(!bench.thread().atWork());
  }

  void theLastDragIsUsed() {
    ReportBench bench;
    auto* drags = bench.find<QListWidget>("reportDrags");
    const auto enabled = [drags] { return (drags->item(myLastDrag)->flags() & Qt::ItemIsEnabled) != 0; };
    const QPoint from = bench.place(0, 31), to = from + QPoint(70, -60);
    bench.stroke(0, {from});
    QVERIFY(!enabled());  // a press without a move is not a drag
    bench.stroke(0, {from, to});
    QVERIFY(enabled());
    const std::vector<Command> commands = bench.document().moves().lastDrag();
    QCOMPARE(std::get<commands::Grab>(commands.front()).elements, std::vector<ElementId>{31});
    // The panels store floats.
    QVERIFY((std::get<commands::Drag>(commands.back()).target - bench.position(1, 31)).norm() < 1e-5);
    bench.check("reportDrags", {myLastDrag});
    bench.run();
    QCOMPARE(bench.find<QComboBox>("reportDrag")->currentText(), QStringLiteral("my last drag"));
    QVERIFY(bench.find<QLabel>("reportHeading")->text().endsWith(QStringLiteral("%1 moves").arg(commands.size() - 1)));
  }

  void cancelKeepsTheFinishedDrags() {
    PinnedBench bench;
    QObject context;
    connect(&bench.thread(), &ReportThread::arrived, &context, [&](const ReportThread::Results& results) {
      if (!results->stopped) {
        bench.find<QPushButton>("reportCancel")->click();
      }
    });
    bench.effort(60);
    bench.click("reportRun");
    QTRY_VERIFY_WITH_TIMEOUT(!bench.thread().running(), 60'000);
    bench.isReady();
    QVERIFY(bench.find<QLabel>("reportHeading")->text().contains(QStringLiteral("; stopped; ")));
    QVERIFY(bench.table().rowCount() > 0);
    const QTemporaryDir folder;
    bench.results().saveTo(folder.path());
    const report::Results read = read_results(folder.filePath(QStringLiteral("report.json")).toStdString());
    QVERIFY(read.stopped && !read.rows.empty());
    QVERIFY(read.objects.front().drags.size() < 5);
  }

  void theTimeThatIsLeftIsSaidWhenItIsKnown() {
    QVERIFY(timeLeft(0.5, 4).isEmpty() && timeLeft(0.02, 60).isEmpty());
    QCOMPARE(timeLeft(0.25, 10), QStringLiteral("about 30 s left"));
    QCOMPARE(timeLeft(0.25, 60), QStringLiteral("about 3 min left"));
    QCOMPARE(timeLeft(0.1, 1200), QStringLiteral("about 3 h left"));
    QCOMPARE(timeLeft(1, 10), QStringLiteral("about 1 s left"));
  }

  void theObjectIsComparedAsItIs() {
    ReportBench bench;
    edits::cut(bench.document(), {0, 5, 9});
    edits::setPinned(bench.document(), {0, 62}, true);
    edits::setSoftnessOf(bench.document(), {20}, LinkSoftness{0.5, 2, 0.3});
    ElasticOptions elastic;
    elastic.law.kind = StrainLaw::Kind::gent;
    edits::setElastic(bench.document(), elastic, QStringLiteral("law"));
    const auto order = bench.window.findChild<ReportChoices*>()->order();
    QVERIFY(order.object.elastic == elastic && order.object.law == elastic.law);
    QCOMPARE(order.object.cuts, (std::vector<LinkId>{0, 5, 9}));
    QCOMPARE(order.object.pins, (std::vector<ElementId>{0, 62}));
    QVERIFY(order.object.softness == *bench.document().wholeSoftness());
    QVERIFY(order.object.softness.links.contains(20));
    bench.run();
  }

  void anotherMeshDuringARunIsHarmless() {
    ReportBench bench;
    bench.effort(1);
    bench.click("reportRun");
    edits::replaceMesh(bench.document(), generate({MeshKind::tetra, {4, 4, 4}, 1, {}}), QStringLiteral("other"), {});
    bench.settle();
    bench.document().undoStack().undo();
    bench.document().undoStack().redo();
    QVERIFY(bench.thread().running());
    QTRY_VERIFY_WITH_TIMEOUT(!bench.thread().running(), 60'000);
    // The result is for the object from the start of the run, and the heading says so.
    QVERIFY(bench.find<QLabel>("reportHeading")->text().startsWith(QStringLiteral("sample, 63 elements")));
    QCOMPARE(bench.table().rowCount(), 12);
  }
};

CHAINMAIL_WINDOW_TEST(WindowReportRun)

}  // namespace chainmail::window_report_run

#include "window_report_run.moc"
