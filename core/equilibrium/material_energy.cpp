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

template <int D>
FourNumbers four_of(const FixedMatrix<double, D>& vector) {
  FourNumbers result;
  std::copy_n(vector.data(), D, result.at.begin());
  return result;
}

template <int D>
void add_to(FixedMatrix<double, D>& sum, const FourNumbers& numbers) {
  for (int k = 0; k < D; ++k) {
    sum[k] += numbers.at[std::size_t(k)];
  }
}

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
  cells_ = build_cell_simplices(*mesh_, progress.part(0, 0.5));
  const std::size_t count = cells_.simplices.count();
  is_whole_.assign(cells_.cell_count(), 1);
  is_cut_.assign(mesh_->link_count(), 0);
  whole_beside_.assign(mesh_->element_count(), 0);
  first_simplex_.assign(cells_.cell_count() + 1, 0);
  batches_.assign((count + Batch::lanes - 1) / Batch::lanes, Batch{});
  const Progress filling = progress.part(0.5, 0.8);
  for (std::size_t s = 0; s < count; ++s) {
    filling.report(s, count);
    set_simplex(batches_[s / Batch::lanes], s % Batch::lanes, s);
    for (const ElementId corner : cells_.simplices.corners_of(s)) {
      ++whole_beside_[corner];
    }
    ++first_simplex_[cells_.cell_of[s] + 1];
  }
  for (std::size_t cell = 0; cell + 1 < first_simplex_.size(); ++cell) {
    first_simplex_[cell + 1] += first_simplex_[cell];
  }
  cells_.simplices.gradients = std::vector<double>();  // the batches have them
  cut_links_.clear();
  changed_cells_.clear();
  loose_before_.reset();
  loose_.find(*mesh_, Cuts(), whole_beside_);
  find_cell_links(progress.part(0.8, 0.9));
  divide(progress.part(0.9, 1));
}

/// Sets the corners and gradients of one simplex of a batch.
template <int D>
void MaterialEnergy<D>::set_simplex(Batch& batch, std::size_t lane, std::size_t simplex) const {
  const auto corners = cells_.simplices.corners_of(simplex);
  const auto gradients = cells_.simplices.gradients_of(simplex);
  for (std::size_t k = 0; k <= D; ++k) {
    batch.corner[k][lane] = corners[k];
    for (std::size_t axis = 0; k > 0 && axis < D; ++axis) {
      batch.gradient[k - 1][axis].at[lane] = gradients(Eigen::Index(axis), Eigen::Index(k));
    }
  }
}

/// Copies the gradients of a simplex to a lane of another batch.
template <int D>
void MaterialEnergy<D>::copy_gradients(std::size_t simplex, Batch& batch, std::size_t lane) const {
  const Batch& from = batches_[simplex / Batch::lanes];
  for (std::size_t k = 0; k < D; ++k) {
    for (std::size_t axis = 0; axis < D; ++axis) {
      batch.gradient[k][axis].at[lane] = from.gradient[k][axis].at[simplex % Batch::lanes];
    }
  }
}

/// Returns the gradient of a corner's shape function. Those of all corners add up to 0.
template <int D>
auto MaterialEnergy<D>::gradient(std::size_t simplex, std::size_t corner) const -> Vector {
  const Batch& batch = batches_[simplex / Batch::lanes];
  Vector result;
  for (std::size_t axis = 0; axis < D; ++axis) {
    for (std::size_t k = corner == 0 ? 1 : corner; k <= (corner == 0 ? D : corner); ++k) {
      const double of_corner = batch.gradient[k - 1][axis].at[simplex % Batch::lanes];
      result[int(axis)] += corner == 0 ? -of_corner : of_corner;
    }
  }
  return result;
}

/// Turns the table of links by cell into one of cells by link.
template <int D>
void MaterialEnergy<D>::find_cell_links(const Progress& progress) {
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
    progress.report(cell, cells_.cell_count());
    for (const LinkId link : cells_.links_of(cell)) {
      cell_beside_[next[link]++] = cell;
    }
  }
}

template <int D>
void MaterialEnergy<D>::set_material(const ElasticOptions& elastic, const Progress& progress) {
  lame_ = lame({1, elastic.material.poisson});
  is_neo_hookean_ = elastic.law.kind == StrainLaw::Kind::neo_hookean;
  density_ = ExtendedDensity(elastic.law, lame_, D);
  scale_ = 1;
  double sum = 0;
  for (LinkId link = 0; link < mesh_->link_count(); ++link) {
    progress.report(link, mesh_->link_count());
    sum += std::max(0.0, stiffness_around(link)) / mesh_->link_count();
  }
  scale_ = sum > 0 && std::isfinite(sum) ? sum : 1;
  for (std::uint32_t s = 0; s < cells_.simplices.count(); ++s) {
    set_volume(s, is_whole_[cells_.cell_of[s]] != 0);
  }
}

template <int D>
void MaterialEnergy<D>::set_volume(std::uint32_t simplex, bool is_whole) {
  batches_[simplex / Batch::lanes].volume.at[simplex % Batch::lanes] =
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
  std::vector<Batch> batches;
  std::vector<ElementId> corners;  // of the simplices of these batches, one after the other
  for (const std::uint32_t cell : take_changed_cells()) {
    for (std::uint32_t s = first_simplex_[cell]; s < first_simplex_[cell + 1]; ++s) {
      const std::size_t lane = corners.size() / (D + 1) % Batch::lanes;
      Batch& batch = lane == 0 ? batches.emplace_back() : batches.back();
      copy_gradients(s, batch, lane);
      batch.volume.at[lane] = (is_whole_[cell] != 0 ? 1 : -1) * cells_.simplices.volumes[s] / scale_;
      const auto of_simplex = cells_.simplices.corners_of(s);
      for (std::size_t k = 0; k <= D; ++k) {
        batch.corner[k][lane] = std::uint32_t(corners.size());
        corners.push_back(of_simplex[k]);
      }
    }
  }
  std::vector<FourNumbers> at(corners.size()), pull(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    at[i] = four_of(displacements[corners[i]]);
  }
  const BatchSum sum = evaluate_batches<D>(batches, batch_density(), at.data(), pull.data());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    add_to(force[corners[i]], pull[i]);
  }
  least_ = std::min(least_, sum.least);
  double change = sum.energy;
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
        const Vector one = gradient(s, std::size_t(a - corners.begin()));
        sum -= cells_.simplices.volumes[s] * one.dot(gradient(s, std::size_t(b - corners.begin())));
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

/// Divides the batches into parts that are worth a thread. Their corners become places in their part.
template <int D>
void MaterialEnergy<D>::divide(const Progress& progress) {
  constexpr std::size_t worth = 1024, most = 8;
  const std::size_t count = std::clamp<std::size_t>(batches_.size() / worth, 1, most);
  parts_.assign(count, {});
  for (std::size_t p = 0; p < count; ++p) {
    Part& part = parts_[p];
    part.first = batches_.size() * p / count;
    part.last = batches_.size() * (p + 1) / count;
    part.low = mesh_->element_count();
    const std::size_t end = std::min(part.last * Batch::lanes, cells_.simplices.count());
    progress.report(double(p) / double(count));
    for (std::size_t s = part.first * Batch::lanes; s < end; ++s) {
      const auto corners = cells_.simplices.corners_of(s);
      part.low = std::min(part.low, std::ranges::min(corners));
      part.high = std::max(part.high, std::ranges::max(corners) + 1);
    }
    for (std::size_t s = part.first * Batch::lanes; s < end; ++s) {
      for (auto& corner : batches_[s / Batch::lanes].corner) {
        corner[s % Batch::lanes] -= part.low;
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
    energy += part.sum.energy;
    least_ = std::min(least_, part.sum.least);
  }
  if (force != nullptr) {
    force->resize(displacements.size());
    shared.run(force->size(), [&](std::size_t first, std::size_t last) {
      std::fill(force->begin() + std::ptrdiff_t(first), force->begin() + std::ptrdiff_t(last), Vector());
      for (const Part& part : parts_) {
        for (std::size_t e = std::max<std::size_t>(first, part.low); e < std::min<std::size_t>(last, part.high); ++e) {
          add_to((*force)[e], part.force[e - part.low]);
        }
      }
    });
  }
  return energy + loose_.add(*mesh_, displacements, force);
}

template <int D>
void MaterialEnergy<D>::evaluate(Part& part, const Vectors& displacements, bool wants_force) const {
  const std::size_t count = part.high > part.low ? part.high - part.low : 0;
  part.displacements.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    part.displacements[i] = four_of(displacements[part.low + i]);
  }
  if (wants_force) {
    part.force.assign(count, {});
  }
  part.sum = evaluate_batches<D>(std::span(batches_).subspan(part.first, part.last - part.first), batch_density(),
                                 part.displacements.data(), wants_force ? part.force.data() : nullptr);
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
