#include "equilibrium/material_minimum.h"

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
void MaterialMinimum<D, Steps>::set_material(const ElasticOptions& elastic, const Progress& progress) {
  energy_.set_material(elastic, progress.part(0, 0.5));
  const Progress weighing = progress.part(0.5, 1);
  for (LinkId link = 0; link < weights_.size(); ++link) {
    weighing.report(link, weights_.size());
    weights_[link] = energy_.weight(link);
  }
  preconditioner_.set_links(weights_);
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
  is_outdated_ = true;
  has_changed_cells_ = true;
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
void MaterialMinimum<D, Steps>::extend(const Vectors& jump, Vectors& at, int threads) {
  LoopTeam team(threads, at.size());
  const SharedLoop shared = team.loop();
  const Mesh& mesh = preconditioner_.mesh();
  pull_.assign(at.size(), typename Vectors::value_type());
  for (ElementId e = 0; e < at.size(); ++e) {
    if (jump[e].isZero()) {
      continue;
    }
    at[e] += jump[e];
    for (EntryId entry = mesh.first_entry[e]; entry < mesh.first_entry[e + 1]; ++entry) {
      if (const ElementId other = mesh.neighbours[entry]; !preconditioner_.is_fixed(other)) {
        pull_[other] += weights_[mesh.entry_link[entry]] * jump[e];
      }
    }
  }
  preconditioner_.apply(pull_, step_, shared);
  add(at, 1, step_, shared);
  is_outdated_ = is_material_outdated_ = true;
}

template <int D, class Steps>
double MaterialMinimum<D, Steps>::energy_of(const Vectors& at) {
  is_outdated_ = is_material_outdated_ = true;
  return energy_.evaluate(at, nullptr);
}

template <int D, class Steps>
bool MaterialMinimum<D, Steps>::is_inverted(const Vectors& at, int threads) {
  LoopTeam team(threads, at.size());
  is_material_outdated_ = true;
  find_gradient(at, team.loop());
  return energy_.is_inverted();
}

template <int D, class Steps>
double MaterialMinimum<D, Steps>::evaluate(const Vectors& at, Vectors& force, const SharedLoop& shared) {
  material_value_ = energy_.evaluate(at, &material_force_, shared);
  has_changed_cells_ = false;
  clear_fixed(material_force_, shared);
  return add_regions(at, force, shared);
}

/// Computes the energy and its gradient where they are outdated.
template <int D, class Steps>
void MaterialMinimum<D, Steps>::find_gradient(const Vectors& at, const SharedLoop& shared) {
  const bool is_another = is_material_outdated_ || has_changed_cells_;
  if constexpr (requires { energy_.add_changes(at, material_force_); }) {
    if (!is_material_outdated_ && has_changed_cells_) {
      material_value_ += energy_.add_changes(at, material_force_);
      clear_fixed(material_force_, shared);
      has_changed_cells_ = false;
    }
  }
  value_ = is_material_outdated_ || has_changed_cells_ ? evaluate(at, force_, shared) : add_regions(at, force_, shared);
  distance_ = is_another ? std::numeric_limits<double>::infinity() : distance_;
  is_outdated_ = is_material_outdated_ = false;
}

template <int D, class Steps>
void MaterialMinimum<D, Steps>::clear_fixed(Vectors& force, const SharedLoop& shared) const {
  shared.run(force.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t e = first; e < last; ++e) {
      if (preconditioner_.is_fixed(static_cast<ElementId>(e))) {
        force[e] = {};
      }
    }
  });
}

template <int D, class Steps>
double MaterialMinimum<D, Steps>::add_regions(const Vectors& at, Vectors& force, const SharedLoop& shared) const {
  assign(force, material_force_, shared);
  const double value = material_value_ + regions_.add(at, &force);
  if (!regions_.is_empty()) {
    clear_fixed(force, shared);
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
  LoopTeam team(threads, at.size());
  const SharedLoop shared = team.loop();
  if (is_outdated_) {
    find_gradient(at, shared);
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
