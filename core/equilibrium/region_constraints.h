#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "body/region.h"
#include "mesh/fixed_matrix.h"
#include "mesh/mesh.h"

namespace chainmail {

/// The valid regions in a minimisation, by the alternating direction method of multipliers (Glowinski and Marroco 1975;
/// Boyd et al. 2011): per link, a copy of its difference of displacements that stays inside the region, and a
/// multiplier, which is the region's force.
///
/// `links` in its functions calls visit(link, i, j, region, stiffness) for each link that counts, with the region of
/// element j about i and the stiffness of the link.
template <int Dimension>
class RegionMultipliers {
 public:
  using Vector = FixedMatrix<double, Dimension>;
  using Vectors = std::vector<Vector>;

  /// Stiffness against the distance between a link and its copy, as a multiple of the link's own stiffness.
  double penalty() const { return penalty_; }

  /// Begins without forces, from these displacements.
  template <class Links>
  void begin(LinkId link_count, Links links, const Vectors& at) {
    multiplier_.assign(link_count, Vector());
    inside_.resize(link_count);
    links([&](LinkId link, ElementId i, ElementId j, const auto& region, double) {
      inside_[link] = clamped_to(region, at[j] - at[i]);
    });
    begin_checks();
  }

  /// Checks the penalty after a few steps again, for another problem.
  void begin_checks() {
    steps_ = 0;
    next_check_ = first_check;
  }

  /// Forgets the force of a cut link.
  void drop(LinkId link) {
    multiplier_[link] = {};
    inside_[link] = {};
  }

  /// Adds the forces that pull the links to their copies.
  template <class Links>
  void add_forces(Links links, const Vectors& at, Vectors& force) const {
    links([&](LinkId link, ElementId i, ElementId j, const auto&, double stiffness) {
      const Vector apart = at[j] - at[i];
      const Vector pull = penalty_ * stiffness * (inside_[link] - multiplier_[link] - apart);
      force[i] -= pull;
      force[j] += pull;
    });
  }

  /// What a step has changed; sums over the links, weighted by their stiffness.
  struct Step {
    double outside = 0;  // squared distance between links and their copies
    double stepped = 0;  // squared step of the copies
    double size = 0;     // squared difference of displacements
    bool forced = false;
  };

  /// Moves the copies into the regions, and updates the multipliers.
  template <class Links>
  Step step(Links links, const Vectors& at) {
    Step result;
    links([&](LinkId link, ElementId i, ElementId j, const auto& region, double stiffness) {
      const double weight = penalty_ * stiffness;
      const Vector apart = at[j] - at[i], before = inside_[link];
      const Vector wanted = over_relaxation * apart + (1 - over_relaxation) * before + multiplier_[link];
      inside_[link] = clamped_to(region, wanted);
      multiplier_[link] = wanted - inside_[link];  // exactly 0 inside the region
      result.outside += weight * (apart - inside_[link]).squaredNorm();
      result.stepped += weight * (before - inside_[link]).squaredNorm();
      result.size += weight * apart.squaredNorm();
      result.forced = result.forced || !multiplier_[link].isZero();
    });
    return result;
  }

  /// Changes the penalty if one of the two residuals of a step is much larger than the other. Returns true if it did.
  bool adapt(const Step& step) {
    if (++steps_ < next_check_) {
      return false;
    }
    next_check_ *= 2;
    const double ratio = step.outside > 0 ? std::sqrt(step.stepped / step.outside) : 1;
    const double wanted = ratio > too_stiff ? penalty_ / factor : ratio < too_soft ? penalty_ * factor : penalty_;
    if (wanted == penalty_ || wanted < least || wanted > largest) {
      return false;
    }
    for (Vector& one : multiplier_) {
      one *= penalty_ / wanted;
    }
    penalty_ = wanted;
    return true;
  }

  /// Returns the force of a link's region.
  Vector force(LinkId link, double stiffness) const { return penalty_ * stiffness * multiplier_[link]; }

  static Vector clamped_to(const Region<double, Dimension>& region, Vector apart) {
    for (int k = 0; k < Dimension; ++k) {
      apart[k] = std::min(std::max(apart[k], region.low[k]), region.high[k]);
    }
    return apart;
  }

 private:
  // The penalty at the beginning, and its limits. Few binding links converge best with little, many with much.
  static constexpr double first = 2, least = 0.2, largest = 100;
  // The penalty changes by this factor after 6, 12, 24, ... steps if one of the two residuals is larger than the other
  // by these ratios (after Boyd et al. 2011, section 3.4.1; the ratios were found by trials on sheets and blocks).
  static constexpr double factor = 3, too_stiff = 1.9, too_soft = 0.7;
  static constexpr int first_check = 6;
  static constexpr double over_relaxation = 1.7;

  double penalty_ = first;
  int steps_ = 0, next_check_ = first_check;
  Vectors inside_;      // of each link: its copy
  Vectors multiplier_;  // of each link: its force, divided by the penalty
};

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
