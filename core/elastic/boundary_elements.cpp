#include <algorithm>
#include <string>
#include <utility>

#include "elastic/held.h"
#include "elastic/methods.h"
#include "elastic/pinned_solid.h"
#include "elastic/response.h"
#include "mesh/error.h"

namespace chainmail {
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
