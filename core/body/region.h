#pragma once

#include <algorithm>
#include <cmath>

#include "body/softness.h"
#include "mesh/large_pages.h"
#include "mesh/mesh.h"

namespace chainmail {

/// The valid region: the box along the axes of the coordinates in which a neighbour may lie, relative to its sponsor
/// (mesh units).
template <class Scalar, int Dimension>
struct Region {
  Scalar low[Dimension];
  Scalar high[Dimension];
};

/// Returns the valid region of a link with this rest vector (thesis 3.1, Li and Brodlie 2003).
///
/// The minimum and maximum, which the thesis omits, keep the region of a link that runs left or down from being inside
/// out. Bounds are computed in double and rounded once. About the rest vector, they bound the difference of two
/// displacements: the lower one is never above 0 and the upper one never below 0, whatever is rounded.
template <class Scalar, int Dimension>
Region<Scalar, Dimension> valid_region(const double (&rest_vector)[Dimension], const LinkSoftness& softness,
                                       bool about_rest_vector = false) {
  const double less = about_rest_vector ? 1 : 0;
  Region<Scalar, Dimension> region;
  for (int k = 0; k < Dimension; ++k) {
    double others = 0;
    for (int j = 0; j < Dimension; ++j) {
      others += j == k ? 0 : std::abs(rest_vector[j]);
    }
    const double compressed = (softness.compression - less) * rest_vector[k];
    const double stretched = (softness.stretch - less) * rest_vector[k];
    region.low[k] = static_cast<Scalar>(std::min(compressed, stretched) - softness.shear * others);
    region.high[k] = static_cast<Scalar>(std::max(compressed, stretched) + softness.shear * others);
  }
  return region;
}

/// Returns the valid region of element `to` relative to element `from`, along the axes of the mesh's coordinates.
template <class Scalar, int Dimension>
Region<Scalar, Dimension> valid_region(const Mesh& mesh, ElementId from, ElementId to, const LinkSoftness& softness,
                                       bool about_rest_vector = false) {
  double rest_vector[Dimension];
  for (int k = 0; k < Dimension; ++k) {
    rest_vector[k] = mesh.rest[std::size_t{to} * Dimension + k] - mesh.rest[std::size_t{from} * Dimension + k];
  }
  return valid_region<Scalar, Dimension>(rest_vector, softness, about_rest_vector);
}

/// The same along turned axes, for a mesh whose coordinates are those of the world.
template <class Scalar, int Dimension>
Region<Scalar, Dimension> valid_region(const Mesh& mesh, const RegionAxes& axes, ElementId from, ElementId to,
                                       const LinkSoftness& softness) {
  if (!axes.is_turned()) {
    return valid_region<Scalar, Dimension>(mesh, from, to, softness);
  }
  double rest_vector[Dimension];
  for (int k = 0; k < Dimension; ++k) {
    rest_vector[k] = mesh.rest[std::size_t{to} * Dimension + k] - mesh.rest[std::size_t{from} * Dimension + k];
  }
  turn_into_axes(mesh, axes, rest_vector);
  return valid_region<Scalar, Dimension>(rest_vector, softness);
}

/// The valid regions of an object. If the mesh has few rest vectors and the regions of all links follow from one
/// softness, there is one region per rest vector, which fits into the cache; otherwise one per entry of the neighbour
/// table.
template <class Scalar, int Dimension>
class RegionTable {
 public:
  using One = Region<Scalar, Dimension>;
  /// Index of a region. Valid until something other than values of softness changes.
  using Id = std::uint32_t;

  void set(const Mesh& mesh, const Softness& softness, bool about_rest_vector) {
    const bool by_shape = !mesh.entry_shape.empty() && has_global_regions(softness);
    const std::size_t count = by_shape ? mesh.shapes.size() / Dimension : mesh.neighbours.size();
    if (count != regions_.size()) {
      LargeVector<One>(count).swap(regions_);  // if memory runs out, the old regions stay
    }
    shape_of_ = by_shape ? mesh.entry_shape.data() : nullptr;
    by_shape ? set_shapes(mesh, softness.global, about_rest_vector) : set_entries(mesh, softness, about_rest_vector);
  }

  Id id(EntryId entry) const { return shape_of_ != nullptr ? shape_of_[entry] : entry; }
  /// True if the id of a region is the number of the rest vector of its link.
  bool by_shape() const { return shape_of_ != nullptr; }
  const One& at(Id id) const { return regions_[id]; }
  const One* data() const { return regions_.data(); }
  const One& operator[](EntryId entry) const { return regions_[id(entry)]; }

 private:
  void set_shapes(const Mesh& mesh, const LinkSoftness& softness, bool about_rest_vector) {
    for (std::size_t shape = 0; shape < regions_.size(); ++shape) {
      double rest_vector[Dimension];
      std::copy_n(mesh.shapes.data() + shape * Dimension, Dimension, rest_vector);
      regions_[shape] = valid_region<Scalar, Dimension>(rest_vector, softness, about_rest_vector);
    }
  }

  void set_entries(const Mesh& mesh, const Softness& softness, bool about_rest_vector) {
    for (ElementId e = 0; e < mesh.element_count(); ++e) {
      for (EntryId entry = mesh.first_entry[e]; entry < mesh.first_entry[e + 1]; ++entry) {
        regions_[entry] = valid_region<Scalar, Dimension>(mesh, e, mesh.neighbours[entry],
                                                          softness.of(mesh.entry_link[entry]), about_rest_vector);
      }
    }
  }

  LargeVector<One> regions_;
  const std::uint16_t* shape_of_ = nullptr;  // of the mesh, if there is one region per rest vector
};

}  // namespace chainmail
