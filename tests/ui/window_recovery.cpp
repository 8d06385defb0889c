// Tests the work that a crash or a closed window leaves, and its recovery.

#include <sys/stat.h>

#include <QAction>
#include <QComboBox>
#include <QDateTime>
#include <QDir>
#include <QDockWidget>
#include <QFile>
#include <QJsonDocument>
#include <QJsonValue>
#include <QLabel>
#include <QProcess>
#include <QPushButton>
#include <csignal>
#include <future>
#include <sstream>

#include "document/edits.h"
#include "io/autosave.h"
#include "io/sessions.h"
#include "io/unsaved_work.h"
#include "mesh/error.h"
#include "session_bench.h"
#include "window/bars.h"

namespace chainmail::window_recovery {

namespace {

QStringList autosaved() { return QDir(unsaved_work::folder()).entryList({QStringLiteral("*.chainmail")}, QDir::Files); }

/// Returns the files of objects. A file that is written again gets another number of the file system.
std::vector<std::pair<QString, ino_t>> objects() {
  std::vector<std::pair<QString, ino_t>> found;
  for (const QFileInfo& file :
       QDir(unsaved_work::folder()).entryInfoList({QStringLiteral("*.object-*")}, QDir::Files)) {
    struct stat facts {};
    ::stat(qPrintable(file.filePath()), &facts);
    found.emplace_back(file.fileName(), facts.st_ino);
  }
  return found;
}

QString inFolder(const char* name) { return QDir(unsaved_work::folder()).filePath(QLatin1String(name)); }

/// Returns the work on the disk as the next start would find it; empty unless there is exactly one file.
std::optional<Session> workOnDisk() {
  const QStringList files = autosaved();
  try {
    return files.size() == 1 ? std::optional(unsaved_work::read(inFolder(qPrintable(files.first())))) : std::nullopt;
  } catch (const Error&) {
    return std::nullopt;  // removed at this moment
  }
}

/// Returns the file that has the object, as the work on the disk names it; empty if the work has the object itself.
QString objectOfWork() {
  QFile file(inFolder(qPrintable(autosaved().value(0))));
  const QByteArray text = file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
  return QJsonDocument::fromJson(text)[QStringLiteral("mesh")][QStringLiteral("file")].toString();
}

/// Writes a file into the folder of saved work, with this age in seconds.
void put(const char* name, const QByteArray& text, int secondsAgo) {
  QFile file(inFolder(name));
  QVERIFY(file.open(QIODevice::ReadWrite | QIODevice::Truncate) && file.write(text) == text.size() && file.flush());
  QVERIFY(file.setFileTime(QDateTime::currentDateTime().addSecs(-secondsAgo), QFileDevice::FileModificationTime));
}

/// Returns the text of a session. Two sessions are equal if their texts are.
std::string written(const Session& session) {
  std::ostringstream text;
  write_session(text, session);
  return text.str();
}

/// A workbench with automatic saving. The test starts its timer.
struct SafeBench : Workbench {
  SafeBench() { protect(); }
  explicit SafeBench(const MeshPointer& mesh) : Workbench(mesh) { protect(); }

  void protect() {
    window.sessions().protect();
    timer = find<QTimer>("autosaveTimer");
  }
  RecoveryBar& bar() { return window.sessions().recoveryBar(); }

  /// True if the next start would find exactly the current work.
  bool isSafe() {
    const auto onDisk = workOnDisk();
    return onDisk && written(*onDisk) == written(sessionOf(*this));
  }
  /// Waits until the current work is on the disk and no more writing is pending.
  void save() {
    for (int panel = 0; panel < document().panels(); ++panel) {
      // No frame follows this one for some time.
      QTRY_VERIFY(document().solvers().frame(panel)->statistics.violation.is_whole);
    }
    do {
      settle();
      timer->start(0);
      QTRY_VERIFY(!timer->isActive());
      QTRY_VERIFY(isSafe());
      settle();  // the window also knows that it is written
    } while (timer->isActive());
  }

  QTimer* timer = nullptr;
};

/// Changes an object, writes the expected session to a file, and runs until it is killed.
int crashingProgram(int argc, char** argv) {
  prepareApplication();
  QTemporaryDir settings;
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, settings.path());
  Application application(argc, argv);
  styleApplication();
  Workbench bench(cloth());
  bench.window.sessions().protect();
  bench.document().files().setSession(QStringLiteral("/somewhere/mine.chainmail"));
  changeEverything(bench);
  save_session(argv[2], sessionOf(bench));
  std::puts("worked");
  std::fflush(stdout);
  return QApplication::exec();
}

}  // namespace

class WindowRecovery : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    failOnWarnings();
    QVERIFY(QDir(unsaved_work::folder()).removeRecursively());
  }

  void whatACrashLeftIsOffered() {
    const QString expected = folder_.filePath(QStringLiteral("expected.chainmail"));
    QProcess program;
    program.start(QApplication::applicationFilePath(),
                  {QStringLiteral("window_recovery"), QStringLiteral("--crash"), expected});
    QByteArray said;
    QTRY_VERIFY_WITH_TIMEOUT((said += program.readAllStandardOutput()).contains("worked"), 30000);
    const std::string worked = written(read_session(expected.toStdString()));
    const auto onDisk = [] {
      const auto session = workOnDisk();
      return session ? written(*session) : std::string();
    };
    QTRY_VERIFY_WITH_TIMEOUT(onDisk() == worked, 30000);
    QVERIFY(::kill(pid_t(program.processId()), SIGKILL) == 0);
    QVERIFY(program.waitForFinished());
    QCOMPARE(autosaved().size(), 1);
    const QString left = autosaved().first();

    Workbench bench;
    bench.window.sessions().protect();
    QVERIFY(bench.window.sessions().recoveryBar().isVisible());
    bench.find<QPushButton>("restoreWork")->click();
    bench.settle();
    compare(sessionOf(bench), read_session(expected.toStdString()));
    QCOMPARE(bench.document().files().session(), QStringLiteral("/somewhere/mine.chainmail"));
    QVERIFY(bench.window.isWindowModified());
    QVERIFY(!bench.window.sessions().recoveryBar().isVisible());
    QVERIFY(autosaved().contains(left));  // until the user has saved it, or the window keeps it
    {
      Workbench second;  // another window must not offer the work of a running one
      second.window.sessions().protect();
      QVERIFY(!second.window.sessions().recoveryBar().isVisible());
    }
    bench.window.close();  // without saving
    QTRY_VERIFY(autosaved().size() == 1 && unsaved_work::isClosed(autosaved().first()));
    const QString kept = QDir(unsaved_work::folder()).filePath(autosaved().first());
    QVERIFY(QFile::remove(kept));
  }

  void whatSeveralWindowsWereClosedOnIsAllThere() {
    for (const ElementId pinned : {3U, 4U}) {
      Workbench bench;
      bench.window.sessions().protect();
      edits::setPinned(bench.document(), {pinned}, true);
      bench.settle();
      QVERIFY(bench.window.close());
    }
    Workbench again;
    again.window.sessions().protect();
    for (const ElementId pinned : {4U, 3U}) {  // the newest work first
      again.find<QPushButton>("restoreWork")->click();
      again.settle();
      QCOMPARE(again.document().pins(), std::vector<ElementId>{pinned});
    }
    QVERIFY(!again.window.sessions().recoveryBar().isVisible());
  }

  void whatIsDiscardedIsGone() {
    for (const char* name : {"one.chainmail", "two.chainmail"}) {
      QFile file(QDir(unsaved_work::folder()).filePath(QLatin1String(name)));
      QVERIFY(file.open(QIODevice::WriteOnly) && file.write("{") > 0);
    }
    Workbench bench;
    const MeshPointer before = bench.document().mesh();
    bench.window.sessions().protect();
    auto& bar = bench.window.sessions().recoveryBar();
    QVERIFY(bar.isVisible());
    // The file is damaged: a message, and the user can still discard it.
    bench.find<QPushButton>("restoreWork")->click();
    bench.settle();
    QVERIFY(bench.window.messages().isVisible() && bar.isVisible());
    QCOMPARE(bench.document().mesh(), before);
    bench.find<QPushButton>("discardWork")->click();
    QVERIFY(bar.isVisible());
    bench.find<QPushButton>("discardWork")->click();
    QVERIFY(!bar.isVisible());
    QCOMPARE(autosaved().size(), 2);  // until the window closes
    bench.trigger("takeBackWork");
    QVERIFY(bar.isVisible());
    bench.find<QPushButton>("discardWork")->click();
    QVERIFY(bench.window.close());
    QCOMPARE(autosaved().size(), 1);
  }

  /// A crash comes before closed windows, and its start does not say when it was.
  void theNewestCrashIsOfferedFirst() {
    put("1-a.chainmail", "{", 1'000);
    put("2-b.closed-7.chainmail", "{", 500);
    put("3-c.chainmail", "{", 10'000);
    Workbench bench;
    bench.window.sessions().protect();
    QStringList offered;
    connect(&bench.window.sessions().recoveryBar(), &RecoveryBar::restoreRequested, this,
            [&](const QString& path) { offered << QFileInfo(path).fileName(); });
    const auto text = [&] { return bench.find<QLabel>("recovery")->text(); };
    const QDateTime newest = QFileInfo(inFolder("1-a.chainmail")).lastModified();
    QVERIFY2(text().contains(QLocale().toString(newest, QLocale::ShortFormat)), qPrintable(text()));
    for (int i = 0; i < 3; ++i) {
      bench.find<QPushButton>("restoreWork")->click();
      bench.settle();
      bench.find<QPushButton>("discardWork")->click();
    }
    QCOMPARE(offered, (QStringList{QStringLiteral("1-a.chainmail"), QStringLiteral("3-c.chainmail"),
                                   QStringLiteral("2-b.closed-7.chainmail")}));
  }

  void workIsKeptSafeWhileThereIsSomeToLose() {
    const QString path = folder_.filePath(QStringLiteral("f.chainmail"));
    SafeBench bench;
    bench.timer->start(0);
    QTRY_VERIFY(!bench.timer->isActive());
    QCOMPARE(autosaved().size(), 0);  // because nothing was changed
    edits::setPinned(bench.document(), {3}, true);
    QVERIFY(bench.timer->isActive());
    QVERIFY(bench.timer->remainingTime() <= 4500);  // short enough for what is promised
    bench.save();
    QVERIFY(!bench.timer->isActive());  // nothing runs while nothing changes
    QCOMPARE(workOnDisk()->pins, std::vector<ElementId>{3});
    edits::setPinned(bench.document(), {4}, true);
    QVERIFY(bench.timer->isActive() && bench.timer->remainingTime() <= 4500);
    bench.window.sessions().savePath(path);
    bench.settle();
    bench.timer->start(0);
    QTRY_COMPARE(autosaved().size(), 0);
  }

  /// Tests every kind of edit, each after saving. Most of them move no element.
  void everyKindOfEditIsOnTheDiskWithinFiveSeconds() {
    SafeBench bench(generate({MeshKind::tetra, {4, 3, 3}, 1, {}}));
    Document& document = bench.document();
    edits::setPinned(document, {0}, true);
    bench.save();
    const std::vector<std::pair<const char*, std::function<void()>>> edits{
        {"a pin",
         [&] {
           edits::setPinned(document, {5, 6}, true);
         }},
        {"no pin", [&] { edits::setPinned(document, {5}, false); }},
        {"a cut", [&] { edits::cut(document, {3}); }},
        {"undo", [&] { bench.trigger("undo"); }},
        {"redo", [&] { bench.trigger("redo"); }},
        {"softness",
         [&] {
           edits::setSoftness(document, {0.9, 1.2, 0.1}, QStringLiteral("softness"), 7);
         }},
        {"more of a slider's gesture",
         [&] {
           edits::setSoftness(document, {0.9, 1.3, 0.1}, QStringLiteral("softness"), 7);
         }},
        {"softness of links",
         [&] {
           edits::setSoftnessOf(document, {2, 7}, LinkSoftness{0.5, 2, 1});
         }},
        {"relaxation",
         [&] {
           edits::setRelaxation(document, {false, 0.5, RelaxationScheme::link});
         }},
        {"material",
         [&] {
           edits::setElastic(document, {{2, 0.4}, {4, 4, 4}}, QStringLiteral("material"));
         }},
        {"lattice",
         [&] {
           edits::setElastic(document, {{2, 0.4}, {3, 4, 5}}, QStringLiteral("lattice"));
         }},
        {"an algorithm", [&] { bench.choose(1, "Spiral"); }},
        {"a drag",
         [&] {
           drag(document, 20, {0.4, -0.3, 0.2});
         }},
        {"a drag to where the element is", [&] { drag(document, 1, Point::Zero()); }},
        {"back in what was done", [&] { document.moves().goTo(document.moves().history().length() - 3); }},
        {"other moves",
         [&] {
           const std::vector<Command> moves{commands::Pin{{1}}};
           document.moves().load(std::make_shared<const std::vector<Command>>(moves), QStringLiteral("open moves"));
         }},
        {"reset", [&] { bench.trigger("resetObject"); }},
        {"one panel more", [&] { bench.trigger("addPanel"); }},
        {"one panel less", [&] { bench.trigger("removePanel"); }},
        {"cameras apart", [&] { bench.trigger("linkCameras"); }},
        {"one camera turned",
         [&] {
           bench.view(1).orbit({30, 10});
         }},
        {"parallel rays", [&] { bench.view(0).setParallel(true); }},
        {"other colours", [&] { bench.trigger("colourBy-violation"); }},
        {"links shown", [&] { bench.trigger("showLinks"); }},
        {"a section", [&] { bench.trigger("section"); }},
        {"a dock closed", [&] { bench.find<QDockWidget>("relaxationDock")->close(); }},
    };
    for (const auto& [name, edit] : edits) {
      QTRY_VERIFY2(!bench.timer->isActive(), name);
      const std::string before = written(sessionOf(bench));
      bench.timer->setInterval(4000);  // the longest waiting time
      edit();
      QTRY_VERIFY2(bench.timer->isActive(), name);
      QVERIFY2(bench.timer->remainingTime() <= 4500, name);
      bench.settle();
      QVERIFY2(written(sessionOf(bench)) != before, name);
      bench.save();
      QVERIFY2(bench.isSafe(), name);
    }
  }

  void theObjectIsWrittenOnlyWhenItChanges() {
    SafeBench bench;
    edits::setPinned(bench.document(), {3}, true);
    bench.save();
    const auto first = objects();
    QCOMPARE(first.size(), std::size_t{1});
    QCOMPARE(objectOfWork(), first.front().first);  // the work names it, and does not write it again
    edits::setPinned(bench.document(), {4}, true);
    bench.save();
    QCOMPARE(objects(), first);
    edits::reworkMesh(bench.document(), generate({MeshKind::grid, {5, 5, 1}, 1, {}}), QStringLiteral("grid"),
                      QStringLiteral("repair"));
    bench.settle();
    bench.save();
    QCOMPARE(objects().size(), std::size_t{1});
    QVERIFY(objects() != first);
    bench.window.sessions().savePath(folder_.filePath(QStringLiteral("saved.chainmail")));
    bench.settle();
    bench.timer->start(0);
    QTRY_VERIFY(autosaved().isEmpty() && objects().empty());
    edits::setPinned(bench.document(), {5}, true);
    bench.save();
    QCOMPARE(objects().size(), std::size_t{1});  // it is needed again
  }

  void anObjectWithoutWorkIsRemoved() {
    put("crashed.object-1", "{}", 60);
    put("another.object-2", "{}", 60);
    put("another.closed-1.chainmail", "{}", 60);
    SafeBench bench;
    QCOMPARE(objects().size(), std::size_t{1});
    QCOMPARE(objects().front().first, QStringLiteral("another.object-2"));
    bench.find<QPushButton>("discardWork")->click();
    QVERIFY(bench.window.close());
    QVERIFY(objects().empty());
  }

  /// The change comes while the writer waits for the positions of the first panel, and nothing else changes afterwards:
  /// a camera makes no frame.
  void whatIsDoneWhileItIsWrittenIsWrittenToo() {
    SafeBench bench;
    edits::setPinned(bench.document(), {3}, true);
    bench.save();
    std::promise<void> gate;
    bench.document().solvers().ask(0, [opened = gate.get_future().share()](const Simulation&) { opened.wait(); });
    bench.trigger("linkCameras");
    bench.timer->start(0);
    const auto* autosave = bench.window.findChild<Autosave*>();
    QTRY_VERIFY(autosave->isWriting());
    bench.view(0).setParallel(true);
    QVERIFY(autosave->isWriting() && !bench.timer->isActive());
    gate.set_value();
    QTRY_VERIFY(!autosave->isWriting());
    QVERIFY(bench.timer->isActive());
    bench.timer->start(0);
    QTRY_VERIFY(bench.isSafe());
  }

  /// Only the newest files of closed windows are kept. The clock does not say which work is new: it may go back.
  void theOldestOfClosedWindowsWorkMakesRoom_data() {
    QTest::addColumn<int>("secondsAgo");
    QTest::newRow("a minute ago") << 60;
    QTest::newRow("three days ahead") << -3 * 24 * 3600;
  }
  void theOldestOfClosedWindowsWorkMakesRoom() {
    QFETCH(int, secondsAgo);
    for (int number = 1; number <= unsaved_work::maxClosed; ++number) {
      put(qPrintable(QStringLiteral("%1-a.closed-%1.chainmail").arg(number)), "{", secondsAgo + number);
    }
    {
      SafeBench bench;
      edits::setPinned(bench.document(), {42}, true);
      bench.settle();
      QVERIFY(bench.window.close());
    }
    QCOMPARE(autosaved().size(), unsaved_work::maxClosed);
    QVERIFY(!autosaved().contains(QStringLiteral("1-a.closed-1.chainmail")));
    SafeBench again;
    again.find<QPushButton>("restoreWork")->click();
    again.settle();
    QCOMPARE(again.document().pins(), std::vector<ElementId>{42});  // the newest is offered first
    for (int i = 1; i < unsaved_work::maxClosed; ++i) {
      again.find<QPushButton>("discardWork")->click();
    }
    QVERIFY(!again.bar().isVisible());
  }

  /// While another window runs, its work is not offered or removed, even before its first save.
  void whatAnotherWindowIsWritingIsLeftAlone() {
    put(".chainmail-1.tmp", "half", 60);    // from a running program
    put(".chainmail-2.tmp", "half", 3600);  // from a crash
    SafeBench living;                       // has no file on the disk yet
    QVERIFY(!anotherIsOfferedSomething());
    QVERIFY(QFile::exists(inFolder(".chainmail-1.tmp")));
    QVERIFY(!QFile::exists(inFolder(".chainmail-2.tmp")));
    edits::setPinned(living.document(), {3}, true);
    living.save();
    QVERIFY(!anotherIsOfferedSomething());
    QVERIFY(living.isSafe());
  }

 private:
  static bool anotherIsOfferedSomething() {
    const auto another = std::make_unique<SafeBench>();
    return another->bar().isVisible();
  }

  QTemporaryDir folder_;
};

namespace {

int runClass(int argc, char** argv) {
  if (argc > 2 && std::string_view(argv[1]) == "--crash") {
    return crashingProgram(argc, argv);
  }
  return runWindowTest<WindowRecovery>(argc, argv);
}

}  // namespace

CHAINMAIL_TEST_RUN(WindowRecovery, runClass)

}  // namespace chainmail::window_recovery

#include "window_recovery.moc"
