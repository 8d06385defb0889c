// Measures the real window with ten million elements, in a plane and in space: bench_large RESULTS. It needs a display
// and 6 GiB of memory.

#include <QElapsedTimer>
#include <QEventLoop>
#include <QMouseEvent>
#include <QSettings>
#include <QTemporaryDir>
#include <QTimer>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "bench/metered_application.h"
#include "bench/process.h"
#include "bench/results.h"
#include "bench/scenes.h"
#include "drawing/prepared_levels.h"
#include "io/sessions.h"
#include "mesh/generate.h"
#include "panels/panel.h"
#include "window/main_window.h"
#include "window/startup.h"

namespace chainmail::bench {
namespace {

constexpr int patienceMilliseconds = 300'000;

MeteredApplication& application() { return *static_cast<MeteredApplication*>(qApp); }

void run(int milliseconds) {
  QEventLoop loop;
  QTimer::singleShot(milliseconds, Qt::PreciseTimer, &loop, &QEventLoop::quit);
  loop.exec();
}

/// What a step of the work in the window cost.
struct Cost {
  double ms = 0;       // until it was done
  double longest = 0;  // the longest event in the GUI thread without drawing (ms)
};

/// Does a step, and runs the event loop until it is done.
Cost cost(const char* what, const std::function<void()>& step, const std::function<bool()>& done) {
  QElapsedTimer clock;
  clock.start();
  application().longestMilliseconds = application().longestDrawing = 0;
  step();
  while (!done()) {
    if (clock.elapsed() > patienceMilliseconds) {
      throw std::runtime_error(std::string("it took too long: ") + what);
    }
    run(1);
  }
  const Cost cost{double(clock.nsecsElapsed()) * 1e-6, application().longestMilliseconds};
  std::printf("  %-28s %8.0f ms, longest event %.1f ms, longest drawing %.1f ms, resident %.2f GB\n", what, cost.ms,
              cost.longest, application().longestDrawing, resident_bytes() * 1e-9);
  std::fflush(stdout);
  return cost;
}

void send(View& view, QEvent::Type type, QPointF at) {
  const bool moves = type == QEvent::MouseMove;
  QMouseEvent event(type, at, view.mapToGlobal(at), moves ? Qt::NoButton : Qt::LeftButton,
                    type == QEvent::MouseButtonRelease ? Qt::NoButton : Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&view, &event);
}

/// Opens an object and works with it. Adds the figures below `place`.
void work(Results& results, const std::string& place, const MeshRecipe& recipe) {
  const double before = resident_bytes();
  MainWindow window(generate({MeshKind::grid, {8, 8, 1}, 1, {}}), QStringLiteral("grid"));
  window.resize(1280, 720);
  window.show();
  run(1000);
  Document& document = window.document();
  View& view = window.panel(0).view();
  double longest = 0;
  const auto take = [&](const Cost& one) {
    longest = std::max(longest, one.longest);
    return one.ms;
  };
  const auto settled = [&] { return document.settled(); };
  const auto elements = ElementId(recipe.size[0]) * recipe.size[1] * recipe.size[2];
  const int painted = application().viewPaints;
  results.add(place + "/open_ms",
              take(cost(
                  "open",
                  [&] {
                    window.jobs().start(
                        Jobs::Kind::load, QStringLiteral("Building"), [&](const Progress& progress) -> Jobs::Finish {
                          const MeshPointer mesh = generate(recipe, progress.part(0, 0.8));
                          prepareLevels(mesh, progress.part(0.8, 1));
                          return [&, mesh] {
                            document.replaceMesh(mesh, QStringLiteral("large"), QStringLiteral("build"));
                          };
                        });
                  },
                  [&] {
                    return document.mesh()->element_count() == elements && document.frame(0) && document.frame(1) &&
                           application().viewPaints >= painted + 2 && document.settled();
                  })));
  run(3000);  // the figures at rest
  const QPointF centre = QRectF(view.rect()).center();
  QTimer mouse;
  int step = 0;
  const auto circle = [&](double radius) {
    mouse.disconnect();
    mouse.callOnTimeout([&, radius] {
      const double angle = 2 * std::numbers::pi * ++step / 32;
      send(view, QEvent::MouseMove, centre + radius * QPointF(std::cos(angle), std::sin(angle)));
    });
  };
  mouse.setTimerType(Qt::PreciseTimer);
  circle(1);
  take(cost(
      "local drag, 120 moves",
      [&] {
        send(view, QEvent::MouseButtonPress, centre);
        mouse.start(16);
      },
      [&] { return step >= 120; }));
  mouse.stop();
  results.add(place + "/local_pass_ms", document.statistics(1).last_pass_ms);
  std::printf("  local passes: %.3f and %.3f ms, %llu moved\n", document.statistics(0).last_pass_ms,
              document.statistics(1).last_pass_ms,
              static_cast<unsigned long long>(document.statistics(1).last_pass.moved));
  take(cost(
      "release", [&] { send(view, QEvent::MouseButtonRelease, centre); }, settled));
  const ElementId middle = elements / 2;
  const Mesh& mesh = *document.mesh();
  std::vector<LinkId> links(mesh.entry_link.begin() + mesh.first_entry[middle],
                            mesh.entry_link.begin() + mesh.first_entry[middle + 1]);
  take(cost(
      "cut", [&] { document.cut(links); }, settled));
  take(cost(
      "undo the cut", [&] { document.undo(); }, settled));
  take(cost(
      "undo the drag", [&] { document.undo(); }, settled));
  document.setAlgorithm(0, Algorithm::exact);
  take(cost(
      "stiff", [&] { document.setSoftness(stiff, QStringLiteral("stiff")); }, settled));
  run(3000);
  step = 0;
  circle(100);
  take(cost(
      "whole-body drag, 40 moves",
      [&] {
        send(view, QEvent::MouseButtonPress, centre);
        mouse.start(100);
      },
      [&] { return step >= 40; }));
  mouse.stop();
  std::printf("  whole-body passes: Exact %.1f ms, Natural Queue %.1f ms, %llu moved\n",
              document.statistics(0).last_pass_ms, document.statistics(1).last_pass_ms,
              static_cast<unsigned long long>(document.statistics(1).last_pass.moved));
  results.add(place + "/whole_pass_ms", document.statistics(1).last_pass_ms);
  take(cost(
      "release", [&] { send(view, QEvent::MouseButtonRelease, centre); }, settled));
  results.add(place + "/bytes_per_element", (resident_bytes() - before) / elements);
  take(cost(
      "undo the drag", [&] { document.undo(); }, settled));
  const QTemporaryDir folder;
  auto& sessions = *window.findChild<Sessions*>();
  bool saved = false;
  const auto listening = QObject::connect(&sessions, &Sessions::saved, &window, [&] { saved = true; });
  results.add(place + "/save_ms",
              take(cost(
                  "save", [&] { sessions.savePath(folder.filePath(QStringLiteral("large.chainmail"))); },
                  [&] { return saved; })));
  QObject::disconnect(listening);
  results.add(place + "/gui_longest_ms", longest);
}

}  // namespace
}  // namespace chainmail::bench

int main(int argc, char** argv) {
  using namespace chainmail;
  if (argc < 2) {
    std::fprintf(stderr, "bench_large: name the file of results, as in: bench_large build/bench.json\n");
    return 2;
  }
  prepareApplication();
  const QTemporaryDir settings;
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, settings.path());
  bench::MeteredApplication application(argc, argv);
  styleApplication();
  if (const QString why = whyNoWindow(); !why.isEmpty()) {
    std::fprintf(stderr, "bench_large: %s\n", qPrintable(why));
    return 2;
  }
  bench::Results results(argv[1]);
  std::printf("grid 3162²\n");
  bench::work(results, "/ten_million/plane", {MeshKind::grid, {3162, 3162, 1}, 1, {}});
  std::printf("block 215³\n");
  bench::work(results, "/ten_million/space", {MeshKind::block, {215, 215, 215}, 1, {}});
  results.write();
}
