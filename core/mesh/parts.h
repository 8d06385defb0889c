#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/cuts.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail {

/// How many parts an object has that no uncut link joins. Looks at all of it; an element without links is a part.
std::uint32_t count_parts(const Mesh& mesh, const Cuts& cuts = {}, const Progress& progress = {});

/// The same, kept while links are cut and uncut, at a cost of what changed: searches grow from all ends of the cut
/// links at once. Where they meet around the end of a slit they are done, and where all but one have nowhere left to
/// go: a part that comes loose costs its own size, not that of what it leaves.
class Parts {
 public:
  Parts() = default;
  /// Of an object without cuts.
  explicit Parts(const MeshPointer& mesh);

  std::uint32_t count() const { return count_; }
  /// How many elements the last change made it look at.
  std::size_t looked_at() const { return looked_at_; }

  /// Cuts those of the links that `cuts`, of the same mesh and by this alone, do not hold yet.
  void cut(Cuts& cuts, std::span<const LinkId> links);
  void uncut(Cuts& cuts, std::span<const LinkId> links);

 private:
  std::uint32_t kept_apart(const Cuts& cuts, std::span<const LinkId> links);

  MeshPointer mesh_;
  std::uint32_t count_ = 0;
  std::size_t looked_at_ = 0;
  // The search, from 1, that has reached each element: all 0 between two calls, and taken at the first.
  std::vector<std::uint32_t> reached_by_;
};

}  // namespace chainmail
