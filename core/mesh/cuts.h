#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace chainmail {

/// The cut links of a mesh. Nothing is renumbered: cutting and uncutting a link restores the object exactly, including
/// the order of neighbours.
class Cuts {
 public:
  Cuts() = default;
  explicit Cuts(MeshPointer mesh) : mesh_(std::move(mesh)) {}

  void cut(LinkId link) { set(link, true); }
  void uncut(LinkId link) { set(link, false); }

  bool is_cut(LinkId link) const { return count_ != 0 && (words_[link / 64] >> (link % 64) & 1) != 0; }
  /// True if a link of the element is cut. Saves checking each of its links.
  bool touches(ElementId element) const { return count_ != 0 && (touched_[element / 64] >> (element % 64) & 1) != 0; }
  /// Number of cut links.
  LinkId count() const { return count_; }
  /// Returns the cut links, ascending. Takes time in proportion to their number, plus one word per 4096 links of the
  /// mesh.
  std::vector<LinkId> links() const;

 private:
  void set(LinkId link, bool cut);

  bool has_cut(ElementId element) const;

  MeshPointer mesh_;
  LinkId count_ = 0;
  // All are allocated at the first cut: an object without cuts costs nothing.
  std::vector<std::uint64_t> words_;    // one bit per link
  std::vector<std::uint64_t> filled_;   // one bit per word of `words_` that is not 0
  std::vector<std::uint64_t> touched_;  // one bit per element
};

/// Calls visit(neighbour, entry) for each neighbour whose link is not cut, in the file's order. This is the innermost
/// loop of a pass: without forced inlining a pass takes 1.5 times as long.
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
