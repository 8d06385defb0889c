#include "bullet/deformable_fem.h"

#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableNeoHookeanForce.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "bullet/bullet_body.h"
#include "elastic/simplices.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

// Shear modulus times the square of a frame's time, over the mass of an element (in mean link lengths). It decides how
// far a frame goes towards rest, and how many conjugate gradients it takes. The bend of a bar of 208 elements in 24
// moves of two frames ends at 0.20, 0.036 and 0.016 of its own limit with 0.3, 3 and 30; the same bend in one move
// comes to rest with 3 and 8, and diverges with 30.
constexpr double stiffness_over_inertia = 8;
// Of the rates of strain, as a share of the stiffness. With Bullet's own 0.05, the bend in one move takes twice as many
// frames; with 0, it diverges.
constexpr double damping = 0.01;

/// The cells of an object in space as tetrahedra of a deformable body.
class BulletTetrahedra final : public BulletBody {
 public:
  BulletTetrahedra(const Body& of, const Progress& progress)
      : BulletBody(*of.stored_mesh(), progress.part(0, 0.5)), force_(make_force(lame(of.elastic().material))) {
    const Mesh& mesh = *of.stored_mesh();
    const Simplices cells = build_simplices(mesh, of.cuts(), progress.part(0.5, 0.8));
    for (std::size_t s = 0; s < cells.count(); ++s) {
      add_tetrahedron(cells.corners_of(s));
    }
    take_masses(mesh, cells);
    body().initializeDmInverse();
    body().m_tetraScratches.resize(body().m_tetras.size(), at_rest());
    body().m_tetraScratchesTn.resize(body().m_tetras.size(), at_rest());
    body().setActivationState(DISABLE_DEACTIVATION);
    body().m_sleepingThreshold = 0;
    body().m_bUpdateRtCst = false;
    force_.addSoftBody(&body());
    bodies_.push_back(&body());
    solver_.m_objective->m_lf.push_back(&force_);
    solver_.m_objective->m_preconditioner = solver_.m_objective->m_massPreconditioner;
    solver_.setImplicit(true);
    solver_.m_useProjection = true;  // held nodes stay in place exactly
  }

 private:
  /// At small strains, Lamé's parameters are ¾ μ and λ − ⅝ μ of Bullet's.
  static btDeformableNeoHookeanForce make_force(const Lame& material) {
    const double scale = stiffness_over_inertia / double(bullet_frame_time * bullet_frame_time) / material.mu;
    const double mu = 4.0 / 3 * material.mu, lambda = material.lambda + 5.0 / 8 * mu;
    return {btScalar(scale * mu), btScalar(scale * lambda), btScalar(damping)};
  }

  /// Bullet's own constructor leaves the matrices without values.
  static btSoftBody::TetraScratch at_rest() {
    btSoftBody::TetraScratch scratch;
    scratch.m_F.setIdentity();
    scratch.m_cofF.setIdentity();
    scratch.m_corotation.setIdentity();
    scratch.m_trace = 3;
    scratch.m_J = 1;
    return scratch;
  }

  /// The cells of an object have one orientation, which may be the other one than Bullet's.
  void add_tetrahedron(std::span<const ElementId> corners) {
    std::array<int, 4> nodes{};
    std::ranges::transform(corners, nodes.begin(), [](ElementId corner) { return int(corner); });
    const auto edge = [&](std::size_t k) { return body().m_nodes[nodes[k]].m_x - body().m_nodes[nodes[0]].m_x; };
    if (edge(1).cross(edge(2)).dot(edge(3)) < 0) {
      std::swap(nodes[2], nodes[3]);
    }
    body().appendTetra(nodes[0], nodes[1], nodes[2], nodes[3]);
  }

  /// Gives each element a quarter of the volume of its cells, over the mean of all.
  void take_masses(const Mesh& mesh, const Simplices& cells) {
    std::vector<double> volumes(mesh.element_count(), 0.0);
    double whole = 0;
    for (std::size_t s = 0; s < cells.count(); ++s) {
      whole += cells.volumes[s];
      for (const ElementId corner : cells.corners_of(s)) {
        volumes[corner] += cells.volumes[s] / 4;
      }
    }
    for (ElementId e = 0; e < mesh.element_count(); ++e) {
      set_mass(e, volumes[e] > 0 ? volumes[e] * double(mesh.element_count()) / whole : 1);
    }
  }

  /// The same steps as in btDeformableMultiBodyDynamicsWorld, without rigid bodies and contacts.
  void advance() override {
    btContactSolverInfo contacts;
    solver_.reinitialize(bodies_, bullet_frame_time);
    solver_.predictMotion(bullet_frame_time);
    solver_.backupVelocity();
    solver_.setConstraints(contacts);
    solver_.m_objective->m_projection.setProjection();
    solver_.setupDeformableSolve(true);
    solver_.solveDeformableConstraints(bullet_frame_time);
    for (int i = 0; i < body().m_nodes.size(); ++i) {
      btSoftBody::Node& node = body().m_nodes[i];
      node.m_q = node.m_x;
      node.m_x += node.m_im > 0 ? bullet_frame_time * node.m_v : btVector3(0, 0, 0);
      node.m_vn = node.m_v;
    }
  }

  btDeformableNeoHookeanForce force_;
  btDeformableBodySolver solver_;
  btAlignedObjectArray<btSoftBody*> bodies_;
};

std::unique_ptr<BulletBody> make_tetrahedra(const Body& body, const Progress& progress) {
  if (body.mesh().space_dimension != 3) {
    throw Error("Bullet FEM", "it has elements for objects in space only", "use another algorithm for this object");
  }
  return std::make_unique<BulletTetrahedra>(body, progress);
}

}  // namespace

AlgorithmInfo bullet_fem() {
  const auto source = bullet_source("Smith, de Goes and Kim 2018");
  return {.algorithm = Algorithm(9'001),  // of no other entry; add_algorithm gives it another number
          .name = "bullet-fem",
          .label = "Bullet FEM",
          .source = *source,
          .summary = "neo-Hookean tetrahedra, in implicit frames of a physics engine",
          .style = {"M-.9 1.1V-.1C-.9-.65-.6-1.05-.35-1.35-.1-1.05 .2-.65 .2-.1V1.1ZM.45 1.1V-.9H1V1.1Z", "#3f7f8c"},
          .make = [](Precision, int) -> std::unique_ptr<Method> { return bullet_method(make_tetrahedra, true); },
          .needs_pins = true,
          .obeys_iterations = true,
          .texts = source};
}

}  // namespace chainmail
