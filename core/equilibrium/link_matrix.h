#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "equilibrium/shared_loop.h"
#include "mesh/fixed_matrix.h"
#include "mesh/mesh.h"

namespace chainmail {

/// Number of rigid-body motions (translations and rotations) in a space.
template <int Dimension>
inline constexpr int rigid_modes = Dimension*(Dimension + 1) / 2;

/// What a link contributes to the matrix of an energy: the block g gᵀ + c I, which multiplies the difference of the
/// displacements of its two ends. All numbers of a cut link are 0.
template <class Scalar, int Dimension>
struct LinkBlock {
  using Vector = FixedMatrix<Scalar, Dimension>;
  using Square = FixedMatrix<Scalar, Dimension, Dimension>;

  Vector along;       // g: the link's direction times the root of its axial stiffness
  Scalar across = 0;  // c: its lateral stiffness

  /// Returns the force in the link, if its deflection is `apart`.
  Vector times(const Vector& apart) const { return along * along.dot(apart) + across * apart; }
  Square block() const {
    Square result;
    for (int i = 0; i < Dimension; ++i) {
      for (int j = 0; j < Dimension; ++j) {
        result(i, j) = along[i] * along[j] + (i == j ? across : 0);
      }
    }
    return result;
  }
  bool is_zero() const { return across == 0 && along.isZero(); }
};

/// The matrix of an energy of links: one row of blocks per element, one block per link. Rows and columns of fixed
/// elements are left out: vectors are 0 there, before and after.
template <class Scalar, int Dimension>
class LinkMatrix {
 public:
  static constexpr int rows = Dimension, columns = 1, dimension = Dimension;
  using Block = LinkBlock<Scalar, Dimension>;
  using Vector = typename Block::Vector;
  using Square = typename Block::Square;
  using Vectors = std::vector<Vector>;

  LinkMatrix() = default;
  explicit LinkMatrix(MeshPointer mesh)
      : mesh_(std::move(mesh)), links_(mesh_->link_count()), fixed_(mesh_->element_count()) {}

  const Mesh& mesh() const { return *mesh_; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(fixed_.size()); }
  const Block& link(LinkId link) const { return links_[link]; }
  void set_link(LinkId link, const Block& block) { links_[link] = block; }
  bool is_fixed(ElementId element) const { return fixed_[element] != 0; }
  void set_fixed(ElementId element, bool fixed) { fixed_[element] = fixed ? 1 : 0; }

  /// Returns the product with a vector, which is 0 at fixed elements.
  void apply(const Vectors& x, Vectors& product, const SharedLoop& /*links scatter*/ = {}) const {
    product.assign(x.size(), {});
    const auto* ends = mesh_->links.data();
    for (std::size_t l = 0; l < links_.size(); ++l) {
      const auto [i, j] = ends[l];
      const Vector force = links_[l].times(x[j] - x[i]);
      product[i] -= force;
      product[j] += force;
    }
    clear_fixed(product);
  }

  void clear_fixed(Vectors& x) const {
    for (std::size_t e = 0; e < x.size(); ++e) {
      if (fixed_[e] != 0) {
        x[e] = {};
      }
    }
  }

  /// Calls visit(column, block) for each block of a row, the one on the diagonal last. A fixed element has none.
  template <class Visit>
  void for_each_in_row(std::uint32_t row, Visit visit) const {
    if (is_fixed(row)) {
      return;
    }
    Square diagonal;
    for (EntryId entry = mesh_->first_entry[row]; entry < mesh_->first_entry[row + 1]; ++entry) {
      const Block& link = links_[mesh_->entry_link[entry]];
      const Square block = link.block();
      diagonal += block;
      if (!is_fixed(mesh_->neighbours[entry]) && !link.is_zero()) {
        visit(mesh_->neighbours[entry], -block);
      }
    }
    visit(row, diagonal);
  }

 private:
  MeshPointer mesh_;
  std::vector<Block> links_;
  std::vector<std::uint8_t> fixed_;
};

/// The weighted Laplacian of the links of a mesh: a row per element, a weight per link. It multiplies several columns
/// at once, such as the axes of displacements. Rows and columns of fixed elements are left out: vectors are 0 there,
/// before and after.
template <int Columns>
class LinkLaplacian {
 public:
  static constexpr int rows = 1, columns = Columns, dimension = 1;
  using Square = FixedMatrix<float, 1, 1>;
  using Vector = FixedMatrix<float, 1, Columns>;
  using Vectors = std::vector<Vector>;

  LinkLaplacian() = default;
  explicit LinkLaplacian(MeshPointer mesh)
      : mesh_(std::move(mesh)),
        weights_(mesh_->neighbours.size()),
        sums_(mesh_->element_count()),
        fixed_(mesh_->element_count()),
        entries_(mesh_->link_count()) {
    for (EntryId entry = 0; entry < weights_.size(); ++entry) {
      const LinkId link = mesh_->entry_link[entry];
      entries_[link][mesh_->neighbours[entry] == mesh_->links[link][0] ? 1 : 0] = entry;
    }
  }

  const Mesh& mesh() const { return *mesh_; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(fixed_.size()); }
  bool is_fixed(ElementId element) const { return fixed_[element] != 0; }
  void set_fixed(ElementId element, bool fixed) { fixed_[element] = fixed ? 1 : 0; }

  void set_link(LinkId link, float weight) {
    for (const std::size_t end : {0, 1}) {
      float& present = weights_[entries_[link][end]];
      sums_[mesh_->links[link][end]] += double(weight) - double(present);
      present = weight;
    }
  }

  /// Returns the product with a vector, which is 0 at fixed elements.
  void apply(const Vectors& x, Vectors& product, const SharedLoop& blocks) const {
    product.resize(x.size());
    blocks.run(x.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t e = first; e < last; ++e) {
        product[e] = fixed_[e] != 0 ? Vector() : row_times(static_cast<ElementId>(e), x);
      }
    });
  }

  /// Calls visit(column, block) for each number of a row, the one on the diagonal last. A fixed element has none.
  template <class Visit>
  void for_each_in_row(std::uint32_t row, Visit visit) const {
    if (is_fixed(row)) {
      return;
    }
    for (EntryId entry = mesh_->first_entry[row]; entry < mesh_->first_entry[row + 1]; ++entry) {
      if (!is_fixed(mesh_->neighbours[entry]) && weights_[entry] != 0) {
        visit(mesh_->neighbours[entry], -weights_[entry] * Square::Identity());
      }
    }
    visit(row, float(sums_[row]) * Square::Identity());
  }

 private:
  Vector row_times(ElementId e, const Vectors& x) const {
    Vector sum = float(sums_[e]) * x[e];
    for (EntryId entry = mesh_->first_entry[e]; entry < mesh_->first_entry[e + 1]; ++entry) {
      sum -= weights_[entry] * x[mesh_->neighbours[entry]];
    }
    return sum;
  }

  MeshPointer mesh_;
  std::vector<float> weights_;  // of each entry of the table of neighbours
  std::vector<double> sums_;    // of each element: of its weights; sums of float lose nothing in double
  std::vector<std::uint8_t> fixed_;
  std::vector<std::array<EntryId, 2>> entries_;  // of each link, in the rows of its first and its second end
};

}  // namespace chainmail
