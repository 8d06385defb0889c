// Tests that no exception ends the window: one sentence appears, the work stays, and the window goes on. Exceptions
// come from jobs, slots, listeners, painting and solvers; memory and threads run out.

#include <QFile>

#include "core/allocations.h"
#include "core/failing_method.h"
#include "core/no_threads.h"
#include "document/edits.h"
#include "io/sessions.h"
#include "session_bench.h"
#include "window/bars.h"

namespace chainmail::window_failures {

using test::Failure;
using test::LittleMemory;
using test::NoThreads;

namespace {

QString sentenceOf(Failure failure) {
  switch (failure) {
    case Failure::memory:
      return QStringLiteral("there is not enough memory; save your work");
    case Failure::system:
      return QStringLiteral("the system refuses it");
    case Failure::other:
      return QStringLiteral("it failed (a surprise); save your work");
    default:
      return QStringLiteral("it failed for an unknown reason; save your work");
  }
}

void addFailures() {
  QTest::addColumn<Failure>("failure");
  QTest::newRow("no memory") << Failure::memory;
  QTest::newRow("no thread") << Failure::system;
  QTest::newRow("something else") << Failure::other;
  QTest::newRow("no exception class") << Failure::number;
}

/// A job that does nothing, and fails where the test wants.
Jobs::Work workThat(Failure inThread, Failure inWindow) {
  return [=](const Progress&) -> Jobs::Finish {
    test::fail(inThread);
    return [inWindow] { test::fail(inWindow); };
  };
}

/// An overlay that fails to draw as long as the test wants.
struct FailingOverlay : Overlay {
  void draw(const Canvas&) override {
    ++draws;
    test::fail(failure);
  }
  Failure failure = Failure::none;
  int draws = 0;
};

}  // namespace

class WindowFailures : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void aJobThatFailsGetsASentence_data() { addFailures(); }
  void aJobThatFailsGetsASentence() {
    QFETCH(Failure, failure);
    Workbench bench;
    bool finished = false;
    for (const auto& work : {workThat(failure, Failure::none), workThat(Failure::none, failure)}) {
      bench.window.messages().clear();
      bench.window.jobs().start(Jobs::Kind::load, QStringLiteral("Opening x.obj"), work);
      bench.settle();
      QVERIFY(!bench.window.jobs().running());
      QVERIFY(bench.window.messages().sentence().startsWith(QStringLiteral("Opening x.obj: ") + sentenceOf(failure)));
    }
    bench.window.jobs().start(Jobs::Kind::load, QStringLiteral("next"),
                              [&](const Progress&) -> Jobs::Finish { return [&] { finished = true; }; });
    bench.settle();
    QVERIFY(finished);
  }

  void aJobWithoutAThreadIsRefused() {
    Workbench bench;
    auto& jobs = bench.window.jobs();
    {
      const NoThreads none;
      jobs.start(Jobs::Kind::save, QStringLiteral("Saving x"), workThat(Failure::none, Failure::none));
    }
    QVERIFY(!jobs.running());
    QVERIFY(bench.window.messages().sentence().startsWith(QStringLiteral("Saving x: the system refuses it")));
    bool finished = false;
    jobs.start(Jobs::Kind::save, QStringLiteral("Saving y"),
               [&](const Progress&) -> Jobs::Finish { return [&] { finished = true; }; });
    bench.settle();
    QVERIFY(finished);
  }

  void aSlotThatFailsGetsASentence_data() { addFailures(); }
  void aSlotThatFailsGetsASentence() {
    QFETCH(Failure, failure);
    Workbench bench;
    QTimer::singleShot(0, &bench.window, [failure] { test::fail(failure); });
    QTRY_VERIFY(bench.window.messages().sentence().contains(sentenceOf(failure)));
    QVERIFY(bench.window.isVisible());
  }

  /// A view that cannot be painted is painted again, and the sentence does not come with every paint.
  void aPaintThatFailsGetsOneSentence() {
    FailingOverlay overlay;  // longer than the views
    Workbench bench;
    bench.view(0).addOverlay(overlay);
    overlay.failure = Failure::memory;
    // The bar of the sentence must not resize the view while Qt still uses its picture.
    bench.view(0).update();
    QEvent paintNow(QEvent::UpdateRequest);
    QCoreApplication::sendEvent(&bench.window, &paintNow);
    QVERIFY(overlay.draws > 0);
    QVERIFY(!bench.window.messages().isVisible());
    bench.awaitPaint();
    bench.awaitPaint();
    QTRY_VERIFY(bench.window.messages().sentence().contains(sentenceOf(Failure::memory)));
    bench.window.messages().dismiss();
    const int before = overlay.draws;
    bench.awaitPaint();
    QVERIFY(overlay.draws > before);
    QCoreApplication::processEvents();
    QVERIFY(!bench.window.messages().isVisible());
    overlay.failure = Failure::none;
    bench.awaitPaint();
    bench.dragFar();
    QCOMPARE(bench.document().undoStack().count(), 1);
  }

  /// The edit is complete nevertheless: it is on the stack, and undo and redo work.
  void aListenerThatFailsLeavesTheEdit() {
    Workbench bench;
    Document& document = bench.document();
    QObject context;
    connect(&document, &Document::cutsChanged, &context, [] { throw std::bad_alloc(); });
    connect(&document.moves(), &MovePlayer::changed, &context, [] { throw 7; });
    edits::cut(document, {3, 40});
    QCOMPARE(document.cuts().count(), 2U);
    QCOMPARE(document.undoStack().count(), 1);
    document.undo();
    QCOMPARE(document.cuts().count(), 0U);
    document.redo();
    QCOMPARE(document.cuts().count(), 2U);
    bench.settle();
    QVERIFY(bench.window.messages().isVisible());
  }

  void aMethodThatFailsInADragStopsAlone_data() { addFailures(); }
  void aMethodThatFailsInADragStopsAlone() {
    QFETCH(Failure, failure);
    const auto moves = std::make_shared<test::FailingMoves>();
    const ExtraAlgorithm extra(test::failing_entry(moves));
    Workbench bench;
    Document& document = bench.document();
    edits::setAlgorithm(document, 1, test::failing_algorithm);
    document.handle().grab(31);
    const Point from = document.mesh()->rest_position(31);
    document.handle().drag(from + Point(0.5, 0, 0));
    bench.settle();
    moves->failure = failure;
    document.handle().drag(from + Point(1.5, 1, 0));
    bench.settle();
    QTRY_VERIFY(bench.window.messages().sentence().startsWith(QStringLiteral("Failing: ") + sentenceOf(failure)));
    document.handle().drag(from + Point(2, 2, 0));
    document.handle().release();
    bench.settle();
    QVERIFY(bench.position(0, 31).isApprox(Point(from + Point(2, 2, 0)), 1e-5));  // the other panel went on
    QVERIFY(QString::fromStdString(document.solvers().statistics(1).remark).startsWith(QStringLiteral("stopped: ")));
    const QString path = folder_.filePath(QStringLiteral("kept.chainmail"));
    bench.window.sessions().savePath(path);
    bench.settle();
    QVERIFY(QFile::exists(path));
    document.undo();
    bench.settle();
    QCOMPARE(bench.position(0, 31), from);
    QCOMPARE(bench.position(1, 31), from);
    edits::setAlgorithm(document, 1, Algorithm::natural_queue);
    bench.settle();
  }

  void aPanelWithoutAThreadIsNotAdded() {
    Workbench bench;
    const int before = bench.document().panels();
    {
      const NoThreads none;
      QTimer::singleShot(0, &bench.document(), &Document::addPanel);
      QTRY_VERIFY(bench.window.messages().sentence().contains(QStringLiteral("the system refuses it")));
    }
    QCOMPARE(bench.document().panels(), before);
    bench.document().addPanel();
    bench.settle();
    QCOMPARE(bench.document().panels(), before + 1);
  }

  /// Opening, cutting and dragging fail, the object and the window stay.
  void withLittleMemoryTheWindowStays() {
    Workbench bench(generate({MeshKind::grid, {120, 120, 1}, 1, {}}));
    Document& document = bench.document();
    const QString path = folder_.filePath(QStringLiteral("large.chainmail"));
    bench.window.sessions().savePath(path);
    bench.settle();
    const MeshPointer mesh = document.mesh();
    {
      const LittleMemory little(50'000);
      bench.window.openFile(path);
      QTRY_VERIFY(!bench.window.jobs().running());
      QVERIFY(bench.window.messages().sentence().contains(QStringLiteral("there is not enough memory")));
      drag(document, 7000, {40, 30, 0});
      edits::cut(document, {3, 40});
      QTRY_VERIFY(document.solvers().idle());
    }
    QVERIFY(document.mesh() == mesh);
    bench.settle();
    document.undo();
    document.undo();
    bench.settle();
    QCOMPARE(bench.position(0, 7000), mesh->rest_position(7000));
    QCOMPARE(document.cuts().count(), 0U);
    drag(document, 7000, {40, 30, 0});
    bench.settle();
    QVERIFY(bench.position(0, 7000) != mesh->rest_position(7000));
  }

 private:
  QTemporaryDir folder_;
};

CHAINMAIL_WINDOW_TEST(WindowFailures)

}  // namespace chainmail::window_failures

#include "window_failures.moc"
