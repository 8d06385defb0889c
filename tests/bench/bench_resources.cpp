// Measures resources of passes other than time: memory of a scene as the window holds it, allocations, and how much two
// panels on two cores slow each other down: bench_resources RESULTS.

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <barrier>
#include <chrono>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <thread>

#include "bench/contestants.h"
#include "bench/process.h"
#include "bench/results.h"
#include "core/allocations.h"
#include "core/threads.h"
#include "simulate/solver_thread.h"

namespace chainmail::bench {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// Runs `measure` in a copy of this process and returns its result.
double in_a_child(const std::function<double()>& measure) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) {
    throw std::runtime_error("no pipe");
  }
  const pid_t child = fork();
  if (child == 0) {
    const double value = measure();
    _exit(write(ends[1], &value, sizeof value) == ssize_t{sizeof value} ? 0 : 1);
  }
  double value = 0;
  int status = 0;
  const bool whole = read(ends[0], &value, sizeof value) == ssize_t{sizeof value};
  close(ends[0]);
  close(ends[1]);
  if (waitpid(child, &status, 0) != child || status != 0 || !whole) {
    throw std::runtime_error("a measurement of memory failed");
  }
  return value;
}

/// Returns the bytes per element of two solver threads, as in the document: both deform the mesh, and both frames are
/// read.
double bytes_per_element() {
  const double before = resident_bytes();
  const Scene scene("grid1024");
  const DragPath round = path_of(Drag::whole_body, *scene.mesh);
  std::vector<std::unique_ptr<SolverThread>> panels;
  for (const Algorithm algorithm : {Algorithm::generalized, Algorithm::natural_queue}) {
    panels.push_back(std::make_unique<SolverThread>(scene.mesh, algorithm, [] {}));
    panels.back()->post(commands::SetSoftness{{stiff, {}}});
    panels.back()->post(commands::Grab{round.element});
  }
  for (const Point& target : round.targets) {
    for (const auto& panel : panels) {
      panel->post(commands::Drag{target});
    }
    test::wait_until([&] {
      panels[0]->latest_frame();
      panels[1]->latest_frame();
      return panels[0]->idle() && panels[1]->idle();
    });
  }
  return (resident_bytes() - before) / scene.mesh->element_count();
}

/// Returns the mean number of allocations per pass after the warm-up; the maximum over all algorithms and both drags.
double allocations_per_pass() {
  constexpr int passes = 64;
  const Scene scene("grid64");
  double most = 0;
  for (const auto& info : algorithms()) {
    for (const Drag drag : {Drag::local, Drag::whole_body}) {
      const Contestant one = dragged(scene, std::string(info.name), drag);
      for (int i = 0; i < 4 * passes; ++i) {
        one.pass();
      }
      const std::uint64_t before = test::allocations;
      for (int i = 0; i < passes; ++i) {
        one.pass();
      }
      most = std::max(most, double(test::allocations - before) / passes);
    }
  }
  return most;
}

/// Returns the passes per second of each contestant. All run at the same time, each on its own thread.
std::vector<double> speeds(const std::vector<Contestant*>& at_once) {
  std::vector<double> speed(at_once.size());
  std::barrier start(static_cast<std::ptrdiff_t>(at_once.size()));
  std::vector<std::jthread> threads;
  for (std::size_t i = 0; i < at_once.size(); ++i) {
    threads.emplace_back([&, i] {
      start.arrive_and_wait();
      const auto begin = Clock::now();
      auto now = begin;
      int passes = 0;
      for (; now < begin + 400ms; now = Clock::now()) {
        at_once[i]->pass();
        ++passes;
      }
      speed[i] = passes / std::chrono::duration<double>(now - begin).count();
    });
  }
  threads.clear();
  return speed;
}

/// Returns the speed of the slower of two panels that run at the same time, divided by its speed alone.
double two_panels() {
  const Scene scene("grid512");
  Contestant left = dragged(scene, names::natural_queue, Drag::whole_body);
  Contestant right = dragged(scene, names::natural_queue, Drag::whole_body);
  std::vector<double> alone[2], together[2];
  for (int repetition = 0; repetition < 7; ++repetition) {
    alone[0].push_back(speeds({&left})[0]);
    const auto both = speeds({&left, &right});
    together[0].push_back(both[0]);
    together[1].push_back(both[1]);
    alone[1].push_back(speeds({&right})[0]);
  }
  return std::min(median(together[0]) / median(alone[0]), median(together[1]) / median(alone[1]));
}

/// Returns the median time (ms) from the press on an element, after a hover, to the frame in which the whole object of
/// a million elements has moved.
double grab_to_frame(Algorithm algorithm) {
  const Scene scene("grid1000");
  const DragPath round = path_of(Drag::whole_body, *scene.mesh);
  SolverThread panel(scene.mesh, algorithm, [] {});
  panel.post(commands::SetSoftness{{stiff, {}}});
  std::vector<double> ms;
  for (int i = 0; i < 7; ++i) {
    const ElementId element = i % 2 == 0 ? round.element : scene.mesh->element_count() - 1;
    const int prepared = panel.prepared();
    panel.prepare(element);
    test::wait_until([&] { return panel.prepared() > prepared && panel.settled(); });
    const std::uint64_t passes = panel.latest_frame().statistics.passes;
    const auto begin = Clock::now();
    panel.post(commands::Grab{element});
    panel.post(commands::Drag{round.targets[std::size_t(i + 1)] - round.targets[0], {}, true});
    while (panel.latest_frame().statistics.passes == passes) {
    }
    if (panel.latest_frame().statistics.last_pass.moved < scene.mesh->element_count() * 9ULL / 10) {
      throw std::logic_error("the whole object should have moved");
    }
    ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
    panel.post(commands::Release{});
  }
  return median(ms);
}

/// Returns the resident bytes of a mesh and a solver after its first passes.
double scene_bytes(const char* mesh) {
  const double before = resident_bytes();
  const Scene scene(mesh);
  const Contestant one = dragged(scene, names::natural_queue, Drag::whole_body);
  return resident_bytes() - before;
}

}  // namespace
}  // namespace chainmail::bench

int main(int argc, char** argv) {
  using namespace chainmail::bench;
  if (argc != 2) {
    std::fprintf(stderr, "bench_resources: name the file of results, as in: bench_resources build/bench.json\n");
    return 2;
  }
  // Each runs in a separate process, because its heap must be unused.
  const double bytes = in_a_child(bytes_per_element);
  const double plane = in_a_child([] { return scene_bytes("grid1024"); });
  const double space = in_a_child([] { return scene_bytes("grid1024_3d"); });
  Results results(argv[1]);
  results.add("/bytes_per_element", bytes);
  results.add("/plane/bytes", plane / space);
  results.add("/allocations_per_pass", allocations_per_pass());
  results.add("/two_panels", two_panels());
  for (const auto& info : chainmail::algorithms()) {
    results.add("/grab_to_frame_ms/" + std::string(info.name), grab_to_frame(info.algorithm));
  }
  results.write();
}
