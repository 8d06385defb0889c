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
  bool touches(ElementId element) const { return count_ != 0 && (touched_[element / 64] >> (element % 64) & 1) != 0; }
  /// Number of links cut.
  LinkId count() const { return count_; }
  /// The links cut, ascending. Time: their number, and a word for each 4096 links of the mesh.
  std::vector<LinkId> links() const;

 private:
  void set(LinkId link, bool cut);

  bool has_cut(ElementId element) const;

  MeshPointer mesh_;
  LinkId count_ = 0;
  // All are taken at the first cut: an uncut object pays nothing.
  std::vector<std::uint64_t> words_;    // a bit a link
  std::vector<std::uint64_t> filled_;   // a bit a word of these that is not 0
  std::vector<std::uint64_t> touched_;  // a bit an element
};

/// Calls visit(neighbour, entry) for each neighbour to which the link is not cut, in the file's order. The innermost
/// loop of a pass: left to itself the compiler calls it, and a pass takes half as long again.
template <class Visit>
[[gnu::always_inline]] inline void for_each_neighbour(const Mesh& mesh, const Cuts& cuts, ElementId element,
                                                      Visit visit) {
  const bool has_cuts = cuts.touches(element);
  for (EntryId entry = mesh.first_entry[element]; entry < mesh.first_entry[element + 1]; ++entry) {
    if (!has_cuts || !cuts.is_cut(mesh.entry_link[entry])) {
      visit(mesh.neighbours[entry], entry);
    }
  }
}

}  // namespace chainmail
