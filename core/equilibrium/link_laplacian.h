#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "equilibrium/shared_loop.h"
#include "mesh/fixed_matrix.h"
#include "mesh/mesh.h"

namespace chainmail {

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
