// Divides solids along strokes (see README.md): bench_knife [MESH]. Prints a table in Markdown.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "files/mesh/open_mesh.h"
#include "mesh/cells.h"
#include "mesh/divide_cells.h"
#include "mesh/generate.h"
#include "solver/deformer.h"

namespace chainmail::bench {
namespace {

using Stroke = std::vector<Eigen::Vector2d>;  // in shares of the object's width and height

double volume_of(const std::array<Point, 4>& p) { return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) / 6; }

struct Cells {
  std::size_t count = 0;
  double volume = 0;
  double worst = 1;  // quality
};

Cells cells_of(const Mesh& mesh) {
  Cells cells;
  const auto add = [&](const std::array<ElementId, 4>& corner) {
    std::array<Point, 4> at;
    std::ranges::transform(corner, at.begin(), [&](ElementId e) { return mesh.rest_position(e); });
    cells.volume += volume_of(at);
    cells.worst = std::min(cells.worst, tetrahedron_quality(at));
  };
  std::ranges::for_each(mesh.tetrahedra, add);
  for (const auto& cell : mesh.hexahedra) {
    for_each_tetrahedron(mesh, cell, add);
  }
  cells.count = mesh.tetrahedra.size() + mesh.hexahedra.size();
  return cells;
}

MeshPointer block(std::uint32_t cubes, double jitter) {
  const std::uint32_t n = cubes + 1;
  const MeshPointer regular = generate({MeshKind::tetra, {n, n, n}, 1, {}});
  if (jitter == 0) {
    return regular;
  }
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> one(-jitter, jitter);
  MeshParts parts;
  for (ElementId e = 0; e < regular->element_count(); ++e) {
    const Point at = regular->rest_position(e);
    const bool inside = (at.array() > 0).all() && (at.array() < cubes).all();
    parts.rest.push_back(inside ? Point(at + Point(one(random), one(random), one(random))) : at);
  }
  parts.tetrahedra = regular->tetrahedra;
  parts.links = regular->links;
  return build_mesh(std::move(parts));
}

/// Where the elements are in a view from above.
std::vector<ViewPlace> places_of(const Mesh& mesh, const Stroke& shares, Stroke& stroke) {
  std::vector<ViewPlace> places;
  Eigen::Vector2d low = Eigen::Vector2d::Constant(HUGE_VAL), high = -low;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    places.push_back({mesh.rest_position(e).head<2>()});
    low = low.cwiseMin(places.back().at);
    high = high.cwiseMax(places.back().at);
  }
  for (const Eigen::Vector2d& share : shares) {
    stroke.push_back(low + share.cwiseProduct(high - low));
  }
  return places;
}

/// Milliseconds of this thread on its core, so that other load on the machine counts little.
double now() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * double(time.tv_sec) + 1e-6 * double(time.tv_nsec);
}

constexpr int repetitions = 5;

/// Counts the milliseconds that something takes: the median of some times.
template <class Action>
double milliseconds(Action action) {
  std::vector<double> times;
  for (int i = 0; i < repetitions; ++i) {
    const double start = now();
    action();
    times.push_back(now() - start);
  }
  std::ranges::sort(times);
  return times[repetitions / 2];
}

void divide(const std::string& object, const MeshPointer& mesh, const std::string& name, const Stroke& shares) {
  Stroke stroke;
  const std::vector<ViewPlace> places = places_of(*mesh, shares, stroke);
  SplitEdit edit;
  const double find = milliseconds([&] { edit = divide_cells(*mesh, places, stroke); });
  if (edit.empty()) {
    std::printf("| %s | %s | nothing comes apart |\n", object.c_str(), name.c_str());
    return;
  }
  SplitPointer split;
  MeshPointer divided;
  const double build = milliseconds([&] {
    split = make_split(mesh, edit);
    divided = split->after();
  });
  const Deformer deformer(mesh, Algorithm::natural_queue, Precision::single_precision);
  const Snapshot rest = deformer.body().snapshot();
  std::vector<Deformer> copies;
  for (int i = 0; i < repetitions; ++i) {
    copies.push_back(deformer.copy());
  }
  auto next = copies.begin();
  const double carry_out = milliseconds([&] { (next++)->split(split, rest); });
  const Cells before = cells_of(*mesh), after = cells_of(*divided);
  std::printf("| %s | %s | %zu | %zu | %zu | %.3f | %.3f | %.0e | %.0f | %.0f | %.0f |\n", object.c_str(), name.c_str(),
              before.count, edit.removed_cells.size(), after.count, before.worst, after.worst,
              std::abs(after.volume / before.volume - 1), find, build, carry_out);
}

}  // namespace
}  // namespace chainmail::bench

int main(int argc, char** argv) {
  using namespace chainmail;
  using namespace chainmail::bench;
  std::printf(
      "| object | stroke | cells | replaced | after | worst quality | after | volume error | find (ms) | "
      "mesh (ms) | body (ms) |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  const std::vector<std::pair<std::string, Stroke>> strokes{
      {"across", {{-0.1, 0.47}, {1.1, 0.53}}},
      {"slit", {{-0.1, 0.52}, {0.5, 0.48}}},
      {"bent", {{0.3, -0.1}, {0.45, 0.5}, {0.75, 0.6}, {0.8, 1.1}}},
  };
  std::vector<std::pair<std::string, MeshPointer>> objects;
  if (argc > 1) {
    objects.emplace_back(argv[1], open_mesh(argv[1]).mesh);
  }
  for (const std::uint32_t cubes : {26U, 56U}) {
    const std::string cells = std::to_string(6 * cubes * cubes * cubes);
    objects.emplace_back("block of " + cells, block(cubes, 0));
    objects.emplace_back("jittered block of " + cells, block(cubes, 0.2));
  }
  for (const auto& [object, mesh] : objects) {
    for (const auto& [name, shares] : strokes) {
      divide(object, mesh, name, shares);
    }
    // About as many cells in objects of any size.
    divide(object, mesh, "of 2,000 cells",
           {{-0.1, 0.47}, {0.5 * std::pow(100'000.0 / mesh->tetrahedra.size(), 2 / 3.0), 0.47}});
  }
}
