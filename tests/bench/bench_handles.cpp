// Prints the time of a move of a handle of many elements, for every algorithm: bench_handles [FILTER]. The filter is a
// part of SCENE/ALGORITHM. The handle moves on a circle of eight moves, then rotates back and forth by two degrees.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "measure/violation.h"
#include "mesh/error.h"
#include "mesh/generate.h"
#include "mesh/layers.h"
#include "solver/solver.h"

using namespace chainmail;

namespace {

constexpr int rounds = 5;
constexpr int moves_per_round = 8;

struct HandleScene {
  std::string name;
  MeshPointer mesh;
  std::vector<ElementId> handle, pins;
  double radius;  // of the circle (mesh units)
};

/// A square patch in the middle of a plane object, of which the lower edge is pinned for the methods that need pins.
HandleScene with_patch(const std::string& name, MeshKind kind, std::uint32_t side, std::uint32_t width) {
  HandleScene scene{name, generate({kind, {side, side, 1}}), {}, {}, 2};
  const std::uint32_t first = (side - width) / 2;
  for (std::uint32_t y = first; y < first + width; ++y) {
    for (std::uint32_t x = first; x < first + width; ++x) {
      scene.handle.push_back(y * side + x);
    }
  }
  scene.pins = layer(*scene.mesh, *find_side("bottom"));
  return scene;
}

/// A solid of tetrahedra whose top is the handle.
HandleScene solid_with_top(std::uint32_t side) {
  HandleScene scene{"solid", generate({MeshKind::tetra, {side, side, side}}), {}, {}, 0.5};
  scene.handle = layer(*scene.mesh, *find_side("top"));
  scene.pins = layer(*scene.mesh, *find_side("bottom"));
  return scene;
}

double median_of(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(values.size() / 2));
  return values[values.size() / 2];
}

/// The share of the links outside the handle that are violated.
double violated_share(const Solver& solver, const std::set<ElementId>& handle) {
  const Mesh& mesh = solver.body().mesh();
  std::uint64_t violated = 0;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    const auto [a, b] = mesh.links[link];
    const double violation = handle.contains(a) && handle.contains(b)
                                 ? 0
                                 : link_violation(mesh, solver.body().softness(), solver.body().positions(), link);
    violated += violation > counts_as_violated ? 1 : 0;
  }
  return double(violated) / mesh.link_count();
}

class HandleDrag {
 public:
  HandleDrag(const HandleScene& scene, const AlgorithmInfo& algorithm)
      : scene_(scene), solver_(scene.mesh, algorithm.algorithm, Precision::single_precision) {
    if (algorithm.needs_pins) {
      solver_.body().pin(scene.pins);
    }
  }

  void print(const std::string& algorithm) {
    Handle handle(solver_.body(), scene_.handle);
    const double first = move(handle, place(handle, 0));
    std::vector<double> translations, rotations;
    for (int i = 1; i <= rounds * moves_per_round; ++i) {
      translations.push_back(move(handle, place(handle, i)));
    }
    for (int i = 0; i < rounds * moves_per_round; ++i) {
      Pose pose = handle.pose();
      pose.rotation = (i % 2) * 2 * std::numbers::pi / 180 * Point(0, 0, 1);
      rotations.push_back(move(handle, pose));
    }
    const double violated = violated_share(solver_, {scene_.handle.begin(), scene_.handle.end()});
    std::printf("%-8s  %-14s  %9u  %7zu  %10.3f  %10.3f  %10.3f  %8.4f\n", scene_.name.c_str(), algorithm.c_str(),
                scene_.mesh->element_count(), scene_.handle.size(), first, median_of(translations),
                median_of(rotations), violated);
  }

 private:
  Pose place(const Handle& handle, int i) const {
    const double angle = 2 * std::numbers::pi * i / moves_per_round;
    return {handle.grabbed().pivot + scene_.radius * Point(std::cos(angle), std::sin(angle), 0), Point::Zero()};
  }

  double move(Handle& handle, const Pose& pose) {
    const auto start = std::chrono::steady_clock::now();
    solver_.move(handle, pose);
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  }

  const HandleScene& scene_;
  Solver solver_;
};

}  // namespace

int main(int argc, char** argv) {
  const std::string filter = argc > 1 ? argv[1] : "";
  std::printf("%-8s  %-14s  %9s  %7s  %10s  %10s  %10s  %8s\n", "scene", "algorithm", "elements", "handle", "first ms",
              "later ms", "rotation", "violated");
  for (const HandleScene& scene :
       {with_patch("surface", MeshKind::cloth, 159, 17), with_patch("cloth", MeshKind::cloth, 1000, 100),
        with_patch("grid", MeshKind::grid, 1000, 100), solid_with_top(12)}) {
    for (const AlgorithmInfo& algorithm : every_algorithm()) {
      const std::string name(algorithm.offered_name());
      if ((scene.name + "/" + name).find(filter) == std::string::npos) {
        continue;
      }
      try {
        HandleDrag(scene, algorithm).print(name);
      } catch (const Error& error) {
        std::printf("%-8s  %-14s  %s\n", scene.name.c_str(), name.c_str(), error.what());
      }
      std::fflush(stdout);
    }
  }
}
