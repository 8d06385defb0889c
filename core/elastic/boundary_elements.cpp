#include "elastic/boundary_elements.h"

#include <algorithm>
#include <string>
#include <utility>

#include "elastic/dense.h"
#include "elastic/methods.h"
#include "elastic/response.h"
#include "elastic/simplices.h"
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
  Eigen::MatrixXd tractions = follow - at_handle.rightCols(cases);
  DenseLu(at_handle.leftCols(units)).solve(tractions);
  const auto together = [&](const Eigen::MatrixXd& of) {
    Eigen::MatrixXd sum = of.rightCols(cases);
    add_product(sum, 1, of.leftCols(units), tractions);
    return sum;
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

namespace {

using Eigen::Index;

/// An object of one or more solids. Each is solved on its own and does not affect the others.
class BoundaryElements final : public LinearResponse {
 public:
  BoundaryElements(const ElasticProblem& problem, const Progress& progress)
      : LinearResponse(problem), pinned_(problem.mesh->element_count()), solids_of_(pinned_.size()) {
    for (std::size_t i = 0; i < problem.pins.size(); ++i) {
      pinned_[problem.pins[i]] = Eigen::Map<const Point>(problem.pinned.data() + 3 * i);
    }
    auto solids = enclosed_solids(problem.mesh, problem.cuts, progress.part(0, 0.05));
    check_pinned(*problem.mesh, problem.pins);
    const Progress rest = progress.part(0.05, 1);
    const double count = double(solids.size());
    for (std::size_t i = 0; i < solids.size(); ++i) {
      const Progress part = rest.part(double(i) / count, double(i + 1) / count);
      solids_.emplace_back(*problem.mesh, std::move(solids[i]), pinned_, problem.options.material.poisson, part);
      std::ranges::for_each(solids_.back().elements(), [&](ElementId e) { ++solids_of_[e]; });
    }
    start_at_rest();
  }

 private:
  Eigen::MatrixXd respond(std::span<const ElementId> elements, const Eigen::MatrixXd& prescribed,
                          const Progress& progress) override {
    Eigen::MatrixXd response = Eigen::MatrixXd::Zero(Index(3 * pinned_.size()), prescribed.cols());
    for (const PinnedSolid& solid : solids_) {
      std::vector<ElementId> corners;
      Eigen::MatrixXd of_corners(prescribed.rows(), prescribed.cols());
      for (std::size_t i = 0; i < elements.size(); ++i) {
        if (solid.has_corner(elements[i])) {
          of_corners.middleRows<3>(Index(3 * corners.size())) = prescribed.middleRows<3>(Index(3 * i));
          corners.push_back(elements[i]);
        } else {
          check_outside(solid, elements[i]);
        }
      }
      if (!corners.empty()) {
        add(solid, solid.respond(corners, of_corners, progress), response);
      }
    }
    for (std::size_t e = 0; e < pinned_.size(); ++e) {
      if (pinned_[e]) {
        response.middleRows<3>(3 * Index(e)).setZero();
      }
    }
    for (std::size_t i = 0; i < elements.size(); ++i) {
      response.middleRows<3>(3 * Index{elements[i]}) = prescribed.middleRows<3>(Index(3 * i));
    }
    return response;
  }

  /// Throws Error if an element lies inside a solid.
  static void check_outside(const PinnedSolid& solid, ElementId element) {
    if (std::ranges::count(solid.elements(), element) != 0) {
      throw Error("BEM",
                  "element " + std::to_string(element) + " lies inside the object, and BEM works only on the surface",
                  "grab an element of the surface");
    }
  }

  void start_at_rest() {
    Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(Index(3 * pinned_.size()), 1);
    for (const PinnedSolid& solid : solids_) {
      add(solid, solid.at_rest(), rest);
    }
    for (std::size_t e = 0; e < pinned_.size(); ++e) {
      if (pinned_[e]) {
        rest.middleRows<3>(3 * Index(e)) = *pinned_[e];
      }
    }
    set_base({rest.data(), rest.data() + rest.size()});
  }

  /// Adds the displacements of the elements of a solid. An element that two solids share gets the mean.
  void add(const PinnedSolid& solid, const Eigen::MatrixXd& of_solid, Eigen::MatrixXd& to) const {
    for (std::size_t i = 0; i < solid.elements().size(); ++i) {
      const ElementId e = solid.elements()[i];
      to.middleRows<3>(3 * Index{e}) += of_solid.middleRows<3>(Index(3 * i)) / double(solids_of_[e]);
    }
  }

  PinnedElements pinned_;
  std::vector<std::uint32_t> solids_of_;  // number of solids that have each element
  std::vector<PinnedSolid> solids_;
};

}  // namespace

std::unique_ptr<ElasticSolver> make_boundary_elements(const ElasticProblem& problem, const Progress& progress) {
  return std::make_unique<BoundaryElements>(problem, progress);
}

}  // namespace chainmail
