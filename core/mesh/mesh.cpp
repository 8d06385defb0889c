#include "mesh/mesh.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "mesh/error.h"
#include "mesh/large_pages.h"
#include "mesh/parts.h"
#include "mesh/polygon_triangles.h"

namespace chainmail {
namespace {

/// Fills the neighbour table from pairs in any order. Rows are ascending, and each link is once in both of its rows.
void fill_neighbour_table(Mesh& mesh, const std::vector<std::array<ElementId, 2>>& links, std::size_t element_count,
                          const Progress& progress) {
  std::vector<EntryId> next(element_count + 1, 0);
  for (std::size_t i = 0; i < links.size(); ++i) {
    progress.part(0, 0.2).report(i, links.size());
    ++next[links[i][0] + 1];
    ++next[links[i][1] + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  mesh.first_entry = next;
  mesh.neighbours.resize(2 * links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    progress.part(0.2, 0.5).report(i, links.size());
    const auto& [a, b] = links[i];
    mesh.neighbours[next[a]++] = b;
    mesh.neighbours[next[b]++] = a;
  }
  EntryId kept = 0;
  for (std::size_t e = 0; e < element_count; ++e) {
    progress.part(0.5, 1).report(e, element_count);
    const auto first = mesh.neighbours.begin() + mesh.first_entry[e];
    const auto last = mesh.neighbours.begin() + mesh.first_entry[e + 1];
    std::sort(first, last);
    mesh.first_entry[e] = kept;
    kept += static_cast<EntryId>(std::distance(
        mesh.neighbours.begin() + kept, std::copy(first, std::unique(first, last), mesh.neighbours.begin() + kept)));
  }
  mesh.first_entry[element_count] = kept;
  mesh.neighbours.resize(kept);
}

/// Returns the entries of each row in ascending order of neighbour; nothing if all rows are in that order.
std::vector<EntryId> ascending_entries(const Mesh& mesh, const Progress& progress) {
  ElementId ascending = 0;
  while (ascending < mesh.element_count() && std::ranges::is_sorted(mesh.neighbours_of(ascending))) {
    ++ascending;
  }
  if (ascending == mesh.element_count()) {
    return {};
  }
  std::vector<EntryId> order(mesh.neighbours.size());
  std::iota(order.begin(), order.end(), EntryId{0});
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    progress.report(e, mesh.element_count());
    const auto row = mesh.neighbours_of(e);
    if (!std::is_sorted(row.begin(), row.end())) {
      std::sort(order.begin() + mesh.first_entry[e], order.begin() + mesh.first_entry[e + 1],
                [&mesh](EntryId i, EntryId j) { return mesh.neighbours[i] < mesh.neighbours[j]; });
    }
  }
  return order;
}

void number_links(Mesh& mesh, const Progress& progress) {
  const std::vector<EntryId> order = ascending_entries(mesh, progress.part(0, 0.3));
  // Elements are visited in ascending order, so an element meets its lower neighbours in ascending order too. In the
  // row of the higher element, the entry of a link is therefore the next one.
  std::vector<EntryId> next(mesh.first_entry.begin(), mesh.first_entry.end() - 1);
  reserve_in_large_pages(mesh.entry_link, mesh.neighbours.size());
  mesh.entry_link.resize(mesh.neighbours.size());
  reserve_in_large_pages(mesh.links, mesh.neighbours.size() / 2);
  for (ElementId a = 0; a < mesh.element_count(); ++a) {
    progress.part(0.3, 1).report(a, mesh.element_count());
    for (EntryId entry = mesh.first_entry[a]; entry < mesh.first_entry[a + 1]; ++entry) {
      const ElementId b = mesh.neighbours[entry];
      if (a < b) {
        const EntryId at = next[b]++, twin = order.empty() ? at : order[at];
        assert(mesh.neighbours[twin] == a && "a link is in both of its rows");
        mesh.entry_link[entry] = mesh.entry_link[twin] = mesh.link_count();
        mesh.links.push_back({a, b});
      }
    }
  }
}

/// Chooses the axes that the object needs, then others in the order x, y, z until there are `asked` axes.
void choose_axes(Mesh& mesh, const std::vector<Point>& rest, std::optional<int> asked) {
  std::array<bool, 3> is_active{};
  for (int k = 0; k < 3; ++k) {
    is_active[k] = std::any_of(rest.begin(), rest.end(), [&](const Point& p) { return p[k] != rest.front()[k]; });
  }
  const auto needed = static_cast<int>(std::count(is_active.begin(), is_active.end(), true));
  if (asked && (*asked < 1 || *asked > 3)) {
    throw Error("space dimension " + std::to_string(*asked), "there is no such space", "use 1, 2 or 3");
  }
  if (asked && *asked < needed) {
    throw Error("space dimension " + std::to_string(*asked),
                "the object extends along " + std::to_string(needed) + " axes",
                "use " + std::to_string(needed) + " or more");
  }
  const int wanted = std::max(asked.value_or(needed), 1);
  for (int k = 0; k < 3; ++k) {
    if (std::count(is_active.begin(), is_active.end(), true) < wanted) {
      is_active[k] = true;
    }
  }
  mesh.space_dimension = 0;
  for (int k = 0; k < 3; ++k) {
    if (is_active[k]) {
      mesh.axes[mesh.space_dimension++] = k;
    }
  }
  mesh.origin = rest.empty() ? Point(Point::Zero()) : rest.front();
}

void store_rest(Mesh& mesh, const std::vector<Point>& rest) {
  mesh.rest.reserve(rest.size() * mesh.space_dimension);
  for (const Point& p : rest) {
    for (int k = 0; k < mesh.space_dimension; ++k) {
      mesh.rest.push_back(p[mesh.axes[k]]);
    }
  }
}

/// Divides the polygons into triangles.
void divide_polygons(Mesh& mesh, const Progress& progress) {
  std::vector<Point> at;
  for (std::size_t i = 0; i < mesh.polygons.size(); i += mesh.polygons[i] + 1) {
    progress.report(i, mesh.polygons.size());
    const auto corners = std::span<const ElementId>(mesh.polygons).subspan(i + 1, mesh.polygons[i]);
    at.clear();
    for (const ElementId corner : corners) {
      at.push_back(mesh.rest_position(corner));
    }
    divide_polygon(corners, at, mesh.triangles);
  }
}

int object_dimension(const Mesh& mesh) {
  if (mesh.has_cells()) {
    return 3;
  }
  if (!mesh.triangles.empty()) {
    return 2;
  }
  if (!mesh.lattice) {
    return 1;
  }
  const auto& size = mesh.lattice->size;
  const auto extended = std::count_if(size.begin(), size.end(), [](std::uint32_t n) { return n > 1; });
  return std::max(1, static_cast<int>(extended));
}

/// Returns true if `to`, which has the higher id, is next to `from` along one axis.
bool is_one_step(const Lattice& lattice, ElementId from, ElementId to) {
  const auto [width, height, depth] = lattice.size;
  const ElementId way = to - from;
  return (way == 1 && from % width + 1 < width) || (way == width && from / width % height + 1 < height) ||
         way == std::uint64_t{width} * height;
}

bool is_grid(const Mesh& mesh) {
  return mesh.lattice && std::all_of(mesh.links.begin(), mesh.links.end(),
                                     [&](const auto& link) { return is_one_step(*mesh.lattice, link[0], link[1]); });
}

std::array<Point, 2> box_of(const Mesh& mesh) {
  std::array<Point, 2> box{mesh.origin, mesh.origin};
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    const Point p = mesh.rest_position(e);
    box[0] = box[0].cwiseMin(p);
    box[1] = box[1].cwiseMax(p);
  }
  return box;
}

double mean_link_length(const Mesh& mesh, const Progress& progress) {
  double sum = 0;
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    progress.report(link, mesh.link_count());
    sum += rest_length(mesh, link);
  }
  return mesh.links.empty() ? 0 : sum / mesh.link_count();
}

}  // namespace

Point Lattice::position(ElementId element) const {
  const std::uint64_t layer = std::uint64_t{size[0]} * size[1];
  const std::uint64_t column = element % size[0], row = element / size[0] % size[1], plane = element / layer;
  return Point(double(column), double(row), double(plane)) * spacing;
}

bool Mesh::has_axis(int axis) const {
  const auto end = axes.begin() + space_dimension;
  return std::find(axes.begin(), end, axis) != end;
}

Point Mesh::to_point(const double* coordinates) const {
  Point point = origin;
  for (int k = 0; k < space_dimension; ++k) {
    point[axes[k]] = coordinates[k];
  }
  return point;
}

Point Mesh::rest_position(ElementId element) const {
  return to_point(rest.data() + std::size_t{element} * space_dimension);
}

bool is_far(const Mesh& mesh) {
  constexpr double many = 16;  // radii: four of the 24 bits of single precision
  const Point middle = (mesh.box[0] + mesh.box[1]) / 2;
  return middle.cwiseAbs().maxCoeff() > many * (mesh.box[1] - mesh.box[0]).norm() / 2;
}

double rest_length(const Mesh& mesh, LinkId link) {
  const int dimension = mesh.space_dimension;
  const double* from = mesh.rest.data() + std::size_t{mesh.links[link][0]} * dimension;
  const double* to = mesh.rest.data() + std::size_t{mesh.links[link][1]} * dimension;
  Point vector = Point::Zero();
  for (int k = 0; k < dimension; ++k) {
    vector[mesh.axes[k]] = to[k] - from[k];
  }
  return vector.stableNorm();
}

std::optional<LinkId> find_link(const Mesh& mesh, ElementId a, ElementId b) {
  if (mesh.neighbours_of(a).size() > mesh.neighbours_of(b).size()) {
    std::swap(a, b);
  }
  const auto row = mesh.neighbours_of(a);
  const auto found = std::find(row.begin(), row.end(), b);
  if (found == row.end()) {
    return std::nullopt;
  }
  return mesh.entry_link[mesh.first_entry[a] + std::distance(row.begin(), found)];
}

MeshPointer build_mesh(MeshParts parts, const Progress& progress) {
  if (parts.rest.size() > element_limit) {
    throw Error("mesh", std::to_string(parts.rest.size()) + " elements are too many",
                "use at most " + std::to_string(element_limit));
  }
  auto mesh = std::make_shared<Mesh>();
  progress.report(0);
  choose_axes(*mesh, parts.rest, parts.space_dimension);
  progress.report(0.05);
  store_rest(*mesh, parts.rest);
  if (parts.first_entry.empty()) {
    fill_neighbour_table(*mesh, parts.links, parts.rest.size(), progress.part(0.1, 0.5));
  } else {
    mesh->first_entry = std::move(parts.first_entry);
    mesh->neighbours = std::move(parts.neighbours);
  }
  number_links(*mesh, progress.part(0.5, 0.7));
  number_shapes(*mesh, progress.part(0.7, 0.75));
  mesh->row_kinds = find_row_kinds(*mesh, progress.part(0.75, 0.8));
  if (!mesh->row_kinds.known()) {
    move_to_large_pages(std::span<const EntryId>(mesh->first_entry));
    move_to_large_pages(std::span<const ElementId>(mesh->neighbours));
    move_to_large_pages(std::span<const std::uint16_t>(mesh->entry_shape));
  }
  mesh->own_triangles = parts.triangles.size();
  mesh->triangles = std::move(parts.triangles);
  mesh->polygons = std::move(parts.polygons);
  mesh->tetrahedra = std::move(parts.tetrahedra);
  mesh->hexahedra = std::move(parts.hexahedra);
  mesh->texture = std::move(parts.texture);
  mesh->skin = std::move(parts.skin);
  mesh->split = std::move(parts.split);
  mesh->lattice = parts.lattice;
  divide_polygons(*mesh, progress.part(0.8, 0.82));
  mesh->object_dimension = object_dimension(*mesh);
  mesh->mean_link_length =
      parts.mean_link_length ? *parts.mean_link_length : mean_link_length(*mesh, progress.part(0.82, 0.9));
  mesh->part_count = count_parts(*mesh, {}, progress.part(0.9, 1));
  mesh->box = box_of(*mesh);
  mesh->is_grid = is_grid(*mesh);
  return mesh;
}

void check_element(const Mesh& mesh, ElementId element) {
  if (element >= mesh.element_count()) {
    throw Error("element " + std::to_string(element), "there is no such element",
                "use an id below " + std::to_string(mesh.element_count()));
  }
}

void check_elements(const Mesh& mesh, std::span<const ElementId> elements) {
  for (const ElementId element : elements) {
    check_element(mesh, element);
  }
}

void check_links(const Mesh& mesh, std::span<const LinkId> links) {
  for (const LinkId link : links) {
    if (link >= mesh.link_count()) {
      throw Error("link " + std::to_string(link), "there is no such link",
                  "use a number below " + std::to_string(mesh.link_count()));
    }
  }
}

void refuse_axis(const std::string& where, int axis) {
  const std::string name(1, "xyz"[axis]);
  throw Error(where, "the object does not extend along " + name,
              "leave " + name + " unchanged, or make the mesh with more space dimensions");
}

void check_displacement(const Mesh& mesh, const std::string& where, const Point& displacement) {
  if (!displacement.allFinite()) {
    throw Error(where, "a coordinate is not a finite number", "give numbers");
  }
  for (int k = 0; k < 3; ++k) {
    if (displacement[k] != 0 && !mesh.has_axis(k)) {
      refuse_axis(where, k);
    }
  }
}

void check_position(const Mesh& mesh, const std::string& where, const Point& position) {
  Point moved = position;
  for (int k = 0; k < 3; ++k) {
    moved[k] = !mesh.has_axis(k) && position[k] == mesh.origin[k] ? 0 : position[k];
  }
  check_displacement(mesh, where, moved);
}

}  // namespace chainmail
