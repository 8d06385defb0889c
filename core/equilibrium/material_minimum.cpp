#include "equilibrium/material_minimum.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "equilibrium/surface_steps.h"

namespace chainmail {
namespace {

// The ratio of volumes below which the energy is extended at the beginning of a search.
constexpr double soft_below = 0.5;
// With a cell below it, the ratio is lowered only when the search has come this close to the minimum (relative).
constexpr double close = 0.02;

}  // namespace

template <int D, class Steps>
void MaterialMinimum<D, Steps>::begin(const MeshPointer& mesh, const Progress& progress) {
  has_begun_ = false;
  energy_.build(mesh, progress);
  preconditioner_.begin(mesh);
  steps_.begin(energy_, progress);
  regions_.begin(mesh->link_count());
  weights_.assign(mesh->link_count(), 0);
  has_begun_ = true;
  forget();
}

template <int D, class Steps>
void MaterialMinimum<D, Steps>::set_material(const ElasticOptions& elastic) {
  energy_.set_material(elastic);
  for (LinkId link = 0; link < weights_.size(); ++link) {
    weights_[link] = energy_.weight(link);
    preconditioner_.set_link(link, weights_[link]);
  }
  regions_.clear();
  forget();
}

template <int D, class Steps>
void MaterialMinimum<D, Steps>::set_cuts(const Cuts& cuts) {
  const std::vector<LinkId> changed = energy_.set_cuts(cuts);
  for (const LinkId link : changed) {
    weights_[link] = energy_.weight(link);
    preconditioner_.set_link(link, weights_[link]);
  }
  steps_.outdate_inverse();
  is_outdated_ = is_material_outdated_ = true;
}

template <int D, class Steps>
void MaterialMinimum<D, Steps>::set_fixed(ElementId element, bool fixed) {
  if (preconditioner_.is_fixed(element) == fixed) {
    return;
  }
  preconditioner_.set_fixed(element, fixed);
  steps_.outdate_inverse();
  is_outdated_ = is_material_outdated_ = true;
}

template <int D, class Steps>
void MaterialMinimum<D, Steps>::forget() {
  steps_.forget();
  is_outdated_ = is_material_outdated_ = true;
  energy_.set_extension_below(soft_below);
}

template <int D, class Steps>
void MaterialMinimum<D, Steps>::extend(const Vectors& jump, Vectors& at) {
  const Mesh& mesh = preconditioner_.mesh();
  pull_.assign(at.size(), Vectors::value_type::Zero());
  for (ElementId e = 0; e < at.size(); ++e) {
    if (jump[e].isZero(0)) {
      continue;
    }
    at[e] += jump[e];
    for (EntryId entry = mesh.first_entry[e]; entry < mesh.first_entry[e + 1]; ++entry) {
      if (const ElementId other = mesh.neighbours[entry]; !preconditioner_.is_fixed(other)) {
        pull_[other] += weights_[mesh.entry_link[entry]] * jump[e];
      }
    }
  }
  preconditioner_.apply(pull_, step_, {});
  add(at, 1, step_);
  is_outdated_ = is_material_outdated_ = true;
}

template <int D, class Steps>
bool MaterialMinimum<D, Steps>::is_inverted(const Vectors& at) {
  energy_.evaluate(at, nullptr);
  return energy_.is_inverted();
}

template <int D, class Steps>
double MaterialMinimum<D, Steps>::evaluate(const Vectors& at, Vectors& force, const SharedLoop& shared) {
  material_value_ = energy_.evaluate(at, &material_force_, shared);
  for (ElementId e = 0; e < material_force_.size(); ++e) {
    if (preconditioner_.is_fixed(e)) {
      material_force_[e].setZero();
    }
  }
  return add_regions(at, force);
}

template <int D, class Steps>
double MaterialMinimum<D, Steps>::add_regions(const Vectors& at, Vectors& force) const {
  force = material_force_;
  const double value = material_value_ + regions_.add(at, &force);
  for (ElementId e = 0; !regions_.is_empty() && e < force.size(); ++e) {
    if (preconditioner_.is_fixed(e)) {
      force[e].setZero();
    }
  }
  return value;
}

/// Lowers the ratio below which the energy is extended: at once where that changes nothing, step by step otherwise.
template <int D, class Steps>
void MaterialMinimum<D, Steps>::harden(const Vectors& at, const SharedLoop& shared) {
  const double present = energy_.extension_below(), least = energy_.least_volume();
  double wanted = present;
  if (least >= present) {
    wanted = Energy::measured_below;
  } else if (distance_ < close * std::sqrt(2 * std::max(0.0, value_))) {
    wanted = std::max({Energy::measured_below, least, present / 4});
  }
  if (wanted < present) {
    energy_.set_extension_below(wanted);
    if (least < present) {
      value_ = evaluate(at, force_, shared);
    }
  }
}

template <int D, class Steps>
bool MaterialMinimum<D, Steps>::step(Vectors& at, int threads, const Progress& progress) {
  // Less is done before a helper has come.
  constexpr std::size_t worth_helpers = 8192;
  ThreadTeam team(threads);
  if (threads > 1 && at.size() >= worth_helpers) {
    team.call_helpers();
  }
  const SharedLoop shared(team);
  if (is_outdated_) {
    value_ = is_material_outdated_ ? evaluate(at, force_, shared) : add_regions(at, force_);
    distance_ = is_material_outdated_ ? std::numeric_limits<double>::infinity() : distance_;
    is_outdated_ = is_material_outdated_ = false;
  }
  harden(at, shared);
  const auto value_at = [&](const Vectors& x, Vectors& force) { return evaluate(x, force, shared); };
  const bool lowered = steps_.step(value_at, energy_, preconditioner_, regions_, at, value_, force_, shared, progress);
  distance_ = lowered ? steps_.distance() : 0;
  is_material_outdated_ = !lowered;  // the last try was elsewhere
  return steps_.has_prepared();
}

/// The coarser levels of the multigrid do without the springs: they would follow each change of the working set, and it
/// converges as fast.
template <int D, class Steps>
void MaterialMinimum<D, Steps>::follow_regions(std::span<const LinkId> changed) {
  for (const LinkId link : changed) {
    const double penalty = regions_.is_active(link) ? RegionPenalties<D>::penalty : 0;
    preconditioner_.set_link_for_a_while(link, weights_[link] + penalty * stiffness(link));
  }
  is_outdated_ = true;
}

template <int D>
std::unique_ptr<EnergyMinimum<D>> make_minimum(const Mesh& mesh) {
  if constexpr (D == 3) {
    if (is_surface_in_space(mesh)) {
      return std::make_unique<MaterialMinimum<3, SurfaceSteps>>();
    }
  }
  return std::make_unique<MaterialMinimum<D>>();
}

template std::unique_ptr<EnergyMinimum<1>> make_minimum(const Mesh& mesh);
template std::unique_ptr<EnergyMinimum<2>> make_minimum(const Mesh& mesh);
template std::unique_ptr<EnergyMinimum<3>> make_minimum(const Mesh& mesh);

}  // namespace chainmail
