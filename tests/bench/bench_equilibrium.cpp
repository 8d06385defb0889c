// Measures the relaxation to the equilibrium (see README.md): bench_equilibrium RESULTS, or bench_equilibrium --large
// for the cut of large objects, which takes minutes.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "bench/results.h"
#include "mesh/generate.h"
#include "mesh/layers.h"
#include "simulate/simulation.h"

namespace chainmail::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr LinkSoftness open{0, 100, 100};  // regions that never bind

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

MeshPointer mesh_of(MeshKind kind, std::uint32_t width) {
  return generate({kind, {width, width, kind == MeshKind::tetra ? width : 1}, 1, {}});
}

/// An object whose left side is pinned and whose last element is dragged by a fifth of the object's width.
class Scene {
 public:
  Scene(const MeshPointer& mesh, const LinkSoftness& softness, Algorithm algorithm = Algorithm::exact)
      : simulation_(mesh, algorithm, Precision::double_precision), handle_(mesh->element_count() - 1) {
    simulation_.apply(commands::SetSoftness{{softness, {}}});
    simulation_.apply(commands::Pin{layer(*mesh, *find_side("left"))});
    simulation_.apply(commands::Grab{{handle_}});
    const Point corner = mesh->rest_position(handle_);
    way_ = 0.2 * corner.maxCoeff() * Point(0.8, -0.6, 0);
    from_ = corner;
  }

  Simulation& simulation() { return simulation_; }
  /// Drags to a share of the whole way.
  void drag(double share) { simulation_.apply(commands::Drag{from_ + share * way_}); }
  /// Runs sweeps or iterations.
  void relax(RelaxationScheme scheme, int count, double until = 0) {
    simulation_.apply(commands::Relax{std::uint32_t(count), 1, scheme, until});
  }
  std::vector<double> displacements() const {
    return displacements_of(simulation_.mesh(), simulation_.body().positions());
  }
  /// Largest distance from another state on an axis, over the displacement of the handle.
  double distance_from(const std::vector<double>& other) const {
    const std::vector<double> now = displacements();
    const int n = simulation_.mesh().space_dimension;
    double largest = 0, square = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      largest = std::max(largest, std::abs(now[i] - other[i]));
    }
    for (int k = 0; k < n; ++k) {
      square += std::pow(now[std::size_t{handle_} * n + k], 2);
    }
    return largest / std::sqrt(square);
  }

 private:
  Simulation simulation_;
  ElementId handle_;
  Point from_, way_;
};

std::vector<double> equilibrium_of(const MeshPointer& mesh, const LinkSoftness& softness) {
  Scene scene(mesh, softness);
  scene.drag(1);
  scene.relax(RelaxationScheme::equilibrium, 1000, 1e-6);
  return scene.displacements();
}

struct Effort {
  int iterations = 0;
  double seconds = 0;
};

/// Returns the effort from a fresh grab until the object stays within 1 % of the equilibrium, set-up included.
Effort effort(const MeshPointer& mesh, const LinkSoftness& softness, RelaxationScheme scheme, int stride, int most) {
  const std::vector<double> goal = equilibrium_of(mesh, softness);
  Scene scene(mesh, softness);
  scene.drag(1);
  Effort effort, reached;
  bool is_near = false;
  for (int beyond = 0; effort.iterations < most && beyond < 10;) {
    const auto start = Clock::now();
    scene.relax(scheme, stride);
    effort.seconds += seconds_since(start);
    effort.iterations += stride;
    if (scene.distance_from(goal) > 0.01) {
      is_near = false;
      beyond = 0;
    } else if (!is_near) {
      reached = effort;
      is_near = true;
    } else {
      ++beyond;
    }
  }
  return is_near ? reached : Effort{most, effort.seconds};
}

void growth(Results& results, const char* name, MeshKind kind, std::uint32_t small, std::uint32_t middle,
            std::uint32_t large) {
  for (const auto& [regions, softness] : {std::pair("free", open), std::pair("binding", LinkSoftness{})}) {
    const std::string place = std::string(name) + "/" + regions;
    const auto run = [&, softness = softness](std::uint32_t width) {
      return effort(mesh_of(kind, width), softness, RelaxationScheme::equilibrium, 1, 1000);
    };
    const Effort few = run(small), some = run(middle), many = run(large);
    results.add("/equilibrium/iterations/" + place, double(many.iterations) / few.iterations);
    results.add("/equilibrium/seconds_at_100000/" + place, some.seconds * 1e5 / mesh_of(kind, middle)->element_count());
    std::printf("%s: iterations %d, %d, %d; seconds %.3g, %.3g, %.3g\n", place.c_str(), few.iterations, some.iterations,
                many.iterations, few.seconds, some.seconds, many.seconds);
  }
}

/// Compares with sweeps, which need many.
void against_sweeps(Results& results) {
  const MeshPointer mesh = mesh_of(MeshKind::cloth, 128);
  const Effort direct = effort(mesh, open, RelaxationScheme::equilibrium, 1, 1000);
  const Effort sweeps = effort(mesh, open, RelaxationScheme::mean, 250, 5000);
  results.add("/equilibrium/over_sweeps", sweeps.seconds / direct.seconds);
  std::printf("sweeps: %d in %.3g s; iterations: %d in %.3g s\n", sweeps.iterations, sweeps.seconds, direct.iterations,
              direct.seconds);
}

/// Measures how far the object is behind the equilibrium at the end of a drag of a second, with 8 ms of iterations in
/// each frame.
void lag(Results& results, const char* name, const MeshPointer& mesh, const LinkSoftness& softness) {
  constexpr int frames = 60;
  const std::vector<double> goal = equilibrium_of(mesh, softness);
  Scene scene(mesh, softness);
  scene.simulation().apply(commands::SetRelaxation{true, 1, RelaxationScheme::equilibrium});
  for (int frame = 1; frame <= frames; ++frame) {
    scene.drag(double(frame) / frames);
    const auto start = Clock::now();
    do {
      scene.simulation().continue_relaxation();
    } while (seconds_since(start) < 0.008);
  }
  results.add(std::string("/equilibrium/lag/") + name, scene.distance_from(goal));
}

/// Returns the time of the first answer after a cut through half of the object, between two moves of a drag.
double after_cut(const MeshPointer& mesh, Algorithm algorithm, const LinkSoftness& softness) {
  Scene scene(mesh, softness, algorithm);
  const bool relaxes = algorithm == Algorithm::exact;
  const auto answer = [&](double share) {
    scene.drag(share);
    if (relaxes) {
      scene.relax(RelaxationScheme::equilibrium, 1000, 1e-2);
    }
  };
  answer(0.5);
  const double middle = mesh->box[1].x() / 2 + 0.25, half = mesh->box[1].y() / 2;
  std::vector<LinkId> cut;
  for (LinkId link = 0; link < mesh->link_count(); ++link) {
    const Point a = mesh->rest_position(mesh->links[link][0]), b = mesh->rest_position(mesh->links[link][1]);
    if ((a.x() < middle) != (b.x() < middle) && std::min(a.y(), b.y()) > half) {
      cut.push_back(link);
    }
  }
  const auto start = Clock::now();
  scene.simulation().apply(commands::Cut{cut});
  answer(0.6);
  return seconds_since(start);
}

void against_fem(Results* results, MeshKind kind, const char* name, std::uint32_t width) {
  const MeshPointer mesh = mesh_of(kind, width);
  const double ours = after_cut(mesh, Algorithm::exact, open), fem = after_cut(mesh, Algorithm::linear_fem, open);
  std::printf("after a cut, %s of %u elements: equilibrium %.3g s, linear FEM %.3g s\n", name, mesh->element_count(),
              ours, fem);
  if (results != nullptr) {
    results->add(std::string("/equilibrium/after_cut/") + name + std::to_string(width), fem / ours);
  }
}

}  // namespace
}  // namespace chainmail::bench

int main(int count, char** arguments) {
  using namespace chainmail;
  using namespace chainmail::bench;
  if (count == 2 && std::strcmp(arguments[1], "--large") == 0) {
    against_fem(nullptr, MeshKind::cloth, "sheet", 380);
    against_fem(nullptr, MeshKind::tetra, "block", 40);
    return 0;
  }
  if (count != 2) {
    std::fprintf(stderr, "usage: bench_equilibrium RESULTS, or bench_equilibrium --large\n");
    return 2;
  }
  Results results(arguments[1]);
  growth(results, "plane", MeshKind::cloth, 32, 128, 512);
  growth(results, "space", MeshKind::tetra, 10, 20, 40);
  against_sweeps(results);
  lag(results, "plane", mesh_of(MeshKind::cloth, 224), open);
  lag(results, "plane_binding", mesh_of(MeshKind::cloth, 224), {});
  lag(results, "space", mesh_of(MeshKind::tetra, 37), open);
  for (const std::uint32_t width : {45U, 141U}) {
    against_fem(&results, MeshKind::cloth, "sheet", width);
  }
  for (const std::uint32_t width : {13U, 27U}) {
    against_fem(&results, MeshKind::tetra, "block", width);
  }
  results.write();
  return 0;
}
