// Meshes as bytes, for another process: pickle, and with it Dask.
#include <pybind11/stl.h>

#include "api/access.h"
#include "files/session/flat_mesh.h"
#include "python/arrays.h"
#include "python/module.h"
#include "python/own_softness.h"
#include "python/pickling.h"

namespace chainmail::python {
namespace {

/// The softness of links that a file makes stiffer.
py::list own_softness_of(const api::Mesh& mesh) {
  py::list rows;
  for (const auto& [link, softness] : api::Access::impl(mesh).softness) {
    rows.append(py::make_tuple(link, api::softness_of(softness)));
  }
  return rows;
}

py::object lattice_of(const chainmail::Mesh& mesh) {
  return mesh.lattice ? py::object(py::make_tuple(mesh.lattice->size, mesh.lattice->spacing)) : py::none();
}

/// Returns what the mesh is made of. The neighbour table keeps its order, on which results depend.
py::object state_of(const api::Mesh& mesh) {
  const FlatMesh flat = flat_mesh_of(*api::Access::pointer(mesh));
  py::dict state;
  state["rest"] = bytes_of(flat.rest);
  state["first_entry"] = bytes_of(flat.first_entry);
  state["neighbours"] = bytes_of(flat.neighbours);
  state["triangles"] = bytes_of(flat.triangles);
  state["polygons"] = bytes_of(flat.polygons);
  state["tetrahedra"] = bytes_of(flat.tetrahedra);
  state["hexahedra"] = bytes_of(flat.hexahedra);
  state["lattice"] = lattice_of(*api::Access::pointer(mesh));
  state["space_dimension"] = flat.space_dimension;
  state["softness"] = own_softness_of(mesh);
  state["remark"] = mesh.remark();
  return state;
}

FlatMesh flat_mesh_from(const StateFields& state) {
  using SizeAndSpacing = std::pair<std::array<std::uint32_t, 3>, double>;
  FlatMesh flat{.rest = state.reals("rest"),
                .first_entry = state.ids("first_entry"),
                .neighbours = state.ids("neighbours"),
                .triangles = state.ids("triangles"),
                .polygons = state.ids("polygons"),
                .tetrahedra = state.ids("tetrahedra"),
                .hexahedra = state.ids("hexahedra"),
                .lattice = {},
                .space_dimension = state.get<std::int64_t>("space_dimension")};
  if (const auto lattice = state.get<std::optional<SizeAndSpacing>>("lattice")) {
    flat.lattice = Lattice{lattice->first, lattice->second};
  }
  return flat;
}

/// Returns the softness of links that exist.
OwnSoftness softness_of_links_from(const StateFields& state, const chainmail::Mesh& mesh) {
  std::vector<std::pair<LinkId, chainmail::LinkSoftness>> entries;
  for (const auto& [link, softness] : state.get<std::vector<std::pair<LinkId, api::LinkSoftness>>>("softness")) {
    check_links(mesh, std::span(&link, 1));
    entries.emplace_back(link, api::softness_of(softness));
    check(entries.back().second);
  }
  return grouped(std::move(entries));
}

api::Mesh mesh_of(const py::object& parts) {
  const StateFields state("Mesh", parts);
  return api::guarded([&] {
    MeshPointer mesh = checked_mesh(flat_mesh_from(state), state.where());
    OwnSoftness softness = softness_of_links_from(state, *mesh);
    return api::Access::mesh(std::move(mesh), std::move(softness), state.get<std::string>("remark"));
  });
}

}  // namespace

void add_mesh_state(py::class_<api::Mesh>& mesh) {
  add_pickling(mesh, &state_of, &mesh_of);
  const py::object as_object = mesh.attr("__reduce__");
  set_reduction(mesh, [as_object](const py::object& self) -> py::object {
    const py::object shared = shared_mesh(self);
    // Another object stands for this mesh: copy.copy() returns that one, since a mesh does not change.
    return shared.is(self) ? as_object(self)
                           : py::make_tuple(py::module_::import("copy").attr("copy"), py::make_tuple(shared));
  });
  mesh.def("__copy__", [](const py::object& self) { return self; });
  mesh.def(
      "__deepcopy__", [](const py::object& self, const py::object& /*memo*/) { return self; }, py::arg("memo"));
}

}  // namespace chainmail::python
