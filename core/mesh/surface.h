#pragma once

#include <unordered_map>

#include "mesh/cells.h"
#include "mesh/cuts.h"

namespace chainmail {

/// A set of numbers in no order. Inserting and erasing take constant time.
class NumberSet {
 public:
  std::span<const std::uint32_t> numbers() const { return numbers_; }
  bool contains(std::uint32_t number) const { return indices_.count(number) != 0; }
  void set(std::uint32_t number, bool in);

 private:
  std::vector<std::uint32_t> numbers_;
  std::unordered_map<std::uint32_t, std::uint32_t> indices_;  // index of each number in the list
};

/// The outer surface of a mesh's cells under cuts. A cell is whole while no link along its edges is cut. A side is
/// visible if its own cell is whole and there is no whole cell on its other side. A cut reveals the inside, at a cost
/// in proportion to the cells around the link.
class Surface {
 public:
  /// The surface of the object without cuts.
  explicit Surface(CellTablePointer table);
  Surface(CellTablePointer table, const Cuts& cuts);

  const CellTable& table() const { return *table_; }
  const CellTablePointer& table_pointer() const { return table_; }
  /// Cuts a link, which is not cut.
  void cut(LinkId link) { change(link, true); }
  /// Uncuts a link, which is cut.
  void uncut(LinkId link) { change(link, false); }

  bool is_whole(CellId cell) const { return cut_links_.empty() || cut_links_[cell] == 0; }
  /// The visible sides, in no order.
  std::span<const SideId> sides() const { return sides_.numbers(); }
  /// True if a visible side was inside the object before cuts of links and splits: see Mesh::skin.
  bool is_inner(SideId side) const;
  /// The uncut links along visible sides, and those whose cells are all gone. Links that were never the edge of a cell
  /// are CellTable::loose_links.
  std::span<const LinkId> links() const { return links_.numbers(); }
  /// The corners of the visible sides as triangles, three each, counterclockwise at rest as seen from outside. A
  /// diagonal is not a link.
  std::vector<ElementId> triangles() const;

 private:
  void show_uncut();
  void change(LinkId link, bool cut);
  void look_at_sides(CellId cell);
  void look_at_links(CellId cell);
  bool is_side_in_sight(SideId side) const;
  bool is_link_in_sight(LinkId link) const;

  CellTablePointer table_;
  std::vector<std::uint8_t> cut_links_;  // number along the edges of each cell; allocated by the first cut
  NumberSet cut_;                        // the links
  NumberSet sides_, links_;              // visible
  std::vector<SideId> opened_;           // by splits, ascending
};

/// Appends the triangles of a side: one, or two that are split by the diagonal from the lowest corner, the same for
/// both of two coinciding sides.
void append_triangles(const Side& side, std::vector<ElementId>& corners);

}  // namespace chainmail
