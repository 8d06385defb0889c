// Measures the real window with a million elements: bench_window RESULTS. It needs a display.

#include <QDir>
#include <QElapsedTimer>
#include <QProcess>
#include <QTemporaryDir>
#include <QTimer>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "bench/contest.h"
#include "bench/process.h"
#include "bench/window_program.h"
#include "docks/mesh_dock.h"
#include "io/file_actions.h"
#include "mesh/generate.h"
#include "panels/panel.h"
#include "window/main_window.h"

namespace chainmail::bench {
namespace {

constexpr int moveMilliseconds = 16;
constexpr int dragMilliseconds = 5000;
constexpr int idleMilliseconds = 5000;
constexpr int patienceMilliseconds = 120'000;
constexpr int restMilliseconds = 300;  // after this time, work in the background has ended

/// Runs the event loop until `done` returns true; returns the time on `clock` (ms).
double until(const QElapsedTimer& clock, const char* what, const std::function<bool()>& done) {
  while (!done()) {
    if (clock.elapsed() > patienceMilliseconds) {
      throw std::runtime_error(std::string("it took too long: ") + what);
    }
    run(1);
  }
  return double(clock.nsecsElapsed()) * 1e-6;
}

/// Waits until both views are drawn with the document's mesh; returns the time on `clock` (ms).
double untilShown(MainWindow& window, const QElapsedTimer& clock, ElementId elements) {
  Document& document = window.document();
  until(clock, "the object in both panels", [&] {
    return document.mesh()->element_count() == elements && document.solvers().frame(0) != nullptr &&
           document.solvers().frame(1) != nullptr;
  });
  const int before = application().viewPaints;
  window.panel(0).view().update();
  window.panel(1).view().update();
  return until(clock, "drawing", [&] { return application().viewPaints >= before + Document::minPanels; });
}

struct FrameMilliseconds {
  double own = 0, painting = 0;
};

/// Returns the processor time of the GUI thread per drawn frame of a local drag, without painting and for painting. The
/// default tool moves the middle element on a circle of 2.5 spacings, 60 moves per second.
FrameMilliseconds guiMilliseconds(MainWindow& window) {
  View& view = window.panel(0).view();
  const auto side = ElementId(std::lround(std::sqrt(window.document().mesh()->element_count())));
  const ElementId middle = (side / 2) * side + side / 2;
  const QPointF centre = view.viewPosition(middle);
  const double spacing = QLineF(centre, view.viewPosition(middle + 100)).length() / 100;
  send(view, QEvent::MouseButtonPress, centre);
  int step = 0;
  QTimer mouse;
  mouse.setTimerType(Qt::PreciseTimer);
  mouse.callOnTimeout([&] {
    const double angle = 2 * std::numbers::pi * ++step / 32;
    send(view, QEvent::MouseMove, centre + 2.5 * spacing * QPointF(std::cos(angle), std::sin(angle)));
  });
  mouse.start(moveMilliseconds);
  run(1000);  // the first frames upload everything
  MeteredApplication& app = application();
  const double cpu = cpu_milliseconds(CLOCK_THREAD_CPUTIME_ID), drawing = app.drawingMilliseconds;
  const int frames = app.framesDrawn, steps = step;
  run(dragMilliseconds);
  const int drawn = app.framesDrawn - frames;
  const double drew = app.drawingMilliseconds - drawing;
  const double own = cpu_milliseconds(CLOCK_THREAD_CPUTIME_ID) - cpu - drew;
  mouse.stop();
  const auto* frame = window.document().solvers().frame(0);
  std::printf("local drag: %d frames and %d moves in %d s, %llu moved; GUI thread %.3f ms a frame, drawing %.1f ms\n",
              drawn, step - steps, dragMilliseconds / 1000,
              frame == nullptr ? 0ULL : static_cast<unsigned long long>(frame->statistics.last_pass.moved), own / drawn,
              drew / drawn);
  send(view, QEvent::MouseButtonRelease, centre);
  return {own / drawn, drew / drawn};
}

/// Returns the median time from a mouse event to the picture that shows it on the screen (ms). During a local drag, the
/// mouse moves every 7 ms, as real mice report. A picture shows the newest move whose position the element has.
double latencyMilliseconds(MainWindow& window) {
  constexpr int mouseMilliseconds = 7, places = 64;
  View& view = window.panel(0).view();
  const auto side = ElementId(std::lround(std::sqrt(window.document().mesh()->element_count())));
  const ElementId middle = (side / 2) * side + side / 2;
  const QPointF centre = view.viewPosition(middle);
  const double radius = 2.5 * QLineF(centre, view.viewPosition(middle + 100)).length() / 100;
  const auto place = [&](int step) {
    const double angle = 2 * std::numbers::pi * step / places;
    return centre + radius * QPointF(std::cos(angle), std::sin(angle));
  };
  QElapsedTimer clock;
  clock.start();
  std::vector<double> sent, latencies;
  int shown = -1;
  const auto look = [&] {
    const QPointF at = view.viewPosition(middle);
    for (int step = int(sent.size()) - 1; step > shown && step > int(sent.size()) - places; --step) {
      if (QLineF(place(step), at).length() < 0.25 * radius * std::numbers::pi / places) {
        shown = step;
        latencies.push_back(double(clock.nsecsElapsed()) * 1e-6 - sent[step]);
        return;
      }
    }
  };
  const auto looking = QObject::connect(&view, &QOpenGLWidget::frameSwapped, &window, look);
  send(view, QEvent::MouseButtonPress, centre);
  QTimer mouse;
  mouse.setTimerType(Qt::PreciseTimer);
  mouse.callOnTimeout([&] {
    sent.push_back(double(clock.nsecsElapsed()) * 1e-6);
    send(view, QEvent::MouseMove, place(int(sent.size()) - 1));
  });
  mouse.start(mouseMilliseconds);
  run(dragMilliseconds);
  mouse.stop();
  QObject::disconnect(looking);
  send(view, QEvent::MouseButtonRelease, centre);
  if (latencies.size() < 10) {
    throw std::runtime_error("hardly any picture showed a move of the mouse");
  }
  std::sort(latencies.begin(), latencies.end());
  std::printf("mouse to picture: %zu pictures for %zu moves, median %.1f ms, nine in ten within %.1f ms\n",
              latencies.size(), sent.size(), latencies[latencies.size() / 2], latencies[latencies.size() * 9 / 10]);
  return latencies[latencies.size() / 2];
}

/// Returns the share of a core that the whole process uses while there is no input.
double idleShare() {
  const double before = cpu_milliseconds(CLOCK_PROCESS_CPUTIME_ID);
  const int painted = application().viewPaints;
  const double woken = wake_ups();
  run(idleMilliseconds);
  const double share = (cpu_milliseconds(CLOCK_PROCESS_CPUTIME_ID) - before) / idleMilliseconds;
  std::printf("idle: %.5f of a core, %d paints, %d wake-ups (the clock of this measurement is one)\n", share,
              application().viewPaints - painted, int(wake_ups() - woken));
  if (application().viewPaints != painted) {
    throw std::runtime_error("a view was drawn while nothing changed");
  }
  return share;
}

double saveMilliseconds(MainWindow& window, const QString& path) {
  auto& files = *window.findChild<FileActions*>();
  bool saved = false;
  const auto listening = QObject::connect(&files, &FileActions::saved, &window, [&] { saved = true; });
  QElapsedTimer clock;
  clock.start();
  files.savePath(path);
  const double ms = until(clock, "saving", [&] { return saved; });
  QObject::disconnect(listening);
  run(restMilliseconds);
  return ms;
}

double openMilliseconds(MainWindow& window, const QString& path, ElementId elements) {
  const MeshPointer before = window.document().mesh();
  QElapsedTimer clock;
  clock.start();
  window.openFile(path);
  until(clock, "opening", [&] { return window.document().mesh() != before; });
  const double ms = untilShown(window, clock, elements);
  run(restMilliseconds);
  return ms;
}

/// Returns the time from the start of a process to the first picture of the sample object in both panels (ms). The
/// process starts as workbench does. The parent passes its clock's time.
double firstFrameMilliseconds() {
  QProcess child;
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  child.start(QCoreApplication::applicationFilePath(),
              {QStringLiteral("--first-frame"), QString::number(qint64(now.tv_sec) * 1'000'000'000 + now.tv_nsec)});
  if (!child.waitForFinished(patienceMilliseconds) || child.exitCode() != 0) {
    throw std::runtime_error("the window did not come up: " + child.readAllStandardError().toStdString());
  }
  bool isNumber = false;
  const double ms = child.readAllStandardOutput().toDouble(&isNumber);
  if (!isNumber) {
    throw std::runtime_error("the window that came up did not say when");
  }
  return ms;
}

/// Runs that process and prints the time (ms).
int showFirstFrame(const char* startNanoseconds) {
  const auto sample = sampleRecipe();
  MainWindow window(generate(sample), recipeName(sample));
  bool said = false;
  const auto look = [&] {
    if (!said && application().viewsPainted.size() == Document::minPanels) {
      said = true;
      timespec now{};
      clock_gettime(CLOCK_MONOTONIC, &now);
      std::printf("%.3f\n", (1e9 * double(now.tv_sec) + double(now.tv_nsec) - std::atof(startNanoseconds)) * 1e-6);
      std::fflush(stdout);
      QCoreApplication::quit();
    }
  };
  for (int panel = 0; panel < Document::minPanels; ++panel) {
    // Qt emits frameSwapped when the screen shows the painted frame.
    QObject::connect(&window.panel(panel).view(), &QOpenGLWidget::frameSwapped, &window, look);
  }
  window.show();
  return QApplication::exec();
}

/// Writes a dented ball with about 100,000 triangles as an OBJ file.
void writeBall(const QString& path) {
  constexpr int rings = 224, around = 224;
  std::FILE* file = std::fopen(path.toLocal8Bit().constData(), "w");
  if (file == nullptr) {
    throw std::runtime_error("the ball cannot be written");
  }
  for (int ring = 0; ring <= rings; ++ring) {
    for (int i = 0; i < around; ++i) {
      const double up = std::numbers::pi * (ring + 0.5) / (rings + 1), turn = 2 * std::numbers::pi * i / around;
      const double radius = 1 + 0.1 * std::sin(6 * turn) * std::sin(5 * up);
      std::fprintf(file, "v %.7g %.7g %.7g\n", radius * std::sin(up) * std::cos(turn), radius * std::cos(up),
                   radius * std::sin(up) * std::sin(turn));
    }
  }
  for (int ring = 0; ring < rings; ++ring) {
    for (int i = 0; i < around; ++i) {
      const int a = ring * around + i + 1, b = ring * around + (i + 1) % around + 1;
      std::fprintf(file, "f %d %d %d\nf %d %d %d\n", a, b, a + around, b, b + around, a + around);
    }
  }
  std::fclose(file);
}

/// Returns the time per picture (ms) while the element in the middle of the view is dragged around on a circle.
double surfaceFrameMilliseconds(MainWindow& window) {
  View& view = window.panel(0).view();
  const QPointF centre = QRectF(view.rect()).center();
  send(view, QEvent::MouseButtonPress, centre);
  int step = 0;
  QTimer mouse;
  mouse.setTimerType(Qt::PreciseTimer);
  mouse.callOnTimeout([&] {
    const double angle = 2 * std::numbers::pi * ++step / 32;
    send(view, QEvent::MouseMove, centre + 20 * QPointF(std::cos(angle), std::sin(angle)));
  });
  mouse.start(moveMilliseconds);
  run(1000);
  MeteredApplication& app = application();
  const int frames = app.framesDrawn;
  const double cpu = cpu_milliseconds(CLOCK_THREAD_CPUTIME_ID), drawing = app.drawingMilliseconds;
  QElapsedTimer clock;
  clock.start();
  run(dragMilliseconds);
  const int drawn = app.framesDrawn - frames;
  const double ms = double(clock.nsecsElapsed()) * 1e-6 / drawn;
  const double own = cpu_milliseconds(CLOCK_THREAD_CPUTIME_ID) - cpu - (app.drawingMilliseconds - drawing);
  mouse.stop();
  send(view, QEvent::MouseButtonRelease, centre);
  std::printf("surface drag: %d frames, %.1f ms per frame; GUI thread %.2f ms per frame without drawing\n", drawn, ms,
              own / drawn);
  return ms;
}

/// Measures a surface with 100,000 triangles: opening until the first complete picture, and pictures during a drag.
void measureSurface(Results& results) {
  MainWindow window(generate({MeshKind::grid, {8, 8, 1}, 1, {}}), QStringLiteral("grid8"));
  window.show();
  run(1000);
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("ball.obj"));
  writeBall(path);
  results.add("/window/surface_complete_ms", openMilliseconds(window, path, 225 * 224));
  results.add("/window/surface_frame_ms", surfaceFrameMilliseconds(window));
}

void measure(Results& results) {
  results.add("/window/first_frame_ms", firstFrameMilliseconds());
  measureSurface(results);
  constexpr std::uint32_t side = 1024;
  MainWindow window(generate({MeshKind::grid, {side, side, 1}, 1, {}}), QStringLiteral("grid1024"));
  QElapsedTimer clock;
  clock.start();
  window.show();
  untilShown(window, clock, side * side);
  run(1000);
  const FrameMilliseconds frame = guiMilliseconds(window);
  results.add("/window/gui_ms", frame.own);
  results.add("/window/painting_ms", frame.painting);
  until(clock, "the solvers to end", [&] { return window.document().solvers().idle(); });
  results.add("/window/latency_ms", latencyMilliseconds(window));
  until(clock, "the solvers to end", [&] { return window.document().solvers().idle(); });
  run(2000);  // the figures at rest are updated a moment later
  results.add("/window/idle_cpu", idleShare());
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("million.obj"));
  results.add("/window/save_ms", saveMilliseconds(window, path));
  results.add("/window/open_ms", openMilliseconds(window, path, side * side));
}

}  // namespace
}  // namespace chainmail::bench

int main(int argc, char** argv) {
  using namespace chainmail::bench;
  return measureInWindow(argc, argv, "bench_window", measure, [](int count, char** arguments) -> std::optional<int> {
    const bool isFirstFrame = count == 3 && std::string_view(arguments[1]) == "--first-frame";
    return isFirstFrame ? std::optional(showFirstFrame(arguments[2])) : std::nullopt;
  });
}
