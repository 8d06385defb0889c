#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <vector>

#include "body/softness.h"
#include "elastic/material.h"
#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "solver/solver.h"

namespace chainmail {

/// Smallest violation that counts, in rest lengths of the link. Smaller ones are rounding errors.
inline constexpr double counts_as_violated = 1e-4;

/// Distance of links from their valid regions, in rest lengths of the link (for a link of zero length: in the mesh's
/// mean rest length). Cut links do not count.
struct Violation {
  double max = 0;
  double rms = 0;
  double fraction = 0;      // share of the measured links that count as violated
  std::uint64_t links = 0;  // number of measured links

  bool operator==(const Violation&) const = default;
};

/// Returns the violation of one link: the Euclidean norm of the excess per axis. Computed in double.
double link_violation(const Mesh& mesh, const Softness& softness, const PositionView& position, LinkId link);

/// Returns the violation of the whole mesh.
Violation measure_violation(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position);

/// Collects the violations of links.
class ViolationSum {
 public:
  void add(double violation);
  Violation result() const;

 private:
  double max_ = 0;
  double squares_ = 0;
  std::uint64_t violated_ = 0;
  std::uint64_t links_ = 0;
};

/// Measures the violation of the whole mesh in slices. The object must not change in between.
class WholeViolation {
 public:
  /// Measures the next `count` links. Returns true if more links remain.
  bool go_on(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position, LinkId count);
  Violation result() const { return sum_.result(); }

 private:
  ViolationSum sum_;
  LinkId next_ = 0;
};

/// Measures the violation of the links of some elements, each link once.
class TouchedViolation {
 public:
  /// Takes time in proportion to the number of links of `elements`, or of every n-th of them if they are more than
  /// `most`. Keeps one bit per element between calls.
  Violation measure(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position,
                    std::initializer_list<std::span<const ElementId>> elements,
                    std::size_t most = std::numeric_limits<std::size_t>::max());
  /// True if the last measurement left some of the elements out.
  bool sampled() const { return sampled_; }

 private:
  template <class Use>
  static void for_each_sampled(std::initializer_list<std::span<const ElementId>> elements, std::size_t nth, Use use);

  std::vector<bool> seen_;  // all false between two calls
  bool sampled_ = false;
};

/// Returns the elastic energy over the uncut links, of the kind that the softness names (see
/// equilibrium/link_energy.h), or of the material of its cells, in double. The isotropic one, ½ Σ |(x_j − x_i) −
/// r_ij|², is in mesh units squared; that of the material, as neo-Hookean FEM has it, in units of Young's modulus times
/// mesh units to the power of the space's dimension.
double elastic_energy(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position,
                      const ElasticOptions& elastic = {});

/// Returns the displacement of the elements from rest (mesh units), in double.
struct Displacement {
  double max = 0;
  double rms = 0;
};
Displacement measure_displacement(const Mesh& mesh, const PositionView& position);

}  // namespace chainmail
