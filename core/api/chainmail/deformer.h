#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "chainmail/body.h"
#include "chainmail/handle.h"
#include "chainmail/job.h"
#include "chainmail/types.h"

namespace chainmail::api {

/// What a move did.
struct MoveResult {
  std::uint64_t checked = 0;  ///< Number of candidates that the method processed.
  std::uint64_t moved = 0;    ///< Number of elements that moved, without the handle.
  bool stopped = false;       ///< True if the handle stopped before its target (see remark and Exact ChainMail).
  Pose reached = {};          ///< Where the handle is now.
  std::string remark = {};    ///< Reason why the move did not end as requested. Usually empty.
};

/// A candidate that a method of the ChainMail family processed in a move.
struct TraceStep {
  ElementId element = 0;  ///< The element that may have to move.
  ElementId sponsor = 0;  ///< The neighbour whose move made it a candidate; no_sponsor if there is none.
  bool moved = false;     ///< True if it moved.
};
/// Stands for the sponsor of a candidate without one.
inline constexpr ElementId no_sponsor = 0xffffffff;

/// Options of relaxation.
struct RelaxOptions {
  double step = 1;  ///< Share of the way that an element moves per sweep: above 0, to 1.
  RelaxationScheme scheme = RelaxationScheme::mean;  ///< Which elements move where.
  /// With the scheme `equilibrium`: distance from the equilibrium at which it ends, in the norm of the energy, relative
  /// to its root; 0 to 1. With 0, all iterations run.
  double until = 1e-3;
};

/// How close an object is to the equilibrium.
struct EquilibriumCertificate {
  double violation = 0;  ///< Largest violation of a link, in rest lengths.
  double residual = 0;   ///< Estimated distance from the equilibrium, as RelaxOptions::until.
  /// Energy above a lower bound of the energy of all valid states, relative to the energy. None for corotated
  /// links and the material, whose energies are not convex.
  std::optional<double> energy_gap;
  bool regions_bind = false;  ///< True if valid regions change the equilibrium.
  int iterations = 0;         ///< Iterations since the handle, the pins or the object changed.
};

/// Deforms one object with one method: it owns a Body and what the method keeps between moves. After the first moves,
/// a translation allocates no memory, except with neo-Hookean FEM or while tracing. One thread at a time may use it.
class Deformer {
 public:
  /// Takes an object over. Throws Error if there is no such method, or if it does not work on the mesh.
  Deformer(Body body, std::string_view method);
  /// Takes an object at rest.
  Deformer(const Mesh& mesh, std::string_view method, Precision precision = Precision::double_precision);
  /// Moves the deformer; `other` may then only be assigned to or destroyed.
  Deformer(Deformer&& other) noexcept;
  /// Moves the deformer; `other` may then only be assigned to or destroyed.
  Deformer& operator=(Deformer&& other) noexcept;
  ~Deformer();

  /// The object. Its cuts, pins, softness and positions may be changed between moves, even while dragging.
  Body& body();
  /// The object.
  const Body& body() const;

  /// Name of the method.
  std::string method() const;
  /// Continues with another method from the current positions. Throws Error if there is none with this name, or if it
  /// does not work on the mesh.
  void set_method(std::string_view method);

  /// Sets the number of threads that a move may use, at least 1, which is the default. Only Exact ChainMail uses more,
  /// for large objects, and no result depends on it. Throws Error for a number below 1.
  void set_threads(int threads);

  /// Grabs elements; the same as the constructor of Handle.
  Handle grab(const std::vector<ElementId>& elements) const { return Handle(body(), elements); }
  /// Moves a handle to a pose, and the method answers: one pass. The handle knows the pose that it reached. Throws
  /// Error if the handle is of another mesh, if an element of it is pinned, if the pose is not finite or would leave
  /// the space of the object, and if the method has no answer; and Cancelled. Nothing has moved then.
  MoveResult move(Handle& handle, const Pose& target);
  /// Moves one element to a position (mesh units).
  MoveResult move(ElementId element, const Vector3& target);
  /// The elements that the last move moved, in order of update, without the handle. Valid until the next move.
  std::span<const ElementId> moved() const;
  /// Releases the handle of the last move: relaxation may move its elements.
  void release();

  /// Runs sweeps of relaxation about the elements of the last move, until nothing moves or this many have run; the
  /// handle and the pins stay. Each element stays in the valid regions of its neighbours. Returns the number of sweeps
  /// that ran; 0 for methods of elasticity, whose answers are equilibria. The scheme `equilibrium` runs iterations
  /// instead, for all elements. Throws Error for a step out of its range or a number below 0, and if pins contradict
  /// each other and the scheme is `equilibrium`; and Cancelled, which keeps the positions that were reached.
  int relax(int sweeps, const RelaxOptions& options = {});
  /// Returns how close the object is to the equilibrium; all zeros if it was not relaxed to it. Costs about two
  /// iterations.
  EquilibriumCertificate certificate();

  /// Sets the job that long preparations, solutions and sweeps report to, and that can cancel them.
  void set_job(const Job& job);
  /// Turns on or off that moves are traced.
  void set_tracing(bool on);
  /// The candidates of the last move, in order, if it was traced and the method processes candidates one by one.
  std::span<const TraceStep> trace() const;

 private:
  friend struct Access;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Drags elements of an object from rest by a displacement (mesh units) in one move, and returns the positions of all
/// elements: x, y, z each (mesh units). A shortcut for a Deformer that is used once; throws the same.
std::vector<double> deform(const Mesh& mesh, std::string_view method, const std::vector<ElementId>& elements,
                           const Vector3& by);

}  // namespace chainmail::api
