#include "elastic/pinned_solid.h"

#include <Eigen/LU>
#include <algorithm>
#include <string>
#include <utility>

#include "elastic/held.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

using Eigen::Index;

std::vector<ElementId> corners_of(const Solid& solid) {
  std::vector<ElementId> corners;
  for (const auto& triangle : solid.triangles) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  std::ranges::sort(corners);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

}  // namespace

PinnedSolid::PinnedSolid(const Mesh& mesh, Solid solid, const PinnedElements& pinned, double poisson,
                         const Progress& progress)
    : solid_(std::move(solid)), elements_(corners_of(solid_)), corner_count_(elements_.size()) {
  elements_.insert(elements_.end(), solid_.inner.begin(), solid_.inner.end());
  check_pins(mesh, pinned);
  find_pinned_facets(pinned);
  system_.emplace(std::move(solid_.facets), is_pinned_, poisson, progress.part(0, 0.95));
  at_rest_ = Eigen::VectorXd::Zero(Index(3 * elements_.size()));
  if (!pins_.isZero(0)) {
    at_rest_ = at_elements(system_->solve(pins_), progress.part(0.95, 1));
  }
}

bool PinnedSolid::has_corner(ElementId element) const {
  return std::binary_search(elements_.begin(), elements_.begin() + std::ptrdiff_t(corner_count_), element);
}

void PinnedSolid::check_pins(const Mesh& mesh, const PinnedElements& pinned) const {
  const auto holds_surface = [&](ElementId e) { return pinned[e] && has_corner(e); };
  for (const ElementId e : solid_.inner) {
    // A layer of pins may be two elements deep. Then its outer elements hold the surface.
    if (pinned[e] && std::ranges::none_of(mesh.neighbours_of(e), holds_surface)) {
      throw Error("BEM",
                  "element " + std::to_string(e) + " is pinned inside the object, and BEM works only on the surface",
                  "unpin it, or compare by linear FEM");
    }
  }
  std::vector<ElementId> pins = elements_;
  std::erase_if(pins, [&](ElementId e) { return !pinned[e]; });
  check_part_held(mesh, elements_.front(), pins);
}

void PinnedSolid::find_pinned_facets(const PinnedElements& pinned) {
  const auto& triangles = solid_.triangles;
  const auto is_pinned = [&](ElementId e) { return pinned[e].has_value(); };
  is_pinned_.resize(triangles.size());
  std::vector<bool> holds(pinned.size());  // true for corners of facets with only pinned corners
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (std::ranges::all_of(triangles[t], is_pinned)) {
      is_pinned_[t] = true;
      std::ranges::for_each(triangles[t], [&](ElementId e) { holds[e] = true; });
    }
  }
  pins_ = Eigen::VectorXd::Zero(Index(3 * triangles.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    is_pinned_[t] =
        is_pinned_[t] || std::ranges::any_of(triangles[t], [&](ElementId e) { return is_pinned(e) && !holds[e]; });
    const auto count = std::ranges::count_if(triangles[t], is_pinned);
    for (std::size_t i = 0; i < 3 && is_pinned_[t]; ++i) {
      pins_.segment<3>(Index(3 * t)) += pinned[triangles[t][i]].value_or(Point::Zero()) / double(count);
    }
  }
}

PinnedSolid::HandleFacets PinnedSolid::facets_about(std::span<const ElementId> corners,
                                                    const Eigen::MatrixXd& prescribed) const {
  HandleFacets about;
  about.displacements = Eigen::MatrixXd::Zero(Index(3 * solid_.triangles.size()), prescribed.cols());
  for (std::size_t t = 0; t < solid_.triangles.size(); ++t) {
    auto displacement = about.displacements.middleRows<3>(Index(3 * about.facets.size()));
    int count = 0;
    for (const ElementId corner : solid_.triangles[t]) {
      const auto found = std::ranges::lower_bound(corners, corner);
      if (found != corners.end() && *found == corner) {
        displacement += prescribed.middleRows<3>(3 * (found - corners.begin()));
        ++count;
      }
    }
    if (count > 0) {
      displacement /= count;
      about.facets.push_back(t);
    }
  }
  return about;
}

/// In the system, the tractions of the handle's facets are known. So this computes the displacements for unit tractions
/// on them, and combines these so that the facets move as prescribed. Facets that pins also hold have known
/// displacements and move with the handle directly.
Eigen::MatrixXd PinnedSolid::respond(std::span<const ElementId> corners, const Eigen::MatrixXd& prescribed,
                                     const Progress& progress) const {
  const HandleFacets about = facets_about(corners, prescribed);
  const Index cases = prescribed.cols();
  Eigen::MatrixXd handle = Eigen::MatrixXd::Zero(pins_.size(), cases);
  std::vector<std::size_t> free;
  Eigen::MatrixXd follow(3 * Index(about.facets.size()), cases);  // of the free facets
  for (std::size_t i = 0; i < about.facets.size(); ++i) {
    const auto displacement = about.displacements.middleRows<3>(Index(3 * i));
    if (is_pinned_[about.facets[i]]) {
      handle.middleRows<3>(Index(3 * about.facets[i])) = displacement;
    } else {
      follow.middleRows<3>(Index(3 * free.size())) = displacement;
      free.push_back(about.facets[i]);
    }
  }
  const Index units = Index(3 * free.size());
  follow.conservativeResize(units, cases);
  Eigen::MatrixXd known = Eigen::MatrixXd::Zero(pins_.size(), units + cases);
  known.rightCols(cases) = handle;
  for (std::size_t i = 0; i < free.size(); ++i) {
    known.block<3, 3>(Index(3 * free[i]), Index(3 * i)).setIdentity();
  }
  const auto fields = system_->solve(known);
  progress.report(0.5);
  Eigen::MatrixXd at_handle(units, units + cases);
  for (std::size_t i = 0; i < free.size(); ++i) {
    at_handle.middleRows<3>(Index(3 * i)) = fields.displacements.middleRows<3>(Index(3 * free[i]));
  }
  const Eigen::MatrixXd tractions = at_handle.leftCols(units).partialPivLu().solve(follow - at_handle.rightCols(cases));
  const auto together = [&](const Eigen::MatrixXd& of) -> Eigen::MatrixXd {
    return of.rightCols(cases) + of.leftCols(units) * tractions;
  };
  return at_elements({together(fields.displacements), together(fields.tractions)}, progress.part(0.5, 1));
}

Eigen::MatrixXd PinnedSolid::at_elements(const BoundarySystem::Fields& fields, const Progress& progress) const {
  Eigen::MatrixXd at = Eigen::MatrixXd::Zero(Index(3 * elements_.size()), fields.displacements.cols());
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(Index(corner_count_));
  for (std::size_t t = 0; t < solid_.triangles.size(); ++t) {
    const double area = system_->facets()[t].area;
    for (const ElementId e : solid_.triangles[t]) {
      const Index i =
          std::lower_bound(elements_.begin(), elements_.begin() + std::ptrdiff_t(corner_count_), e) - elements_.begin();
      at.middleRows<3>(3 * i) += area * fields.displacements.middleRows<3>(Index(3 * t));
      areas[i] += area;
    }
  }
  for (Index i = 0; i < areas.size(); ++i) {
    at.middleRows<3>(3 * i) /= areas[i];
  }
  for (std::size_t i = 0; i < solid_.inner.size(); ++i) {
    progress.report(double(i) / double(solid_.inner.size()));
    const std::size_t index = corner_count_ + i;
    at.middleRows<3>(Index(3 * index)) = system_->displacement_inside(solid_.inner_positions[i], fields);
  }
  return at;
}

}  // namespace chainmail
