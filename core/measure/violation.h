#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "solve/softness.h"
#include "solve/solver.h"

namespace chainmail {

/// A link violated by more than this (rest lengths) counts as such; below it is rounding.
inline constexpr double counts_as_violated = 1e-4;

/// How far links lie outside their valid regions, in rest lengths of the link (a link of zero length:
/// in the mesh's mean rest length). Cut links do not count.
struct Violation {
  double max = 0;
  double rms = 0;
  double fraction = 0;      // of the links looked at, those that count as violated
  std::uint64_t links = 0;  // looked at

  bool operator==(const Violation&) const = default;
};

/// The violation of one link: the Euclidean norm, over the axes, of what exceeds the region.
/// Computed in double, whatever the solver uses.
double link_violation(const Mesh& mesh, const Softness& softness, const PositionView& position, LinkId link);

/// The violation over the whole mesh.
Violation measure_violation(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position);

/// Gathers the violations of links, one by one.
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

/// The violation over the whole mesh, measured in slices: the object must stay as it is meanwhile.
class WholeViolation {
 public:
  /// Looks at the next links, so many of them; says whether there are more.
  bool go_on(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position, LinkId count);
  Violation result() const { return sum_.result(); }

 private:
  ViolationSum sum_;
  LinkId next_ = 0;
};

/// The violation over the links of some elements, each link once.
class TouchedViolation {
 public:
  /// Time: the number of these links. The memory that it takes the first time, a bit an element, it keeps.
  Violation measure(const Mesh& mesh, const Softness& softness, const Cuts& cuts, const PositionView& position,
                    std::initializer_list<std::span<const ElementId>> elements);

 private:
  std::vector<bool> seen_;  // none between two calls
};

/// Elastic energy ½ Σ over links |(x_j − x_i) − r_ij|² (mesh units squared), in double.
double elastic_energy(const Mesh& mesh, const Cuts& cuts, const PositionView& position);

/// Distance from rest over the elements (mesh units), in double.
struct Displacement {
  double max = 0;
  double rms = 0;
};
Displacement measure_displacement(const Mesh& mesh, const PositionView& position);

}  // namespace chainmail
