// Measures the real window with ten million elements, in a plane and in space: bench_large RESULTS. It needs a display
// and 6 GB of memory.

#include <QElapsedTimer>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "bench/process.h"
#include "bench/scenes.h"
#include "bench/window_program.h"
#include "document/edits.h"
#include "drawing/mesh_levels.h"
#include "io/sessions.h"
#include "mesh/generate.h"
#include "panels/panel.h"
#include "window/main_window.h"

namespace chainmail::bench {
namespace {

constexpr int patienceMilliseconds = 300'000;
constexpr int hoverMilliseconds = 500;
constexpr int restMilliseconds = 3000;  // after this time, the figures at rest are measured

/// The passes of a panel in a drag. The first one searches; later ones use what it found.
struct Passes {
  std::uint64_t known = 0;  // of the simulation
  double first = 0;         // ms
  std::vector<double> later;

  void add(const Statistics& statistics) {
    if (statistics.passes == known) {
      return;
    }
    known = statistics.passes;
    if (first == 0) {
      first = statistics.last_pass_ms;
    } else {
      later.push_back(statistics.last_pass_ms);
    }
  }
  /// Returns the median of the later passes (ms), or the time of the only one.
  double median() {
    if (later.empty()) {
      return first;
    }
    const auto middle = later.begin() + std::ptrdiff_t(later.size() / 2);
    std::ranges::nth_element(later, middle);
    return *middle;
  }
};

/// A window in which one object is opened and used. Each step prints what it cost.
class LargeScene {
 public:
  LargeScene() : window_(generate({MeshKind::grid, {8, 8, 1}, 1, {}}), QStringLiteral("grid")) {
    window_.resize(1280, 720);
    window_.show();
    run(1000);
    before_ = resident_bytes();
    mouse_.setTimerType(Qt::PreciseTimer);
  }

  /// Builds the object as the Mesh dock does. Returns the time until both panels show it (ms).
  double open(const MeshRecipe& recipe) {
    const auto elements = ElementId(recipe.size[0]) * recipe.size[1] * recipe.size[2];
    const int painted = application().viewPaints;
    const auto build = [this, recipe](const Progress& progress) -> Jobs::Finish {
      const MeshPointer mesh = generate(recipe, progress.part(0, 0.8));
      prepareLevels(mesh, progress.part(0.8, 1));
      return [this, mesh] { edits::replaceMesh(document(), mesh, QStringLiteral("large"), QStringLiteral("build")); };
    };
    const auto isShown = [&] {
      return document().mesh()->element_count() == elements && document().solvers().frame(0) != nullptr &&
             document().solvers().frame(1) != nullptr && application().viewPaints >= painted + 2 &&
             document().solvers().settled();
    };
    const double ms = step(
        "open", [&] { window_.jobs().start(Jobs::Kind::load, QStringLiteral("Building"), build); }, isShown);
    run(restMilliseconds);
    return ms;
  }

  /// Drags what is in the middle of the view on a circle (radius in pixels). Returns the median time of the later
  /// passes that Natural Queue showed (ms).
  double drag(const char* what, double radius, int moves, int interval) {
    int count = 0;
    const auto move = [&] {
      const double angle = 2 * std::numbers::pi * ++count / 32;
      send(view(), QEvent::MouseMove, centre() + radius * QPointF(std::cos(angle), std::sin(angle)));
    };
    step(
        "hover", [&] { hover(view(), centre()); }, settled());
    run(hoverMilliseconds);
    const auto moving = QObject::connect(&mouse_, &QTimer::timeout, &window_, move);
    const PanelSolvers& solvers = document().solvers();
    std::array<Passes, 2> passes{Passes{.known = solvers.statistics(0).passes, .later = {}},
                                 Passes{.known = solvers.statistics(1).passes, .later = {}}};
    const auto listening = QObject::connect(&solvers, &PanelSolvers::frameReady, &window_, [&](int panel) {
      passes[std::size_t(panel)].add(solvers.statistics(panel));
    });
    const auto press = [&] {
      send(view(), QEvent::MouseButtonPress, centre());
      mouse_.start(interval);
    };
    step(what, press, [&] { return count >= moves; });
    mouse_.stop();
    QObject::disconnect(moving);
    QObject::disconnect(listening);
    for (int panel = 0; panel < 2; ++panel) {
      const Statistics& last = solvers.statistics(panel);
      Passes& own = passes[std::size_t(panel)];
      std::printf("  %s: first pass %.3f ms, %zu later ones shown, median %.3f ms, %llu moved by the last\n",
                  info(last.algorithm).name.data(), own.first, own.later.size(), own.median(),
                  static_cast<unsigned long long>(last.last_pass.moved));
    }
    step(
        "release", [&] { send(view(), QEvent::MouseButtonRelease, centre()); }, settled());
    return passes[1].median();
  }

  void cutAndUndo() {
    const Mesh& mesh = *document().mesh();
    const ElementId middle = mesh.element_count() / 2;
    const std::vector<LinkId> links(mesh.entry_link.begin() + mesh.first_entry[middle],
                                    mesh.entry_link.begin() + mesh.first_entry[middle + 1]);
    step(
        "cut", [&] { edits::cut(document(), links); }, settled());
    undo("undo the cut");
  }
  void undo(const char* what) {
    step(
        what, [&] { document().undo(); }, settled());
  }

  void makeStiff() {
    edits::setAlgorithm(document(), 0, Algorithm::exact);
    step(
        "stiff", [&] { edits::setSoftness(document(), stiff, QStringLiteral("stiff")); }, settled());
    run(restMilliseconds);
  }

  double save() {
    const QTemporaryDir folder;
    auto& sessions = *window_.findChild<Sessions*>();
    bool saved = false;
    const auto listening = QObject::connect(&sessions, &Sessions::saved, &window_, [&] { saved = true; });
    const QString path = folder.filePath(QStringLiteral("large.chainmail"));
    const double ms = step(
        "save", [&] { sessions.savePath(path); }, [&] { return saved; });
    QObject::disconnect(listening);
    return ms;
  }

  double bytesPerElement() { return (resident_bytes() - before_) / document().mesh()->element_count(); }
  /// The longest event of all steps in the GUI thread, without drawing (ms).
  double longestMilliseconds() const { return longest_; }

 private:
  using Condition = std::function<bool()>;

  Document& document() { return window_.document(); }
  View& view() { return window_.panel(0).view(); }
  QPointF centre() { return QRectF(view().rect()).center(); }
  Condition settled() {
    return [this] { return document().solvers().settled(); };
  }

  /// Does a step, and runs the event loop until it is done. Returns the time (ms).
  double step(const char* what, const std::function<void()>& act, const Condition& done) {
    QElapsedTimer clock;
    clock.start();
    application().longestMilliseconds = application().longestDrawing = 0;
    act();
    while (!done()) {
      if (clock.elapsed() > patienceMilliseconds) {
        throw std::runtime_error(std::string("it took too long: ") + what);
      }
      run(1);
    }
    const double ms = double(clock.nsecsElapsed()) * 1e-6, longest = application().longestMilliseconds;
    longest_ = std::max(longest_, longest);
    std::printf("  %-28s %8.0f ms, longest event %.1f ms (%s), longest drawing %.1f ms\n", what, ms, longest,
                application().longestEvent.data(), application().longestDrawing);
    std::fflush(stdout);
    return ms;
  }

  MainWindow window_;
  QTimer mouse_;
  double before_ = 0;  // resident bytes
  double longest_ = 0;
};

void measure(Results& results, const std::string& place, const MeshRecipe& recipe) {
  LargeScene scene;
  results.add(place + "/open_ms", scene.open(recipe));
  results.add(place + "/local_pass_ms", scene.drag("local drag, 120 moves", 1, 120, 16));
  scene.cutAndUndo();
  scene.undo("undo the drag");
  scene.makeStiff();
  results.add(place + "/whole_pass_ms", scene.drag("whole-body drag, 40 moves", 100, 40, 100));
  results.add(place + "/bytes_per_element", scene.bytesPerElement());
  scene.undo("undo the drag");
  results.add(place + "/save_ms", scene.save());
  results.add(place + "/gui_longest_ms", scene.longestMilliseconds());
}

void measure(Results& results) {
  std::printf("grid 3162²\n");
  measure(results, "/ten_million/plane", {MeshKind::grid, {3162, 3162, 1}, 1, {}});
  std::printf("block 215³\n");
  measure(results, "/ten_million/space", {MeshKind::block, {215, 215, 215}, 1, {}});
}

}  // namespace
}  // namespace chainmail::bench

int main(int argc, char** argv) {
  using namespace chainmail::bench;
  return measureInWindow(argc, argv, "bench_large", measure);
}
