// Tests the window with an object of a million elements and too little memory: the test starts itself as a child under
// a limit of address space, as `ulimit -v` sets it. At every limit, the child goes on, or ends with a sentence; and the
// work that it had saved automatically can be opened.
//
//   with_display test_window_memory                       some limits
//   with_display test_window_memory --all [FROM TO STEP]  all limits, in MB, as a table
//   with_display test_window_memory --work [FOLDER]       the child

#include <sys/resource.h>

#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QProcess>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <string_view>

#include "common/last_words.h"
#include "document/edits.h"
#include "drawing/prepared_levels.h"
#include "io/file_actions.h"
#include "io/sessions.h"
#include "io/unsaved_work.h"
#include "mesh/error.h"
#include "mesh/failure.h"
#include "window.h"
#include "window/message_bar.h"

using namespace chainmail;

namespace {

constexpr std::uint32_t width = 1000;  // elements: a million
constexpr ElementId pinned = 4242, grabbed = 500'500;
constexpr LinkId firstCut = 300'000, cuts = 100;
constexpr int patience = 60'000;  // milliseconds for one step of the child
constexpr int patienceForPicture = 2'000;
constexpr quint64 megabyte = 1024 * 1024;

void say(const char* kind, const QString& text = {}) {
  std::printf("%s %s\n", kind, qPrintable(text));
  std::fflush(stdout);
}

/// Returns the most address space that this process has had, in MB.
quint64 largestSpace() {
  QFile status(QStringLiteral("/proc/self/status"));
  if (!status.open(QIODevice::ReadOnly)) {
    return 0;
  }
  const QByteArray text = status.readAll();
  return text.mid(text.indexOf("VmPeak:") + 7).trimmed().split(' ').first().toULongLong() / 1024;
}

/// Returns the file by which the parent tells the child to go on.
QString goFile(const QString& folder) { return QDir(folder).filePath(QStringLiteral("go")); }

/// Works like a user, step by step, and says what it has done and each sentence that the window shows.
class Child {
 public:
  explicit Child(const QString& folder)
      : folder_(folder), window_(generate({MeshKind::grid, {9, 7, 1}, 1, {}}), QStringLiteral("sample")) {
    const auto sentence = [](const QString& text) { say("sentence", text); };
    QObject::connect(&window_.jobs(), &Jobs::failed, sentence);
    QObject::connect(&document(), &Document::refused, sentence);
    QObject::connect(window_.findChild<FileActions*>(), &FileActions::failed, sentence);  // also of automatic saving
    QObject::connect(&window_.area(), &PanelArea::failed, sentence);
    QObject::connect(Application::get(), &Application::failed, sentence);
    window_.show();
    window_.sessions().protect();
  }

  void work() {
    step(
        "window", [] {}, [] { return true; });
    step(
        "object", [this] { build(); }, [this] { return !window_.jobs().running(); });
    if (document().mesh()->element_count() < width * width) {
      return;  // the sentence says why
    }
    step("pin", [this] { edits::setPinned(document(), {pinned}, true); });
    step("drag", [this] { drag({200, -300, 0}); });
    step("cut", [this] { cut(); });
    keep();
    step("panel", [this] { document().addPanel(); });
    step("colours", [this] { window_.findChild<QAction*>(QStringLiteral("colourBy-violation"))->trigger(); });
    step("select", [this] { selectAll(); });
    step("relax", [this] { edits::setRelaxation(document(), {true, 1, RelaxationScheme::equilibrium}); });
    step("drag again", [this] { drag({-100, 200, 0}); });
    step("undo", [this] { document().undo(); });
    step("redo", [this] { document().redo(); });
    step("panel less", [this] { document().removePanel(); });
    step(
        "save", [this] { window_.sessions().savePath(QDir(folder_).filePath(QStringLiteral("saved.chainmail"))); },
        [this] { return !window_.jobs().running(); });
  }

 private:
  Document& document() { return window_.document(); }

  /// Does something in an event, as a user does, and waits until the window and the solvers have followed.
  void step(const char* name, const std::function<void()>& act, const std::function<bool()>& isDone = {}) {
    bool begun = false;
    QTimer::singleShot(0, &window_, [&] {
      begun = true;
      act();
    });
    const bool ended =
        QTest::qWaitFor([&] { return begun && (isDone ? isDone() : document().solvers().idle()); }, patience);
    awaitPicture();
    say(ended ? "did" : "waited", QStringLiteral("%1 (%2 MB)").arg(QLatin1String(name)).arg(largestSpace()));
  }

  /// Lets the window paint. Without memory, the picture may never come, and then nothing waits for it.
  void awaitPicture() {
    View& view = window_.panel(0).view();
    bool isShown = false;
    QObject context;
    QObject::connect(&view, &QOpenGLWidget::frameSwapped, &context, [&] { isShown = true; });
    view.update();
    static_cast<void>(QTest::qWaitFor([&] { return isShown; }, patienceForPicture));
  }

  void build() {
    window_.jobs().start(
        Jobs::Kind::load, QStringLiteral("Building"), [this](const Progress& progress) -> Jobs::Finish {
          const MeshPointer mesh = generate({MeshKind::grid, {width, width, 1}, 1, {}}, progress.part(0, 0.8));
          prepareLevels(mesh, progress.part(0.8, 1));
          return
              [this, mesh] { edits::replaceMesh(document(), mesh, QStringLiteral("large"), QStringLiteral("build")); };
        });
  }

  void drag(const Point& by) {
    document().handle().grab(grabbed);
    for (int i = 1; i <= 5; ++i) {
      document().handle().drag(document().mesh()->rest_position(grabbed) + by * i / 5);
    }
    document().handle().release();
  }

  void cut() {
    std::vector<LinkId> links(cuts);
    std::iota(links.begin(), links.end(), firstCut);
    edits::cut(document(), links);
  }

  void selectAll() {
    std::vector<ElementId> all(document().mesh()->element_count());
    std::iota(all.begin(), all.end(), ElementId{0});
    document().selection().set(std::move(all));
  }

  /// Waits until the parent has seen that the work was saved automatically, or has given up.
  void keep() {
    window_.findChild<QTimer*>(QStringLiteral("autosaveTimer"))->start(0);
    say("edited");
    step(
        "wait for automatic saving", [] {}, [this] { return QFile::exists(goFile(folder_)); });
  }

  QString folder_;
  MainWindow window_;
};

int runChild(int argc, char** argv) {
  prepareLastWords();
  if (const QString why = whyNoMemory(); !why.isEmpty()) {
    say("sentence", why);
    return 2;
  }
  prepareApplication();
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, QLatin1String(argv[2]));
  try {
    Application application(argc, argv);
    styleApplication();
    if (const QString why = whyNoWindow(); !why.isEmpty()) {
      say("sentence", why);
      return 2;
    }
    Child child(QString::fromLocal8Bit(argv[2]));
    child.work();
  } catch (...) {
    say("sentence", QString::fromStdString(failure_sentence("window")));
    return 2;
  }
  say("end");
  return 0;
}

/// How a child has ended.
struct Outcome {
  quint64 limit = 0;  // MB; 0: none
  QString steps;      // the last step that it did, and with how much address space
  QString sentence;   // the first that it said, or the last line of its errors
  QString end;
  bool isWhole = false;     // it worked to the end
  bool isEdited = false;    // it had work to lose
  bool isKept = false;      // its work was saved automatically while it ran
  bool opensAgain = false;  // that work can be opened, with all edits
};

/// Returns true if the unsaved work in a folder has the pin, the cuts and the drag of the child's edits: its positions,
/// or the moves that lead to them.
bool hasWork(const QString& folder) {
  qputenv("XDG_DATA_HOME", folder.toUtf8());
  for (const QString& name : QDir(unsaved_work::folder()).entryList({QStringLiteral("*.chainmail")}, QDir::Files)) {
    try {
      const Session session = unsaved_work::read(QDir(unsaved_work::folder()).filePath(name));
      return session.mesh->element_count() == width * width && session.pins == std::vector<ElementId>{pinned} &&
             session.cuts.size() >= cuts && (!session.panels.front().positions.is_at_rest() || session.moves_done > 0);
    } catch (const Error&) {
      return false;  // just being replaced
    }
  }
  return false;
}

void take(Outcome& outcome, const QByteArray& said) {
  for (const QByteArray& line : said.split('\n')) {
    const QString text = QString::fromUtf8(line.mid(line.indexOf(' ') + 1));
    if (line.startsWith("did ") || line.startsWith("waited ")) {
      outcome.steps = text;
    } else if (line.startsWith("sentence ") && outcome.sentence.isEmpty()) {
      outcome.sentence = text;
    } else if (line.startsWith("edited")) {
      outcome.isEdited = true;
    } else if (line.startsWith("end")) {
      outcome.isWhole = true;
    }
  }
}

/// Waits until a child ends; when it has edited, until its work is saved or it says why not. Returns what it said.
QByteArray attend(QProcess& child, const QString& folder, Outcome& outcome) {
  QByteArray said;
  QElapsedTimer waits;
  while (child.state() != QProcess::NotRunning) {
    child.waitForFinished(100);
    said += child.readAllStandardOutput();
    if (!said.contains("\nedited") || QFile::exists(goFile(folder))) {
      continue;
    }
    if (!waits.isValid()) {
      waits.start();
    }
    outcome.isKept = hasWork(folder);
    if (outcome.isKept || said.contains("Automatic saving failed") || waits.elapsed() > patience) {
      QFile go(goFile(folder));
      static_cast<void>(go.open(QIODevice::WriteOnly));
    }
  }
  return said + child.readAllStandardOutput();
}

/// Runs a child under a limit of address space in MB; 0: without one.
Outcome runUnder(quint64 limit) {
  Outcome outcome;
  outcome.limit = limit;
  const QTemporaryDir folder;
  QProcess child;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert(QStringLiteral("XDG_DATA_HOME"), folder.path());
  environment.insert(QStringLiteral("XDG_RUNTIME_DIR"), folder.path());  // without it, Qt warns
  child.setProcessEnvironment(environment);
  child.setChildProcessModifier([limit] {
    const rlimit bytes{limit * megabyte, limit * megabyte}, none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    if (limit > 0) {
      ::setrlimit(RLIMIT_AS, &bytes);
    }
  });
  child.start(QCoreApplication::applicationFilePath(), {QStringLiteral("--work"), folder.path()});
  const QByteArray said = attend(child, folder.path(), outcome);
  take(outcome, said);
  const QByteArray errors = child.readAllStandardError().trimmed();
  if (outcome.sentence.isEmpty() && !outcome.isWhole) {
    outcome.sentence = QString::fromLocal8Bit(errors.mid(errors.lastIndexOf('\n') + 1));
  }
  outcome.end = child.exitStatus() == QProcess::CrashExit ? QStringLiteral("signal %1").arg(child.exitCode())
                                                          : QStringLiteral("status %1").arg(child.exitCode());
  outcome.opensAgain = hasWork(folder.path());
  return outcome;
}

/// Returns what is wrong with an outcome; empty if nothing is.
QString fault(const Outcome& outcome) {
  if (outcome.isEdited && !outcome.opensAgain && !outcome.isWhole) {
    return QStringLiteral("the work is lost");
  }
  if (!outcome.isWhole && outcome.sentence.isEmpty()) {
    return QStringLiteral("it ended without a sentence");
  }
  return {};
}

void print(const Outcome& outcome) {
  std::printf("%5llu | %-10s | %-38s | %-4s | %-5s | %s%s\n", static_cast<unsigned long long>(outcome.limit),
              qPrintable(outcome.isWhole ? QStringLiteral("end") : outcome.end), qPrintable(outcome.steps),
              outcome.isKept ? "kept" : "-", outcome.opensAgain ? "opens" : "-",
              qPrintable(fault(outcome).isEmpty() ? QString() : fault(outcome).toUpper() + QStringLiteral(": ")),
              qPrintable(outcome.sentence));
  std::fflush(stdout);
}

}  // namespace

class WindowMemory : public QObject {
  Q_OBJECT

 private slots:
  /// Limits between what the window alone takes and what all the work takes.
  void workIsKeptAtEveryLimit() {
#if !defined(NDEBUG) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    QSKIP("only the release build is fast enough, and the sanitizers reserve terabytes of address space");
#else
    const Outcome free = runUnder(0);
    print(free);
    QVERIFY(free.isWhole && free.isKept && free.sentence.isEmpty());
    const quint64 most = largestOf(free);
    for (const quint64 percent : {60, 40, 34}) {
      const Outcome outcome = runUnder(most * percent / 100);
      print(outcome);
      QCOMPARE(fault(outcome), QString());
    }
#endif
  }

 private:
  /// Returns the address space that a child said it had taken, in MB.
  static quint64 largestOf(const Outcome& outcome) {
    return outcome.steps.section(QLatin1Char('('), 1).section(QLatin1Char(' '), 0, 0).toULongLong();
  }
};

int main(int argc, char** argv) {
  if (argc > 2 && std::string_view(argv[1]) == "--work") {
    return runChild(argc, argv);
  }
  QCoreApplication::setOrganizationName(QStringLiteral("ChainMail"));
  QCoreApplication::setApplicationName(QStringLiteral("workbench"));
  const QCoreApplication application(argc, argv);
  if (argc > 1 && std::string_view(argv[1]) == "--all") {
    const auto number = [&](int i, quint64 otherwise) {
      return argc > i ? std::strtoull(argv[i], nullptr, 10) : otherwise;
    };
    const quint64 from = number(2, 300), to = number(3, 3500), step = number(4, 50);
    for (quint64 limit = from; limit <= to; limit += step) {
      print(runUnder(limit));
    }
    return 0;
  }
  WindowMemory test;
  return QTest::qExec(&test, argc, argv);
}
#include "window_memory.moc"
