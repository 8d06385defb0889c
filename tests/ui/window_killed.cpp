// Kills a window again and again while it drags, and checks what the next start finds.

#include <QDateTime>
#include <QDir>
#include <QProcess>
#include <QPushButton>
#include <QRandomGenerator>
#include <csignal>
#include <sstream>

#include "document/edits.h"
#include "io/sessions.h"
#include "io/unsaved_work.h"
#include "session_bench.h"

namespace chainmail::window_killed {

namespace {

constexpr int stepMilliseconds = 40, movesOfAStep = 5;
constexpr qint64 promisedMilliseconds = 5000;  // of work that may be lost

std::string written(const Session& session) {
  std::ostringstream text;
  write_session(text, session);
  return text.str();
}

/// Drags without end. After each drag it pins one more element and prints the time, so that the number of pins tells
/// how much of the work is there.
int draggingProgram(int argc, char** argv) {
  prepareApplication();
  QTemporaryDir settings;
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, settings.path());
  Application application(argc, argv);
  styleApplication();
  Workbench bench(generate({MeshKind::grid, {60, 50, 1}, 1, {}}));
  bench.window.sessions().protect();
  Document& document = bench.document();
  const ElementId dragged = 1525;
  const Point rest = document.mesh()->rest_position(dragged);
  ElementId pinned = 0;
  int moves = 0;
  QTimer timer;
  QObject::connect(&timer, &QTimer::timeout, [&] {
    if (moves % movesOfAStep == 0) {
      document.handle().release();
      edits::setPinned(document, {pinned++}, true);
      std::printf("%lld\n", static_cast<long long>(QDateTime::currentMSecsSinceEpoch()));
      std::fflush(stdout);
      document.handle().grab(dragged);
    }
    document.handle().drag(rest + Point(6 * std::sin(0.3 * moves), 6 * std::cos(0.2 * moves), 0));
    ++moves;
  });
  timer.start(stepMilliseconds);
  return QApplication::exec();
}

}  // namespace

class WindowKilled : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  /// CHAINMAIL_KILLS is the number of rounds. Many take longer than Qt lets a test run (QTEST_FUNCTION_TIMEOUT).
  void littleWorkIsLost() {
    const int rounds = std::max(1, qEnvironmentVariableIntValue("CHAINMAIL_KILLS"));
    qint64 maxLost = 0;
    for (int round = 0; round < rounds; ++round) {
      QVERIFY(QDir(unsaved_work::folder()).removeRecursively());
      QProcess program;
      program.start(QApplication::applicationFilePath(), {QStringLiteral("window_killed"), QStringLiteral("--drag")});
      // A step takes about a fifth of a second: from before the first writing to after the third.
      const int steps = 20 + QRandomGenerator::global()->bounded(40);
      QByteArray said;
      QTRY_VERIFY_WITH_TIMEOUT((said += program.readAllStandardOutput()).count('\n') >= steps, 90'000);
      const qint64 killedAt = QDateTime::currentMSecsSinceEpoch();
      QVERIFY(::kill(pid_t(program.processId()), SIGKILL) == 0);
      QVERIFY(program.waitForFinished());
      const auto times = (said + program.readAllStandardOutput()).trimmed().split('\n');
      const QStringList found = unsaved_work::all();
      const std::size_t kept = found.isEmpty() ? 0 : unsaved_work::read(found.first()).pins.size();
      const qint64 lost = kept < std::size_t(times.size()) ? killedAt - times[qsizetype(kept)].toLongLong() : 0;
      maxLost = std::max(maxLost, lost);
      QVERIFY2(lost <= promisedMilliseconds, qPrintable(QStringLiteral("round %1: %2 ms").arg(round).arg(lost)));
      if (!found.isEmpty()) {
        opensAsItWasWritten(found.first());
      }
    }
    qInfo("%d kills, at most %lld ms of work lost", rounds, static_cast<long long>(maxLost));
  }

 private:
  static void opensAsItWasWritten(const QString& path) {
    Session kept = unsaved_work::read(path);
    kept.mesh_file.clear();
    Workbench bench;
    bench.window.sessions().protect();
    bench.find<QPushButton>("restoreWork")->click();
    bench.settle();
    Session restored = sessionOf(bench);
    restored.ui = kept.ui;  // the cameras fit another window
    QVERIFY(written(restored) == written(kept));
  }
};

namespace {

int runClass(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "--drag") {
    return draggingProgram(argc, argv);
  }
  return runWindowTest<WindowKilled>(argc, argv);
}

}  // namespace

CHAINMAIL_TEST_RUN(WindowKilled, runClass)

}  // namespace chainmail::window_killed

#include "window_killed.moc"
