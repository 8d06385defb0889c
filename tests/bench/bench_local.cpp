// Measures relaxation that is fine only where needed (equilibrium/local_relaxation.h), relaxation of all elements and
// quasi-Newton FEM against the equilibrium of all elements: bench_local [KIND [SCALE [fast]]] drags a patch of a block,
// or a whole side, for 60 frames, with a cut in between, or with a large one before; fast only the first, without the
// comparison. KIND is patch, side, wound, jitter, poisson, or a file with tetrahedra.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "body/body_view.h"
#include "equilibrium/equilibrium_solver.h"
#include "equilibrium/local_relaxation.h"
#include "files/mesh/open_mesh.h"
#include "mesh/error.h"
#include "mesh/generate.h"
#include "mesh/layers.h"
#include "mesh/refine.h"
#include "mesh/scattered.h"
#include "solver/algorithms.h"

namespace chainmail::bench {
namespace {

constexpr int frames = 60;
constexpr double pi = 3.14159265358979;

/// A number from −1 to 1.
double random_of(std::uint64_t seed) { return double(scattered(seed * scatter_step) >> 11) * 0x1p-52 - 1; }

/// A block of tetrahedra; `jitter` moves inner elements (cells), and those of a side along it.
MeshPointer block(std::array<std::uint32_t, 3> cubes, double jitter) {
  MeshPointer mesh = generate({MeshKind::tetra, {cubes[0] + 1, cubes[1] + 1, cubes[2] + 1}, 1, {}});
  if (jitter == 0) {
    return mesh;
  }
  MeshParts parts;
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    Point at = mesh->rest_position(e);
    for (int k = 0; k < 3; ++k) {
      const bool inside = at[k] > 0.5 && at[k] < double(cubes[std::size_t(k)]) - 0.5;
      at[k] += inside ? jitter * random_of(3 * std::uint64_t{e} + std::uint64_t(k)) : 0;
    }
    parts.rest.push_back(at);
  }
  parts.links = mesh->links;
  parts.tetrahedra = mesh->tetrahedra;
  return build_mesh(std::move(parts));
}

/// An object, pinned at one end and dragged at another.
struct Scene {
  std::string name;
  MeshPointer mesh;
  std::vector<ElementId> pins, held;
  std::vector<LinkId> wound;  // cut in the middle of the drag
  bool is_wounded = false;    // the links are cut before the drag
  double far = 0;             // how far the handle goes (mesh units)
  double poisson = 0.3;
};

/// Pins the elements within `deep` of the left end, and holds those within `radius` of the highest element at `along`
/// of the length; or, without a radius, the right end. The wound is beside the handle: a plane, from the surface down.
Scene scene_of(std::string name, MeshPointer mesh, double deep, double radius, double along = 0.75,
               bool is_wounded = false) {
  Scene scene{std::move(name), mesh, {}, {}, {}, is_wounded};
  const auto [low, high] = mesh->box;
  const double length = high[0] - low[0], size = mesh->mean_link_length;
  const Point aim(low[0] + along * length, (low[1] + high[1]) / 2, high[2]);
  ElementId middle = 0;
  const auto score = [&](ElementId e) {
    const Point at = mesh->rest_position(e);
    return std::hypot(at[0] - aim[0], at[1] - aim[1]) > 2 * size ? -INFINITY : at[2] - 1e-3 * (at - aim).norm();
  };
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    middle = score(e) > score(middle) ? e : middle;
  }
  const Point centre = mesh->rest_position(middle);
  std::vector<std::uint8_t> is_surface(mesh->element_count(), 0);
  std::ranges::for_each(boundary(*mesh), [&](ElementId e) { is_surface[e] = 1; });
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    const Point at = mesh->rest_position(e);
    if (at[0] <= low[0] + deep) {
      scene.pins.push_back(e);
    } else if (radius > 0 ? is_surface[e] != 0 && (at - centre).norm() <= radius : at[0] >= high[0] - deep) {
      scene.held.push_back(e);
    }
  }
  scene.far = (radius > 0 ? 0.1 : 0.3) * length;
  const double plane = centre[0] + radius + 1.7 * size;
  const double wide = is_wounded ? 0.15 * length : 2 * size, down = is_wounded ? 0.3 * length : 4 * size;
  for (LinkId link = 0; radius > 0 && link < mesh->link_count(); ++link) {
    const Point a = mesh->rest_position(mesh->links[link][0]), b = mesh->rest_position(mesh->links[link][1]);
    const Point at = (a + b) / 2;
    if ((a[0] < plane) != (b[0] < plane) && std::abs(at[1] - centre[1]) < wide && centre[2] - at[2] < down) {
      scene.wound.push_back(link);
    }
  }
  return scene;
}

/// A body of a scene, whose handle follows a curve.
class Dragged {
 public:
  explicit Dragged(const Scene& scene) : scene_(scene), body_(scene.mesh, Precision::double_precision) {
    body_.set_softness(Softness{{0, 1000, 1000}, {}, EnergyKind::material});
    ElasticOptions elastic;
    elastic.material.poisson = scene.poisson;
    body_.set_elastic(elastic);
    body_.pin(scene.pins);
    if (scene.is_wounded) {
      body_.cut(scene.wound);
    }
  }

  Body& body() { return body_; }
  std::span<const ElementId> held() const { return scene_.held; }
  static bool is_cut_at(int frame) { return frame == frames / 2 + 1; }
  /// Where the handle is in a frame, from rest. A hand is not steady.
  std::array<double, 3> way(int i) const {
    const double t = double(i) / frames;
    const auto shake = [&](std::uint64_t k) { return 0.002 * random_of(std::uint64_t(i) * 3 + k + 1000); };
    return {scene_.far * (0.25 * std::sin(2 * pi * t) + shake(0)),
            scene_.far * (0.2 * (1 - std::cos(pi * t)) + shake(1)),
            scene_.far * (0.95 * t * t * (3 - 2 * t) + 0.02 * t + shake(2))};
  }
  /// Moves the handle on; cuts in the middle.
  void frame(int i) {
    if (i > frames / 2 && body_.cuts().count() == 0) {
      body_.cut(scene_.wound);
    }
    const std::array<double, 3> by = way(i);
    body_.with_view([&]<class View>(const View& view) {
      if constexpr (View::Dimension == 3) {
        for (const ElementId e : scene_.held) {
          for (int k = 0; k < 3; ++k) {
            view.set_position(e, k, scene_.mesh->rest[std::size_t{e} * 3 + std::size_t(k)] + by[std::size_t(k)]);
          }
        }
      }
    });
    body_.note_move();
  }

 private:
  const Scene& scene_;
  Body body_;
};

std::vector<double> displacements(const Body& body) {
  std::vector<double> at(body.mesh().rest.size());
  body.copy_positions(at);
  for (std::size_t i = 0; i < at.size(); ++i) {
    at[i] -= body.mesh().rest[i];
  }
  return at;
}

struct Error {
  double all = 0, moved = 0, largest = 0;  // relative; of elements that moved by 10 % of the handle; per handle's way
};
/// `is_held`: by a cell, of each element. Methods differ in where they leave the others.
Error compare(const std::vector<double>& is, const std::vector<double>& should,
              const std::vector<std::uint8_t>& is_held, double far) {
  double e = 0, u = 0, em = 0, um = 0, most = 0;
  for (std::size_t i = 0; i < is.size(); i += 3) {
    if (is_held[i / 3] == 0) {
      continue;
    }
    double d = 0, s = 0;
    for (std::size_t k = i; k < i + 3; ++k) {
      d += std::pow(is[k] - should[k], 2);
      s += std::pow(should[k], 2);
    }
    e += d;
    u += s;
    most = std::max(most, d);
    if (s > 0.01 * far * far) {
      em += d;
      um += s;
    }
  }
  return {std::sqrt(e / u), um > 0 ? std::sqrt(em / um) : 0, std::sqrt(most) / far};
}

double at_fraction(std::vector<double> values, double fraction) {
  std::ranges::sort(values);
  return values[std::min(values.size() - 1, std::size_t(fraction * double(values.size())))];
}

/// Returns whether a cell without a cut link has each element, after the drag.
std::vector<std::uint8_t> held_by_cells(const Scene& scene) {
  std::vector<std::uint8_t> is_cut(scene.mesh->link_count(), 0), is_held(scene.mesh->element_count(), 0);
  for (const LinkId link : scene.wound) {
    is_cut[link] = 1;
  }
  for (const auto& cell : scene.mesh->tetrahedra) {
    bool is_whole = true;
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        is_whole = is_whole && is_cut[*find_link(*scene.mesh, cell[a], cell[b])] == 0;
      }
    }
    for (std::size_t a = 0; is_whole && a < 4; ++a) {
      is_held[cell[a]] = 1;
    }
  }
  return is_held;
}

struct Reference {
  std::vector<std::uint8_t> is_held;
  std::vector<int> frame;
  std::vector<std::vector<double>> at;
};

Reference solve(const Scene& scene, int every) {
  Dragged dragged(scene);
  Reference result{held_by_cells(scene), {}, {}};
  int iterations = 0;
  for (int i = every; i <= frames; i += every) {
    dragged.frame(i);
    const auto solver = EquilibriumSolver::make(3, false);  // without what others have learned before a cut
    const bool reached = solver->solve(dragged.body(), dragged.held(), 3e-4, 100);
    iterations += solver->iterations();
    if (!reached) {
      std::printf("  frame %d: all elements reach only %.1e\n", i, solver->residual());
    }
    result.frame.push_back(i);
    result.at.push_back(displacements(dragged.body()));
  }
  std::printf("%s: %u elements, %zu cells; all of them take %.0f iterations\n", scene.name.c_str(),
              scene.mesh->element_count(), scene.mesh->tetrahedra.size(),
              double(iterations) / double(result.frame.size()));
  return result;
}

/// Times and errors of a method along a drag.
class Tally {
 public:
  explicit Tally(const Scene& scene, const Reference& reference) : scene_(scene), reference_(reference) {}

  /// Measures the processor time of a frame.
  template <class Frame>
  void time(int i, Frame frame) {
    const auto start = std::clock();
    frame();
    ms_.push_back(double(std::clock() - start) * 1e3 / CLOCKS_PER_SEC);
    cut_ = Dragged::is_cut_at(i) ? ms_.back() : cut_;
  }
  /// Compares the displacements of a frame, if the reference has it. Returns the relative error then, or 0.
  template <class Displacements>
  double compare_frame(int i, Displacements displacements) {
    if (next_ == reference_.frame.size() || reference_.frame[next_] != i) {
      return 0;
    }
    const Error error = compare(displacements(), reference_.at[next_], reference_.is_held, scene_.far);
    worst_ = {std::max(worst_.all, error.all), std::max(worst_.moved, error.moved),
              std::max(worst_.largest, error.largest)};
    mean_ += error.all / double(reference_.frame.size());
    ++next_;
    return error.all;
  }
  void print() const {
    const std::vector later(ms_.begin() + 1, ms_.end());
    std::printf("rms %.3f worst %.3f moved %.3f max %.3f | ms first %.1f median %.2f p90 %.2f most %.2f cut %.1f",
                mean_, worst_.all, worst_.moved, worst_.largest, ms_[0], at_fraction(later, 0.5),
                at_fraction(later, 0.9), at_fraction(later, 1), scene_.wound.empty() ? 0.0 : cut_);
  }

 private:
  const Scene& scene_;
  const Reference& reference_;
  std::vector<double> ms_;
  double mean_ = 0, cut_ = 0;
  Error worst_;
  std::size_t next_ = 0;
};

void drag(const Scene& scene, const Reference& reference, const LocalRelaxation::Options& options) {
  Dragged dragged(scene);
  const auto begin = std::clock();
  LocalRelaxation relaxation(dragged.body(), options);
  const double building = double(std::clock() - begin) * 1e3 / CLOCKS_PER_SEC;
  Tally tally(scene, reference);
  double nodes = 0, tetrahedra = 0, written = 0, iterations = 0, least = 1, lowest = 1e9, highest = 0;
  for (int i = 1; i <= frames; ++i) {
    dragged.frame(i);
    LocalRelaxation::Result result;
    tally.time(i, [&] { result = relaxation.update(dragged.body(), dragged.held()); });
    nodes += double(result.nodes) / frames;
    tetrahedra += double(result.tetrahedra) / frames;
    written += double(relaxation.moved().size()) / frames;
    iterations += double(result.iterations) / frames;
    least = std::min(least, result.least_ratio);
    const double error = tally.compare_frame(i, [&] {
      relaxation.finish(dragged.body());
      return displacements(dragged.body());
    });
    if (result.estimate && error > 0) {
      lowest = std::min(lowest, *result.estimate / error);
      highest = std::max(highest, *result.estimate / error);
    }
  }
  std::printf("  theta %-4g widest 1/%-4.3g tol %-6g| ", options.theta, 1 / options.widest, options.tolerance);
  tally.print();
  std::printf(" | %.0f nodes %.0f tets %.0f written %.1f its, J %.2f | built in %.0f ms\n", nodes, tetrahedra, written,
              iterations, least, building);
  if (options.has_twin) {
    std::printf("    with the twin; estimate/error %.2f to %.2f\n", lowest, highest);
  }
}

/// Drags with iterations for all elements. The first frame prepares them.
void drag_all(const Scene& scene, const Reference& reference, int iterations) {
  Dragged dragged(scene);
  const auto solver = EquilibriumSolver::make(3, false);
  Tally tally(scene, reference);
  for (int i = 1; i <= frames; ++i) {
    dragged.frame(i);
    tally.time(i, [&] { solver->solve(dragged.body(), dragged.held(), 0.01, iterations); });
    tally.compare_frame(i, [&] { return displacements(dragged.body()); });
  }
  std::printf("  all elements, up to %d iterations a frame | ", iterations);
  tally.print();
  std::printf("\n");
}

/// Makes the solver, and holds the handle from rest.
std::unique_ptr<ElasticSolver> make_quasi_newton(const Body& body, const Scene& scene, int iterations) {
  ElasticProblem problem{scene.mesh, body.cuts(), scene.pins, std::vector<double>(3 * scene.pins.size(), 0.0), {}};
  problem.options.material.poisson = scene.poisson;
  problem.options.iterations = std::uint32_t(iterations);
  auto solver = make_elastic(Algorithm::quasi_newton, problem);
  const std::vector<double> none(3 * scene.held.size(), 0.0);
  solver->hold({scene.held, none, none}, {});
  return solver;
}

/// Drags with quasi-Newton FEM. The first frame and the cut prepare it: its matrix is factored.
void drag_quasi_newton(const Scene& scene, const Reference& reference, int iterations) {
  Dragged dragged(scene);
  std::unique_ptr<ElasticSolver> solver;
  Tally tally(scene, reference);
  for (int i = 1; i <= frames; ++i) {
    dragged.frame(i);
    tally.time(i, [&] {
      if (!solver || Dragged::is_cut_at(i)) {
        const std::vector<double> before = solver ? solver->displacements() : std::vector<double>();
        solver = make_quasi_newton(dragged.body(), scene, iterations);
        if (!before.empty()) {
          solver->start_from(before);
        }
      }
      solver->move(ElasticMotion::by(dragged.way(i)), {});
    });
    tally.compare_frame(i, [&] { return solver->displacements(); });
  }
  std::printf("  quasi-Newton FEM, up to %d iterations a frame | ", iterations);
  tally.print();
  std::printf("\n");
}

void run(const Scene& scene, int every) {
  const Reference reference = every > 0 ? solve(scene, every) : Reference();
  drag(scene, reference, {});
  drag(scene, reference, {.has_twin = true});
  drag(scene, reference, {.theta = 1});
  drag(scene, reference, {.tolerance = 0.005});
  if (every > 0) {
    drag_all(scene, reference, 1);
    drag_all(scene, reference, 20);
    try {
      drag_quasi_newton(scene, reference, 1);
      drag_quasi_newton(scene, reference, 20);
    } catch (const chainmail::Error& error) {
      std::printf("  %s\n", error.what());
    }
  }
}

/// Runs a block of a kind. `every`: the frames between comparisons, 0 for none.
void run_block(const std::string& kind, const std::string& scale, const std::array<std::uint32_t, 3>& cubes,
               int every) {
  const bool is_jittered = kind == "jitter";
  Scene scene = scene_of(scale + ", " + kind, block(cubes, is_jittered ? 0.2 : 0), 0.01, kind == "side" ? 0 : 3.1, 0.75,
                         kind == "wound");
  scene.poisson = kind == "poisson" ? 0.45 : scene.poisson;
  run(scene, every);
}

/// Runs an irregular mesh, refined until it has this many elements.
void run_file(const std::string& path, double elements, int every) {
  MeshPointer mesh = open_mesh(path).mesh;
  while (mesh->element_count() < elements) {
    mesh = refine(*mesh).mesh;
  }
  const double size = mesh->mean_link_length;
  run(scene_of(path, mesh, 0.1 * (mesh->box[1][0] - mesh->box[0][0]), 3 * size), every);
}

}  // namespace
}  // namespace chainmail::bench

int main(int count, char** arguments) {
  using namespace chainmail::bench;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const std::string kind = count > 1 ? arguments[1] : "all", scale = count > 2 ? arguments[2] : "all";
  const bool compares = count < 4;
  const std::array<std::uint32_t, 3> small{24, 24, 20}, medium{48, 48, 40}, large{96, 96, 112};
  for (const auto& [name, cubes, elements, every] :
       {std::tuple("10^4", small, 1e4, 5), std::tuple("10^5", medium, 5e4, 10), std::tuple("10^6", large, 5e5, 20)}) {
    if (scale != "all" && scale != name) {
      continue;
    }
    if (kind.find('.') != std::string::npos) {
      run_file(kind, elements, compares ? every : 0);
    }
    for (const char* block : {"patch", "side", "wound", "jitter", "poisson"}) {
      if (kind == "all" || kind == block) {
        run_block(block, name, cubes, compares ? every : 0);
      }
    }
  }
}
