#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// Returns the number of parts that no uncut link joins. Visits the whole object; an element without links is a part.
std::uint32_t count_parts(const Mesh& mesh, const Cuts& cuts = {}, const Progress& progress = {});

/// The number of parts, updated while links are cut and uncut, at a cost in proportion to the change: searches grow
/// from all ends of the cut links at once. They stop when they meet around the end of a slit, or when all but one have
/// nowhere left to go. So a part that comes loose costs its own size, not the size of the rest.
class Parts {
 public:
  Parts() = default;
  /// For an object without cuts.
  explicit Parts(const MeshPointer& mesh);

  std::uint32_t count() const { return count_; }
  /// Number of elements that the last change visited.
  std::size_t looked_at() const { return looked_at_; }

  /// Cuts the links that are not cut yet. `cuts` belongs to the same mesh, and only this object changes it.
  void cut(Cuts& cuts, std::span<const LinkId> links);
  void uncut(Cuts& cuts, std::span<const LinkId> links);

 private:
  std::uint32_t parts_separated_by(const Cuts& cuts, std::span<const LinkId> links);

  MeshPointer mesh_;
  std::uint32_t count_ = 0;
  std::size_t looked_at_ = 0;
  // Number of the search, from 1, that has reached each element. All 0 between two calls; allocated by the first.
  std::vector<std::uint32_t> reached_by_;
};

}  // namespace chainmail
