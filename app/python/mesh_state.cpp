// Meshes as bytes, for another process: pickle, and with it Dask.
#include <pybind11/stl.h>

#include <algorithm>

#include "api/access.h"
#include "python/arrays.h"
#include "python/module.h"

namespace chainmail::python {
namespace {

template <std::size_t Columns>
std::vector<std::array<ElementId, Columns>> groups_of(const std::vector<ElementId>& flat) {
  std::vector<std::array<ElementId, Columns>> groups(flat.size() / Columns);
  for (std::size_t i = 0; i < groups.size() * Columns; ++i) {
    groups[i / Columns][i % Columns] = flat[i];
  }
  return groups;
}

template <std::size_t Columns>
py::array_t<ElementId> flat_array(std::span<const std::array<ElementId, Columns>> groups) {
  return array_of(std::span(groups.empty() ? nullptr : groups.front().data(), groups.size() * Columns));
}

/// The softness of links that a file makes stiffer.
py::list own_softness_of(const api::Mesh& mesh) {
  py::list rows;
  for (const auto& [link, softness] : api::Access::inside(mesh).softness) {
    rows.append(py::make_tuple(link, api::softness_of(softness)));
  }
  return rows;
}

py::object lattice_of(const chainmail::Mesh& mesh) {
  return mesh.lattice ? py::object(py::make_tuple(mesh.lattice->size, mesh.lattice->spacing)) : py::none();
}

/// Returns what the mesh is made of. The neighbour table keeps its order, on which results depend.
py::dict state_of(const api::Mesh& mesh) {
  const chainmail::Mesh& inside = *api::Access::pointer(mesh);
  py::dict state;
  state["rest"] = array_of(mesh.rest_positions(), 1);
  state["first_entry"] = array_of(inside.first_entry);
  state["neighbours"] = array_of(inside.neighbours);
  state["triangles"] = flat_array(mesh.triangles());
  state["polygons"] = array_of(inside.polygons);
  state["tetrahedra"] = flat_array(mesh.tetrahedra());
  state["hexahedra"] = flat_array(mesh.hexahedra());
  state["lattice"] = lattice_of(inside);
  state["space_dimension"] = inside.space_dimension;
  state["softness"] = own_softness_of(mesh);
  state["remark"] = mesh.remark();
  return state;
}

template <class Value>
Value part_of(const py::dict& state, const char* name) {
  return state[name].cast<Value>();
}

std::vector<ElementId> ids_in(const py::dict& state, const char* name) { return ids_of(state[name], "element"); }

/// Returns the parts. build_mesh finds the same axes and numbers of links again.
MeshParts parts_of(const py::dict& state) {
  MeshParts parts;
  const auto rest = part_of<py::array_t<double, py::array::c_style | py::array::forcecast>>(state, "rest");
  for (py::ssize_t at = 0; at + 2 < rest.size(); at += 3) {
    parts.rest.emplace_back(rest.data()[at], rest.data()[at + 1], rest.data()[at + 2]);
  }
  parts.first_entry = ids_in(state, "first_entry");
  parts.neighbours = ids_in(state, "neighbours");
  parts.triangles = groups_of<3>(ids_in(state, "triangles"));
  parts.polygons = ids_in(state, "polygons");
  parts.tetrahedra = groups_of<4>(ids_in(state, "tetrahedra"));
  parts.hexahedra = groups_of<8>(ids_in(state, "hexahedra"));
  if (const py::object lattice = state["lattice"]; !lattice.is_none()) {
    const auto [size, spacing] = lattice.cast<std::pair<std::array<std::uint32_t, 3>, double>>();
    parts.lattice = Lattice{size, spacing};
  }
  parts.space_dimension = part_of<int>(state, "space_dimension");
  return parts;
}

api::Mesh mesh_of(const py::dict& state) {
  OwnSoftness softness;
  for (const py::handle row : state["softness"]) {
    const auto [link, own] = row.cast<std::pair<LinkId, api::LinkSoftness>>();
    softness.set(link, api::softness_of(own));
  }
  return api::guarded([&] {
    return api::Access::mesh(build_mesh(parts_of(state)), std::move(softness), part_of<std::string>(state, "remark"));
  });
}

}  // namespace

void add_mesh_state(py::class_<api::Mesh>& mesh) { mesh.def(py::pickle(&state_of, &mesh_of)); }

}  // namespace chainmail::python
