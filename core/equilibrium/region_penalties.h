#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "equilibrium/region_multipliers.h"
#include "mesh/fixed_matrix.h"

namespace chainmail {

/// The valid regions in the minimisation of an energy that is not quadratic, by the augmented Lagrangian (Hestenes
/// 1969; Powell 1969; Rockafellar 1973 for inequalities): outside its region, a link has a spring to the region, which
/// a multiplier shifts until the link lies on the boundary. Only links in the working set are looked at between
/// updates: those outside or with a multiplier.
template <int Dimension>
class RegionPenalties {
 public:
  using Vector = FixedMatrix<double, Dimension>;
  using Vectors = std::vector<Vector>;
  /// Stiffness of the springs, as a multiple of the link's own stiffness.
  static constexpr double penalty = 4;

  void begin(LinkId link_count) {
    place_.assign(link_count, none);
    active_.clear();
  }
  bool is_empty() const { return active_.empty(); }
  bool is_active(LinkId link) const { return link < place_.size() && place_[link] != none; }

  /// Calls visit(i, j, stiffness) for each spring.
  template <class Visit>
  void for_each_spring(Visit visit) const {
    for (const Active& one : active_) {
      visit(one.i, one.j, one.stiffness);
    }
  }
  /// Adds the springs' forces to `force`, if given, and returns their energy.
  double add(const Vectors& at, Vectors* force) const {
    double energy = 0;
    for (const Active& one : active_) {
      const Vector wanted = at[one.j] - at[one.i] + one.multiplier;
      const Vector outside = wanted - RegionMultipliers<Dimension>::clamped_to(one.region, wanted);
      energy += one.stiffness / 2 * outside.squaredNorm();
      if (force != nullptr) {
        (*force)[one.i] += one.stiffness * outside;
        (*force)[one.j] -= one.stiffness * outside;
      }
    }
    return energy;
  }

  struct Update {
    /// Σ stiffness · squared change of the multiplier: how far links are outside their regions, or held by a force that
    /// they do not need.
    double error = 0;
    std::vector<LinkId> changed;  // links that joined or left the working set
  };
  /// Finds the working set anew. `links(visit)` calls visit(link, i, j, region, stiffness) for each link that counts;
  /// `moves`: true to update the multipliers too.
  template <class Links>
  Update update(Links links, const Vectors& at, bool moves) {
    Update result;
    std::vector<Active> next;
    links([&](LinkId link, ElementId i, ElementId j, const Region<double, Dimension>& region, double stiffness) {
      Active one{link, i, j, region, penalty * stiffness, Vector()};
      const Vector apart = at[j] - at[i];
      const bool was = place_[link] != none;
      if (was) {
        one.multiplier = active_[place_[link]].multiplier;
      }
      const Vector wanted = apart + one.multiplier;
      const Vector outside = wanted - RegionMultipliers<Dimension>::clamped_to(region, wanted);
      result.error += stiffness * (outside - one.multiplier).squaredNorm();
      const bool is = !outside.isZero();
      if (moves) {
        one.multiplier = outside;
      }
      if (is || (was && !moves)) {
        next.push_back(one);
      }
      if (is != was && (is || moves)) {
        result.changed.push_back(link);
      }
    });
    for (const Active& one : active_) {
      place_[one.link] = none;
    }
    active_ = std::move(next);
    for (std::size_t k = 0; k < active_.size(); ++k) {
      place_[active_[k].link] = static_cast<std::uint32_t>(k);
    }
    return result;
  }

  /// Forgets all forces. Returns the links that were in the working set.
  std::vector<LinkId> clear() {
    std::vector<LinkId> links;
    for (const Active& one : active_) {
      place_[one.link] = none;
      links.push_back(one.link);
    }
    active_.clear();
    return links;
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFF;

  struct Active {
    LinkId link;
    ElementId i, j;
    Region<double, Dimension> region;
    double stiffness;   // of the spring
    Vector multiplier;  // the region's force, divided by this stiffness
  };

  std::vector<Active> active_;        // the working set
  std::vector<std::uint32_t> place_;  // of each link in it
};

}  // namespace chainmail
