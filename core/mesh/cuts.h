#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// Which links of a mesh are cut. Nothing is renumbered: cutting and uncutting a link restores the
/// object exactly, the neighbour order included.
class Cuts {
 public:
  Cuts() = default;
  explicit Cuts(MeshPointer mesh) : mesh_(std::move(mesh)) {}

  void cut(LinkId link) { set(link, true); }
  void uncut(LinkId link) { set(link, false); }

  bool is_cut(LinkId link) const { return count_ != 0 && (words_[link / 64] >> (link % 64) & 1) != 0; }
  /// Whether any link of the element is cut; spares the look at each of its links.
  bool touches(ElementId element) const { return count_ != 0 && touched_[element] != 0; }
  /// Number of links cut.
  LinkId count() const { return count_; }
  /// The links cut, ascending.
  std::vector<LinkId> links() const;

 private:
  void set(LinkId link, bool cut);

  MeshPointer mesh_;
  LinkId count_ = 0;
  // Both are taken at the first cut: an uncut object pays nothing.
  std::vector<std::uint64_t> words_;
  std::vector<std::uint8_t> touched_;
};

}  // namespace chainmail
