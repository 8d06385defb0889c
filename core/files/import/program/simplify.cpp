#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Constrained_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "files/import/program/given_surface.h"
#include "files/import/program/oriented_surface.h"
#include "files/import/program/tasks.h"

namespace chainmail::import {
namespace {

namespace simplification = CGAL::Surface_mesh_simplification;
using FixedEdges = Halfedges::Property_map<Halfedges::Edge_index, bool>;

constexpr double share_before = 0.2;  // of the time: orienting the surface, and the cost of each edge
constexpr std::size_t collapses_per_report = 256;

/// A surface whose edges are collapsed one after another, those that change its shape least first (Lindstrom and Turk
/// 1998). The elements at its borders stay, and those at which it was taken apart.
class CollapsingSurface : public OrientedSurface {
 public:
  explicit CollapsingSurface(const MeshParts& parts)
      : OrientedSurface(parts),
        copies_(originals().size() - parts.rest.size()),
        fixed_(halfedges().add_property_map<Halfedges::Edge_index, bool>("e:fixed", false).first),
        is_fixed_(parts.rest.size(), false),
        element_(originals()) {
    std::vector<bool> has_copies(parts.rest.size(), false);
    for (std::size_t v = parts.rest.size(); v < originals().size(); ++v) {
      has_copies[originals()[v]] = true;
    }
    for (const auto edge : halfedges().edges()) {
      const ElementId a = originals()[halfedges().vertex(edge, 0)], b = originals()[halfedges().vertex(edge, 1)];
      if (halfedges().is_border(edge) || has_copies[a] || has_copies[b]) {
        fixed_[edge] = true;
        is_fixed_[a] = is_fixed_[b] = true;
      }
    }
  }

  /// Number of elements; copies do not count.
  std::size_t element_count() const { return halfedges().number_of_vertices() - copies_; }
  /// Number of elements that stay.
  std::size_t fixed_count() const { return std::size_t(std::count(is_fixed_.begin(), is_fixed_.end(), true)); }

  /// Collapses edges until so many elements are left, or until no edge can be collapsed.
  void collapse_to(std::size_t elements, const Report& report);
  /// Returns the elements that are left, in the order of their ids, and the triangles.
  ImportedMesh rest(const MeshParts& parts) const;

  /// Makes the vertex that is left of an edge the end of the edge that stays, if one of them does.
  void keep_fixed(Halfedges::Vertex_index left, Halfedges::Vertex_index a, Halfedges::Vertex_index b) {
    element_[left] = is_fixed_[element_[a]] ? element_[a] : is_fixed_[element_[b]] ? element_[b] : element_[left];
  }

 private:
  std::size_t copies_;
  FixedEdges fixed_;
  std::vector<bool> is_fixed_;      // of each element
  std::vector<ElementId> element_;  // of each vertex
};

/// Follows which element a vertex stands for.
class FixedStay : public simplification::Edge_collapse_visitor_base<Halfedges> {
 public:
  explicit FixedStay(CollapsingSurface& surface) : surface_(&surface) {}

  template <class Profile>
  void OnCollapsed(const Profile& edge, Halfedges::Vertex_index left) {
    surface_->keep_fixed(left, edge.v0(), edge.v1());
  }

 private:
  CollapsingSurface* surface_;
};

/// Ends the collapsing, and reports its progress.
class EnoughCollapsed {
 public:
  EnoughCollapsed(const CollapsingSurface& surface, std::size_t elements, const Report& report)
      : surface_(surface), elements_(elements), first_(surface.element_count()), report_(report) {}

  template <class Cost, class Profile>
  bool operator()(const Cost& /*cost*/, const Profile& /*edge*/, std::size_t /*first*/, std::size_t /*now*/) const {
    const std::size_t now = surface_.element_count();
    if (now % collapses_per_report == 0) {
      report_(share_before + (1 - share_before) * double(first_ - now) / double(first_ - elements_));
    }
    return now <= elements_;
  }

 private:
  const CollapsingSurface& surface_;
  std::size_t elements_, first_;
  const Report& report_;
};

void CollapsingSurface::collapse_to(std::size_t elements, const Report& report) {
  using Placement =
      simplification::Constrained_placement<simplification::LindstromTurk_placement<Halfedges>, FixedEdges>;
  simplification::edge_collapse(halfedges(), EnoughCollapsed(*this, elements, report),
                                CGAL::parameters::edge_is_constrained_map(fixed_)
                                    .get_placement(Placement(fixed_))
                                    .filter(simplification::Bounded_normal_change_filter<>())
                                    .visitor(FixedStay(*this)));
}

ImportedMesh CollapsingSurface::rest(const MeshParts& parts) const {
  ImportedMesh mesh;
  std::vector<bool> is_left(parts.rest.size(), false);
  std::vector<Point> positions = parts.rest;
  for (const auto vertex : halfedges().vertices()) {
    const auto& point = halfedges().point(vertex);
    is_left[element_[vertex]] = true;
    positions[element_[vertex]] = {point.x(), point.y(), point.z()};
  }
  std::vector<ElementId> ids(parts.rest.size());
  for (std::size_t element = 0; element < ids.size(); ++element) {
    ids[element] = ElementId(mesh.parts.rest.size());
    if (is_left[element]) {
      mesh.parts.rest.push_back(positions[element]);
    }
  }
  for (const auto face : halfedges().faces()) {
    std::array<ElementId, 3> corners{};
    std::size_t i = 0;
    for (const auto vertex : CGAL::vertices_around_face(halfedges().halfedge(face), halfedges())) {
      corners[i++] = ids[element_[vertex]];
    }
    mesh.parts.triangles.push_back(corners);
  }
  return mesh;
}

std::string at_least(std::size_t least) { return "choose " + std::to_string(least) + " or more"; }

/// Refuses before the work begins.
void check_fixed(const CollapsingSurface& surface, std::size_t elements) {
  const std::size_t fixed = surface.fixed_count();
  if (fixed > 0 && elements <= fixed) {
    refuse("the " + std::to_string(fixed) + " elements at its borders and non-manifold edges stay, so it cannot have " +
               std::to_string(elements),
           fixed + 1 < surface.element_count() ? at_least(fixed + 1) : "use a surface with more elements inside");
  }
}

}  // namespace

ImportedMesh simplify_surface(const std::filesystem::path& path, std::size_t elements, const Report& report) {
  const ImportedMesh given = read_surface(path);
  try {
    CollapsingSurface surface(given.parts);
    check_fixed(surface, elements);
    report(share_before / 2);
    surface.collapse_to(elements, report);
    if (surface.element_count() > elements) {
      refuse("with fewer than " + std::to_string(surface.element_count()) + " elements it would fold or lose its shape",
             at_least(surface.element_count()));
    }
    return surface.rest(given.parts);
  } catch (const CGAL::Failure_exception&) {
    refuse("CGAL failed to simplify it", "repair it first (Object > Repair, or chainmail repair)");
  }
}

}  // namespace chainmail::import
