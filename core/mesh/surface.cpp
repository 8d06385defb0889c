#include "mesh/surface.h"

#include <algorithm>

#include "mesh/skin.h"

namespace chainmail {

void NumberSet::set(std::uint32_t number, bool in) {
  const auto found = indices_.find(number);
  if (in == (found != indices_.end())) {
    return;
  }
  if (in) {
    indices_.emplace(number, static_cast<std::uint32_t>(numbers_.size()));
    numbers_.push_back(number);
    return;
  }
  const std::uint32_t index = found->second, last = numbers_.back();
  numbers_[index] = last;
  numbers_.pop_back();
  indices_[last] = index;
  indices_.erase(number);
}

Surface::Surface(CellTablePointer table) : table_(std::move(table)) { show_uncut(); }

Surface::Surface(CellTablePointer table, const Cuts& cuts) : Surface(std::move(table)) {
  for (const LinkId link : cuts.links()) {
    cut(link);
  }
}

void Surface::show_uncut() {
  const Skin* skin = table_->mesh()->skin.get();
  for (SideId side = 0; side < table_->side_count(); ++side) {
    if (table_->twin(side) != CellTable::none) {
      continue;
    }
    sides_.set(side, true);
    const Side corners = table_->side(side);
    if (skin != nullptr && !skin->contains(corners.corners())) {
      opened_.push_back(side);
    }
    for (int i = 0; i < corners.count; ++i) {
      if (const auto link = find_link(*table_->mesh(), corners.corner[i], corners.corner[(i + 1) % corners.count])) {
        links_.set(*link, true);
      }
    }
  }
}

bool Surface::is_inner(SideId side) const {
  return table_->twin(side) != CellTable::none || std::ranges::binary_search(opened_, side);
}

void Surface::change(LinkId link, bool cut) {
  if (table_->empty() || cut_.contains(link) == cut) {
    return;
  }
  cut_.set(link, cut);
  if (cut_links_.empty()) {
    cut_links_.resize(table_->cell_count());
  }
  bool has_cells = false;
  std::vector<CellId> changed;
  table_->for_each_cell(link, [&](CellId cell) {
    has_cells = true;
    const bool was = is_whole(cell);
    cut_links_[cell] = static_cast<std::uint8_t>(cut_links_[cell] + (cut ? 1 : -1));
    if (was != is_whole(cell)) {
      changed.push_back(cell);
    }
  });
  std::for_each(changed.begin(), changed.end(), [this](CellId cell) { look_at_sides(cell); });
  std::for_each(changed.begin(), changed.end(), [this](CellId cell) { look_at_links(cell); });
  if (has_cells) {
    links_.set(link, is_link_in_sight(link));
  }
}

/// Updates the visibility of the sides of a cell and of the sides that coincide with them.
void Surface::look_at_sides(CellId cell) {
  for (SideId side = table_->first_side(cell); side < table_->end_side(cell); ++side) {
    sides_.set(side, is_side_in_sight(side));
    table_->for_each_twin(side, [this](SideId twin) { sides_.set(twin, is_side_in_sight(twin)); });
  }
}

bool Surface::is_side_in_sight(SideId side) const {
  bool covered = table_->twin(side) != CellTable::none;
  table_->for_each_twin(side, [&](SideId twin) { covered = covered && is_whole(table_->cell_of(twin)); });
  return is_whole(table_->cell_of(side)) && !covered;
}

void Surface::look_at_links(CellId cell) {
  const auto corners = table_->corners_of(cell);
  for (const auto& [i, j] : table_->edges_of(cell)) {
    if (const auto link = find_link(*table_->mesh(), corners[i], corners[j])) {
      links_.set(*link, is_link_in_sight(*link));
    }
  }
}

bool Surface::is_link_in_sight(LinkId link) const {
  if (cut_.contains(link)) {
    return false;
  }
  bool in_whole = false, on_side = false;
  const auto [a, b] = table_->mesh()->links[link];
  table_->for_each_cell(link, [&, a = a, b = b](CellId cell) {
    in_whole = in_whole || is_whole(cell);
    for (SideId side = table_->first_side(cell); side < table_->end_side(cell) && !on_side; ++side) {
      on_side = sides_.contains(side) && table_->has_corner(side, a) && table_->has_corner(side, b);
    }
  });
  return on_side || !in_whole;
}

std::vector<ElementId> Surface::triangles() const {
  std::vector<ElementId> corners;
  corners.reserve(3 * sides_.numbers().size());
  for (const SideId side : sides_.numbers()) {
    append_triangles(table_->side(side), corners);
  }
  return corners;
}

void append_triangles(const Side& side, std::vector<ElementId>& corners) {
  const auto all = side.corners();
  const auto lowest = std::min_element(all.begin(), all.end()) - all.begin();
  const auto at = [&](std::ptrdiff_t i) { return all[(lowest + i) % side.count]; };
  for (int i = 1; i + 1 < side.count; ++i) {
    corners.insert(corners.end(), {at(0), at(i), at(i + 1)});
  }
}

}  // namespace chainmail
