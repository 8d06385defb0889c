// Tests recording and replay in a real window: moves are a script, can be reached with a slider, and give pictures.

#include <QFile>
#include <QFileDialog>
#include <QLabel>
#include <QPainter>
#include <QProcess>
#include <QSignalSpy>
#include <QSlider>

#include "docks/replay_dock.h"
#include "document/edits.h"
#include "files/session/moves.h"
#include "io/pictures.h"
#include "panels/panel_area.h"
#include "safe_bench.h"
#include "window.h"
#include "window/bars.h"

namespace chainmail::window_replay {

namespace {

using Shapes = std::vector<std::vector<float>>;

Shapes shapes(Workbench& bench) {
  return {bench.document().solvers().frame(0)->positions, bench.document().solvers().frame(1)->positions};
}

/// Makes two drags with a cut and pins in between.
void work(Workbench& bench) {
  const QPoint from = bench.place(0, 31);
  bench.stroke(0, {from, from + QPoint(110, -140)});
  edits::cut(bench.document(), {3, 4, 40});
  edits::setPinned(bench.document(), {0}, true);
  edits::setSoftness(bench.document(), {0.9, 1.1, 0.05}, QStringLiteral("stiffer"));
  const QPoint corner = bench.place(1, 62);
  bench.stroke(1, {corner, corner + QPoint(60, -90)});
}

/// Waits until relaxation has ended in both panels.
void settleAll(Workbench& bench) {
  for (const int panel : {0, 1}) {
    QTRY_VERIFY_WITH_TIMEOUT(!bench.document().solvers().frame(panel)->statistics.relaxing, 30'000);
  }
  bench.settleFigures();  // a view says for a moment that it still relaxes
}

/// Goes to the beginning or end of the recorded commands.
void go(Workbench& bench, const char* action) {
  bench.trigger(action);
  const bool first = QLatin1String(action) == QLatin1String("replayFirst");
  const MoveHistory& history = bench.document().moves().history();
  QTRY_COMPARE(history.position(), first ? history.start() : history.length());
  bench.settle();
}

/// Makes three drags of few moves, each far enough to be visible, with a cut in between.
void workInFewMoves(Workbench& bench) {
  Document& document = bench.document();
  const auto drag = [&](ElementId element, std::initializer_list<Point> ways) {
    document.handle().grab(element);
    for (const Point& way : ways) {
      document.handle().drag(document.mesh()->rest_position(element) + way);
      bench.settle();  // so that each is a separate move
    }
    document.handle().release();
  };
  drag(31, {{1, 1, 0}, {3, 2, 0}, {4, -2, 0}});
  edits::cut(document, {3, 4, 40});
  drag(62, {{-2, 1, 0}, {1, 3, 0}});
  bench.settle();
}

/// The content of a film: the panels, with even numbers of pixels. The figures below the views are left out, because
/// they contain times.
struct Scene {
  explicit Scene(Workbench& bench) : area(*bench.window.findChild<PanelArea*>()) {
    for (int panel = 0; panel < bench.document().panels(); ++panel) {
      View& view = bench.view(panel);
      views.push_back(QRect(view.mapTo(&area, QPoint()), view.size()));
    }
    const QSize all = area.size() * area.devicePixelRatioF();
    size = QSize(all.width() / 2 * 2, all.height() / 2 * 2);
  }

  QImage views_of(const QImage& picture) const {
    QImage result = picture.convertToFormat(QImage::Format_RGB32);
    QRegion others(result.rect());
    for (const QRect& view : views) {
      others -= view;
    }
    QPainter painter(&result);
    for (const QRect& other : others) {
      painter.fillRect(other, Qt::black);
    }
    return result;
  }
  QImage now() const {
    QImage picture = pictureOf(area);
    picture.setDevicePixelRatio(1);
    return views_of(picture.copy(QRect(QPoint(), size)));
  }

  PanelArea& area;
  std::vector<QRect> views;
  QSize size;
};

/// Returns the content of the panels before the first move, after each move, and at the end.
std::vector<QImage> shownAfterEachMove(Workbench& bench) {
  const Scene scene(bench);
  const MoveHistory& history = bench.document().moves().history();
  const std::size_t last = history.length();
  std::vector<QImage> pictures;
  const auto showAt = [&](std::size_t position) {
    bench.document().moves().goTo(position);
    bench.settle();
    pictures.push_back(scene.now());
  };
  showAt(0);
  for (std::size_t i = 0; i < last; ++i) {
    if (std::holds_alternative<commands::Drag>(history.at(i))) {
      showAt(i + 1);
    }
  }
  showAt(last);
  return pictures;
}

/// Returns the mean difference of two pictures, in levels of a channel.
double apart(const QImage& one, const QImage& other) {
  double sum = 0;
  for (int y = 0; y < one.height(); ++y) {
    for (int x = 0; x < one.width(); ++x) {
      const QRgb a = one.pixel(x, y), b = other.pixel(x, y);
      sum += std::abs(qRed(a) - qRed(b)) + std::abs(qGreen(a) - qGreen(b)) + std::abs(qBlue(a) - qBlue(b));
    }
  }
  return sum / (3.0 * one.width() * one.height());
}

ReplayDock* dock(Workbench& bench) { return bench.find<ReplayDock>("replayDock"); }

/// Returns the positions after a simulation has executed the commands with an algorithm.
std::vector<float> run(const std::vector<Command>& moves, const MeshPointer& mesh, Algorithm algorithm) {
  Simulation simulation(mesh, algorithm, Precision::single_precision);
  for (const Command& move : moves) {
    simulation.apply(move);
  }
  std::vector<float> positions(mesh->rest.size());
  simulation.body().copy_positions(positions);
  return positions;
}

/// Stands in for ffmpeg, which loses details: the film is the pictures as they are.
class RawFilms {
 public:
  RawFilms() {
    QFile program(folder_.filePath(QStringLiteral("ffmpeg")));
    QVERIFY(program.open(QIODevice::WriteOnly) &&
            program.write("#!/bin/sh\nfor last; do :; done\nexec cat > \"$last\"\n") > 0);
    program.setPermissions(QFile::ReadOwner | QFile::ExeOwner);
    qputenv("PATH", folder_.path().toLocal8Bit() + ':' + path_);
  }
  ~RawFilms() { qputenv("PATH", path_); }
  RawFilms(const RawFilms&) = delete;
  RawFilms& operator=(const RawFilms&) = delete;

  QString film() const { return folder_.filePath(QStringLiteral("films/film.mp4")); }
  /// Saves a film, and returns its pictures.
  std::vector<QImage> save(Workbench& bench) {
    QDir(folder_.path()).mkdir(QStringLiteral("films"));
    const Scene scene(bench);
    QSignalSpy saved(dock(bench), &ReplayDock::saved);
    dock(bench)->saveFilm(film());
    std::vector<QImage> pictures;
    if (saved.wait(30'000)) {
      QFile file(film());
      static_cast<void>(file.open(QIODevice::ReadOnly));
      const qsizetype bytes = qsizetype(4) * scene.size.width() * scene.size.height();
      for (QByteArray one = file.read(bytes); one.size() == bytes; one = file.read(bytes)) {
        pictures.push_back(scene.views_of(QImage(reinterpret_cast<const uchar*>(one.constData()), scene.size.width(),
                                                 scene.size.height(), QImage::Format_RGB32)
                                              .copy()));
      }
    }
    return pictures;
  }
  QStringList files() const {
    return QDir(folder_.filePath(QStringLiteral("films")))
        .entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot);
  }

 private:
  QTemporaryDir folder_;
  QByteArray path_ = qgetenv("PATH");
};

/// Returns the title of the dialog for files that an action opens, and closes the dialog.
QString askedBy(Workbench& bench, const char* action) {
  QString title;
  QTimer timer;
  QObject::connect(&timer, &QTimer::timeout, &timer, [&] {
    if (auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget())) {
      timer.stop();
      title = dialog->windowTitle();
      dialog->reject();
    }
  });
  timer.start(10);
  bench.trigger(action);
  return title;
}

/// Writes a script of one long drag.
void writeDrags(const QString& path, int drags) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(R"({"version": 1, "commands": [{"do": "grab", "element": 31})");
  for (int i = 0; i < drags; ++i) {
    file.write(
        ",\n"
        R"({"do": "drag", "target": [4.5, 0.125, 0]})");
  }
  file.write("]}");
}

}  // namespace

class WindowReplay : public QObject {
  Q_OBJECT

 private slots:
  void init() { failOnWarnings(); }

  /// A position in the recorded commands gives the same result however it is reached, and moving the slider is one undo
  /// step in all.
  void aSliderGoesThereAndBack() {
    Workbench bench;
    // A busy machine samples a stroke less often.
    for (int i = 0; i < 12 || bench.document().moves().history().length() <= 64; ++i) {
      const QPoint from = bench.place(0, ElementId(5 * i % 60));
      bench.stroke(0, {from, from + QPoint(60 - 20 * (i % 12), 50)});
    }
    const Shapes live = shapes(bench);
    const int steps = bench.document().undoStack().count();
    const auto length = bench.document().moves().history().length();
    QVERIFY(length > 64);  // snapshots are saved on the way
    auto* slider = bench.find<QSlider>("replaySlider");
    QTRY_COMPARE(slider->maximum(), int(length));
    std::map<std::size_t, Shapes> seen;
    for (const std::size_t place :
         {length, length / 2, length / 3, length - 3, length / 3, length / 2, std::size_t{1}}) {
      slider->setValue(int(place));
      QTRY_COMPARE(bench.document().moves().history().position(), place);
      bench.settle();
      const auto [first, isNew] = seen.emplace(place, shapes(bench));
      QVERIFY(isNew || first->second == shapes(bench));
    }
    QVERIFY(seen[length] == live);
    QCOMPARE(bench.document().undoStack().count(), steps + 1);
    bench.trigger("undo");
    bench.settle();
    QVERIFY(shapes(bench) == live);
  }

  /// Steps forward and back stop after the same moves, and the label shows the number of the move.
  void stepsGoFromMoveToMoveBothWays() {
    Workbench bench;
    workInFewMoves(bench);
    const MoveHistory& history = bench.document().moves().history();
    const std::size_t length = history.length();
    const auto go = [&](const char* action) {
      const std::size_t before = history.position();
      bench.trigger(action);
      QTRY_VERIFY(history.position() != before);
      bench.settleFigures();
    };
    const auto* place = bench.find<QLabel>("replayPlace");
    go("replayFirst");
    QCOMPARE(place->text(), QStringLiteral("move 0 of 5"));
    std::vector<std::size_t> onward{history.position()};
    std::vector<Shapes> seen{shapes(bench)};
    for (int moves = 1; moves <= 5; ++moves) {
      go("replayForward");
      QCOMPARE(place->text(), QStringLiteral("move %1 of 5").arg(moves));
      QVERIFY(shapes(bench) != seen.back());
      onward.push_back(history.position());
      seen.push_back(shapes(bench));
    }
    go("replayForward");  // to the end of the last drag
    QCOMPARE(history.position(), length);
    for (std::size_t moves = 5; moves-- > 0;) {
      go("replayBack");
      if (history.position() == onward.back()) {
        go("replayBack");  // from the end to the last move
      }
      QCOMPARE(place->text(), QStringLiteral("move %1 of 5").arg(moves));
      QVERIFY(shapes(bench) == seen[moves]);
    }
    QVERIFY(!bench.find<QAction>("replayBack")->isEnabled());  // this is the beginning
  }

  void savedMovesAreAScriptOfIdenticalBitsAndThoseOfAnotherMeshAreRefused() {
    Workbench bench;
    work(bench);
    QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("moves.json"));
    dock(bench)->saveMoves(path);
    bench.settle();
    const auto moves = read_moves(path.toStdString(), bench.document().mesh());
    for (int panel = 0; panel < 2; ++panel) {
      QVERIFY(run(moves, bench.document().mesh(), bench.document().algorithm(panel)) ==
              bench.document().solvers().frame(panel)->positions);
    }
    const Shapes live = shapes(bench);
    edits::resetObject(bench.document());
    dock(bench)->openMoves(path);
    bench.settle();
    QCOMPARE(bench.document().moves().history().position(), std::size_t{0});
    QCOMPARE(bench.document().cuts().count(), 0U);
    go(bench, "replayLast");
    QVERIFY(shapes(bench) == live);

    const QString other = folder.filePath(QStringLiteral("other.json"));
    QFile file(other);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(R"({"version": 1, "commands": [{"do": "grab", "element": 99999}]})");
    file.close();
    dock(bench)->openMoves(other);
    bench.settle();
    QVERIFY(bench.window.messages().sentence().contains(
        QStringLiteral("command 0: 'element' names element 99999, which does not exist")));
    QVERIFY(shapes(bench) == live);
  }

  void theWindowStaysAtWorkWhileALargeFileIsOpenedAlsoForAnotherObject() {
    Workbench bench;
    QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("large.json"));
    writeDrags(path, 200'000);
    QSignalSpy frames(&bench.document().solvers(), &PanelSolvers::frameReady);
    dock(bench)->openMoves(path);
    QVERIFY(bench.window.jobs().running());
    // Meanwhile the user drags, and the panels follow.
    bench.document().handle().grab(31);
    bench.document().handle().drag(Point(4, 9, 0));
    QVERIFY(frames.wait());
    QVERIFY(bench.window.jobs().running());
    bench.document().handle().release();
    QTRY_VERIFY_WITH_TIMEOUT(!bench.window.jobs().running(), 60'000);
    bench.settle();
    QCOMPARE(bench.document().moves().history().length(), std::size_t{200'001});
    QCOMPARE(bench.document().moves().history().position(), std::size_t{0});
    QCOMPARE(bench.document().undoStack().count(), 2);

    // The moves are checked for a mesh that is replaced meanwhile.
    dock(bench)->openMoves(path);
    edits::replaceMesh(bench.document(), generate({MeshKind::line, {3, 1, 1}, 1, {}}), QStringLiteral("line"),
                       QStringLiteral("build line"));
    QTRY_VERIFY_WITH_TIMEOUT(!bench.window.jobs().running(), 60'000);
    bench.settle();
    QCOMPARE(bench.document().moves().history().length(), bench.document().moves().history().start());
    QVERIFY(bench.window.messages().sentence().contains(QStringLiteral("the object was replaced")));
  }

  void playingCarriesEveryMoveOutAndStops() {
    Workbench bench;
    work(bench);
    const Shapes live = shapes(bench);
    go(bench, "replayFirst");
    bench.trigger("replayPlay");
    QTRY_COMPARE_WITH_TIMEOUT(bench.document().moves().history().position(),
                              bench.document().moves().history().length(), 10'000);
    bench.settle();
    QVERIFY(shapes(bench) == live);
    QTRY_VERIFY(bench.find<QAction>("replayPlay")->text().contains(QStringLiteral("Play")));
  }

  /// At 5 moves a second, the rest would take three times as long as this waits.
  void anotherSpeedCountsWhilePlaying() {
    Workbench bench;
    const MoveHistory& history = bench.document().moves().history();
    bench.document().handle().grab(31);
    for (int move = 1; move <= 150; ++move) {
      bench.document().handle().drag(bench.document().mesh()->rest_position(31) + Point(0.01 * move, 0, 0));
      bench.settle();
    }
    bench.document().handle().release();
    bench.settle();
    go(bench, "replayFirst");
    auto* speed = bench.find<QComboBox>("replaySpeed");
    speed->setCurrentIndex(speed->findData(5));
    bench.trigger("replayPlay");
    QTRY_VERIFY(history.position() > 0);
    QVERIFY(history.length() - history.position() > 100);
    speed->setCurrentIndex(speed->findData(120));
    QTRY_COMPARE_WITH_TIMEOUT(history.position(), history.length(), 10'000);
  }

  void aFilmShowsEveryMoveAndHasAFile() {
    RawFilms films;
    Workbench bench;
    workInFewMoves(bench);
    QCOMPARE(askedBy(bench, "exportFilm"), QStringLiteral("Export film"));
    const std::vector<QImage> shown = shownAfterEachMove(bench);
    QCOMPARE(shown.size(), std::size_t{7});
    for (std::size_t i = 1; i <= 5; ++i) {
      QVERIFY(shown[i] != shown[i - 1]);  // so that a picture that is too early or too late is noticed
    }
    const std::vector<QImage> pictures = films.save(bench);
    QCOMPARE(pictures.size(), shown.size());
    for (std::size_t i = 0; i < shown.size(); ++i) {
      QVERIFY2(pictures[i] == shown[i], qPrintable(QString::number(i)));
    }
    QCOMPARE(films.files().size(), 1);
  }

  /// With relaxation, the film ends with what the panels show, and the work stays as it was: also what is relaxing.
  void aFilmChangesNothing() {
    Workbench bench;
    edits::setRelaxation(bench.document(), {true, 0.2, RelaxationScheme::mean});
    workInFewMoves(bench);
    settleAll(bench);
    const QImage then = Scene(bench).now();
    RawFilms films;
    QVERIFY(films.save(bench).back() == then);
    bench.document().undo();
    bench.settle();
    const Shapes live = shapes(bench);
    const int steps = bench.document().undoStack().count(), index = bench.document().undoStack().index();
    const std::vector<LinkId> cuts = bench.document().cuts().links();
    const bool modified = bench.document().isModified();
    const QImage now = Scene(bench).now();
    QVERIFY(films.save(bench).back() == then);  // the undone step is part of it
    bench.settle();
    QVERIFY(shapes(bench) == live);
    QCOMPARE(bench.document().undoStack().count(), steps);  // the undone step can be redone
    QCOMPARE(bench.document().undoStack().index(), index);
    QCOMPARE(bench.document().cuts().links(), cuts);
    QCOMPARE(bench.document().isModified(), modified);
    QVERIFY(bench.document().relaxation().on);
    QVERIFY(Scene(bench).now() == now);
    bench.document().redo();
    bench.settle();
    QVERIFY(shapes(bench) != live);
  }

  void aFilmThatIsGivenUpLeavesNothing_data() {
    QTest::addColumn<bool>("isCancelled");
    QTest::addColumn<bool>("changes");
    QTest::newRow("cancelled") << true << false;
    QTest::newRow("the object is changed") << false << true;
    QTest::newRow("a view is clicked") << false << false;
  }

  /// And so does the next one.
  void aFilmThatIsGivenUpLeavesNothing() {
    QFETCH(bool, isCancelled);
    QFETCH(bool, changes);
    Workbench bench;
    work(bench);
    bench.settle();
    const Shapes live = shapes(bench);
    RawFilms films;
    QSignalSpy failed(dock(bench), &ReplayDock::failed);
    QDir().mkpath(QFileInfo(films.film()).path());
    for (int film = 1; film <= 2; ++film) {
      dock(bench)->saveFilm(films.film());
      QTRY_VERIFY(bench.window.jobs().running() && bench.window.jobs().share() > 0);
      if (isCancelled) {
        bench.window.jobs().cancel();
      } else if (changes) {
        edits::setPinned(bench.document(), {ElementId(4 + film)}, true);
      } else {
        QTest::mouseClick(&bench.view(0), Qt::LeftButton, {}, QPoint(2, 2));
      }
      QTRY_VERIFY(!bench.document().moves().isFilming());
      bench.settle();
      QCOMPARE(failed.size(), isCancelled ? 0 : film);
      QTRY_VERIFY(!bench.window.jobs().running());
      QVERIFY(films.files().isEmpty());
      QVERIFY(shapes(bench) == live);
      QCOMPARE(bench.document().pins().size(), std::size_t(changes ? 1 + film : 1));
    }
  }

  void aVideoShowsEveryMoveInItsOrder() {
    QVERIFY2(Film::canMakeVideos(), "ffmpeg was not found; install the package ffmpeg");
    Workbench bench;
    workInFewMoves(bench);
    const std::vector<QImage> shown = shownAfterEachMove(bench);
    const Scene scene(bench);
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("film.mp4"));
    QSignalSpy saved(dock(bench), &ReplayDock::saved);
    dock(bench)->saveFilm(path);
    QVERIFY(saved.wait(60'000));
    QCOMPARE(QDir(folder.path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot).size(), 1);

    QProcess decoder;
    decoder.start(QStringLiteral("ffmpeg"), {QStringLiteral("-v"), QStringLiteral("error"), QStringLiteral("-i"), path,
                                             folder.filePath(QStringLiteral("%03d.png"))});
    QVERIFY(decoder.waitForFinished(60'000));
    QCOMPARE(decoder.exitCode(), 0);
    const QStringList names = QDir(folder.path()).entryList({QStringLiteral("*.png")}, QDir::Files, QDir::Name);
    QCOMPARE(names.size(), qsizetype(shown.size()));
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const QImage picture(folder.filePath(names[qsizetype(i)]));
      QCOMPARE(picture.size(), scene.size);
      const QImage views = scene.views_of(picture);
      // A codec loses details, but no other move is more similar.
      const double own = apart(views, shown[i]);
      for (const QImage& other : shown) {
        QVERIFY2(other == shown[i] || own < apart(views, other), qPrintable(names[qsizetype(i)]));
      }
    }
  }
};

CHAINMAIL_WINDOW_TEST(WindowReplay)

}  // namespace chainmail::window_replay

#include "window_replay.moc"
