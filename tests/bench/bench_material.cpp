// Measures relaxation to the material (see README.md): bench_material ORGAN, with the file of the sample organ,
// compares it with its own minimum; bench_material alone measures threads and cuts of a large object, iterations on
// small and large blocks, and the lag behind the handle.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "files/mesh/open_mesh.h"
#include "mesh/generate.h"
#include "mesh/layers.h"
#include "report/run/physics_cases.h"
#include "report/table/contestant.h"
#include "simulate/simulation.h"

namespace chainmail::bench {
namespace {

constexpr std::array iterations_tried{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 15, 20, 30, 50};
constexpr int repetitions = 5;

double milliseconds_of(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(values.size() / 2));
  return values[values.size() / 2];
}

/// RMS of the distance between two states over RMS of the displacements of the second.
double distance_between(const std::vector<double>& now, const std::vector<double>& goal,
                        const std::vector<double>& rest) {
  double apart = 0, way = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    apart += std::pow(now[i] - goal[i], 2);
    way += std::pow(goal[i] - rest[i], 2);
  }
  return std::sqrt(apart / way);
}

struct Contestant {
  const char* name;
  Algorithm algorithm;
  EnergyKind energy = EnergyKind::material;  // of relaxation
  bool relaxes() const { return info(algorithm).relaxes(); }
};
constexpr std::array contestants{Contestant{"material, multigrid", Algorithm::exact},
                                 Contestant{"co-rotated links", Algorithm::exact, EnergyKind::corotated},
                                 Contestant{"quasi-Newton FEM", Algorithm::quasi_newton}};

enum class Regions { free, binding };  // wide open, or the default

/// An object under a contestant, whose valid regions do not bind unless said; positions in single precision.
class Run {
 public:
  Run(const report::Case& object, const Contestant& contestant, int iterations, int threads = 1,
      Regions regions = Regions::free)
      : contestant_(contestant),
        iterations_(iterations),
        simulation_(object.mesh, contestant.algorithm, Precision::single_precision) {
    simulation_.set_threads(threads);
    const bool open = regions == Regions::free;
    Softness softness = report::softness_of({.algorithm = Algorithm::exact, .open_regions = open}, object.softness);
    softness.energy = contestant.energy;
    simulation_.apply(commands::SetSoftness{softness});
    ElasticOptions options = object.elastic;
    options.iterations = std::uint32_t(std::max(1, iterations));  // of other methods
    simulation_.apply(commands::SetElastic{options});
    simulation_.apply(commands::Pin{object.pins});
  }

  /// Carries out a command; after a move, also the iterations. Returns the time (ms).
  double apply(const Command& command) {
    return milliseconds_of([&] {
      simulation_.apply(command);
      if (std::holds_alternative<commands::Drag>(command) && contestant_.relaxes()) {
        iterate(iterations_);
      }
    });
  }
  void iterate(int count) {
    if (count > 0) {
      simulation_.apply(commands::Relax{std::uint32_t(count), 1, RelaxationScheme::equilibrium});
    }
  }
  /// Runs one iteration. Returns the residual.
  double residual_of_one() {
    iterate(1);
    return simulation_.statistics().residual.value_or(0);
  }
  /// Drags, then runs iterations for this time, at least one.
  void frame(const Command& command, double ms) {
    simulation_.apply(command);
    const auto start = std::chrono::steady_clock::now();
    do {
      iterate(1);
    } while (std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() < ms);
  }
  std::vector<double> positions() const {
    std::vector<double> all(simulation_.mesh().rest.size());
    simulation_.body().copy_positions(all);
    return all;
  }

 private:
  Contestant contestant_;
  int iterations_;
  Simulation simulation_;
};

/// The minimum of the same energy on the same cells, by Newton's method in double precision.
class Minimum {
 public:
  Minimum(const report::Case& object, const std::vector<Command>& commands) : rest_(object.mesh->rest) {
    Simulation simulation(object.mesh, Algorithm::neo_hookean, Precision::double_precision);
    simulation.apply(commands::Pin{object.pins});
    std::ranges::for_each(commands, [&](const Command& command) { simulation.apply(command); });
    positions_.resize(rest_.size());
    simulation.body().copy_positions(positions_);
  }

  /// RMS of the distance from it over RMS of its displacements.
  double error_of(const Run& run) const { return distance_between(run.positions(), positions_, rest_); }

 private:
  std::vector<double> rest_, positions_;
};

/// Errors and times along a drag of many moves, with this many iterations in each.
void drag(const report::Case& object, const std::vector<Command>& moves, int iterations) {
  const Minimum minimum(object, moves);
  for (const Contestant& contestant : contestants) {
    Run run(object, contestant, iterations);
    std::vector<double> ms;
    std::ranges::for_each(moves, [&](const Command& command) { ms.push_back(run.apply(command)); });
    ms.erase(ms.begin(), ms.begin() + 2);  // the grab and the first move
    std::printf("  %-20s %2d per move: error %.4f, later move %.3f ms\n", contestant.name, iterations,
                minimum.error_of(run), median(ms));
  }
}

struct Effort {
  int iterations = 0;
  double error = 0;  // at the end
  std::vector<double> ms;
};

/// Runs the last commands with more and more iterations in the last move, until the error is small enough.
Effort effort(const report::Case& object, const Contestant& contestant, const std::vector<Command>& moves,
              std::size_t timed, double enough) {
  const Minimum minimum(object, moves);
  Effort effort;
  for (const int count : iterations_tried) {
    Run run(object, contestant, count);
    std::ranges::for_each(moves, [&](const Command& command) { run.apply(command); });
    effort.iterations = count;
    effort.error = minimum.error_of(run);
    if (effort.error <= enough) {
      break;
    }
  }
  for (int i = 0; i < repetitions; ++i) {
    Run run(object, contestant, effort.iterations);
    double ms = 0;
    for (std::size_t k = 0; k < moves.size(); ++k) {
      const double one = run.apply(moves[k]);
      ms += k + timed >= moves.size() ? one : 0;
    }
    effort.ms.push_back(ms);
  }
  return effort;
}

void efforts(const char* what, const report::Case& object, const std::vector<Command>& moves, std::size_t timed,
             double enough) {
  for (const Contestant& contestant : contestants) {
    const Effort found = effort(object, contestant, moves, timed, enough);
    std::printf("  %-20s %s: error %.4f after %d iterations, %.3g ms\n", contestant.name, what, found.error,
                found.iterations, median(found.ms));
  }
}

std::vector<Command> moves_of(const std::vector<report::RecordedMoves>& drags, const char* name) {
  return std::ranges::find(drags, std::string(name), &report::RecordedMoves::name)->commands;
}

/// The drags of the suite: a bend in 24 moves and in one, and a cut while dragging.
void measure(const report::Case& object) {
  const auto drags = report::physics_drags(object, true, report::patch_share);
  std::printf("%s: %u elements, %zu tetrahedra\n", object.name.c_str(), object.mesh->element_count(),
              object.mesh->tetrahedra.size());
  const std::vector<Command> bend = moves_of(drags, "bend");
  drag(object, bend, 1);
  efforts("fresh grab", object, {bend.front(), bend.back()}, 1, 0.02);
  efforts("after a cut", object, moves_of(drags, "cut, then move"), 2, 0.05);
}

/// What an iteration takes on one thread and on two, and the repair after a cut of some links.
void threads_and_repair(const report::Case& object) {
  const std::vector<Command> bend = moves_of(report::physics_drags(object, false, report::patch_share), "bend");
  constexpr std::size_t cut_links = 100;
  for (const int threads : {1, 2}) {
    Run run(object, contestants.front(), 1, threads);
    run.apply(bend[0]);
    const double build = run.apply(bend[1]);
    std::vector<double> one, after;
    LinkId next = object.mesh->link_count() / 2;
    for (int i = 0; i < 10; ++i) {
      one.push_back(milliseconds_of([&] { run.iterate(1); }));
    }
    for (int i = 0; i < repetitions; ++i) {
      std::vector<LinkId> links(cut_links);
      std::ranges::generate(links, [&] { return next++; });
      run.apply(commands::Cut{links});
      after.push_back(milliseconds_of([&] { run.iterate(1); }));
      run.iterate(1);
    }
    std::printf(
        "%s, %u elements, %d threads: first move %.3g ms, iteration %.3g ms, first after a cut of %zu links %.3g ms\n",
        object.name.c_str(), object.mesh->element_count(), threads, build, median(one), cut_links, median(after));
  }
}

/// Iterates to the equilibrium. Returns how many iterations it takes until the object stays within 1 % of it; one more
/// than are kept if those do not suffice.
int iterations_to_equilibrium(Run& run, const std::vector<double>& rest) {
  constexpr int kept = 100, most = 500;
  constexpr double residual = 1e-6, near = 0.01;
  std::vector<std::vector<double>> states;
  int count = 0;
  for (double now = 1; now > residual && count < most; ++count) {
    now = run.residual_of_one();
    if (count < kept) {
      states.push_back(run.positions());
    }
  }
  const std::vector<double> goal = run.positions();
  int needed = int(states.size()) + 1;
  while (needed > 1 && distance_between(states[std::size_t(needed) - 2], goal, rest) <= near) {
    --needed;
  }
  if (count == most) {
    std::printf("  (residual above %g after %d iterations)\n", residual, most);
  }
  return needed;
}

report::Case block_of(std::uint32_t width) {
  report::Case object;
  object.name = "block";
  object.mesh = generate({MeshKind::tetra, {width, width, width}});
  object.pins = layer(*object.mesh, *find_side("left"));
  return object;
}

std::vector<LinkId> half_of_the_middle_plane(const Mesh& mesh) {
  const double middle = mesh.box[1].x() / 2 + 0.25, half = mesh.box[1].y() / 2;
  std::vector<LinkId> links;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    const Point a = mesh.rest_position(mesh.links[link][0]), b = mesh.rest_position(mesh.links[link][1]);
    if ((a.x() < middle) != (b.x() < middle) && std::min(a.y(), b.y()) > half) {
      links.push_back(link);
    }
  }
  return links;
}

/// A drag of a patch across by a fifth of the width.
struct PatchDrag {
  explicit PatchDrag(const report::Case& object)
      : grab(moves_of(report::physics_drags(object, false, report::patch_share), "bend").front()),
        way(std::get<commands::Drag>(moves_of(report::physics_drags(object, false, report::patch_share), "bend").back())
                .target) {}
  Command to(double share) const { return commands::Drag{share * way, {}, true}; }

  Command grab;
  Point way;
};

/// Iterations to 1 % of the equilibrium from a fresh grab, after a move 5 % of the width farther, and after a cut
/// through half of the middle plane.
std::array<int, 3> iterations_of(const report::Case& object, Regions regions) {
  const PatchDrag drag(object);
  const std::vector<double>& rest = object.mesh->rest;
  Run run(object, contestants.front(), 0, 1, regions);
  run.apply(drag.grab);
  run.apply(drag.to(1));
  const int fresh = iterations_to_equilibrium(run, rest);
  run.apply(drag.to(1.25));
  const int later = iterations_to_equilibrium(run, rest);
  run.apply(commands::Cut{half_of_the_middle_plane(*object.mesh)});
  return {fresh, later, iterations_to_equilibrium(run, rest)};
}

void growth_of_iterations() {
  for (const Regions regions : {Regions::free, Regions::binding}) {
    std::array<int, 3> small{};
    for (const std::uint32_t width : {9U, 17U, 41U}) {
      const std::array<int, 3> now = iterations_of(block_of(width), regions);
      small = width == 9 ? now : small;
      std::printf("block of %u^3 cells, %s: iterations to 1 %%: fresh grab %d, later move %d, after a cut %d",
                  width - 1, regions == Regions::free ? "free" : "binding", now[0], now[1], now[2]);
      std::printf(" (over 8^3: %.2f, %.2f, %.2f)\n", double(now[0]) / small[0], double(now[1]) / small[1],
                  double(now[2]) / small[2]);
    }
  }
}

/// How far the object is behind the equilibrium at the end of a drag of a second, with 8 ms of iterations per frame.
void lag() {
  constexpr int frames = 60;
  const report::Case object = block_of(37);
  const PatchDrag drag(object);
  for (const Regions regions : {Regions::free, Regions::binding}) {
    Run run(object, contestants.front(), 0, 1, regions);
    run.apply(drag.grab);
    for (int frame = 1; frame <= frames; ++frame) {
      run.frame(drag.to(double(frame) / frames), 8);
    }
    const std::vector<double> shown = run.positions();
    iterations_to_equilibrium(run, object.mesh->rest);
    std::printf("lag, %u elements, %s: %.4f\n", object.mesh->element_count(),
                regions == Regions::free ? "free" : "binding",
                distance_between(shown, run.positions(), object.mesh->rest));
  }
}

report::Case organ_of(const char* file) {
  report::Case object;
  object.name = "organ";
  object.mesh = open_mesh(file).mesh;
  object.pins = layer(*object.mesh, *find_side("bottom"));
  return object;
}

}  // namespace
}  // namespace chainmail::bench

int main(int count, char** arguments) {
  using namespace chainmail;
  using namespace chainmail::bench;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  constexpr std::uint64_t small = 256, large = 5184, huge = 100'000;
  if (count < 2) {
    threads_and_repair(report::pinned_bar(huge, {}, {}, false));
    growth_of_iterations();
    lag();
    return 0;
  }
  measure(report::pinned_bar(small, {}, {}));
  measure(report::pinned_sheet(small, {}, {}));
  measure(organ_of(arguments[1]));
  measure(report::pinned_bar(large, {}, {}));
  return 0;
}
