#include "equilibrium/material_energy.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "equilibrium/surface_energy.h"

namespace chainmail {
namespace {

template <class Id>
void make_unique(std::vector<Id>& ids) {
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

double modulus_of(const Lame& lame) { return 2 * lame.mu + lame.lambda; }

template <int D, class Energy = MaterialEnergy<D>>
double energy_in_space(const Mesh& mesh, const ElasticOptions& elastic, const Cuts& cuts,
                       const PositionView& position) {
  Energy energy;
  energy.build(MeshPointer(std::shared_ptr<void>(), &mesh));
  energy.set_material(elastic);
  energy.set_cuts(cuts);
  energy.set_extension_below(Energy::measured_below);
  typename Energy::Vectors displacements(mesh.element_count());
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    for (int k = 0; k < D; ++k) {
      displacements[e][k] = position(e, k) - mesh.rest[std::size_t{e} * D + std::size_t(k)];
    }
  }
  return energy.evaluate(displacements, nullptr) * energy.scale() * elastic.material.young;
}

}  // namespace

template <int D>
void MaterialEnergy<D>::build(MeshPointer mesh, const Progress& progress) {
  mesh_ = std::move(mesh);
  cells_ = build_cell_simplices(*mesh_, progress);
  const std::size_t count = cells_.simplices.count();
  is_whole_.assign(cells_.cell_count(), 1);
  is_cut_.assign(mesh_->link_count(), 0);
  whole_beside_.assign(mesh_->element_count(), 0);
  first_simplex_.assign(cells_.cell_count() + 1, 0);
  batches_.assign((count + lanes - 1) / lanes, Batch{});
  for (std::size_t s = 0; s < count; ++s) {
    Batch& batch = batches_[s / lanes];
    const auto corners = cells_.simplices.corners_of(s);
    const auto gradients = cells_.simplices.gradients_of(s);
    for (int k = 0; k <= D; ++k) {
      batch.corner[std::size_t(k)][s % lanes] = corners[std::size_t(k)];
      ++whole_beside_[corners[std::size_t(k)]];
      for (int axis = 0; k > 0 && axis < D; ++axis) {
        batch.gradient[std::size_t(k - 1)][std::size_t(axis)][Eigen::Index(s % lanes)] = gradients(axis, k);
      }
    }
    ++first_simplex_[cells_.cell_of[s] + 1];
  }
  for (std::size_t s = count; s % lanes != 0; ++s) {  // the rest of the last batch has no volume
    for (auto& corner : batches_.back().corner) {
      corner[s % lanes] = corner[0];
    }
  }
  for (std::size_t cell = 0; cell + 1 < first_simplex_.size(); ++cell) {
    first_simplex_[cell + 1] += first_simplex_[cell];
  }
  cut_links_.clear();
  changed_cells_.clear();
  loose_before_.reset();
  loose_.find(*mesh_, Cuts(), whole_beside_);
  find_cell_links();
  divide();
}

/// Turns the table of links by cell into one of cells by link.
template <int D>
void MaterialEnergy<D>::find_cell_links() {
  first_cell_.assign(mesh_->link_count() + 1, 0);
  for (const LinkId link : cells_.links) {
    ++first_cell_[link + 1];
  }
  for (std::size_t link = 0; link < mesh_->link_count(); ++link) {
    first_cell_[link + 1] += first_cell_[link];
  }
  std::vector<std::uint32_t> next(first_cell_.begin(), first_cell_.end() - 1);
  cell_beside_.resize(cells_.links.size());
  for (std::uint32_t cell = 0; cell < cells_.cell_count(); ++cell) {
    for (const LinkId link : cells_.links_of(cell)) {
      cell_beside_[next[link]++] = cell;
    }
  }
}

template <int D>
void MaterialEnergy<D>::set_material(const ElasticOptions& elastic) {
  lame_ = lame({1, elastic.material.poisson});
  is_neo_hookean_ = elastic.law.kind == StrainLaw::Kind::neo_hookean;
  density_ = ExtendedDensity(elastic.law, lame_, D);
  scale_ = 1;
  double sum = 0;
  for (LinkId link = 0; link < mesh_->link_count(); ++link) {
    sum += std::max(0.0, stiffness_around(link)) / mesh_->link_count();
  }
  scale_ = sum > 0 && std::isfinite(sum) ? sum : 1;
  for (std::uint32_t s = 0; s < cells_.simplices.count(); ++s) {
    set_volume(s, is_whole_[cells_.cell_of[s]] != 0);
  }
}

template <int D>
void MaterialEnergy<D>::set_volume(std::uint32_t simplex, bool is_whole) {
  batches_[simplex / lanes].volume[Eigen::Index(simplex % lanes)] =
      is_whole ? cells_.simplices.volumes[simplex] / scale_ : 0;
}

template <int D>
void MaterialEnergy<D>::set_cell(std::uint32_t cell, bool is_whole) {
  is_whole_[cell] = is_whole ? 1 : 0;
  for (std::uint32_t s = first_simplex_[cell]; s < first_simplex_[cell + 1]; ++s) {
    set_volume(s, is_whole);
    for (const ElementId corner : cells_.simplices.corners_of(s)) {
      whole_beside_[corner] += is_whole ? 1 : std::uint32_t(-1);
    }
  }
}

template <int D>
std::vector<LinkId> MaterialEnergy<D>::set_cuts(const Cuts& cuts) {
  std::vector<LinkId> changed;
  std::vector<std::uint32_t> cells = take_cuts(cuts, changed);
  std::erase_if(cells, [&](std::uint32_t cell) {
    const auto links = cells_.links_of(cell);
    const bool whole = std::ranges::none_of(links, [&](LinkId link) { return is_cut_[link] != 0; });
    if (whole == (is_whole_[cell] != 0)) {
      return true;
    }
    set_cell(cell, whole);
    changed.insert(changed.end(), links.begin(), links.end());
    return false;
  });
  make_unique(changed);
  changed_cells_.insert(changed_cells_.end(), cells.begin(), cells.end());
  update_loose(cuts, cells, changed);
  return changed;
}

/// Takes over which links are cut. Adds those that changed to `changed`, and returns the cells that need them,
/// ascending.
template <int D>
std::vector<std::uint32_t> MaterialEnergy<D>::take_cuts(const Cuts& cuts, std::vector<LinkId>& changed) {
  std::vector<LinkId> now = cuts.links();
  std::ranges::set_symmetric_difference(cut_links_, now, std::back_inserter(changed));
  cut_links_ = std::move(now);
  std::vector<std::uint32_t> cells;
  for (const LinkId link : changed) {
    is_cut_[link] = cuts.is_cut(link) ? 1 : 0;
    cells.insert(cells.end(), cell_beside_.begin() + first_cell_[link], cell_beside_.begin() + first_cell_[link + 1]);
  }
  make_unique(cells);
  return cells;
}

/// Finds the loose links among `changed` and those of the corners of these cells.
template <int D>
void MaterialEnergy<D>::update_loose(const Cuts& cuts, std::span<const std::uint32_t> cells,
                                     std::vector<LinkId> changed) {
  for (const std::uint32_t cell : cells) {
    for (std::uint32_t s = first_simplex_[cell]; s < first_simplex_[cell + 1]; ++s) {
      for (const ElementId corner : cells_.simplices.corners_of(s)) {
        changed.insert(changed.end(), mesh_->entry_link.begin() + mesh_->first_entry[corner],
                       mesh_->entry_link.begin() + mesh_->first_entry[corner + 1]);
      }
    }
  }
  make_unique(changed);
  if (!loose_before_) {
    loose_before_ = loose_;
  }
  loose_.update(*mesh_, cuts, whole_beside_, changed);
}

/// Returns the cells that are removed and were not at the last evaluation, or the other way round.
template <int D>
std::vector<std::uint32_t> MaterialEnergy<D>::take_changed_cells() {
  std::ranges::sort(changed_cells_);
  std::vector<std::uint32_t> cells;
  for (const std::uint32_t cell : changed_cells_) {
    if (!cells.empty() && cells.back() == cell) {
      cells.pop_back();  // changed and changed back
    } else {
      cells.push_back(cell);
    }
  }
  changed_cells_.clear();
  return cells;
}

template <int D>
double MaterialEnergy<D>::add_changes(const Vectors& displacements, Vectors& force) {
  double change = 0;
  Lanes least = Lanes::Constant(least_);
  Batch batch;
  for (const std::uint32_t cell : take_changed_cells()) {
    for (std::uint32_t s = first_simplex_[cell]; s < first_simplex_[cell + 1]; ++s) {
      // All lanes have the simplex; only the first counts.
      const Batch& from = batches_[s / lanes];
      const auto lane = Eigen::Index(s % lanes);
      for (std::size_t k = 0; k <= D; ++k) {
        batch.corner[k].fill(from.corner[k][s % lanes]);
        for (std::size_t axis = 0; k > 0 && axis < D; ++axis) {
          batch.gradient[k - 1][axis].setConstant(from.gradient[k - 1][axis][lane]);
        }
      }
      batch.volume.setZero();
      batch.volume[0] = (is_whole_[cell] != 0 ? 1 : -1) * cells_.simplices.volumes[s] / scale_;
      change += evaluate(batch, displacements, &force, 0, least);
    }
  }
  least_ = least.minCoeff();
  if (loose_before_) {
    change += loose_.add(*mesh_, displacements, &force);
    change += loose_before_->add(*mesh_, displacements, &force, -1);
    loose_before_.reset();
  }
  return change;
}

/// Returns the sum over the simplices that have both ends of a link of −V (2μ + λ) ∇a·∇b.
template <int D>
double MaterialEnergy<D>::stiffness_around(LinkId link) const {
  const auto [i, j] = mesh_->links[link];
  double sum = 0;
  for (std::uint32_t at = first_cell_[link]; at < first_cell_[link + 1]; ++at) {
    const std::uint32_t cell = cell_beside_[at];
    for (std::uint32_t s = first_simplex_[cell]; is_whole_[cell] != 0 && s < first_simplex_[cell + 1]; ++s) {
      const auto corners = cells_.simplices.corners_of(s);
      const auto a = std::ranges::find(corners, i), b = std::ranges::find(corners, j);
      if (a != corners.end() && b != corners.end()) {
        const auto gradients = cells_.simplices.gradients_of(s);
        sum -= cells_.simplices.volumes[s] * gradients.col(a - corners.begin()).dot(gradients.col(b - corners.begin()));
      }
    }
  }
  return sum * modulus_of(lame_) / scale_;
}

template <int D>
double MaterialEnergy<D>::weight(LinkId link) const {
  if (is_cut_[link] != 0) {
    return 0;
  }
  const auto [i, j] = mesh_->links[link];
  const bool is_loose = whole_beside_[i] == 0 || whole_beside_[j] == 0;
  return is_loose ? LooseLinks<D>::stiffness : std::max(least_weight, stiffness_around(link));
}

/// Divides the batches into parts that are worth a thread.
template <int D>
void MaterialEnergy<D>::divide() {
  constexpr std::size_t worth = 1024, most = 8;
  const std::size_t count = std::clamp<std::size_t>(batches_.size() / worth, 1, most);
  parts_.assign(count, {});
  for (std::size_t p = 0; p < count; ++p) {
    Part& part = parts_[p];
    part.first = batches_.size() * p / count;
    part.last = batches_.size() * (p + 1) / count;
    part.low = mesh_->element_count();
    for (std::size_t b = part.first; b < part.last; ++b) {
      for (const auto& corners : batches_[b].corner) {
        part.low = std::min(part.low, std::ranges::min(corners));
        part.high = std::max(part.high, std::ranges::max(corners) + 1);
      }
    }
  }
}

template <int D>
double MaterialEnergy<D>::evaluate(const Vectors& displacements, Vectors* force, const SharedLoop& shared) {
  shared.each(parts_.size(), [&](std::size_t p) { evaluate(parts_[p], displacements, force != nullptr); });
  double energy = 0;
  least_ = 1;
  changed_cells_.clear();
  loose_before_.reset();
  for (const Part& part : parts_) {
    energy += part.energy;
    least_ = std::min(least_, part.least);
  }
  if (force != nullptr) {
    force->resize(displacements.size());
    shared.run(force->size(), [&](std::size_t first, std::size_t last) {
      std::fill(force->begin() + std::ptrdiff_t(first), force->begin() + std::ptrdiff_t(last), Vector());
      for (const Part& part : parts_) {
        for (std::size_t e = std::max<std::size_t>(first, part.low); e < std::min<std::size_t>(last, part.high); ++e) {
          (*force)[e] += part.force[e - part.low];
        }
      }
    });
  }
  return energy + loose_.add(*mesh_, displacements, force);
}

template <int D>
void MaterialEnergy<D>::evaluate(Part& part, const Vectors& displacements, bool wants_force) const {
  if (wants_force) {
    part.force.assign(part.high > part.low ? part.high - part.low : 0, Vector());
  }
  part.energy = 0;
  Lanes least = Lanes::Ones();
  for (std::size_t b = part.first; b < part.last; ++b) {
    part.energy += evaluate(batches_[b], displacements, wants_force ? &part.force : nullptr, part.low, least);
  }
  part.least = least.minCoeff();
}

template <int D>
double MaterialEnergy<D>::evaluate(const Batch& batch, const Vectors& displacements, Vectors* force, ElementId low,
                                   Lanes& least) const {
  const Matrix strain = strain_of(batch, displacements);
  Lanes energy, determinant;
  Matrix stress;
  find_stress(strain, batch.volume, energy, determinant, force != nullptr ? &stress : nullptr);
  least = (batch.volume > 0).select(least.min(determinant), least);
  if (force != nullptr) {
    add_forces(batch, stress, *force, low);
  }
  return energy.sum();
}

/// Returns F − 1.
template <int D>
auto MaterialEnergy<D>::strain_of(const Batch& batch, const Vectors& displacements) -> Matrix {
  Matrix apart;  // [corner − 1][axis]: from the first corner's displacement
  for (std::size_t k = 0; k < D; ++k) {
    for (std::size_t l = 0; l < lanes; ++l) {
      const Vector& first = displacements[batch.corner[0][l]];
      const Vector& here = displacements[batch.corner[k + 1][l]];
      for (std::size_t axis = 0; axis < D; ++axis) {
        apart[k][axis][Eigen::Index(l)] = here[Eigen::Index(axis)] - first[Eigen::Index(axis)];
      }
    }
  }
  Matrix strain;
  for (std::size_t row = 0; row < D; ++row) {
    for (std::size_t column = 0; column < D; ++column) {
      Lanes sum = apart[0][row] * batch.gradient[0][column];
      for (std::size_t k = 1; k < D; ++k) {
        sum += apart[k][row] * batch.gradient[k][column];
      }
      strain[row][column] = sum;
    }
  }
  return strain;
}

template <int D>
void MaterialEnergy<D>::add_forces(const Batch& batch, const Matrix& stress, Vectors& force, ElementId low) {
  std::array<std::array<Lanes, D>, D + 1> pull;
  for (std::size_t axis = 0; axis < D; ++axis) {
    pull[0][axis].setZero();
    for (std::size_t k = 0; k < D; ++k) {
      Lanes sum = stress[axis][0] * batch.gradient[k][0];
      for (std::size_t column = 1; column < D; ++column) {
        sum += stress[axis][column] * batch.gradient[k][column];
      }
      pull[k + 1][axis] = sum;
      pull[0][axis] -= sum;
    }
  }
  for (std::size_t l = 0; l < lanes; ++l) {
    for (std::size_t k = 0; k <= D; ++k) {
      Vector& sum = force[batch.corner[k][l] - low];
      for (std::size_t axis = 0; axis < D; ++axis) {
        sum[Eigen::Index(axis)] -= pull[k][axis][Eigen::Index(l)];
      }
    }
  }
}

template <int D>
auto MaterialEnergy<D>::cofactor_of(const Matrix& f) -> Matrix {
  Matrix cofactor;
  if constexpr (D == 1) {
    cofactor[0][0].setOnes();
  } else if constexpr (D == 2) {
    cofactor = {{{f[1][1], -f[1][0]}, {-f[0][1], f[0][0]}}};
  } else {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
      for (std::size_t j = 0; j < 3; ++j) {
        const std::size_t c = (j + 1) % 3, d = (j + 2) % 3;
        cofactor[i][j] = f[a][c] * f[b][d] - f[a][d] * f[b][c];
      }
    }
  }
  return cofactor;
}

/// Returns the energy, and the first Piola-Kirchhoff stress times the volume.
template <int D>
void MaterialEnergy<D>::find_stress(const Matrix& strain, const Lanes& volume, Lanes& energy, Lanes& determinant,
                                    Matrix* stress) const {
  Matrix f = strain;
  Lanes shape = Lanes::Zero();
  for (std::size_t i = 0; i < D; ++i) {
    f[i][i] += 1;
    shape += 2 * strain[i][i];
    for (std::size_t j = 0; j < D; ++j) {
      shape += strain[i][j] * strain[i][j];
    }
  }
  const Matrix cofactor = cofactor_of(f);
  determinant = f[0][0] * cofactor[0][0];
  for (std::size_t j = 1; j < D; ++j) {
    determinant += f[0][j] * cofactor[0][j];
  }
  Lanes value, by_shape, by_volume;
  find_density(shape, determinant, value, by_shape, by_volume);
  energy = volume * value;
  if (stress != nullptr) {
    by_shape *= 2 * volume;
    by_volume *= volume;
    for (std::size_t i = 0; i < D; ++i) {
      for (std::size_t j = 0; j < D; ++j) {
        (*stress)[i][j] = by_shape * f[i][j] + by_volume * cofactor[i][j];
      }
    }
  }
}

/// Returns ln s for the stretch s on the axes that are free of stress, as log_of_free_stretch() of elastic/energy.cpp
/// does, for all lanes at once.
template <int D>
auto MaterialEnergy<D>::log_of_free_stretch(const Lanes& log_volume) const -> Lanes {
  constexpr int most = 60;
  constexpr double free_axes = 3 - D;
  const auto [mu, lambda] = lame_;
  Lanes a = -lambda / (2 * mu + free_axes * lambda) * log_volume, step;
  for (int turn = 0; turn < most; ++turn) {
    const Lanes squared = (2 * a).exp();
    step = (mu * (squared - 1) + lambda * (log_volume + free_axes * a)) / (2 * mu * squared + free_axes * lambda);
    a -= step;
    if ((step.abs() <= 1e-15 * (1 + a.abs())).all()) {
      break;
    }
  }
  return a;
}

template <int D>
void MaterialEnergy<D>::find_density(const Lanes& shape, const Lanes& determinant, Lanes& value, Lanes& by_shape,
                                     Lanes& by_volume) const {
  if (is_neo_hookean_) {
    constexpr double free_axes = 3 - D;
    const auto [mu, lambda] = lame_;
    const double slope = density_.slope_below(), curvature = density_.curvature_below();
    const Lanes inside = determinant.max(density_.least_volume()), below = determinant - inside;
    Lanes log = inside.log();  // of the whole volume: with the axes that are free of stress
    if constexpr (D < 3) {
      log += free_axes * log_of_free_stretch(log);
    }
    // The free axes add μ/2 (s² − 1) each, which is −λ/2 ln J for the stretch s that minimizes W.
    value = mu / 2 * shape + log * (lambda / 2 * log - mu - free_axes * lambda / 2) +
            below * (slope + curvature / 2 * below);
    by_shape.setConstant(mu / 2);
    by_volume = (lambda * log - mu) / inside + curvature * below;
    return;
  }
  for (int l = 0; l < lanes; ++l) {
    const auto one = density_.at(shape[l], determinant[l]);
    value[l] = one.value;
    by_shape[l] = one.by_shape;
    by_volume[l] = one.by_volume;
  }
}

template class MaterialEnergy<1>;
template class MaterialEnergy<2>;
template class MaterialEnergy<3>;

double material_energy(const Mesh& mesh, const ElasticOptions& elastic, const Cuts& cuts,
                       const PositionView& position) {
  switch (mesh.space_dimension) {
    case 1:
      return energy_in_space<1>(mesh, elastic, cuts, position);
    case 2:
      return energy_in_space<2>(mesh, elastic, cuts, position);
    default:
      return is_surface_in_space(mesh)
                 ? thickness_of(mesh, elastic) * energy_in_space<3, SurfaceEnergy>(mesh, elastic, cuts, position)
                 : energy_in_space<3>(mesh, elastic, cuts, position);
  }
}

}  // namespace chainmail
