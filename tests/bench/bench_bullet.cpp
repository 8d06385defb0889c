// Bullet's soft body beside the family, on the same meshes and the same drag: bench_bullet RESULTS.

#include <BulletSoftBody/btSoftBody.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <random>

#include "bench/contestants.h"
#include "bench/results.h"

namespace chainmail::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int frames = 60;  // a second

/// Where the corner is, frame by frame: half round a circle a quarter of the object's width in radius, away from
/// the body first and back at its side, by 1.3 % of the width a frame.
std::vector<Point> corner_path(const Mesh& mesh) {
  const auto [low, high] = bounds(mesh);
  const double radius = (high - low).maxCoeff() / 4;
  const Point start = mesh.rest_position(0);
  std::vector<Point> path;
  for (int i = 1; i <= frames; ++i) {
    const double angle = std::numbers::pi * i / frames;
    path.emplace_back(start + radius * Point(std::cos(angle) - 1, -std::sin(angle), 0));
  }
  return path;
}

/// What an object that is dragged looks like, whoever moves it.
class Dragged {
 public:
  virtual ~Dragged() = default;
  virtual void frame(const Point& corner) = 0;
  virtual Point position(ElementId element) const = 0;
};

class ByChainMail : public Dragged {
 public:
  ByChainMail(MeshPointer mesh, const std::string& algorithm)
      : mesh_(std::move(mesh)),
        solver_(make_solver(mesh_, find_algorithm(algorithm).value(), Precision::single_precision)) {
    solver_->set_softness({stiff, {}});
  }
  void frame(const Point& corner) override { solver_->move(0, corner); }
  Point position(ElementId element) const override { return point_of(*mesh_, solver_->positions(), element); }

 private:
  MeshPointer mesh_;
  std::unique_ptr<Solver> solver_;
};

/// In the mesh's order an iteration hands the hand's pull on from link to link through the whole object, and one
/// iteration a frame blows up; Bullet's helpers put links in random order, which large meshes pay for in the cache.
/// Random within a thousand gives it both.
std::vector<LinkId> link_order(const Mesh& mesh) {
  constexpr std::ptrdiff_t together = 1024;
  std::vector<LinkId> order(mesh.link_count());
  std::iota(order.begin(), order.end(), LinkId{0});
  std::mt19937_64 random(11);
  for (auto at = order.begin(); at != order.end();) {
    const auto end = at + std::min(together, order.end() - at);
    std::shuffle(at, end, random);
    at = end;
  }
  return order;
}

/// Links as stiff as there are, all masses alike, no gravity, no air and no contacts: only what links cost. The
/// corner has no mass, as Bullet's users hold a node.
class ByBullet : public Dragged {
 public:
  ByBullet(const Mesh& mesh, int iterations) {
    std::vector<btVector3> places;
    for (ElementId e = 0; e < mesh.element_count(); ++e) {
      const Point at = mesh.rest_position(e);
      places.emplace_back(btScalar(at[0]), btScalar(at[1]), btScalar(at[2]));
    }
    const std::vector<btScalar> masses(places.size(), 1);
    world_.m_gravity.setZero();
    world_.air_density = 0;
    world_.m_sparsesdf.Initialize();
    body_ = std::make_unique<btSoftBody>(&world_, int(places.size()), places.data(), masses.data());
    body_->m_materials[0]->m_kLST = 1;
    body_->m_cfg.piterations = iterations;
    body_->m_cfg.collisions = 0;
    for (const LinkId link : link_order(mesh)) {
      body_->appendLink(int(mesh.links[link][0]), int(mesh.links[link][1]));
    }
    body_->setMass(0, 0);
  }

  void frame(const Point& corner) override {
    auto& held = body_->m_nodes[0];
    held.m_x = btVector3(btScalar(corner[0]), btScalar(corner[1]), btScalar(corner[2]));
    held.m_v.setZero();
    // What btSoftRigidDynamicsWorld does in a step, without the rigid bodies that are not there.
    body_->predictMotion(btScalar(1.0 / frames));
    body_->solveConstraints();
    body_->integrateMotion();
  }

  Point position(ElementId element) const override {
    const btVector3& at = body_->m_nodes[int(element)].m_x;
    return {at.x(), at.y(), at.z()};
  }

 private:
  btSoftBodyWorldInfo world_;
  std::unique_ptr<btSoftBody> body_;
};

/// How far the lengths of links are off, as a share of their rest length. The root of the mean square: a mean would
/// favour who leaves a few links about the hand torn and all others where they were.
struct Stretch {
  double rms = 0, largest = 0;
};

Stretch stretch(const Mesh& mesh, const Dragged& object) {
  Stretch found;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    const auto [a, b] = mesh.links[link];
    const double off = std::abs((object.position(b) - object.position(a)).norm() / rest_length(mesh, link) - 1);
    found.rms += off * off / mesh.link_count();
    found.largest = std::max(found.largest, off);
  }
  found.rms = std::sqrt(found.rms);
  return found;
}

std::map<std::string, std::unique_ptr<Dragged>> contestants(const MeshPointer& mesh) {
  std::map<std::string, std::unique_ptr<Dragged>> all;
  for (const int iterations : {1, 10, 50}) {
    all["bullet" + std::to_string(iterations)] = std::make_unique<ByBullet>(*mesh, iterations);
  }
  all["generalized"] = std::make_unique<ByChainMail>(mesh, "generalized");
  all["natural_queue"] = std::make_unique<ByChainMail>(mesh, "natural-queue");
  all["exact"] = std::make_unique<ByChainMail>(mesh, "exact");
  return all;
}

/// All of them frame by frame in turns; the time of a frame is the median over the drag.
void drag(const std::string& mesh_name, Results& results) {
  const Scene scene(mesh_name);
  const auto all = contestants(scene.mesh);
  std::map<std::string, std::vector<double>> ms;
  for (const Point& corner : corner_path(*scene.mesh)) {
    for (const auto& [name, object] : all) {
      const auto begin = Clock::now();
      object->frame(corner);
      ms[name].push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
    }
  }
  for (const auto& [name, object] : all) {
    const double frame_ms = median(ms[name]);
    const Stretch off = stretch(*scene.mesh, *object);
    results.ratios()["vs_bullet"][mesh_name][name] = {{"ms", frame_ms}, {"stretch", off.rms}, {"largest", off.largest}};
    std::printf("%-18s %-18s %10.3f ms a frame, links off by %6.2f %%, at most %8.2f %%\n", mesh_name.c_str(),
                name.c_str(), frame_ms, 100 * off.rms, 100 * off.largest);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace chainmail::bench

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "bench_bullet: name the file of results, as in: bench_bullet build/bench.json\n");
    return 2;
  }
  chainmail::bench::Results results(argv[1]);
  for (const char* mesh : {"cloth256", "cloth512", "block40"}) {
    chainmail::bench::drag(mesh, results);
  }
  results.write();
}
