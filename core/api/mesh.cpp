#include "chainmail/mesh.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "api/access.h"
#include "files/mesh/flaws.h"
#include "mesh/cells.h"
#include "mesh/generate.h"
#include "mesh/layers.h"
#include "mesh/parameters.h"

namespace chainmail::api {

static_assert(element_limit == inner::element_limit && coordinate_limit == inner::coordinate_limit);
static_assert(LatticeOptions().spacing == parameters::spacing.default_value);

namespace {

Mesh generated(inner::MeshKind kind, std::array<std::uint32_t, 3> size, const LatticeOptions& options) {
  return guarded([&] { return Access::mesh(generate({kind, size, options.spacing, options.space_dimension})); });
}

/// Copies a flat array of ids in groups. Throws Error if it is not whole groups, or for an id without a position.
template <std::size_t Size>
std::vector<std::array<ElementId, Size>> groups_of(const std::string& name, std::span<const ElementId> flat,
                                                   std::size_t element_count) {
  if (flat.size() % Size != 0) {
    throw Error(name, "there are " + std::to_string(flat.size()) + " ids",
                "give " + std::to_string(Size) + " for each");
  }
  std::vector<std::array<ElementId, Size>> groups(flat.size() / Size);
  for (std::size_t i = 0; i < flat.size(); ++i) {
    if (flat[i] >= element_count) {
      throw Error(
          name,
          "number " + std::to_string(i / Size) + " uses element " + std::to_string(flat[i]) + ", which has no position",
          "use ids below " + std::to_string(element_count));
    }
    groups[i / Size][i % Size] = flat[i];
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    auto corners = groups[i];
    std::ranges::sort(corners);
    if (std::ranges::adjacent_find(corners) != corners.end()) {
      throw Error(name, "number " + std::to_string(i) + " uses an element twice", "name different elements");
    }
  }
  return groups;
}

std::vector<Point> points_of(std::span<const double> positions) {
  if (positions.empty() || positions.size() % 3 != 0) {
    throw Error("positions", "there are " + std::to_string(positions.size()) + " numbers",
                "give x, y and z for each element");
  }
  if (positions.size() / 3 > element_limit) {
    throw Error("positions", "there are too many elements", "use at most " + std::to_string(element_limit));
  }
  std::vector<Point> points(positions.size() / 3);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!(std::abs(positions[i]) <= coordinate_limit)) {
      throw Error("positions, element " + std::to_string(i / 3), "a coordinate is not a finite number up to 1e100",
                  "give smaller numbers");
    }
    points[i / 3][int(i % 3)] = positions[i];
  }
  return points;
}

MeshParts parts_of(const MeshArrays& arrays) {
  MeshParts parts;
  parts.rest = points_of(arrays.positions);
  const std::size_t count = parts.rest.size();
  parts.links = groups_of<2>("links", arrays.links, count);
  parts.triangles = groups_of<3>("triangles", arrays.triangles, count);
  parts.tetrahedra = groups_of<4>("tetrahedra", arrays.tetrahedra, count);
  parts.hexahedra = groups_of<8>("hexahedra", arrays.hexahedra, count);
  parts.space_dimension = arrays.space_dimension;
  add_links_along_edges(parts);
  if (parts.links.empty()) {
    throw Error("links", "there is no link", "give links, faces or cells");
  }
  MeshFlaws flaws;
  leave_out_flawed(parts, flaws);
  if (flaws.doubled > 0) {
    throw Error("faces and cells", std::to_string(flaws.doubled) + " are there twice", "give each one once");
  }
  return parts;
}

}  // namespace

ElementId Mesh::element_count() const { return impl_->mesh->element_count(); }
LinkId Mesh::link_count() const { return impl_->mesh->link_count(); }

std::span<const ElementId> Mesh::neighbours(ElementId element) const {
  check_id(*impl_->mesh, element);
  return impl_->mesh->neighbours_of(element);
}

std::span<const std::array<ElementId, 2>> Mesh::links() const { return impl_->mesh->links; }

std::array<ElementId, 2> Mesh::link(LinkId link) const {
  check_link_ids(*impl_->mesh, std::span(&link, 1));
  return impl_->mesh->links[link];
}

std::optional<LinkId> Mesh::find_link(ElementId a, ElementId b) const {
  check_id(*impl_->mesh, a);
  check_id(*impl_->mesh, b);
  return inner::find_link(*impl_->mesh, a, b);
}

Vector3 Mesh::rest_position(ElementId element) const {
  check_id(*impl_->mesh, element);
  return vector_of(impl_->mesh->rest_position(element));
}

std::vector<double> Mesh::rest_positions() const {
  std::vector<double> all;
  all.reserve(std::size_t{3} * element_count());
  for (ElementId e = 0; e < element_count(); ++e) {
    const Point point = impl_->mesh->rest_position(e);
    all.insert(all.end(), point.begin(), point.end());
  }
  return all;
}

double Mesh::rest_length(LinkId link) const {
  check_link_ids(*impl_->mesh, std::span(&link, 1));
  return inner::rest_length(*impl_->mesh, link);
}

double Mesh::mean_rest_length() const { return impl_->mesh->mean_link_length; }

std::array<Vector3, 2> Mesh::bounds() const { return {vector_of(impl_->mesh->box[0]), vector_of(impl_->mesh->box[1])}; }

int Mesh::object_dimension() const { return impl_->mesh->object_dimension; }
int Mesh::space_dimension() const { return impl_->mesh->space_dimension; }

std::string Mesh::axes() const {
  std::string axes;
  for (int k = 0; k < 3; ++k) {
    axes += impl_->mesh->has_axis(k) ? std::string(1, "xyz"[k]) : "";
  }
  return axes;
}

std::uint32_t Mesh::part_count() const { return impl_->mesh->part_count; }

std::optional<std::array<std::uint32_t, 3>> Mesh::lattice() const {
  const auto& lattice = impl_->mesh->lattice;
  return lattice ? std::optional(lattice->size) : std::nullopt;
}

bool Mesh::is_grid() const { return impl_->mesh->is_grid; }

std::span<const std::array<ElementId, 3>> Mesh::triangles() const {
  return std::span(impl_->mesh->triangles).first(impl_->mesh->own_triangles);
}
std::span<const std::array<ElementId, 4>> Mesh::tetrahedra() const { return impl_->mesh->tetrahedra; }
std::span<const std::array<ElementId, 8>> Mesh::hexahedra() const { return impl_->mesh->hexahedra; }

std::vector<ElementId> Mesh::side(std::string_view name) const {
  const ObjectSide* side = find_side(name);
  if (side == nullptr && name != "boundary") {
    throw Error("side '" + std::string(name.substr(0, 60)) + "'", "there is no such side",
                "use left, right, bottom, top, back, front or boundary");
  }
  std::vector<ElementId> elements = side == nullptr ? boundary(*impl_->mesh) : layer(*impl_->mesh, *side);
  if (elements.empty()) {
    throw Error(
        "side '" + std::string(name) + "'",
        side == nullptr ? "the object is closed and has no boundary" : "the object does not extend along that axis",
        "use another side, or elements by id");
  }
  return elements;
}

bool Mesh::operator==(const Mesh& other) const { return impl_->mesh == other.impl_->mesh; }
const void* Mesh::identity() const { return impl_->mesh.get(); }
const std::string& Mesh::remark() const { return impl_->remark; }

Mesh make_line(std::uint32_t length, const LatticeOptions& options) {
  return generated(inner::MeshKind::line, {length, 1, 1}, options);
}
Mesh make_grid(std::uint32_t width, std::uint32_t height, const LatticeOptions& options) {
  return generated(inner::MeshKind::grid, {width, height, 1}, options);
}
Mesh make_cloth(std::uint32_t width, std::uint32_t height, const LatticeOptions& options) {
  return generated(inner::MeshKind::cloth, {width, height, 1}, options);
}
Mesh make_block(std::uint32_t width, std::uint32_t height, std::uint32_t depth, const LatticeOptions& options) {
  return generated(inner::MeshKind::block, {width, height, depth}, options);
}
Mesh make_tetra(std::uint32_t width, std::uint32_t height, std::uint32_t depth, const LatticeOptions& options) {
  return generated(inner::MeshKind::tetra, {width, height, depth}, options);
}

Mesh make_mesh(const MeshArrays& arrays) {
  return guarded([&] { return Access::mesh(build_mesh(parts_of(arrays))); });
}

}  // namespace chainmail::api
