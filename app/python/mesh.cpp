// Meshes: generated, from arrays, and from files.
#include <pybind11/stl/filesystem.h>

#include <functional>
#include <limits>

#include "files/mesh/mesh_arrays.h"
#include "files/mesh/open_mesh.h"
#include "mesh/generate.h"
#include "mesh/layers.h"
#include "python/arguments.h"
#include "python/long_work.h"
#include "python/module.h"
#include "python/pickling.h"

namespace chainmail::python {
namespace {

using MeshClass = py::class_<MeshObject, MeshObjectPointer>;

MeshObjectPointer object_of(MeshPointer mesh) { return std::make_shared<MeshObject>(MeshObject{std::move(mesh)}); }

/// Makes a function or a member of a mesh one of the Python class.
template <class Function>
auto on_mesh(Function function) {
  return [function](const MeshObject& one) { return std::invoke(function, *one.mesh); };
}

/// Returns a read-only array that shows groups of ids of a mesh and keeps the mesh alive.
template <std::size_t Columns>
py::array shown_groups(const MeshPointer& mesh, std::span<const std::array<ElementId, Columns>> rows) {
  return shown(rows.empty() ? nullptr : rows.front().data(), rows.size(), Columns, sizeof(rows[0]),
               kept<MeshPointer>(mesh));
}

py::array_t<double> rest_positions_of(const Mesh& mesh) {
  return array_of_points(mesh, [&](ElementId e) { return mesh.rest_position(e); });
}

py::array_t<double> rest_lengths_of(const Mesh& mesh) {
  py::array_t<double> lengths(mesh.link_count());
  double* out = lengths.mutable_data();
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    out[link] = rest_length(mesh, link);
  }
  return lengths;
}

std::string axes_of(const Mesh& mesh) {
  std::string axes;
  for (int k = 0; k < mesh.space_dimension; ++k) {
    axes += "xyz"[mesh.axes[std::size_t(k)]];
  }
  return axes;
}

std::string mesh_in_words(const Mesh& mesh) {
  static constexpr std::array<const char*, 4> kinds{"", "chain", "surface", "volume"};
  return "<Mesh: " + std::string(kinds[std::size_t(mesh.object_dimension)]) + " of " +
         std::to_string(mesh.element_count()) + " elements and " + std::to_string(mesh.link_count()) + " links along " +
         axes_of(mesh) + ">";
}

std::optional<LinkId> found_link(const MeshObject& one, Element a, Element b) {
  return find_link(*one.mesh, a.in(*one.mesh), b.in(*one.mesh));
}

std::uint32_t size_of(const py::object& value, const char* name) {
  const auto size = whole_of(value);
  if (!size || *size < 1 || *size > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(name, std::string(py::repr(value)).substr(0, 60) + " is no number of elements", "use a number from 1");
  }
  return static_cast<std::uint32_t>(*size);
}

MeshObjectPointer mesh_from(const py::object& positions, const py::object& links, const py::object& triangles,
                            const py::object& tetrahedra, const py::object& hexahedra,
                            std::optional<int> space_dimension) {
  const std::vector<double> rest = positions_of(positions);
  const auto pairs = rows_of(links, "links", 2);
  const auto faces = rows_of(triangles, "triangles", 3);
  const auto cells = rows_of(tetrahedra, "tetrahedra", 4);
  const auto blocks = rows_of(hexahedra, "hexahedra", 8);
  const Unlocked unlocked;
  return object_of(make_mesh({rest, pairs, faces, cells, blocks, space_dimension}));
}

void add_content(MeshClass& mesh) {
  mesh.def_property_readonly("element_count", on_mesh(&Mesh::element_count),
                             "Number of elements. Their ids are 0 to element_count - 1.")
      .def_property_readonly("link_count", on_mesh(&Mesh::link_count),
                             "Number of links. Their ids are 0 to link_count - 1.")
      .def_property_readonly(
          "links", [](const MeshObject& one) { return shown_groups(one.mesh, std::span(one.mesh->links)); },
          "The two elements of each link, the smaller id first: shape (link_count, 2), dtype uint32. A read-only\n"
          "view.")
      .def_property_readonly(
          "triangles",
          [](const MeshObject& one) {
            return shown_groups(one.mesh, std::span(one.mesh->triangles).first(one.mesh->own_triangles));
          },
          "Corners of the triangles: shape (n, 3), dtype uint32. A read-only view.")
      .def_property_readonly(
          "tetrahedra", [](const MeshObject& one) { return shown_groups(one.mesh, std::span(one.mesh->tetrahedra)); },
          "Corners of the tetrahedra: shape (n, 4), dtype uint32. A read-only view.")
      .def_property_readonly(
          "hexahedra", [](const MeshObject& one) { return shown_groups(one.mesh, std::span(one.mesh->hexahedra)); },
          "Corners of the hexahedra: shape (n, 8), dtype uint32. A read-only view.")
      .def("rest_positions", on_mesh(&rest_positions_of),
           "Returns the positions at rest: shape (element_count, 3), dtype float64 (mesh units). A copy.")
      .def(
          "rest_position",
          [](const MeshObject& one, Element element) {
            return tuple_of(one.mesh->rest_position(element.in(*one.mesh)));
          },
          py::arg("element"), "Returns the position (x, y, z) of an element at rest (mesh units).")
      .def("rest_lengths", on_mesh(&rest_lengths_of),
           "Returns the length of each link at rest: shape (link_count,), dtype float64 (mesh units). A copy.");
}

void add_connectivity(MeshClass& mesh) {
  mesh.def(
          "neighbours",
          [](const MeshObject& one, Element element) {
            return array_of(one.mesh->neighbours_of(element.in(*one.mesh)));
          },
          py::arg("element"),
          "Returns the elements that an element is linked to: in the order of the file if it lists them (.dat),\n"
          "otherwise ascending. Shape (n,), dtype uint32. A copy.")
      .def(
          "link",
          [](const MeshObject& one, Link link) {
            const auto [first, second] = one.mesh->links[link.in(*one.mesh)];
            return py::make_tuple(first, second);
          },
          py::arg("link"), "Returns the two elements of a link, the smaller id first.")
      .def("find_link", &found_link, py::arg("a"), py::arg("b"),
           "Returns the id of the link between two elements, or None.")
      .def(
          "side", [](const MeshObject& one, const std::string& name) { return array_of(elements_at(*one.mesh, name)); },
          py::arg("name"),
          "Returns the elements at a side, ascending: shape (n,), dtype uint32.\n\n"
          "The sides are left (lowest x), right, bottom (lowest y), top, back (lowest z), front and boundary (outer\n"
          "surface, open edges or ends). Raises Error for another name, and if the mesh has no such side.");
}

void add_facts(MeshClass& mesh) {
  mesh.def_property_readonly("mean_rest_length", on_mesh(&Mesh::mean_link_length),
                             "Mean length of the links at rest (mesh units); 0 without links.")
      .def_property_readonly(
          "bounds", on_mesh([](const Mesh& one) { return py::make_tuple(tuple_of(one.box[0]), tuple_of(one.box[1])); }),
          "Lowest and highest corner (x, y, z) of the box around the rest positions (mesh units).")
      .def_property_readonly("object_dimension", on_mesh(&Mesh::object_dimension),
                             "1 for a chain, 2 for a surface, 3 for a volume.")
      .def_property_readonly("space_dimension", on_mesh(&Mesh::space_dimension),
                             "Number of coordinates that exist: on a line there is no y, in a plane no z.")
      .def_property_readonly("axes", on_mesh(&axes_of), "The axes that exist: 'xyz', or 'xy' in a plane.")
      .def_property_readonly("part_count", on_mesh(&Mesh::part_count), "Number of parts that no link joins.")
      .def_property_readonly("lattice", on_mesh([](const Mesh& one) -> py::object {
                               return one.lattice ? py::object(py::tuple(py::cast(one.lattice->size))) : py::none();
                             }),
                             "Numbers of elements along x, y and z, if the elements are in a lattice, or None.")
      .def_property_readonly("is_grid", on_mesh(&Mesh::is_grid),
                             "True for a lattice whose links run along the axes only. 3D ChainMail needs one.")
      .def_property_readonly(
          "remark", [](const MeshObject& one) { return one.remark; },
          "What the reader of a file remarks about it. Usually empty.")
      .def("__eq__",
           [](const MeshObject& one, const py::object& other) {
             return py::isinstance<MeshObject>(other) && one.mesh == other.cast<const MeshObject&>().mesh;
           })
      .def("__hash__", [](const MeshObject& one) { return std::hash<MeshPointer>()(one.mesh); })
      .def("__repr__", on_mesh(&mesh_in_words));
}

/// Adds a function that generates a mesh of a kind. `sizes` are the names of its first arguments.
template <class... Name>
void add_generator(py::module_& module, const char* name, MeshKind kind, const char* help, Name... sizes) {
  const auto make = [=](std::conditional_t<true, const py::object&, Name>... given, double spacing,
                        std::optional<int> space_dimension) {
    MeshRecipe recipe{kind, {1, 1, 1}, spacing, space_dimension};
    std::size_t i = 0;
    ((recipe.size[i++] = size_of(given, sizes)), ...);
    return object_of(generate(recipe));
  };
  module.def(name, make, py::arg(sizes)..., py::kw_only(), py::arg("spacing") = MeshRecipe().spacing,
             py::arg("space_dimension") = py::none(), help);
}

void add_generators(py::module_& module) {
  add_generator(
      module, "make_line", MeshKind::line,
      "Returns a chain of elements along x.\n\n"
      "`spacing` is the distance between neighbours (mesh units), above 0. `space_dimension` is the number of\n"
      "coordinates, 1 to 3: 3 lets the object leave its line or plane. Default: as many as it extends along.",
      "length");
  add_generator(module, "make_grid", MeshKind::grid,
                "Returns a grid in the plane of x and y, with links along the axes. See make_line() for the options.",
                "width", "height");
  add_generator(module, "make_cloth", MeshKind::cloth,
                "Returns a sheet of triangles: a grid whose squares are split by a diagonal. See make_line() for\n"
                "the options.",
                "width", "height");
  add_generator(module, "make_block", MeshKind::block,
                "Returns a block of elements with links along the three axes. See make_line() for the options.",
                "width", "height", "depth");
  add_generator(module, "make_tetra", MeshKind::tetra,
                "Returns a block of tetrahedra: each cube is split into six. See make_line() for the options.", "width",
                "height", "depth");
}

// Files

MeshObjectPointer read_mesh(const std::filesystem::path& path,
                            const std::optional<std::array<std::uint32_t, 3>>& lattice, std::optional<double> spacing,
                            std::optional<int> space_dimension, std::optional<double> threshold,
                            std::optional<std::uint32_t> every, bool data_outside, bool stiff_where_dense,
                            std::optional<double> weld, const std::string& import_program, const Progress* job,
                            const py::object& progress) {
  ReadOptions options;
  options.size = lattice;
  options.spacing = spacing;
  options.space_dimension = space_dimension;
  options.voxels.threshold = threshold;
  options.voxels.every = every;
  options.voxels.stiff_where_dense = stiff_where_dense;
  options.data_outside = data_outside;
  options.weld = weld;
  options.import_program = import_program;
  OpenedMesh opened = run_long(job, progress, [&](const Progress& run) { return open_mesh(path, options, run); });
  const std::string flaws = in_words(opened.flaws);
  const char* const between = opened.remark.empty() || flaws.empty() ? "" : "; ";
  return std::make_shared<MeshObject>(
      MeshObject{std::move(opened.mesh), std::move(opened.softness), opened.remark + between + flaws});
}

void write_state(const std::filesystem::path& path, const MeshState& state) {
  run_long(nullptr, py::none(), [&](const Progress& run) { save_mesh(path, state, run); });
}

void write_body(const std::filesystem::path& path, const Used<Object>& object) {
  const Body& body = object->body();
  write_state(path, {body.mesh(), body.cuts(), body.positions(), body.softness()});
}

void write_rest(const std::filesystem::path& path, const MeshObject& mesh) {
  const Softness softness{{}, mesh.softness};
  write_state(path, {*mesh.mesh, Cuts(), rest_positions(*mesh.mesh), softness});
}

py::list rows_of_formats() {
  py::list rows;
  for (const MeshFormat& format : mesh_formats()) {
    const py::str endings(format.endings.data(), format.endings.size());
    rows.append(py::dict(py::arg("name") = format.name, py::arg("endings") = endings.attr("split")(),
                         py::arg("content") = format.help, py::arg("reads") = format.reads(),
                         py::arg("writes") = format.writes(), py::arg("holds_positions") = format.holds_positions));
  }
  return rows;
}

void add_files(py::module_& module) {
  module.def("read_mesh", &read_mesh, py::arg("path"), py::kw_only(), py::arg("lattice") = py::none(),
             py::arg("spacing") = py::none(), py::arg("space_dimension") = py::none(),
             py::arg("threshold") = py::none(), py::arg("every") = py::none(),
             py::arg("data_outside") = ReadOptions().data_outside,
             py::arg("stiff_where_dense") = ReadOptions().voxels.stiff_where_dense, py::arg("weld") = py::none(),
             py::arg("import_program") = "", py::arg("job") = py::none(), py::arg("progress") = py::none(),
             "Reads a mesh; chainmail.read_mesh() also finds the import program.");
  module.def(
      "write_mesh", &write_body, py::arg("path"), py::arg("body"),
      "Writes an object with its cuts at its current positions, in the format of the file's ending: faces, cells\n"
      "and links (.obj, .ply, .vtu, .msh, .dat), or a table `id,x,y,z` of positions (.csv). A mesh is written at\n"
      "rest. If writing fails, the old file stays. Raises Error if the format is not known or cannot store the\n"
      "object, or if the file cannot be written.");
  module.def("write_mesh", &write_rest, py::arg("path"), py::arg("mesh"));
  module.def(
      "file_formats", &rows_of_formats,
      "Returns all formats of files, a dictionary each: name, endings (the first one is used for writing), content,\n"
      "reads, writes, and holds_positions (False if it stores links only).");
}

}  // namespace

void add_mesh(py::module_& module) {
  MeshClass mesh(module, "Mesh",
                 "An object at rest: elements, the links between them, faces and cells. It does not change.\n\n"
                 "Every function that takes an id raises Error if there is no such element or link.");
  add_content(mesh);
  add_connectivity(mesh);
  add_facts(mesh);
  add_mesh_pickling(mesh);
  add_generators(module);
  add_files(module);
  module.def(
      "make_mesh", &mesh_from, py::arg("positions"), py::arg("links") = py::none(), py::kw_only(),
      py::arg("triangles") = py::none(), py::arg("tetrahedra") = py::none(), py::arg("hexahedra") = py::none(),
      py::arg("space_dimension") = py::none(),
      "Returns a mesh from arrays, which are copied.\n\n"
      "`positions` has the shape (n, 3), (n, 2) or (n, 1): x, y and z at rest (mesh units). The others are ids:\n"
      "`links` (m, 2), `triangles` (k, 3), `tetrahedra` (k, 4) and `hexahedra` (k, 8). The edges of faces and cells\n"
      "are links, too. Raises Error for a wrong shape or type, a coordinate that is not finite, an id without a\n"
      "position, a link, face or cell that uses an element twice or is there twice, and if there is no link.");
}

}  // namespace chainmail::python
