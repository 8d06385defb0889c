#pragma once

#include <unordered_map>

#include "mesh/cell_table.h"
#include "mesh/cuts.h"

namespace chainmail {

/// Numbers in no order; putting one in and taking one out costs the same whatever there is.
class NumberSet {
 public:
  std::span<const std::uint32_t> numbers() const { return numbers_; }
  bool contains(std::uint32_t number) const { return places_.count(number) != 0; }
  void set(std::uint32_t number, bool in);

 private:
  std::vector<std::uint32_t> numbers_;
  std::unordered_map<std::uint32_t, std::uint32_t> places_;  // among them
};

/// The outer surface of a mesh's cells under cuts. A cell is whole as long as no link along its edges is cut; a side is
/// in sight where its own cell is whole, and none that is whole lies on its other side. A cut shows what is inside, and
/// costs what is about the link: nothing is built anew.
class Surface {
 public:
  /// Of what is not cut.
  explicit Surface(CellTablePointer table);
  Surface(CellTablePointer table, const Cuts& cuts);

  const CellTable& table() const { return *table_; }
  const CellTablePointer& table_pointer() const { return table_; }
  /// Cuts a link that is not cut.
  void cut(LinkId link) { change(link, true); }
  /// Uncuts one that is.
  void uncut(LinkId link) { change(link, false); }

  bool is_whole(CellId cell) const { return cut_links_.empty() || cut_links_[cell] == 0; }
  bool is_in_sight(SideId side) const { return sides_.contains(side); }
  /// Those in sight, in no order.
  std::span<const SideId> sides() const { return sides_.numbers(); }
  /// The links that are not cut and run along sides in sight, or were a cell's and are no whole one's any more. Those
  /// that never were one's edge are CellTable::loose_links.
  std::span<const LinkId> links() const { return links_.numbers(); }
  /// The corners of the sides in sight as triangles, as seen from outside counterclockwise at rest: three for each
  /// triangle. A diagonal is no link.
  std::vector<ElementId> triangles() const;

 private:
  void show_uncut();
  void change(LinkId link, bool cut);
  void look_at_sides(CellId cell);
  void look_at_links(CellId cell);
  bool is_link_in_sight(LinkId link) const;

  CellTablePointer table_;
  std::vector<std::uint8_t> cut_links_;  // along the edges of each cell; taken at the first cut
  NumberSet cut_;                        // the links
  NumberSet sides_, links_;              // in sight
};

/// The triangles that a side is drawn by: one, or two that a diagonal from its lowest corner parts, whichever of the
/// two sides that lie on each other it is.
void append_triangles(const Side& side, std::vector<ElementId>& corners);

}  // namespace chainmail
