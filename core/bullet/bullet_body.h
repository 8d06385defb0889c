#pragma once

#include <BulletSoftBody/btSoftBody.h>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "body/body.h"
#include "solver/algorithms.h"

namespace chainmail {

// Time between two frames (s). It does not change where an object rests, and there is no gravity.
inline constexpr btScalar bullet_frame_time = btScalar(1) / 60;

/// The elements of an object as the nodes of a soft body of Bullet, without gravity, air or contact.
///
/// Most builds of Bullet, such as Debian's, compute in single precision, and Bullet skips links that are shorter than
/// about 0.0003 of its units. So its unit is the mean link length, and its origin is the middle of the object.
class BulletBody {
 public:
  BulletBody(const Mesh& mesh, const Progress& progress);
  BulletBody(const BulletBody&) = delete;
  BulletBody& operator=(const BulletBody&) = delete;
  virtual ~BulletBody() = default;

  /// Returns coordinate k of a position (mesh units) as Bullet has it.
  btScalar inside(double coordinate, int k) const { return btScalar((coordinate - middle_[std::size_t(k)]) / unit_); }
  /// Returns coordinate k of an element as Bullet has it, and in mesh units.
  btScalar at(ElementId element, int k) const { return body_.m_nodes[int(element)].m_x[k]; }
  double outside(ElementId element, int k) const { return middle_[std::size_t(k)] + unit_ * double(at(element, k)); }

  /// Sets an element to a position as Bullet has it, without velocity. An element that is held does not move: it has no
  /// mass, which is how users of Bullet hold a node.
  void put(ElementId element, const btVector3& position, bool held);
  bool is_held(ElementId element) const { return body_.m_nodes[int(element)].m_im == 0; }
  /// Call this after put().
  virtual void update_held() {}

  /// Returns the velocities, three coordinates for each element.
  std::vector<double> velocities() const;
  /// Sets velocities that velocities() returned, but for those of elements that are held.
  void set_velocities(std::span<const double> velocities);

  /// Returns the largest move per frame of an object that rests (mean link lengths).
  double last_move() const;
  /// Runs a frame. Returns the largest move of an element (mean link lengths). Throws Error if a position is not
  /// finite.
  double frame();

 protected:
  /// Moves the nodes by a frame: from m_q, where they were, to m_x.
  virtual void advance() = 0;
  btSoftBody& body() { return body_; }
  void set_mass(ElementId element, double mass);

 private:
  double unit_;                     // mesh units
  std::array<double, 3> middle_{};  // on the axes that exist (mesh units)
  btSoftBodyWorldInfo world_;
  btSoftBody body_;
  std::vector<btScalar> inverse_masses_;
};

/// Makes Bullet's body of an object, with its links or cells.
using MakeBulletBody = std::unique_ptr<BulletBody> (*)(const Body& body, const Progress& progress);

/// Returns a method whose moves set the handle to its target and run frames until the object rests: at most
/// `iterations` frames of the body's elastic options. With `keeps_velocities`, a move goes on with the velocities of
/// the last one if the object is where that left it; otherwise each move begins at rest.
std::unique_ptr<Method> bullet_method(MakeBulletBody make, bool keeps_velocities);

/// The texts of an entry for add_algorithm: the publications, and the version of Bullet.
std::shared_ptr<const std::string> bullet_source(const std::string& publications);

}  // namespace chainmail
