#include "bullet/bullet_body.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "body/body_view.h"
#include "elastic/iterated.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

// An object rests when no element moves more than this in a frame (mean link lengths).
constexpr double last_move_below = 1e-5;
// The same for large objects, in roundings of the largest coordinate: they move elements by up to 3 of these in each
// frame, without end (measured).
constexpr double last_move_in_roundings = 4;

}  // namespace

BulletBody::BulletBody(const Mesh& mesh, const Progress& progress)
    : unit_(mesh.mean_link_length > 0 ? mesh.mean_link_length : 1),
      body_(&world_),
      inverse_masses_(mesh.element_count(), 1) {
  for (std::size_t k = 0; k < std::size_t(mesh.space_dimension); ++k) {
    middle_[k] = (mesh.box[0][mesh.axes[k]] + mesh.box[1][mesh.axes[k]]) / 2;
  }
  world_.m_gravity.setZero();
  world_.air_density = 0;
  world_.m_sparsesdf.Initialize();
  body_.m_cfg.collisions = 0;
  body_.appendMaterial();  // each node has one
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

void BulletBody::set_mass(ElementId element, double mass) { inverse_masses_[element] = btScalar(1 / mass); }

void BulletBody::put(ElementId element, const btVector3& position, bool held) {
  btSoftBody::Node& node = body_.m_nodes[int(element)];
  node.m_x = node.m_q = position;
  node.m_v.setZero();
  node.m_vn.setZero();
  node.m_f.setZero();
  // Bullet's own function takes the lengths at the next frame as rest lengths.
  node.m_im = held ? btScalar(0) : inverse_masses_[element];
}

std::vector<double> BulletBody::velocities() const {
  std::vector<double> result;
  for (int i = 0; i < body_.m_nodes.size(); ++i) {
    const btVector3& velocity = body_.m_nodes[i].m_v;
    result.insert(result.end(), {double(velocity[0]), double(velocity[1]), double(velocity[2])});
  }
  return result;
}

void BulletBody::set_velocities(std::span<const double> velocities) {
  for (std::size_t i = 0; 3 * i < velocities.size(); ++i) {
    btSoftBody::Node& node = body_.m_nodes[int(i)];
    for (int k = 0; k < 3 && node.m_im > 0; ++k) {
      node.m_v[k] = node.m_vn[k] = btScalar(velocities[3 * i + std::size_t(k)]);
    }
  }
}

double BulletBody::last_move() const {
  btScalar largest = 0;
  for (int i = 0; i < body_.m_nodes.size(); ++i) {
    const btVector3 size = body_.m_nodes[i].m_x.absolute();
    largest = std::max(largest, size[size.maxAxis()]);
  }
  const double rounding = double(largest) * double(std::numeric_limits<btScalar>::epsilon());
  return std::max(last_move_below, last_move_in_roundings * rounding);
}

double BulletBody::frame() {
  advance();
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

namespace {

// A frame that moves an element by this diverges (mean link lengths): Bullet itself allows as much as the object is
// long.
constexpr double diverging_move = 50;
constexpr const char* diverged_remark = "it diverged; the elements stay, but for the handle";

/// Answers moves with Bullet. It keeps links or cells, and velocities if wanted, but no positions: each move starts
/// from those of the body.
class BulletMethod final : public Method {
 public:
  BulletMethod(MakeBulletBody make, bool keeps_velocities) : make_(make), keeps_velocities_(keeps_velocities) {}

  PassCount move(Body& body, HandleMove& move, PassOutput output) override {
    prepare(body, output.progress.part(0, 0.1));
    body.with_view([&](const auto& view) { take_positions(view, move); });
    if (keeps_velocities_ && left_ == positions_of(body)) {
      nodes_->set_velocities(velocities_);
    }
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
    if (keeps_velocities_) {
      velocities_ = nodes_->velocities();
      left_ = diverged ? std::vector<double>() : positions_of(body);
    }
    return {body.mesh().element_count(), output.moved.size()};
  }

  std::string remark() const override { return remark_; }

 private:
  void prepare(const Body& body, const Progress& progress) {
    if (!nodes_ || mesh_ != body.stored_mesh() || cuts_ != body.revisions().cuts ||
        material_ != body.elastic().material) {
      nodes_ = make_(body, progress);
      if (mesh_ != nullptr && mesh_ != body.stored_mesh()) {
        left_.clear();  // the velocities are along other axes
      }
      mesh_ = body.stored_mesh();
      cuts_ = body.revisions().cuts;
      material_ = body.elastic().material;
    }
    if (!left_.empty() && velocities_.size() != 3 * std::size_t{body.mesh().element_count()}) {
      throw Error("Bullet", "the velocities are those of another object", "reset the object");
    }
  }

  static std::vector<double> positions_of(const Body& body) {
    std::vector<double> positions(std::size_t{body.mesh().element_count()} * std::size_t(body.mesh().space_dimension));
    body.copy_positions(positions);
    return positions;
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

  MakeBulletBody make_;
  bool keeps_velocities_;
  std::unique_ptr<BulletBody> nodes_;
  MeshPointer mesh_;        // that they were made for
  std::uint64_t cuts_ = 0;  // revision that they were made for
  Material material_;       // that they were made of
  std::string remark_;
  std::vector<double> velocities_, left_;  // after the last move, and the positions in which it left the object
};

}  // namespace

std::unique_ptr<Method> bullet_method(MakeBulletBody make, bool keeps_velocities) {
  return std::make_unique<BulletMethod>(make, keeps_velocities);
}

std::shared_ptr<const std::string> bullet_source(const std::string& publications) {
  const int version = btGetVersion();
  const std::string minor = std::to_string(version % 100);
  return std::make_shared<const std::string>(publications + "; Bullet " + std::to_string(version / 100) +
                                             (minor.size() < 2 ? ".0" : ".") + minor);
}

}  // namespace chainmail
