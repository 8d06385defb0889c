// What a crash leaves of the work in a window, and what becomes of it.

#include <QDir>
#include <QFile>
#include <QProcess>
#include <QPushButton>
#include <csignal>

#include "autosave.h"
#include "message_bar.h"
#include "recovery_bar.h"
#include "session_bench.h"
#include "sessions.h"

using namespace chainmail;

namespace {

QStringList autosaved() { return QDir(Autosave::folder()).entryList({QStringLiteral("*.chainmail")}, QDir::Files); }

/// Works, says what there is when it is on the disk, and goes on until it is killed.
int crashingProgram(int argc, char** argv) {
  prepareApplication();
  QTemporaryDir settings;
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, settings.path());
  QApplication application(argc, argv);
  styleApplication();
  Workbench bench(cloth());
  bench.window.sessions().protect();
  bench.document().setSessionFile(QStringLiteral("/somewhere/mine.chainmail"));
  work(bench);
  save_session(argv[2], sessionOf(bench));
  std::puts("worked");
  std::fflush(stdout);
  return QApplication::exec();
}

}  // namespace

class WindowRecovery : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  void whatACrashLeftIsOffered() {
    const QString expected = folder_.filePath(QStringLiteral("expected.chainmail"));
    QProcess program;
    program.start(QApplication::applicationFilePath(), {QStringLiteral("--crash"), expected});
    QByteArray said;
    QTRY_VERIFY_WITH_TIMEOUT((said += program.readAllStandardOutput()).contains("worked"), 30000);
    QTest::qWait(5000);  // what is promised: no more is lost
    QVERIFY(::kill(pid_t(program.processId()), SIGKILL) == 0);
    QVERIFY(program.waitForFinished());
    QCOMPARE(autosaved().size(), 1);

    Workbench bench;
    bench.window.sessions().protect();
    QVERIFY(bench.window.sessions().recoveryBar().isVisible());
    bench.find<QPushButton>("restoreWork")->click();
    bench.settle();
    compare(sessionOf(bench), read_session(expected.toStdString()));
    QCOMPARE(bench.document().sessionFile(), QStringLiteral("/somewhere/mine.chainmail"));
    QVERIFY(bench.window.isWindowModified());
    QVERIFY(!bench.window.sessions().recoveryBar().isVisible());
    QCOMPARE(autosaved().size(), 1);  // this window's own: safe from the first moment
    {
      Workbench second;  // what a running window holds is nobody else's
      second.window.sessions().protect();
      QVERIFY(!second.window.sessions().recoveryBar().isVisible());
    }
    QCOMPARE(autosaved().size(), 1);
    bench.window.close();  // and still unsaved
    QTRY_VERIFY(autosaved().size() == 1 && Autosave::isClosed(autosaved().first()));
    const QString kept = QDir(Autosave::folder()).filePath(autosaved().first());
    QVERIFY(QFile::remove(kept));
  }

  void whatSeveralWindowsWereClosedOnIsAllThere() {
    for (const ElementId pinned : {3U, 4U}) {
      Workbench bench;
      bench.window.sessions().protect();
      bench.document().setPinned({pinned}, true);
      bench.settle();
      QVERIFY(bench.window.close());
    }
    Workbench again;
    again.window.sessions().protect();
    for (const ElementId pinned : {4U, 3U}) {  // the newest first
      again.find<QPushButton>("restoreWork")->click();
      again.settle();
      QCOMPARE(again.document().pins(), std::vector<ElementId>{pinned});
    }
    QVERIFY(!again.window.sessions().recoveryBar().isVisible());
  }

  void whatIsDiscardedIsGone() {
    for (const char* name : {"one.chainmail", "two.chainmail"}) {
      QFile file(QDir(Autosave::folder()).filePath(QLatin1String(name)));
      QVERIFY(file.open(QIODevice::WriteOnly) && file.write("{") > 0);
    }
    Workbench bench;
    const MeshPointer before = bench.document().mesh();
    bench.window.sessions().protect();
    auto& bar = bench.window.sessions().recoveryBar();
    QVERIFY(bar.isVisible());
    bench.find<QPushButton>("restoreWork")->click();  // damaged: a sentence, and it may still be discarded
    bench.settle();
    QVERIFY(bench.window.messages().isVisible() && bar.isVisible());
    QCOMPARE(bench.document().mesh(), before);
    bench.find<QPushButton>("discardWork")->click();
    QVERIFY(bar.isVisible());
    bench.find<QPushButton>("discardWork")->click();
    QVERIFY(!bar.isVisible());
    QCOMPARE(autosaved().size(), 0);
  }

  void workIsKeptSafeWhileThereIsSomeToLose() {
    const QString path = folder_.filePath(QStringLiteral("f.chainmail"));
    Workbench bench;
    bench.window.sessions().protect();
    auto* timer = bench.find<QTimer>("autosaveTimer");
    const auto passTime = [&] {
      timer->start(0);
      QTRY_VERIFY(!timer->isActive());
      bench.settle();
    };
    passTime();
    QCOMPARE(autosaved().size(), 0);  // nothing was done
    bench.document().setPinned({3}, true);
    QVERIFY(timer->isActive());
    passTime();
    QTRY_COMPARE(autosaved().size(), 1);
    QTRY_VERIFY(!timer->isActive());  // a still scene costs nothing
    const QString file = QDir(Autosave::folder()).filePath(autosaved().first());
    QCOMPARE(read_session(file.toStdString()).pins, std::vector<ElementId>{3});
    bench.window.sessions().savePath(path);
    bench.settle();
    passTime();
    QTRY_COMPARE(autosaved().size(), 0);
  }

 private:
  QTemporaryDir folder_;
};

int main(int argc, char** argv) {
  if (argc > 2 && std::string_view(argv[1]) == "--crash") {
    return crashingProgram(argc, argv);
  }
  return runWindowTest<WindowRecovery>(argc, argv);
}
#include "window_recovery.moc"
