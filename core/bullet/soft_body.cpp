#include "bullet/soft_body.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "bullet/bullet_body.h"

namespace chainmail {
namespace {

// Share of its velocity that an element loses in a frame. With half or twice of it, a cloth takes as long or twice as
// long to come to rest (measured).
constexpr btScalar link_damping = btScalar(0.1);

/// Returns the links in random order, as Bullet's own helpers do. In the mesh's order, one iteration spreads the pull
/// of the handle through the whole object, and one iteration per frame is unstable. The order is the same for every
/// body and on every machine, which Bullet's helpers and std::shuffle do not promise.
std::vector<LinkId> link_order(const Mesh& mesh) {
  std::vector<LinkId> order(mesh.link_count());
  std::iota(order.begin(), order.end(), LinkId{0});
  std::mt19937_64 random(11);
  for (std::size_t left = order.size(); left > 1; --left) {
    std::swap(order[left - 1], order[random() % left]);
  }
  return order;
}

/// The links of an object as those of a soft body.
class BulletLinks final : public BulletBody {
 public:
  BulletLinks(const Mesh& mesh, const Cuts& cuts, const Progress& progress) : BulletBody(mesh, progress.part(0, 0.5)) {
    body().m_cfg.kDP = link_damping;
    body().m_cfg.piterations = 1;
    body().m_materials[0]->m_kLST = 1;
    add_links(mesh, cuts, progress.part(0.5, 1));
    take_rest_lengths();
  }

  /// Links depend on which elements are held.
  void update_held() override { body().updateLinkConstants(); }

 private:
  void add_links(const Mesh& mesh, const Cuts& cuts, const Progress& progress) {
    body().m_links.reserve(int(mesh.link_count() - cuts.count()));
    std::size_t done = 0;
    for (const LinkId link : link_order(mesh)) {
      progress.report(done++, mesh.link_count());
      if (!cuts.is_cut(link)) {
        body().appendLink(int(mesh.links[link][0]), int(mesh.links[link][1]));
      }
    }
  }

  /// Takes the present lengths as rest lengths. Bullet would do so again in the next frame. It squares rounded lengths,
  /// and would move an object at rest by that rounding.
  void take_rest_lengths() {
    body().updateConstants();
    body().m_bUpdateRtCst = false;
    for (int i = 0; i < body().m_links.size(); ++i) {
      btSoftBody::Link& link = body().m_links[i];
      link.m_c1 = (link.m_n[1]->m_x - link.m_n[0]->m_x).length2();
    }
  }

  /// The same steps as in btSoftRigidDynamicsWorld, without rigid bodies.
  void advance() override {
    body().predictMotion(bullet_frame_time);
    body().solveConstraints();
    body().integrateMotion();
  }
};

std::unique_ptr<BulletBody> make_links(const Body& body, const Progress& progress) {
  return std::make_unique<BulletLinks>(*body.stored_mesh(), body.cuts(), progress);
}

}  // namespace

AlgorithmInfo bullet_soft_body() {
  const auto source = bullet_source("Coumans 2015");
  return {.algorithm = Algorithm(9'000),  // of no other entry; add_algorithm gives it another number
          .name = "bullet",
          .label = "Bullet soft body",
          .source = *source,
          .summary = "links return to their rest length one after another, in frames of a physics engine",
          .style = {"M-.65 1.15V-.1C-.65-.65-.35-1.05 0-1.35C.35-1.05 .65-.65 .65-.1V1.15Z", "#736ea0"},  // bullet
          .make = [](Precision, int) -> std::unique_ptr<Method> { return bullet_method(make_links, false); },
          .needs_pins = true,
          .obeys_iterations = true,
          .texts = source};
}

}  // namespace chainmail
