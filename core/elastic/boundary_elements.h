#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "elastic/boundary_system.h"
#include "elastic/closed_surface.h"

namespace chainmail {

/// Displacement of each pinned element from rest (mesh units); none for free elements.
using PinnedElements = std::vector<std::optional<Point>>;

/// One solid with pins, by boundary elements.
///
/// Displacements are prescribed on facets. A pin holds the facets with only pinned corners, or all facets around it if
/// there are none of these; the handle holds all facets around its elements. The other facets are free of tractions.
/// The displacement of an element is the mean of the facets around it, by area.
///
/// Since only displacements are prescribed, Young's modulus cancels out.
class PinnedSolid {
 public:
  /// Throws Error if the pins do not hold the solid, and Cancelled.
  PinnedSolid(const Mesh& mesh, Solid solid, const PinnedElements& pinned, double poisson, const Progress& progress);

  /// Returns the corners of the triangles, ascending, then the elements inside.
  std::span<const ElementId> elements() const { return elements_; }
  bool has_corner(ElementId element) const;

  /// Returns the displacements of its elements, three rows each, while only the pins are prescribed.
  const Eigen::VectorXd& at_rest() const { return at_rest_; }
  /// Returns what a handle at some corners (ascending) adds: one column for each column of `prescribed`, which holds
  /// the displacements of these corners, three rows each. A facet moves by the mean of its corners in the handle. On
  /// facets that both hold, the handle counts. Throws Cancelled.
  Eigen::MatrixXd respond(std::span<const ElementId> corners, const Eigen::MatrixXd& prescribed,
                          const Progress& progress) const;

 private:
  void check_pins(const Mesh& mesh, const PinnedElements& pinned) const;
  /// Facets with a corner in the handle, and their displacements, three rows each.
  struct HandleFacets {
    std::vector<std::size_t> facets;
    Eigen::MatrixXd displacements;
  };
  HandleFacets facets_about(std::span<const ElementId> corners, const Eigen::MatrixXd& prescribed) const;
  void find_pinned_facets(const PinnedElements& pinned);
  Eigen::MatrixXd at_elements(const BoundarySystem::Fields& fields, const Progress& progress) const;

  Solid solid_;
  std::vector<ElementId> elements_;
  std::size_t corner_count_ = 0;
  std::vector<bool> is_pinned_;  // per facet
  Eigen::VectorXd pins_;         // displacements of the pinned facets, 0 for others; three rows per facet
  std::optional<BoundarySystem> system_;
  Eigen::VectorXd at_rest_;
};

}  // namespace chainmail
