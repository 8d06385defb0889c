#include "bullet/soft_body.h"

#include <BulletSoftBody/btSoftBody.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "body/body.h"
#include "body/body_view.h"
#include "elastic/iterated.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

// Time between two frames (s). It does not change where an object rests, and there is no gravity.
constexpr btScalar frame_time = btScalar(1) / 60;
// Share of its velocity that an element loses in a frame. With half or twice of it, a cloth takes as long or twice as
// long to come to rest (measured).
constexpr btScalar link_damping = btScalar(0.1);
// An object rests when no element moves more than this in a frame (mean link lengths).
constexpr double last_move_below = 1e-5;
// The same for large objects, in roundings of the largest coordinate: they move elements by up to 3 of these in each
// frame, without end (measured).
constexpr double last_move_in_roundings = 4;
// A frame that moves an element by this diverges (mean link lengths): Bullet itself allows as much as the object is
// long.
constexpr double diverging_move = 50;
constexpr const char* diverged_remark = "it diverged; the elements stay, but for the handle";

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

/// The elements and links of an object as a soft body of Bullet, without gravity, air or contact.
///
/// Most builds of Bullet, such as Debian's, compute in single precision, and Bullet skips links that are shorter than
/// about 0.0003 of its units. So its unit is the mean link length, and its origin is the middle of the object.
class BulletLinks {
 public:
  BulletLinks(const Mesh& mesh, const Cuts& cuts, const Progress& progress);

  /// Returns coordinate k of a position (mesh units) as Bullet has it.
  btScalar inside(double coordinate, int k) const { return btScalar((coordinate - middle_[std::size_t(k)]) / unit_); }
  /// Returns coordinate k of an element as Bullet has it, and in mesh units.
  btScalar at(ElementId element, int k) const { return body_.m_nodes[int(element)].m_x[k]; }
  double outside(ElementId element, int k) const { return middle_[std::size_t(k)] + unit_ * double(at(element, k)); }

  /// Sets an element to a position as Bullet has it, without velocity. An element that is held does not move: it has no
  /// mass, which is how users of Bullet hold a node.
  void put(ElementId element, const btVector3& position, bool held);
  bool is_held(ElementId element) const { return body_.m_nodes[int(element)].m_im == 0; }
  /// Call this after put(): links depend on which elements are held.
  void update_held() { body_.updateLinkConstants(); }

  /// Returns the largest move per frame of an object that rests (mean link lengths).
  double last_move() const;
  /// Runs a frame. Returns the largest move of an element (mean link lengths). Throws Error if a position is not
  /// finite.
  double frame();

 private:
  void add_nodes(const Mesh& mesh, const Progress& progress);
  void add_links(const Mesh& mesh, const Cuts& cuts, const Progress& progress);
  void take_rest_lengths();

  double unit_;                     // mesh units
  std::array<double, 3> middle_{};  // on the axes that exist (mesh units)
  btSoftBodyWorldInfo world_;
  btSoftBody body_{&world_};
};

BulletLinks::BulletLinks(const Mesh& mesh, const Cuts& cuts, const Progress& progress)
    : unit_(mesh.mean_link_length > 0 ? mesh.mean_link_length : 1) {
  for (std::size_t k = 0; k < std::size_t(mesh.space_dimension); ++k) {
    middle_[k] = (mesh.box[0][mesh.axes[k]] + mesh.box[1][mesh.axes[k]]) / 2;
  }
  world_.m_gravity.setZero();
  world_.air_density = 0;
  world_.m_sparsesdf.Initialize();
  body_.m_cfg.collisions = 0;
  body_.m_cfg.kDP = link_damping;
  body_.m_cfg.piterations = 1;
  body_.appendMaterial()->m_kLST = 1;  // each node and link has it
  add_nodes(mesh, progress.part(0, 0.5));
  add_links(mesh, cuts, progress.part(0.5, 1));
  take_rest_lengths();
}

void BulletLinks::add_nodes(const Mesh& mesh, const Progress& progress) {
  body_.m_nodes.reserve(int(mesh.element_count()));
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    progress.report(e, mesh.element_count());
    btVector3 at(0, 0, 0);
    for (int k = 0; k < mesh.space_dimension; ++k) {
      at[k] = inside(mesh.rest[std::size_t{e} * std::size_t(mesh.space_dimension) + std::size_t(k)], k);
    }
    body_.appendNode(at, 1);
  }
}

void BulletLinks::add_links(const Mesh& mesh, const Cuts& cuts, const Progress& progress) {
  body_.m_links.reserve(int(mesh.link_count() - cuts.count()));
  std::size_t done = 0;
  for (const LinkId link : link_order(mesh)) {
    progress.report(done++, mesh.link_count());
    if (!cuts.is_cut(link)) {
      body_.appendLink(int(mesh.links[link][0]), int(mesh.links[link][1]));
    }
  }
}

/// Takes the present lengths as rest lengths. Bullet would do so again in the next frame. It squares rounded lengths,
/// and would move an object at rest by that rounding.
void BulletLinks::take_rest_lengths() {
  body_.updateConstants();
  body_.m_bUpdateRtCst = false;
  for (int i = 0; i < body_.m_links.size(); ++i) {
    btSoftBody::Link& link = body_.m_links[i];
    link.m_c1 = (link.m_n[1]->m_x - link.m_n[0]->m_x).length2();
  }
}

void BulletLinks::put(ElementId element, const btVector3& position, bool held) {
  btSoftBody::Node& node = body_.m_nodes[int(element)];
  node.m_x = node.m_q = position;
  node.m_v.setZero();
  node.m_vn.setZero();
  node.m_f.setZero();
  // Bullet's own function takes the lengths at the next frame as rest lengths.
  node.m_im = btScalar(held ? 0 : 1);
}

double BulletLinks::last_move() const {
  btScalar largest = 0;
  for (int i = 0; i < body_.m_nodes.size(); ++i) {
    const btVector3 size = body_.m_nodes[i].m_x.absolute();
    largest = std::max(largest, size[size.maxAxis()]);
  }
  const double rounding = double(largest) * double(std::numeric_limits<btScalar>::epsilon());
  return std::max(last_move_below, last_move_in_roundings * rounding);
}

/// Takes the same steps as btSoftRigidDynamicsWorld, without rigid bodies.
double BulletLinks::frame() {
  body_.predictMotion(frame_time);
  body_.solveConstraints();
  body_.integrateMotion();
  double largest = 0, sum = 0;
  for (int i = 0; i < body_.m_nodes.size(); ++i) {
    const double move = (body_.m_nodes[i].m_x - body_.m_nodes[i].m_q).length();
    largest = std::max(largest, move);
    sum += move;
  }
  if (!std::isfinite(sum)) {
    throw Error("Bullet", "positions leave the range of its precision", "use a target that is nearer to the object");
  }
  return largest;
}

/// Answers moves with Bullet: sets the handle to its target and runs frames until the object rests, at most
/// `iterations` of the body's elastic options. It keeps links, but no positions and velocities: each move starts at
/// rest from the positions of the body.
class BulletMethod final : public Method {
 public:
  PassCount move(Body& body, HandleMove& move, PassOutput output) override {
    prepare(body, output.progress.part(0, 0.1));
    body.with_view([&](const auto& view) { take_positions(view, move); });
    std::string remark = come_to_rest(body.elastic().iterations, output.progress.part(0.1, 1));
    const bool diverged = remark == diverged_remark;
    output.moved.clear();
    body.with_view([&](const auto& view) {
      place_handle(view, move);
      if (!diverged) {
        take_answer(view, output.moved);
      }
    });
    remark_ = std::move(remark);
    return {body.mesh().element_count(), output.moved.size()};
  }

  std::string remark() const override { return remark_; }

 private:
  void prepare(const Body& body, const Progress& progress) {
    if (!nodes_ || mesh_ != body.stored_mesh() || cuts_ != body.revisions().cuts) {
      nodes_ = std::make_unique<BulletLinks>(*body.stored_mesh(), body.cuts(), progress);
      mesh_ = body.stored_mesh();
      cuts_ = body.revisions().cuts;
    }
  }

  template <class View>
  void take_positions(const View& view, const HandleMove& move) {
    const auto put = [&](ElementId element, bool held, auto coordinate) {
      btVector3 at(0, 0, 0);
      for (int k = 0; k < View::Dimension; ++k) {
        at[k] = nodes_->inside(coordinate(k), k);
      }
      nodes_->put(element, at, held);
    };
    for (ElementId e = 0; e < view.mesh->element_count(); ++e) {
      put(e, view.pinned(e), [&](int k) { return view.absolute(e, k); });
    }
    for_each_target(view, move, [&](ElementId element, const auto& target) {
      put(element, true, [&](int k) { return view.origin(element, k) + double(target[k]); });
    });
    nodes_->update_held();
  }

  /// Runs frames until the object rests, at most `most`. Returns an empty text if it rests, else the reason.
  std::string come_to_rest(std::uint32_t most, const Progress& progress) {
    const double last_move = nodes_->last_move();
    double largest = 0;
    for (std::uint32_t i = 0; i < most; ++i) {
      progress.report(double(i) / most);
      largest = nodes_->frame();
      if (largest <= last_move) {
        return {};
      }
      if (largest > diverging_move) {
        return diverged_remark;
      }
    }
    return not_converged(most, largest);
  }

  /// Sets the position of every element that is not held, and collects those that moved. A coordinate that Bullet did
  /// not change keeps the digits that Bullet does not have.
  template <class View>
  void take_answer(const View& view, std::vector<ElementId>& moved) const {
    for (ElementId e = 0; e < view.mesh->element_count(); ++e) {
      const auto before = view.positions[e];
      for (int k = 0; k < View::Dimension && !nodes_->is_held(e); ++k) {
        if (nodes_->at(e, k) != nodes_->inside(view.absolute(e, k), k)) {
          view.set_position(e, k, nodes_->outside(e, k));
        }
      }
      if (view.positions[e] != before) {
        moved.push_back(e);
      }
    }
  }

  std::unique_ptr<BulletLinks> nodes_;
  MeshPointer mesh_;        // that they were made for
  std::uint64_t cuts_ = 0;  // revision that they were made for
  std::string remark_;
};

/// The publication, and the version of Bullet.
std::shared_ptr<const std::string> bullet_source() {
  const int version = btGetVersion();
  const std::string minor = std::to_string(version % 100);
  return std::make_shared<const std::string>("Coumans 2015; Bullet " + std::to_string(version / 100) +
                                             (minor.size() < 2 ? ".0" : ".") + minor);
}

}  // namespace

AlgorithmInfo bullet_soft_body() {
  const auto source = bullet_source();
  return {.algorithm = Algorithm(9'000),  // of no other entry; add_algorithm gives it another number
          .name = "bullet",
          .label = "Bullet soft body",
          .source = *source,
          .summary = "links return to their rest length one after another, in frames of a physics engine",
          .style = {"M-.65 1.15V-.1C-.65-.65-.35-1.05 0-1.35C.35-1.05 .65-.65 .65-.1V1.15Z", "#736ea0"},  // bullet
          .make = [](Precision, int) -> std::unique_ptr<Method> { return std::make_unique<BulletMethod>(); },
          .needs_pins = true,
          .obeys_iterations = true,
          .texts = source};
}

}  // namespace chainmail
