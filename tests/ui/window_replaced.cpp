// Tests what happens to unsaved work when another object replaces it: it is kept, on every path.

#include <unistd.h>

#include <QDir>
#include <QDropEvent>
#include <QMenu>
#include <QMimeData>
#include <QProcess>
#include <QToolButton>
#include <csignal>
#include <functional>
#include <sstream>

#include "common/as_path.h"
#include "folders.h"
#include "io/samples.h"
#include "io/unsaved_work.h"
#include "safe_bench.h"
#include "window/bars.h"

namespace chainmail::window_replaced {

namespace {

using Open = std::function<void(Workbench&)>;

QStringList kept() { return QDir(unsaved_work::folder()).entryList({QStringLiteral("*.chainmail")}, QDir::Files); }

Session readKept(const QString& name) { return unsaved_work::read(QDir(unsaved_work::folder()).filePath(name)); }

/// Returns the text of the work in a session, without what the window shows.
std::string work(Session session) {
  session.ui.clear();
  session.mesh_file.clear();
  std::ostringstream text;
  write_session(text, session);
  return text.str();
}

void drop(Workbench& bench, const QUrl& url) {
  QMimeData data;
  data.setUrls({url});
  QDragEnterEvent enter(QPoint(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&bench.window, &enter);
  QDropEvent event(QPointF(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&bench.window, &event);
  bench.settle();
}

void press(Workbench& bench, const char* button) {
  bench.settle();
  bench.find<QPushButton>(button)->click();
  bench.settle();
}

/// Pins and drags, so that there is something to lose.
void change(Workbench& bench) {
  edits::setPinned(bench.document(), {3}, true);
  drag(bench.document(), 1, {0.4, 0.3, 0});
  bench.settle();
}

/// Drags, says so, and runs until it is ended. The move is not on the disk yet.
int endingProgram(int argc, char** argv) {
  prepareApplication();
  QTemporaryDir settings;
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, settings.path());
  Application application(argc, argv);
  styleApplication();
  Workbench bench;
  bench.window.sessions().protect();
  keepWorkAtTheEnd(bench.window);
  bench.find<QTimer>("autosaveTimer")->setInterval(3'600'000);
  change(bench);
  std::puts("dragged");
  std::fflush(stdout);
  return QApplication::exec();
}

}  // namespace

class WindowReplaced : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    QVERIFY(QDir(unsaved_work::folder()).removeRecursively());
    {
      SafeBench other;  // its work is offered to the next window
      edits::setPinned(other.document(), {7}, true);
      other.settle();
      QVERIFY(other.window.close());
    }
    bench_ = std::make_unique<SafeBench>();
    bench_->window.sessions().savePath(path("other.chainmail"));
    bench_->settle();
  }
  void init() { failOnWarnings(); }
  void cleanupTestCase() { bench_.reset(); }

  void unsavedWorkIsKept_data() {
    QTest::addColumn<Open>("open");
    const auto row = [](const char* name, Open open) { QTest::newRow(name) << std::move(open); };
    const auto opens = [&row](const char* name, const QString& file) {
      row(name, [file](Workbench& bench) { bench.open(file); });
    };
    opens("a session", path("other.chainmail"));
    opens("a mesh", sourceFile("meshes/cloth.obj"));
    row("a sample", [](Workbench& bench) {
      bench.find<QPushButton>("openSamples")->click();
      bench.find<QToolButton>("sample torus.obj")->click();
    });
    row("Build", [](Workbench& bench) { bench.find<QPushButton>("buildMesh")->click(); });
    row("a volume", [](Workbench& bench) {
      bench.open(sourceFile("meshes/phantom.nrrd"));
      press(bench, "volumeAgree");
    });
    opens("a sheet", sourceFile("meshes/face.png"));
    row("a drop", [](Workbench& bench) { drop(bench, QUrl::fromLocalFile(sourceFile("meshes/sphere.obj"))); });
    row("a lesson", [](Workbench& bench) { bench.trigger("lesson1"); });
    row("a recent file", [](Workbench& bench) {
      for (QMenu* menu : bench.window.findChildren<QMenu*>()) {
        if (menu->title() == QStringLiteral("Open &recent")) {
          menu->actions().first()->trigger();
        }
      }
    });
    row("restored work", [](Workbench& bench) { bench.find<QPushButton>("restoreWork")->click(); });
  }
  void unsavedWorkIsKept() {
    QFETCH(Open, open);
    Document& document = bench_->document();
    change(*bench_);
    bench_->save();
    const std::string before = work(sessionOf(*bench_));
    const MeshPointer mesh = document.mesh();
    const QStringList others = kept();
    if (QString(QTest::currentDataTag()) != QStringLiteral("restored work")) {  // it is where nothing can be read
      const FullDisk disk;
      const Answer cancel(QStringLiteral("Cancel"));
      open(*bench_);
      bench_->settle();
      QCOMPARE(cancel.questions, 1);
      QVERIFY(document.mesh() == mesh && work(sessionOf(*bench_)) == before);
    }
    open(*bench_);
    bench_->settle();
    QVERIFY(document.mesh() != mesh);
    bench_->save();
    QStringList now = kept();
    now.removeIf([&](const QString& name) { return others.contains(name) && !unsaved_work::isClosed(name); });
    int found = 0;
    for (const QString& name : now) {
      found += !others.contains(name) && work(readKept(name)) == before ? 1 : 0;
    }
    QCOMPARE(found, 1);
  }

  /// Undo returns to the work, and once it is saved, there is no other copy of it.
  void workIsKeptUntilItIsSaved() {
    bench_.reset();
    QVERIFY(QDir(unsaved_work::folder()).removeRecursively());
    SafeBench bench;
    change(bench);
    bench.open(sourceFile("meshes/cloth.obj"));
    QVERIFY(!bench.window.isWindowModified());
    QCOMPARE(kept().size(), 1);
    QTRY_VERIFY(bench.window.messages().sentence().startsWith(QStringLiteral("Your unsaved work is kept")));
    bench.document().undo();
    bench.save();
    QVERIFY(bench.window.isWindowModified());
    bench.window.sessions().savePath(path("elsewhere.chainmail"));
    bench.settle();
    bench.save();
    QCOMPARE(kept(), QStringList());
  }

  void workThatCannotBeKeptMayBeDiscarded() {
    bench_.reset();
    QVERIFY(QDir(unsaved_work::folder()).removeRecursively());
    SafeBench bench;
    change(bench);
    const MeshPointer mesh = bench.document().mesh();
    const FullDisk disk;
    const Answer discard(QStringLiteral("Discard"));
    bench.open(sourceFile("meshes/cloth.obj"));
    QCOMPARE(discard.questions, 1);
    QVERIFY(bench.document().mesh() != mesh);
  }

  void aDropFromElsewhereGetsASentence() {
    Workbench bench;
    const MeshPointer mesh = bench.document().mesh();
    drop(bench, QUrl(QStringLiteral("https://example.org/mesh.obj")));
    QCOMPARE(bench.window.messages().sentence(),
             QStringLiteral("https://example.org/mesh.obj: it is not a file of this computer; save it to a file first, "
                            "then drop that file"));
    drop(bench, QUrl(QStringLiteral("file://server/mesh.obj")));
    QVERIFY(bench.window.messages().sentence().startsWith(QStringLiteral("file://server/mesh.obj: it is not")));
    QVERIFY(bench.document().mesh() == mesh);
    drop(bench, QUrl(QStringLiteral("file://localhost") + sourceFile("meshes/sphere.obj")));
    QCOMPARE(bench.document().name(), QStringLiteral("sphere.obj"));
  }

  /// A name that is not UTF-8, and one with a line end.
  void unusualNames_data() {
    QTest::addColumn<QByteArray>("name");
    QTest::addColumn<QString>("shown");
    QTest::newRow("not UTF-8") << QByteArray("caf\xe9") << QStringLiteral("caf\\xe9");
    QTest::newRow("two lines") << QByteArray("a\nb") << QStringLiteral("a\\x0ab");
  }
  void unusualNames() {
    QFETCH(QByteArray, name);
    QFETCH(QString, shown);
    const std::string folder = folder_.path().toStdString() + "/";
    const std::filesystem::path mesh = folder + name.toStdString() + ".obj",
                                session = folder + name.toStdString() + ".chainmail";
    std::filesystem::copy_file(sourceFile("meshes/cloth.obj").toStdString(), mesh);
    Workbench bench;
    drop(bench, QUrl::fromEncoded("file://" + QByteArray::fromStdString(mesh.string()).toPercentEncoding("/")));
    QCOMPARE(bench.document().name(), shown + QStringLiteral(".obj"));
    QVERIFY(bench.window.windowTitle().startsWith(shown));
    edits::setPinned(bench.document(), {3}, true);
    bench.window.sessions().savePath(pathOf(QByteArray::fromStdString(session.string())));
    bench.settle();
    QVERIFY(std::filesystem::exists(session));
    QVERIFY(bench.window.windowTitle().startsWith(shown + QStringLiteral(".chainmail")));
    bench.trigger("saveSession");  // to the same file
    bench.settle();
    Workbench again;
    for (QMenu* menu : again.window.findChildren<QMenu*>()) {
      if (menu->title() == QStringLiteral("Open &recent")) {
        QVERIFY(menu->actions().first()->text().contains(shown + QStringLiteral(".chainmail")));
        menu->actions().first()->trigger();
      }
    }
    again.settle();
    QCOMPARE(again.document().pins(), std::vector<ElementId>{3});
  }

  void theLastDragIsKeptAtTheEnd_data() {
    QTest::addColumn<int>("signal");
    QTest::newRow("SIGTERM") << SIGTERM;
    QTest::newRow("SIGHUP") << SIGHUP;
    QTest::newRow("a lost display") << 0;
  }
  void theLastDragIsKeptAtTheEnd() {
    QFETCH(int, signal);
    bench_.reset();
    QVERIFY(QDir(unsaved_work::folder()).removeRecursively());
    QProcess display, program;
    if (signal == 0) {
      // A number that neither another test nor with_display has, for its reason.
      display.start(QStringLiteral("Xvfb"),
                    {QStringLiteral(":%1").arg(50'100 + ::getpid() % 9'000), QStringLiteral("-displayfd"),
                     QStringLiteral("1"), QStringLiteral("-screen"), QStringLiteral("0"), QStringLiteral("1600x900x24"),
                     QStringLiteral("-nolisten"), QStringLiteral("tcp")});
      QTRY_VERIFY(display.canReadLine());
      auto environment = QProcessEnvironment::systemEnvironment();
      environment.insert(QStringLiteral("DISPLAY"),
                         QLatin1Char(':') + QString::fromLatin1(display.readLine().trimmed()));
      program.setProcessEnvironment(environment);
    }
    program.start(QApplication::applicationFilePath(), {QStringLiteral("window_replaced"), QStringLiteral("--end")});
    QTRY_VERIFY_WITH_TIMEOUT(program.canReadLine(), Workbench::longestWait);
    QCOMPARE(kept(), QStringList());  // nothing is on the disk before
    signal == 0 ? display.kill() : void(::kill(pid_t(program.processId()), signal));
    QVERIFY(program.waitForFinished());
    display.waitForFinished();
    QCOMPARE(kept().size(), 1);
    const Session session = readKept(kept().first());
    QCOMPARE(session.pins, std::vector<ElementId>{3});
    QVERIFY(!session.panels.front().positions.is_at_rest());
  }

 private:
  QString path(const char* name) const { return folder_.filePath(QLatin1String(name)); }

  QTemporaryDir folder_;
  std::unique_ptr<SafeBench> bench_;
};

namespace {

int runClass(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "--end") {
    return endingProgram(argc, argv);
  }
  return runWindowTest<WindowReplaced>(argc, argv);
}

}  // namespace

CHAINMAIL_TEST_RUN(WindowReplaced, runClass)

}  // namespace chainmail::window_replaced

#include "window_replaced.moc"
