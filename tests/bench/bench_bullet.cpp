// Compares Bullet's soft body with ChainMail on a task that both solve: bench_bullet RESULTS.

#include <BulletSoftBody/btSoftBody.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <numeric>
#include <random>

#include "bench/contestants.h"
#include "bench/results.h"
#include "measure/reference_solution.h"

namespace chainmail::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int frames = 60;               // per second
constexpr int frames_of_the_drag = 60;   // after them, the handle is held
constexpr int max_frames = 60 * frames;  // after them, the object counts as not settled
constexpr double settled_step = 1e-5;    // largest movement of an element in a frame, in spacings

/// A cloth in the plane with a pinned bottom side. The handle is the element in the middle of the top side. It moves up
/// and to the side by a tenth of the height each.
struct Task {
  explicit Task(std::uint32_t side) : scene("cloth" + std::to_string(side)), handle(side * (side - 1) + side / 2) {
    for (ElementId e = 0; e < side; ++e) {
      pins.push_back(e);
    }
    const double by = 0.1 * (side - 1);
    displacement = Point(by, by, 0);
  }
  Point target(double share) const { return scene.mesh->rest_position(handle) + share * displacement; }

  Scene scene;
  ElementId handle;
  std::vector<ElementId> pins;
  Point displacement;
};

/// A dragged object, for any method that moves it.
class Dragged {
 public:
  virtual ~Dragged() = default;
  virtual void frame(const Point& handle) = 0;
  virtual Point position(ElementId element) const = 0;
};

/// A ChainMail algorithm, or linear FEM, with its default parameters.
class BySolver : public Dragged {
 public:
  BySolver(const Task& task, Algorithm algorithm)
      : mesh_(task.scene.mesh),
        handle_(task.handle),
        solver_(std::make_unique<Deformer>(mesh_, algorithm, Precision::double_precision)) {
    solver_->body().pin(task.pins);
  }
  void frame(const Point& handle) override { solver_->move(handle_, handle); }
  Point position(ElementId element) const override { return point_of(*mesh_, solver_->body().positions(), element); }

 private:
  MeshPointer mesh_;
  ElementId handle_;
  std::unique_ptr<Deformer> solver_;
};

/// Returns the links in random order, as Bullet's own helpers do. In the mesh's order, one iteration spreads the pull
/// of the handle through the whole object, and one iteration per frame is unstable.
std::vector<LinkId> link_order(const Mesh& mesh) {
  std::vector<LinkId> order(mesh.link_count());
  std::iota(order.begin(), order.end(), LinkId{0});
  std::mt19937_64 random(11);
  std::shuffle(order.begin(), order.end(), random);
  return order;
}

/// Links of full stiffness, equal masses, and some damping so that the object comes to rest; no gravity, air or
/// contacts. The handle and the pins have no mass, which is how users of Bullet hold a node.
class ByBullet : public Dragged {
 public:
  ByBullet(const Task& task, int iterations) : handle_(int(task.handle)) {
    const Mesh& mesh = *task.scene.mesh;
    std::vector<btVector3> positions;
    for (ElementId e = 0; e < mesh.element_count(); ++e) {
      positions.push_back(vector(mesh.rest_position(e)));
    }
    const std::vector<btScalar> masses(positions.size(), 1);
    world_.m_gravity.setZero();
    world_.air_density = 0;
    world_.m_sparsesdf.Initialize();
    body_ = std::make_unique<btSoftBody>(&world_, int(positions.size()), positions.data(), masses.data());
    body_->m_materials[0]->m_kLST = 1;
    body_->m_cfg.kDP = btScalar(0.1);
    body_->m_cfg.piterations = iterations;
    body_->m_cfg.collisions = 0;
    for (const LinkId link : link_order(mesh)) {
      body_->appendLink(int(mesh.links[link][0]), int(mesh.links[link][1]));
    }
    body_->setMass(handle_, 0);
    for (const ElementId pin : task.pins) {
      body_->setMass(int(pin), 0);
    }
  }

  void frame(const Point& handle) override {
    body_->m_nodes[handle_].m_x = vector(handle);
    body_->m_nodes[handle_].m_v.setZero();
    // The same steps as in btSoftRigidDynamicsWorld, without rigid bodies.
    body_->predictMotion(btScalar(1.0 / frames));
    body_->solveConstraints();
    body_->integrateMotion();
  }

  Point position(ElementId element) const override {
    const btVector3& at = body_->m_nodes[int(element)].m_x;
    return {at.x(), at.y(), at.z()};
  }

 private:
  static btVector3 vector(const Point& point) { return {btScalar(point[0]), btScalar(point[1]), btScalar(point[2])}; }

  int handle_;
  btSoftBodyWorldInfo world_;
  std::unique_ptr<btSoftBody> body_;
};

/// An object in which only the handle moves.
class ByNothing : public Dragged {
 public:
  explicit ByNothing(const Task& task) : task_(task), at_(task.target(0)) {}
  void frame(const Point& handle) override { at_ = handle; }
  Point position(ElementId element) const override {
    return element == task_.handle ? at_ : task_.scene.mesh->rest_position(element);
  }

 private:
  const Task& task_;
  Point at_;
};

std::map<std::string, std::unique_ptr<Dragged>> contestants(const Task& task) {
  std::map<std::string, std::unique_ptr<Dragged>> all;
  for (const int iterations : {1, 10, 50}) {
    all["bullet" + std::to_string(iterations)] = std::make_unique<ByBullet>(task, iterations);
  }
  all["natural_queue"] = std::make_unique<BySolver>(task, Algorithm::natural_queue);
  all["exact"] = std::make_unique<BySolver>(task, Algorithm::exact);
  all["linear_fem"] = std::make_unique<BySolver>(task, Algorithm::linear_fem);
  all["nothing"] = std::make_unique<ByNothing>(task);
  return all;
}

std::vector<Point> positions(const Task& task, const Dragged& object) {
  std::vector<Point> all;
  for (ElementId e = 0; e < task.scene.mesh->element_count(); ++e) {
    all.push_back(object.position(e));
  }
  return all;
}

struct Settled {
  std::vector<double> ms;  // per frame
  int frames = 0;          // until it came to rest, or max_frames
};

/// Runs the drag, then frames with the handle held, until no element moves by more than settled_step.
Settled settle(const Task& task, Dragged& object) {
  Settled result;
  auto before = positions(task, object);
  for (double largest = 1;
       result.frames < max_frames && (result.frames <= frames_of_the_drag || largest > settled_step); ++result.frames) {
    const auto begin = Clock::now();
    object.frame(task.target(std::min(1.0, double(result.frames + 1) / frames_of_the_drag)));
    result.ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
    auto now = positions(task, object);
    largest = 0;
    for (std::size_t e = 0; e < now.size(); ++e) {
      largest = std::max(largest, (now[e] - before[e]).norm());
    }
    before = std::move(now);
  }
  return result;
}

/// Displacements from rest, compared with those of the reference solution.
struct Shape {
  // Mean over all elements of the displacement along the handle's direction, divided by the handle's displacement.
  double follow = 0;
  double relative = 0;  // RMS(u - reference) / RMS(reference)
};

Shape shape(const Task& task, const std::vector<Point>& positions, const std::vector<Point>& reference) {
  double follow = 0, apart = 0, square = 0;
  for (ElementId e = 0; e < positions.size(); ++e) {
    const Point u = positions[e] - task.scene.mesh->rest_position(e);
    follow += u.dot(task.displacement) / task.displacement.squaredNorm() / double(positions.size());
    apart += (u - reference[e]).squaredNorm();
    square += reference[e].squaredNorm();
  }
  return {follow, std::sqrt(apart / square)};
}

/// Returns the displacements of a neo-Hookean solid on the same cells, at rest after the drag.
std::vector<Point> reference_solution(const Task& task) {
  ElasticProblem problem;
  problem.mesh = task.scene.mesh;
  problem.cuts = Cuts(task.scene.mesh);
  problem.pins = task.pins;
  problem.pinned.assign(task.pins.size() * 2, 0);
  const auto solution = ReferenceSolver(problem).at(task.handle, task.target(1)).displacements;
  std::vector<Point> all;
  for (std::size_t i = 0; i < solution.size(); i += 2) {
    all.emplace_back(solution[i], solution[i + 1], 0);
  }
  return all;
}

/// Runs the contestants one after another, so that the data of each stays in the caches from frame to frame, as in real
/// programs.
void run_task(std::uint32_t side, Results& results) {
  const Task task(side);
  const auto reference = reference_solution(task);
  for (const auto& [name, object] : contestants(task)) {
    const Settled settled = settle(task, *object);
    const Shape found = shape(task, positions(task, *object), reference);
    const std::string place = "/vs_bullet/" + task.scene.name + "/" + name + "/";
    results.add(place + "ms", median(settled.ms));
    results.add(place + "frames", settled.frames);
    results.add(place + "follow", found.follow);
    results.add(place + "relative", found.relative);
    std::printf(
        "%-10s %-14s %8.3f ms per frame, settled after %4d frames, follow-through %5.1f %%, relative error %.3f\n",
        task.scene.name.c_str(), name.c_str(), median(settled.ms), settled.frames, 100 * found.follow, found.relative);
    std::fflush(stdout);
  }
  const Shape own = shape(
      task,
      [&] {
        std::vector<Point> all;
        for (ElementId e = 0; e < reference.size(); ++e) {
          all.push_back(task.scene.mesh->rest_position(e) + reference[e]);
        }
        return all;
      }(),
      reference);
  results.add("/vs_bullet/" + task.scene.name + "/reference/follow", own.follow);
}

}  // namespace
}  // namespace chainmail::bench

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "bench_bullet: name the file of results, as in: bench_bullet build/bench.json\n");
    return 2;
  }
  chainmail::bench::Results results(argv[1]);
  chainmail::bench::run_task(32, results);
  chainmail::bench::run_task(64, results);
  results.write();
}
