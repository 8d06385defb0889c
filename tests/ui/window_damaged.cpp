// Tests a real window with damaged files: sessions with all that they say of the window, lessons, moves,
// pictures, volumes and meshes, one after another in the same window, as a user would open them. A run has a fixed
// number of files. With the environment variable CHAINMAIL_DAMAGED_SECONDS, it takes that time instead.
// CHAINMAIL_DAMAGED_SEED sets the seed, and CHAINMAIL_DAMAGED_KEEP names a folder for the file that was open when the
// test fails.

#include <QDir>
#include <QDirIterator>
#include <QElapsedTimer>
#include <QFile>
#include <QImage>
#include <QLoggingCategory>
#include <QPushButton>

#include "docks/replay_dock.h"
#include "document/edits.h"
#include "folders.h"
#include "fuzz/damage.h"
#include "io/sessions.h"
#include "window.h"
#include "window/bars.h"
#include "window/lessons.h"

namespace chainmail::window_damaged {

namespace {

constexpr int fewFiles = 30;
constexpr int betweenUndos = 10;
constexpr qint64 longestOpening = 20'000;  // milliseconds for a small file, with sanitizers on a busy machine

int asked(const char* variable, int otherwise) {
  bool is = false;
  const int value = qEnvironmentVariableIntValue(variable, &is);
  return is ? value : otherwise;
}

/// A file, and the files that belong to it, by their names.
struct Sample {
  QString name;
  std::map<QString, std::string> parts;
};

std::string content(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll().toStdString() : std::string();
}

void write(const QString& path, const std::string& bytes) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(QByteArray::fromStdString(bytes));
}

}  // namespace

class WindowDamaged : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    makeSessions();
    makePictures();
    takeFiles(sourceFile("tests/fuzz/corpus/session"));
    takeFiles(sourceFile("tests/fuzz/corpus/moves"), QStringLiteral("moves-"));
    takeFiles(sourceFile("tests/fuzz/corpus/metaimage"));
    takeFiles(sourceFile("tests/fuzz/corpus/nrrd"));
    takeFiles(sourceFile("tests/fuzz/corpus/obj"));
    takeFiles(sourceFile("resources/lessons"));
    QVERIFY(samples_.size() > 20);
  }

  void init() {
    failOnWarnings();
    QLoggingCategory::setFilterRules(
        QStringLiteral("qt.gui.imageio.*=false"));  // the readers of pictures warn of damage
    QSettings().clear();
  }

  void oneAfterAnother() {
    const int seconds = asked("CHAINMAIL_DAMAGED_SECONDS", 0);
    const auto seed = unsigned(asked("CHAINMAIL_DAMAGED_SEED", int(std::random_device()() % 1'000'000)));
    qInfo("the seed is %u", seed);
    fuzz::Damage damage(seed);
    Workbench bench;
    QElapsedTimer clock;
    clock.start();
    int files = 0;
    while (!QTest::currentTestFailed() && (seconds > 0 ? clock.elapsed() < 1000 * seconds : files < fewFiles)) {
      openOne(bench, damage, ++files);
    }
    if (QTest::currentTestFailed()) {
      keep();
    } else {
      qInfo("%d executions, nothing found; %d opened, %d refused", files, opened_, files - opened_);
      QVERIFY(opened_ > 0 && opened_ < files);
    }
  }

 private:
  /// Sessions with several docks, panels and cameras, at rest and in the middle of a lesson.
  void makeSessions() {
    Workbench bench(generate({MeshKind::tetra, {4, 3, 3}, 1, {}}));
    bench.trigger("addPanel");
    bench.trigger("showPropagation");
    bench.trigger("showReport");
    bench.trigger("linkCameras");
    bench.view(0).orbit({70, 35});
    edits::setPinned(bench.document(), {0, 1, 2}, true);
    edits::cut(bench.document(), {4, 5});
    bench.document().handle().grab(30);
    bench.document().handle().drag(bench.position(0, 30) + Point(0.5, 0.2, 0));
    bench.document().handle().release();
    bench.settle();
    bench.window.sessions().savePath(source_.filePath(QStringLiteral("whole.chainmail")));
    bench.settle();
    takeFiles(source_.path());
  }

  void makePictures() {
    QImage picture(40, 30, QImage::Format_RGB32);
    picture.fill(Qt::darkCyan);
    for (const char* name : {"picture.png", "picture.jpg"}) {
      const QString path = source_.filePath(QLatin1String(name));
      QVERIFY(picture.save(path));
      samples_.push_back({QLatin1String(name), {{QLatin1String(name), content(path)}}});
      samples_.push_back({QLatin1String(name), {{QLatin1String(name), content(path)}}});
    }
    // A session that names a picture.
    const std::string session = content(source_.filePath(QStringLiteral("whole.chainmail")));
    auto tree = nlohmann::json::parse(session);
    tree["mesh"] = {{"file", "picture.png"}, {"across", 8}};
    tree["cuts"] = tree["pins"] = nlohmann::json::array();
    tree.erase("moves");
    tree.erase("moves_done");
    for (auto& panel : tree["panels"]) {
      panel = {{"algorithm", "exact"},
               {"precision", "float"},
               {"from_rest", true},
               {"runs", nlohmann::json::array()},
               {"held", nlohmann::json::array()}};
    }
    samples_.push_back({QStringLiteral("picture.chainmail"),
                        {{QStringLiteral("picture.chainmail"), tree.dump()},
                         {QStringLiteral("picture.png"), content(source_.filePath(QStringLiteral("picture.png")))}}});
  }

  /// Adds each file of a folder. The data of a detached volume has the name that its header gives.
  void takeFiles(const QString& folder, const QString& prefix = {}) {
    QDirIterator files(folder, QDir::Files);
    while (files.hasNext()) {
      const QString path = files.next();
      if (!path.endsWith(QLatin1String(".py"))) {
        const QString name = prefix + QFileInfo(path).fileName();
        samples_.push_back({name, {{name, content(path)}, {QStringLiteral("data.raw"), std::string(4096, '\7')}}});
      }
    }
  }

  void openOne(Workbench& bench, fuzz::Damage& damage, int number) {
    Sample sample = samples_[damage.below(samples_.size())];
    const auto part = std::next(sample.parts.begin(), std::ptrdiff_t(damage.below(sample.parts.size())));
    damage.below(3) > 0 ? damage.apply_to_json(part->second) : damage.apply(part->second);
    for (const auto& [name, bytes] : sample.parts) {
      write(folder_.filePath(name), bytes);
    }
    open_ = sample.name;
    bench.window.messages().clear();
    QElapsedTimer clock;
    clock.start();
    openIn(bench, folder_.filePath(sample.name));
    check(bench, clock.elapsed());
    if (number % betweenUndos == 0) {
      undoAll(bench);
    }
  }

  void openIn(Workbench& bench, const QString& path) {
    if (open_.startsWith(QLatin1String("moves-"))) {
      bench.window.findChild<ReplayDock*>()->openMoves(path);
    } else {
      bench.open(path);
      if (auto* button = bench.find<QPushButton>("volumeAgree"); button->isVisible()) {
        button->click();
      }
      for (int step = 0; step < 3; ++step) {
        bench.trigger("lessonNext");
      }
    }
    bench.settle();
  }

  /// Whatever was opened, the window works.
  void check(Workbench& bench, qint64 milliseconds) {
    QVERIFY2(milliseconds < longestOpening, qPrintable(QString::number(milliseconds)));
    QVERIFY(bench.window.isVisible());
    const QString sentence = bench.window.messages().isVisible() ? bench.window.messages().sentence() : QString();
    QVERIFY2(!sentence.contains(QStringLiteral("internal error")), qPrintable(sentence));
    for (const uint letter : sentence.toUcs4()) {  // a name of a file may contain letters that no font has
      QVERIFY2(QChar::category(letter) != QChar::Other_Control, qPrintable(sentence));
    }
    opened_ += sentence.isEmpty() ? 1 : 0;
    const QRect screen = bench.window.screen()->geometry();
    QVERIFY2(screen.width() >= bench.window.width() && screen.height() >= bench.window.height(),
             qPrintable(QStringLiteral("%1 x %2").arg(bench.window.width()).arg(bench.window.height())));
    for (int panel = 0; panel < bench.document().panels(); ++panel) {
      const Frame& frame = *bench.document().solvers().frame(panel);
      QVERIFY(std::all_of(frame.positions.begin(), frame.positions.end(), [](float x) { return std::isfinite(x); }));
    }
    bench.trigger("fitView");
    const QPoint middle = bench.view(0).rect().center();
    bench.stroke(0, {middle, middle + QPoint(20, 10)});
  }

  static void undoAll(Workbench& bench) {
    while (bench.document().undoStack().canUndo()) {
      bench.trigger("undo");
    }
    bench.settle();
    bench.document().undoStack().clear();
  }

  void keep() {
    const QString folder = qEnvironmentVariable("CHAINMAIL_DAMAGED_KEEP");
    if (folder.isEmpty() || !QDir().mkpath(folder)) {
      return;
    }
    for (const QString& name : QDir(folder_.path()).entryList(QDir::Files)) {
      QFile::remove(folder + QLatin1Char('/') + name);
      QFile::copy(folder_.filePath(name), folder + QLatin1Char('/') + name);
    }
    qInfo("the file is %s/%s", qPrintable(folder), qPrintable(open_));
  }

  std::vector<Sample> samples_;
  QTemporaryDir source_, folder_;
  QString open_;  // name of the last opened file
  int opened_ = 0;
};

namespace {

int runClass(int argc, char** argv) {
  qputenv("QTEST_FUNCTION_TIMEOUT", "100000000");  // the number of files decides how long it takes
  return runWindowTest<WindowDamaged>(argc, argv);
}

}  // namespace

CHAINMAIL_TEST_RUN(WindowDamaged, runClass)

}  // namespace chainmail::window_damaged

#include "window_damaged.moc"
