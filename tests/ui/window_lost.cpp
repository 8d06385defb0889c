// Tests that no path through the window loses work: other objects, failed writes, clocks, other windows, undo, lessons.

#include <sys/stat.h>
#include <unistd.h>

#include <QDir>
#include <QLabel>
#include <QPushButton>
#include <QThread>

#include "document/edits.h"
#include "io/file_actions.h"
#include "io/samples.h"
#include "io/sessions.h"
#include "io/unsaved_work.h"
#include "safe_bench.h"
#include "window/bars.h"
#include "window/show_menu.h"

namespace chainmail::window_lost {

namespace {

QStringList kept() { return QDir(unsaved_work::folder()).entryList({QStringLiteral("*.chainmail")}, QDir::Files); }

int modeOf(const QString& path) {
  struct stat status {};
  return stat(qPrintable(path), &status) == 0 ? int(status.st_mode & 07777) : 0;
}

}  // namespace

class WindowLost : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QVERIFY(QDir(unsaved_work::folder()).removeRecursively());
    QSettings().clear();
  }

  void anotherObjectIsAnotherDocument_data() {
    QTest::addColumn<std::function<void(Workbench&)>>("open");
    const QString mesh = path("other.obj");
    QTest::newRow("a mesh") << std::function([mesh](Workbench& bench) {
      bench.window.findChild<FileActions*>()->savePath(mesh);
      bench.settle();
      bench.open(mesh);
    });
    QTest::newRow("a sample") << std::function([](Workbench& bench) {
      bench.window.findChild<FileActions*>()->openSample(samplesFolder() + QStringLiteral("/torus.obj"));
    });
    QTest::newRow("Build") << std::function([](Workbench& bench) { bench.find<QPushButton>("buildMesh")->click(); });
  }
  void anotherObjectIsAnotherDocument() {
    QFETCH(std::function<void(Workbench&)>, open);
    const QString session = path("lecture.chainmail");
    Workbench bench(cloth());
    edits::setPinned(bench.document(), {3}, true);
    bench.window.sessions().savePath(session);
    bench.settle();
    open(bench);
    bench.settle();
    QCOMPARE(bench.document().files().session(), QString());  // so that Save asks for a file
    QVERIFY(!bench.window.windowTitle().contains(QStringLiteral("lecture")));
    bench.document().undo();
    bench.settle();
    QCOMPARE(bench.document().files().session(), session);
    QCOMPARE(bench.document().pins(), std::vector<ElementId>{3});
    bench.document().redo();
    bench.settle();
    QCOMPARE(bench.document().files().session(), QString());
  }

  void closingAsksIfWorkCannotBeKept_data() {
    QTest::addColumn<bool>("isKeptLater");
    QTest::newRow("and it is discarded") << false;
    QTest::newRow("and it is kept later") << true;
  }
  void closingAsksIfWorkCannotBeKept() {
    QFETCH(bool, isKeptLater);
    auto bench = std::make_unique<SafeBench>();
    edits::setPinned(bench->document(), {3}, true);
    bench->settle();
    FullDisk disk;
    {
      const Answer cancel(QStringLiteral("Cancel"));
      QVERIFY(!bench->window.close());
      QCOMPARE(cancel.questions, 1);
      QVERIFY2(cancel.said.contains(QStringLiteral("folder does not exist")), qPrintable(cancel.said));
    }
    QVERIFY(bench->window.isVisible());
    drag(bench->document(), 31, {1, 0, 0});  // the solvers still work
    bench->settle();
    QVERIFY(bench->position(0, 31).x() > bench->document().mesh()->rest_position(31).x() + 0.9);
    if (isKeptLater) {
      disk.end();
      QVERIFY(bench->window.close());
    } else {
      const Answer discard(QStringLiteral("Discard"));
      QVERIFY(bench->window.close());
      QCOMPARE(discard.questions, 1);
      disk.end();
    }
    bench.reset();
    QCOMPARE(kept().size(), isKeptLater ? 1 : 0);
  }

  void savingGoesOnAfterAFailure() {
    SafeBench bench;
    edits::setPinned(bench.document(), {3}, true);
    int first = 0;
    {
      const FullDisk disk;
      bench.save();
      QTRY_VERIFY(bench.window.messages().sentence().startsWith(QStringLiteral("Automatic saving failed")));
      first = bench.timer->interval();
      bench.save();
      QTRY_COMPARE(bench.timer->interval(), 2 * first);
      QVERIFY(bench.timer->isActive());  // it tries again by itself
      QCOMPARE(bench.window.messages().count(), 1);
    }
    bench.save();
    QTRY_VERIFY(!bench.window.messages().isVisible());
    QCOMPARE(kept().size(), 1);
  }

  void restoredWorkStaysUntilItIsSavedElsewhere() {
    {
      SafeBench bench;
      edits::setPinned(bench.document(), {42}, true);
      bench.settle();
      QVERIFY(bench.window.close());
    }
    QCOMPARE(kept().size(), 1);
    const QString first = kept().first();
    SafeBench again;
    again.find<QPushButton>("restoreWork")->click();
    again.settle();
    again.save();
    QTRY_COMPARE(kept().size(), 2);
    again.document().undo();
    again.save();
    QTRY_COMPARE(kept(), QStringList{first});
    again.document().redo();
    again.settle();
    again.window.sessions().savePath(path("elsewhere.chainmail"));
    again.settle();
    again.save();
    QTRY_VERIFY(kept().isEmpty());
    QCOMPARE(read_session(path("elsewhere.chainmail").toStdString()).pins, std::vector<ElementId>{42});
  }

  void twoWindowsOnOneFile() {
    const QString file = path("both.chainmail");
    Workbench one(cloth());
    one.window.sessions().savePath(file);
    one.settle();
    edits::setPinned(one.document(), {3}, true);
    Session others = sessionOf(one);
    others.pins = {7};
    save_session(file.toStdString(), others);
    {
      const Answer cancel(QStringLiteral("Cancel"));
      one.trigger("saveSession");
      one.settle();
      QCOMPARE(cancel.questions, 1);
    }
    QCOMPARE(read_session(file.toStdString()).pins, std::vector<ElementId>{7});
    one.open(file);
    QCOMPARE(one.document().pins(), std::vector<ElementId>{7});
    edits::setPinned(one.document(), {8}, true);
    save_session(file.toStdString(), others);
    {
      const Answer overwrite(QStringLiteral("Overwrite"));
      one.trigger("saveSession");
      one.settle();
      QCOMPARE(overwrite.questions, 1);
    }
    QCOMPARE(read_session(file.toStdString()).pins, (std::vector<ElementId>{7, 8}));
    edits::setPinned(one.document(), {9}, true);
    one.trigger("saveSession");  // what this window has written is known to it
    one.settle();
    QCOMPARE(read_session(file.toStdString()).pins, (std::vector<ElementId>{7, 8, 9}));
  }

  void aComputationThatEndsIsNamed() {
    Workbench bench(generate({MeshKind::tetra, {8, 8, 8}, 1, {}}));
    edits::setPinned(bench.document(), {0, 1, 2, 3, 4, 5, 6, 7}, true);
    bench.settle();
    bench.window.jobs().start(Jobs::Kind::compute, QStringLiteral("Calibrating softness"),
                              [](const Progress& progress) -> Jobs::Finish {
                                for (;;) {
                                  progress.report(0.5);  // throws when it is cancelled
                                  QThread::yieldCurrentThread();
                                }
                              });
    bench.window.findChild<FileActions*>()->openSample(samplesFolder() + QStringLiteral("/torus.obj"));
    bench.settle();
    QCOMPARE(bench.window.messages().sentence(),
             QStringLiteral("'Calibrating softness' ended without a result, because 'Opening torus.obj' began"));
  }

  void unsavedWorkIsPrivate() {
    SafeBench bench;
    edits::setPinned(bench.document(), {3}, true);
    bench.save();
    QTRY_COMPARE(kept().size(), 1);
    QCOMPARE(modeOf(unsaved_work::folder()), 0700);
    const QDir folder(unsaved_work::folder());
    const QStringList files =
        folder.entryList({QStringLiteral("*.chainmail"), QStringLiteral("*.object-*")}, QDir::Files);
    QCOMPARE(files.size(), 2);
    for (const QString& name : files) {
      QCOMPARE(modeOf(folder.filePath(name)), 0600);
    }
  }

  void afterALessonTheSettingsAreTheUsersOwn() {
    Workbench bench;
    bench.trigger("showLinks");
    edits::setSoftness(bench.document(), {0.7, 1.3, 0.15}, QStringLiteral("softness"));
    bench.choose(0, "Spiral");
    const LinkSoftness own = bench.document().softness();
    for (const char* lesson : {"lesson1", "lesson2"}) {
      bench.trigger(lesson);
      bench.settle();
      bench.trigger("lessonNext");
      bench.settle();
    }
    bench.trigger("lessonClose");
    edits::replaceMesh(bench.document(), cloth(), QStringLiteral("cloth"), QStringLiteral("build"));
    bench.settle();
    QVERIFY(bench.document().softness() == own);
    QVERIFY(bench.document().algorithm(0) == Algorithm::spiral);
    QCOMPARE(bench.window.showMenu().chosen(), QStringLiteral("links"));
  }

  /// A session that was fitted is fitted again, with its positions.
  void aSessionOpensAsItWasSeen() {
    const QString file = path("seen.chainmail");
    {
      Workbench bench;
      drag(bench.document(), 31, {14, 9, 0});
      bench.settle();
      bench.trigger("fitView");
      bench.settle();
      QVERIFY(bench.window.area().showsAll());
      bench.window.sessions().savePath(file);
      bench.settle();
    }
    Workbench again;
    again.open(file);
    QTRY_VERIFY(again.window.area().showsAll());
    again.settleFigures();
    for (const QLabel* label : again.window.panel(0).findChildren<QLabel*>()) {
      QVERIFY(!label->text().contains(QStringLiteral("Nothing has moved")));
    }
  }

 private:
  QString path(const char* name) const { return folder_.filePath(QLatin1String(name)); }

  QTemporaryDir folder_;
};

CHAINMAIL_WINDOW_TEST(WindowLost)

}  // namespace chainmail::window_lost

#include "window_lost.moc"
