#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "elastic/boundary_system.h"
#include "elastic/closed_surface.h"

namespace chainmail {

/// Where each element of an object is pinned, from rest (mesh units); nothing where it is not.
using PinnedElements = std::vector<std::optional<Point>>;

/// One solid that pins hold, by boundary elements.
///
/// What is prescribed is prescribed on facets: a pin holds those of which all corners are pinned, or all about it where
/// it has none of these; the hand holds all about its element. The others are free of tractions. An element is where
/// the facets about it are in the mean, by area.
///
/// As displacements alone are prescribed, Young's modulus cancels out.
class PinnedSolid {
 public:
  /// Throws Error where the pins do not hold it, and Cancelled.
  PinnedSolid(const Mesh& mesh, Solid solid, const PinnedElements& pinned, double poisson, const Progress& progress);

  /// The corners of its triangles, ascending, then those inside.
  std::span<const ElementId> elements() const { return elements_; }
  bool has_corner(ElementId element) const;

  /// The displacements of its elements, three rows each, for the pins alone.
  const Eigen::VectorXd& at_rest() const { return at_rest_; }
  /// What the hand at a corner adds as it goes by one along each axis, a column each; where pins hold what it holds,
  /// the hand does. Throws Cancelled.
  Eigen::MatrixXd respond(ElementId corner, const Progress& progress) const;

 private:
  void check_pins(const Mesh& mesh, const PinnedElements& pinned) const;
  std::vector<std::size_t> facets_about(ElementId corner) const;
  void find_pinned_facets(const PinnedElements& pinned);
  Eigen::MatrixXd at_elements(const BoundarySystem::Fields& fields, const Progress& progress) const;

  Solid solid_;
  std::vector<ElementId> elements_;
  std::size_t corner_count_ = 0;
  std::vector<bool> is_pinned_;  // facet by facet
  Eigen::VectorXd pins_;         // the displacements of those that are, facet by facet
  std::optional<BoundarySystem> system_;
  Eigen::VectorXd at_rest_;
};

}  // namespace chainmail
