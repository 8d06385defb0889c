#include "mesh/split.h"

#include <unordered_map>
#include <unordered_set>

#include "mesh/carriers.h"
#include "mesh/cells.h"
#include "mesh/error.h"
#include "mesh/large_pages.h"
#include "mesh/skin.h"

namespace chainmail {
namespace {

/// Calls visit(a, b) for each side of a face.
template <class Visit>
void for_each_side(std::span<const ElementId> corners, Visit visit) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    visit(corners[i], corners[(i + 1) % corners.size()]);
  }
}

/// Calls visit(a, b) for each edge of a cell.
template <class Cell, class Visit>
void for_each_edge(const Cell& cell, Visit visit) {
  for (const auto& [i, j] : edges_of(cell)) {
    visit(cell[std::size_t(i)], cell[std::size_t(j)]);
  }
}

/// Calls visit(number, corners) for each polygon.
template <class Visit>
void for_each_polygon(std::span<const ElementId> polygons, Visit visit) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < polygons.size(); i += polygons[i] + 1) {
    visit(number++, polygons.subspan(i + 1, polygons[i]));
  }
}

[[noreturn]] void refuse(const std::string& problem, const std::string& remedy) {
  throw Error("split", problem, remedy);
}

void check_points(const std::vector<SplitPoint>& points, std::uint64_t elements) {
  if (elements + points.size() > element_limit) {
    refuse("the object would have more than " + std::to_string(element_limit) + " elements", "use a smaller mesh");
  }
  for (const SplitPoint& point : points) {
    const auto& [first, second] = point.shares;
    if (std::ranges::any_of(point.of, [&](ElementId one) { return one >= elements; })) {
      refuse("element " + std::to_string(elements) + " lies between elements that do not exist before it",
             "name elements with lower ids");
    }
    if (!(first >= 0 && second >= 0 && first + second <= 1)) {
      refuse("element " + std::to_string(elements) + " does not lie between its elements",
             "use shares from 0 to 1, together at most 1");
    }
    ++elements;
  }
}

void check_removed(std::span<const std::uint32_t> removed, std::size_t count, const std::string& what) {
  if (std::adjacent_find(removed.begin(), removed.end(), std::greater_equal<>()) != removed.end() ||
      (!removed.empty() && removed.back() >= count)) {
    refuse("the " + what + " to replace are not ascending numbers below " + std::to_string(count),
           "number them from 0, in the order of the object");
  }
}

void check_corners(std::span<const ElementId> corners, std::uint64_t elements) {
  std::vector<ElementId> sorted(corners.begin(), corners.end());
  std::ranges::sort(sorted);
  if (sorted.size() < 3 || sorted.back() >= elements || std::ranges::adjacent_find(sorted) != sorted.end()) {
    refuse("a new face or cell does not have three or more different corners that exist", "name each corner once");
  }
}

void check_polygons(std::span<const ElementId> polygons, std::uint64_t elements) {
  for (std::size_t i = 0; i < polygons.size(); i += std::size_t{polygons[i]} + 1) {
    if (polygons[i] >= polygons.size() - i) {
      refuse("a new polygon lacks corners", "write the number of corners before them");
    }
    check_corners(polygons.subspan(i + 1, polygons[i]), elements);
  }
}

std::uint32_t polygon_count(const Mesh& mesh) {
  std::uint32_t count = 0;
  for_each_polygon(mesh.polygons, [&](std::uint32_t, auto) { ++count; });
  return count;
}

void check(const SplitEdit& edit, const Mesh& mesh) {
  check_can_split(mesh, "split");
  if (edit.empty() && edit.triangles.empty() && edit.polygons.empty() && edit.tetrahedra.empty() &&
      edit.hexahedra.empty()) {
    refuse("it changes nothing", "leave it out");
  }
  if (!mesh.has_cells() && !(edit.tetrahedra.empty() && edit.hexahedra.empty())) {
    refuse("it adds cells to an object without cells", "add faces only");
  }
  check_points(edit.elements, mesh.element_count());
  check_removed(edit.removed, mesh.own_triangles, "triangles");
  check_removed(edit.removed_polygons, polygon_count(mesh), "polygons");
  check_removed(edit.removed_cells, mesh.tetrahedra.size() + mesh.hexahedra.size(), "cells");
  const std::uint64_t elements = mesh.element_count() + edit.elements.size();
  const auto check_all = [elements](const auto& groups) {
    for (const auto& corners : groups) {
      check_corners(corners, elements);
    }
  };
  check_all(edit.triangles);
  check_all(edit.tetrahedra);
  check_all(edit.hexahedra);
  check_polygons(edit.polygons, elements);
}

/// Builds the mesh after a split from the mesh before it.
class MeshAfter {
 public:
  MeshAfter(const Mesh& mesh, const SplitEdit& edit) : mesh_(mesh), edit_(edit) {}

  MeshPointer build(std::shared_ptr<const Skin> skin, SplitPointer split) {
    parts_.skin = std::move(skin);
    parts_.split = std::move(split);
    parts_.space_dimension = mesh_.space_dimension;
    parts_.texture = mesh_.texture;
    parts_.rest = rest_after(mesh_, edit_.elements);
    drop_removed();
    take_triangles();
    take_polygons();
    take_cells();
    link();
    parts_.mean_link_length = mean_link_length();
    return build_mesh(std::move(parts_));
  }

 private:
  void drop_removed();
  void take_triangles();
  void take_polygons();
  void take_cells();
  std::vector<std::uint8_t> ends_of_dropped() const;
  void link();
  std::optional<double> mean_link_length() const;
  void drop(ElementId a, ElementId b) { dropped_.insert(edge_key(a, b)); }
  void keep(ElementId a, ElementId b) { dropped_.erase(edge_key(a, b)); }
  void add(ElementId a, ElementId b) {
    keep(a, b);
    if (const bool old = a < mesh_.element_count() && b < mesh_.element_count(); !old || !find_link(mesh_, a, b)) {
      added_.insert(edge_key(a, b));
    }
  }
  void drop_sides(std::span<const ElementId> corners) {
    for_each_side(corners, [this](ElementId a, ElementId b) { drop(a, b); });
  }
  void keep_sides(std::span<const ElementId> corners) {
    for_each_side(corners, [this](ElementId a, ElementId b) { keep(a, b); });
  }
  void add_sides(std::span<const ElementId> corners) {
    for_each_side(corners, [this](ElementId a, ElementId b) { add(a, b); });
  }

  const Mesh& mesh_;
  const SplitEdit& edit_;
  MeshParts parts_;
  std::unordered_set<EdgeKey> dropped_, added_;  // links that no face or cell has any more, and new ones
};

void MeshAfter::drop_removed() {
  for (const std::uint32_t one : edit_.removed) {
    drop_sides(mesh_.triangles[one]);
  }
  for_each_polygon(mesh_.polygons, [&](std::uint32_t number, auto corners) {
    if (std::ranges::binary_search(edit_.removed_polygons, number)) {
      drop_sides(corners);
    }
  });
  const auto drop_edges = [this](const auto& cell) { for_each_edge(cell, [this](auto a, auto b) { drop(a, b); }); };
  for (const CellId cell : edit_.removed_cells) {
    const std::size_t tetrahedra = mesh_.tetrahedra.size();
    cell < tetrahedra ? drop_edges(mesh_.tetrahedra[cell]) : drop_edges(mesh_.hexahedra[cell - tetrahedra]);
  }
}

void MeshAfter::take_triangles() {
  for (std::uint32_t i = 0; i < mesh_.own_triangles; ++i) {
    if (!std::ranges::binary_search(edit_.removed, i)) {
      parts_.triangles.push_back(mesh_.triangles[i]);
      keep_sides(mesh_.triangles[i]);
    }
  }
  for (const auto& triangle : edit_.triangles) {
    parts_.triangles.push_back(triangle);
    add_sides(triangle);
  }
}

void MeshAfter::take_polygons() {
  const auto take = [this](std::span<const ElementId> corners) {
    parts_.polygons.push_back(static_cast<ElementId>(corners.size()));
    parts_.polygons.insert(parts_.polygons.end(), corners.begin(), corners.end());
  };
  for_each_polygon(mesh_.polygons, [&](std::uint32_t number, auto corners) {
    if (!std::ranges::binary_search(edit_.removed_polygons, number)) {
      take(corners);
      keep_sides(corners);
    }
  });
  for_each_polygon(edit_.polygons, [&](std::uint32_t, auto corners) {
    take(corners);
    add_sides(corners);
  });
}

void MeshAfter::take_cells() {
  const std::vector<std::uint8_t> is_end = ends_of_dropped();
  auto removed = edit_.removed_cells.begin();
  CellId number = 0;
  const auto take = [&](const auto& before, const auto& added, auto& after) {
    reserve_in_large_pages(after, before.size() + added.size());
    for (const auto& cell : before) {
      if (const CellId id = number++; removed != edit_.removed_cells.end() && *removed == id) {
        ++removed;
        continue;
      }
      after.push_back(cell);
      int ends = 0;
      for (const ElementId corner : cell) {
        ends += is_end[corner];
      }
      if (ends > 1) {
        for_each_edge(cell, [this](ElementId a, ElementId b) { keep(a, b); });
      }
    }
    for (const auto& cell : added) {
      after.push_back(cell);
      for_each_edge(cell, [this](ElementId a, ElementId b) { add(a, b); });
    }
  };
  take(mesh_.tetrahedra, edit_.tetrahedra, parts_.tetrahedra);
  take(mesh_.hexahedra, edit_.hexahedra, parts_.hexahedra);
}

/// Returns, for each element of the mesh before, whether a dropped link ends there.
std::vector<std::uint8_t> MeshAfter::ends_of_dropped() const {
  std::vector<std::uint8_t> result(mesh_.element_count());
  for (const EdgeKey one : dropped_) {
    result[ends_of(one)[0]] = result[ends_of(one)[1]] = 1;
  }
  return result;
}

/// Writes the neighbour table. Rows that the file ordered keep their order, with new neighbours last.
void MeshAfter::link() {
  std::vector<std::array<ElementId, 2>> entries;  // element and new neighbour, ascending
  for (const EdgeKey one : added_) {
    const auto [a, b] = ends_of(one);
    entries.push_back({a, b});
    entries.push_back({b, a});
  }
  std::ranges::sort(entries);
  auto& neighbours = parts_.neighbours;
  const std::vector<std::uint8_t> is_end = ends_of_dropped();
  reserve_in_large_pages(neighbours, mesh_.neighbours.size() + entries.size());
  auto next = entries.begin();
  for (ElementId e = 0; e < parts_.rest.size(); ++e) {
    parts_.first_entry.push_back(static_cast<EntryId>(neighbours.size()));
    bool ascending = true;
    if (e < mesh_.element_count()) {
      const auto row = mesh_.neighbours_of(e);
      ascending = std::ranges::is_sorted(row);
      if (is_end[e] == 0) {
        neighbours.insert(neighbours.end(), row.begin(), row.end());
      } else {
        std::ranges::copy_if(row, std::back_inserter(neighbours),
                             [&](ElementId other) { return !dropped_.contains(edge_key(e, other)); });
      }
    }
    const bool has_new = next != entries.end() && (*next)[0] == e;
    for (; next != entries.end() && (*next)[0] == e; ++next) {
      neighbours.push_back((*next)[1]);
    }
    if (ascending && has_new) {
      std::sort(neighbours.begin() + parts_.first_entry.back(), neighbours.end());
    }
  }
  parts_.first_entry.push_back(static_cast<EntryId>(neighbours.size()));
}

/// Returns the mean link length, from that before and what changed; nothing if rounding would show.
std::optional<double> MeshAfter::mean_link_length() const {
  constexpr double few = 1e-3;
  const auto length = [this](EdgeKey edge) {
    const auto [a, b] = ends_of(edge);
    return (parts_.rest[b] - parts_.rest[a]).stableNorm();
  };
  std::vector<EdgeKey> dropped(dropped_.begin(), dropped_.end()), added(added_.begin(), added_.end());
  std::ranges::sort(dropped);  // a sum in another order has other last digits
  std::ranges::sort(added);
  const double before = mesh_.mean_link_length * mesh_.link_count();
  double sum = before;
  for (const EdgeKey edge : dropped) {
    sum -= find_link(mesh_, ends_of(edge)[0], ends_of(edge)[1]) ? length(edge) : 0;
  }
  for (const EdgeKey edge : added) {
    sum += length(edge);
  }
  return sum > few * before ? std::optional(2 * sum / double(parts_.neighbours.size())) : std::nullopt;
}

/// Finds on which link of the old mesh elements and links of the new one lie.
class Origins {
 public:
  explicit Origins(SplitLinks& links) : links_(links), old_(links.before->element_count()) {}

  void find() {
    for (const SplitPoint& point : links_.edit.elements) {
      const LinkId on = point.is_copy() || point.shares[1] != 0 ? SplitLinks::none : between(point.of[0], point.of[1]);
      const ElementId self = old_ + static_cast<ElementId>(original_.size());
      original_.push_back(point.is_copy() ? original(point.of[0]) : self);
      links_.link_of.push_back(point.is_copy() ? links_.link_at(point.of[0]) : on);
    }
    // Most links are kept, in the same order.
    const auto& before = links_.before->links;
    LinkId next = 0;
    links_.parents.reserve(links_.after->links.size());
    for (const auto& link : links_.after->links) {
      while (next < before.size() && before[next] < link) {
        ++next;
      }
      const bool is_kept = next < before.size() && before[next] == link;
      links_.parents.push_back(is_kept ? next : between(link[0], link[1]));
    }
  }

 private:
  ElementId original(ElementId element) const { return element < old_ ? element : original_[element - old_]; }

  /// Returns the old link on which the line between two elements lies.
  LinkId between(ElementId a, ElementId b) const {
    a = original(a);
    b = original(b);
    if (a < old_ && b < old_) {
      return a == b ? SplitLinks::none : find_link(*links_.before, a, b).value_or(SplitLinks::none);
    }
    const LinkId at_a = links_.link_at(a), at_b = links_.link_at(b);
    const LinkId link = at_a == SplitLinks::none ? at_b : at_a;
    return link != SplitLinks::none && is_on(a, at_a, link) && is_on(b, at_b, link) ? link : SplitLinks::none;
  }
  bool is_on(ElementId element, LinkId at, LinkId link) const {
    const auto& [from, to] = links_.before->links[link];
    return at == link || element == from || element == to;
  }

  SplitLinks& links_;
  ElementId old_;
  std::vector<ElementId> original_;  // of each appended element: itself, or what it is a copy of
};

/// Finds the links that are cut after a split.
class CutsAfter {
 public:
  CutsAfter(const SplitLinks& links, std::span<const LinkId> cuts)
      : edit_(links.edit),
        links_(links),
        before_(*links.before),
        after_(*links.after),
        cuts_(cuts),
        is_cut_(after_.link_count()),
        carriers_(before_.element_count()) {
    carriers_.append(edit_.elements);
    add_removed();
    for (LinkId link = 0; link < after_.link_count(); ++link) {
      const LinkId on = links_.parents[link];
      is_cut_[link] = on == SplitLinks::none ? is_inside_gone(after_.links[link]) : was_cut(on);
    }
    cut_corners();
    keep_stubs();
  }

  std::vector<LinkId> links() const {
    std::vector<LinkId> result;
    for (LinkId link = 0; link < is_cut_.size(); ++link) {
      if (is_cut_[link]) {
        result.push_back(link);
      }
    }
    return result;
  }

 private:
  /// A cell or a face that the split replaces.
  struct Removed {
    std::vector<ElementId> corners;  // ascending
    bool is_gone = false;            // it has a cut link
  };

  void add_removed();
  bool was_cut(LinkId link) const { return std::ranges::binary_search(cuts_, link); }
  bool is_inside_gone(std::span<const ElementId> elements) const;
  void cut_corners();
  bool is_loose(const Mesh& mesh, ElementId element, auto is_cut) const {
    const auto links =
        std::span(mesh.entry_link).subspan(mesh.first_entry[element], mesh.neighbours_of(element).size());
    return std::ranges::all_of(links, is_cut);
  }
  void keep_stub(ElementId element) {
    if (is_loose(after_, element, [this](LinkId link) { return is_cut_[link]; }) &&
        !after_.neighbours_of(element).empty()) {
      is_cut_[after_.entry_link[after_.first_entry[element]]] = false;
    }
  }
  void keep_stubs();

  const SplitEdit& edit_;
  const SplitLinks& links_;
  const Mesh &before_, &after_;
  std::span<const LinkId> cuts_;
  std::vector<bool> is_cut_;  // of each link after the split
  Carriers carriers_;
  std::vector<Removed> removed_;
  std::unordered_map<ElementId, std::vector<std::size_t>> removed_at_;  // by corner
};

void CutsAfter::add_removed() {
  const auto add = [this](const auto& corners, auto for_each) {
    Removed one{{corners.begin(), corners.end()}};
    for_each(corners, [&](ElementId a, ElementId b) {
      const auto link = find_link(before_, a, b);
      one.is_gone = one.is_gone || (link && was_cut(*link));
    });
    std::ranges::sort(one.corners);
    for (const ElementId corner : one.corners) {
      removed_at_[corner].push_back(removed_.size());
    }
    removed_.push_back(std::move(one));
  };
  const auto add_face = [&add](std::span<const ElementId> corners) {
    add(corners, [](auto face, auto visit) { for_each_side(face, visit); });
  };
  const auto add_cell = [&add](const auto& corners) {
    add(corners, [](const auto& cell, auto visit) { for_each_edge(cell, visit); });
  };
  for (const std::uint32_t one : edit_.removed) {
    add_face(before_.triangles[one]);
  }
  for_each_polygon(before_.polygons, [&](std::uint32_t number, auto corners) {
    if (std::ranges::binary_search(edit_.removed_polygons, number)) {
      add_face(corners);
    }
  });
  for (const CellId cell : edit_.removed_cells) {
    const std::size_t tetrahedra = before_.tetrahedra.size();
    cell < tetrahedra ? add_cell(before_.tetrahedra[cell]) : add_cell(before_.hexahedra[cell - tetrahedra]);
  }
}

/// True if everything inside which something new lies is gone.
bool CutsAfter::is_inside_gone(std::span<const ElementId> elements) const {
  const Carrier carrier = carriers_.of(elements);
  const std::vector<std::size_t>* fewest = nullptr;
  for (const ElementId one : elements_of(carrier)) {
    const auto found = removed_at_.find(one);
    if (found == removed_at_.end()) {
      return false;
    }
    if (fewest == nullptr || found->second.size() < fewest->size()) {
      fewest = &found->second;
    }
  }
  bool result = false;
  for (const std::size_t i : *fewest) {
    if (std::ranges::includes(removed_[i].corners, elements_of(carrier))) {
      if (!removed_[i].is_gone) {
        return false;
      }
      result = true;
    }
  }
  return result;
}

/// Cuts a link of each piece that still has none: a corner of a bent hexahedron that has all its links in sides that
/// are not cut. A piece of the cell across that side may then be gone, too.
void CutsAfter::cut_corners() {
  for (const auto& corners : edit_.tetrahedra) {
    bool is_whole = is_inside_gone(corners);
    LinkId inner = SplitLinks::none;
    for_each_edge(corners, [&](ElementId a, ElementId b) {
      const LinkId link = find_link(after_, a, b).value();
      is_whole = is_whole && !is_cut_[link];
      inner = links_.parents[link] == SplitLinks::none ? link : inner;
    });
    if (is_whole && inner != SplitLinks::none) {
      is_cut_[inner] = true;
    }
  }
}

/// An element all of whose links would be cut stays linked to its first neighbour, so that it is no part of its own.
/// What is gone stays so: it has other links there.
void CutsAfter::keep_stubs() {
  const auto& elements = edit_.elements;
  for (ElementId i = 0; i < elements.size(); ++i) {
    keep_stub(before_.element_count() + i);
    const ElementId of = elements[i].of[0];
    if (elements[i].is_copy() && of < before_.element_count() &&
        !is_loose(before_, of, [this](LinkId link) { return was_cut(link); })) {
      keep_stub(of);
    }
  }
}

}  // namespace

bool can_split(const Mesh& mesh) { return mesh.has_cells() || (!mesh.triangles.empty() && !mesh.lattice); }

void check_can_split(const Mesh& mesh, const std::string& where) {
  if (!can_split(mesh)) {
    throw Error(where, "the object has neither cells nor faces, or it is a lattice of faces", "cut its links instead");
  }
}

SplitPointer make_split(const MeshPointer& mesh, SplitEdit edit) {
  check(edit, *mesh);
  return std::make_shared<const Split>(mesh, std::move(edit));
}

MeshSource::MeshSource(const MeshPointer& mesh) {
  const bool is_known = mesh->split && mesh->split->kept() == mesh;  // otherwise it is a copy
  is_known ? void(split_ = mesh->split) : void(first_ = mesh);
}

MeshPointer MeshSource::mesh() const {
  std::vector<const Split*> missing;  // the last one first
  MeshPointer mesh = first_;
  for (const MeshSource* source = this; !mesh; mesh = mesh ? mesh : source->first_) {
    const Split& split = *source->split_;
    mesh = split.kept();
    if (!mesh) {
      missing.push_back(&split);
      source = &split.before_;
    }
  }
  for (auto split = missing.rbegin(); split != missing.rend(); ++split) {
    mesh = (*split)->make_after(mesh);
  }
  return mesh;
}

Split::Split(const MeshPointer& before, SplitEdit edit)
    : edit_(std::move(edit)),
      old_count_(before->element_count()),
      old_size_(mesh_size(*before)),
      had_cells_(before->has_cells()),
      before_(before) {}

/// Splits that nobody else needs go one after another: one within the other, they would need a deep stack.
Split::~Split() {
  SplitPointer last = std::move(before_.split_);
  while (last && last.use_count() == 1) {
    SplitPointer next = std::move(last->before_.split_);
    last = std::move(next);
  }
}

MeshPointer Split::kept() const {
  const std::lock_guard lock(mutex_);
  return after_.lock();
}

MeshPointer Split::make_after(const MeshPointer& before) const {
  const std::lock_guard lock(mutex_);
  MeshPointer mesh = after_.lock();
  if (!mesh) {
    mesh = MeshAfter(*before, edit_)
               .build(before->has_cells() ? Skin::after(before, edit_.elements) : nullptr, shared_from_this());
    after_ = mesh;
  }
  return mesh;
}

SplitLinks::SplitLinks(const Split& split) : edit(split.edit()), before(split.before()), after(split.after()) {
  Origins(*this).find();
}

std::uint64_t mesh_size(const Mesh& mesh) {
  return std::uint64_t{mesh.element_count()} + mesh.link_count() + mesh.triangles.size() + mesh.tetrahedra.size() +
         mesh.hexahedra.size();
}

std::vector<Point> rest_after(const Mesh& mesh, std::span<const SplitPoint> points) {
  std::vector<Point> rest;
  rest.reserve(mesh.element_count() + points.size());
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    rest.push_back(mesh.rest_position(e));
  }
  for (const SplitPoint& point : points) {
    rest.push_back(point.mix<Point>(rest[point.of[0]], rest[point.of[1]], rest[point.of[2]]));
  }
  return rest;
}

std::vector<LinkId> links_without_faces(const Mesh& mesh, std::span<const LinkId> links) {
  std::unordered_map<EdgeKey, LinkId> found;
  for (const LinkId link : links) {
    found[edge_key(mesh.links[link][0], mesh.links[link][1])] = link;
  }
  const auto leave_out = [&](ElementId a, ElementId b) { found.erase(edge_key(a, b)); };
  for (std::size_t t = 0; t < mesh.own_triangles; ++t) {
    for_each_side(mesh.triangles[t], leave_out);
  }
  for_each_polygon(mesh.polygons, [&](std::uint32_t, auto corners) { for_each_side(corners, leave_out); });
  const auto leave_out_edges = [&](const auto& cell) { for_each_edge(cell, leave_out); };
  std::ranges::for_each(mesh.tetrahedra, leave_out_edges);
  std::ranges::for_each(mesh.hexahedra, leave_out_edges);
  std::vector<LinkId> result;
  result.reserve(found.size());
  for (const auto& [edge, link] : found) {
    result.push_back(link);
  }
  std::ranges::sort(result);
  return result;
}

std::vector<LinkId> cuts_after(const SplitLinks& links, std::span<const LinkId> cuts) {
  return cuts.empty() ? std::vector<LinkId>() : CutsAfter(links, cuts).links();
}

std::vector<LinkId> cuts_after(const Split& split, std::span<const LinkId> cuts) {
  return cuts.empty() ? std::vector<LinkId>() : cuts_after(SplitLinks(split), cuts);
}

std::vector<ElementId> pins_after(const Split& split, std::span<const ElementId> pins) {
  std::vector<ElementId> result(pins.begin(), pins.end());
  const auto& appended = split.edit().elements;
  for (ElementId i = 0; i < appended.size(); ++i) {
    const auto is_pinned = [&](ElementId one) { return std::ranges::binary_search(result, one); };
    if (std::ranges::all_of(appended[i].of, is_pinned)) {
      result.push_back(split.old_count() + i);
    }
  }
  return result;
}

}  // namespace chainmail
