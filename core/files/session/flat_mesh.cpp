#include "files/session/flat_mesh.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "files/session/object_json.h"
#include "files/session/session_mesh.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

template <std::size_t Size>
std::vector<ElementId> flattened(std::span<const std::array<ElementId, Size>> groups) {
  std::vector<ElementId> flat;
  flat.reserve(Size * groups.size());
  for (const auto& group : groups) {
    flat.insert(flat.end(), group.begin(), group.end());
  }
  return flat;
}

/// Returns the lengths of the rows. If the ends do not ascend, these do not add up to the number of neighbours.
std::vector<std::uint32_t> lengths_of_rows(const std::vector<EntryId>& first_entry) {
  std::vector<std::uint32_t> lengths;
  for (std::size_t i = 1; i < first_entry.size(); ++i) {
    lengths.push_back(first_entry[i] - first_entry[i - 1]);
  }
  return lengths;
}

/// Returns the mesh as the parser of sessions would.
PackedJson session_json_of(FlatMesh flat) {
  PackedJson json;
  json.tree["elements"] = flat.rest.size() / 3;
  json.tree["rest"] = json.add({.reals = std::move(flat.rest)});
  json.tree["space"] = std::uint64_t(std::max<std::int64_t>(0, flat.space_dimension));
  const auto add = [&](const char* key, std::vector<std::uint32_t> ids) {
    json.tree[key] = json.add({.ids = std::move(ids)});
  };
  add("counts", lengths_of_rows(flat.first_entry));
  add("neighbours", std::move(flat.neighbours));
  add("triangles", std::move(flat.triangles));
  add("polygons", std::move(flat.polygons));
  add("tetrahedra", std::move(flat.tetrahedra));
  add("hexahedra", std::move(flat.hexahedra));
  if (flat.lattice) {
    json.tree["lattice"] = {{"size", flat.lattice->size}, {"spacing", flat.lattice->spacing}};
  }
  return json;
}

/// A session cannot contain them, so its reader does not look for them.
void check_finite(const FlatMesh& flat, const std::string& where) {
  const bool finite = std::ranges::all_of(flat.rest, [](double one) { return std::isfinite(one); }) &&
                      (!flat.lattice || std::isfinite(flat.lattice->spacing));
  if (!finite) {
    throw Error(where, "a coordinate is not a finite number", "give numbers");
  }
}

}  // namespace

FlatMesh flat_mesh_of(const Mesh& mesh) {
  FlatMesh flat{.rest = {},
                .first_entry = mesh.first_entry,
                .neighbours = mesh.neighbours,
                .triangles = flattened<3>(std::span(mesh.triangles).first(mesh.own_triangles)),
                .polygons = mesh.polygons,
                .tetrahedra = flattened<4>(mesh.tetrahedra),
                .hexahedra = flattened<8>(mesh.hexahedra),
                .lattice = mesh.lattice,
                .space_dimension = mesh.space_dimension};
  flat.rest.reserve(std::size_t{3} * mesh.element_count());
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    const Point point = mesh.rest_position(e);
    flat.rest.insert(flat.rest.end(), point.begin(), point.end());
  }
  return flat;
}

MeshPointer checked_mesh(FlatMesh flat, const std::string& where, const Progress& progress) {
  check_finite(flat, where);
  const PackedJson json = session_json_of(std::move(flat));
  return read_session_mesh(ObjectFields(where, &json.arrays), json.tree, progress);
}

}  // namespace chainmail
