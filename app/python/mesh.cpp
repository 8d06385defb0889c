#include "chainmail/mesh.h"

#include <pybind11/operators.h>
#include <pybind11/stl.h>

#include <limits>

#include "chainmail/error.h"
#include "python/arrays.h"
#include "python/module.h"
#include "python/pickling.h"
#include "python/unlocked.h"

namespace chainmail::python {
namespace {

/// Returns a read-only array that shows data of a mesh and keeps the mesh alive.
template <class Number>
py::array shown(const api::Mesh& mesh, const Number* first, std::size_t rows, std::size_t columns) {
  const py::capsule owner(new api::Mesh(mesh), [](void* owned) { delete static_cast<api::Mesh*>(owned); });
  py::array array(py::dtype::of<Number>(), {py::ssize_t(rows), py::ssize_t(columns)}, {}, first, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

template <std::size_t Columns>
py::array shown(const api::Mesh& mesh, std::span<const std::array<api::ElementId, Columns>> rows) {
  return shown(mesh, rows.empty() ? nullptr : rows.front().data(), rows.size(), Columns);
}

py::array_t<double> rest_lengths_of(const api::Mesh& mesh) {
  py::array_t<double> lengths(mesh.link_count());
  double* out = lengths.mutable_data();
  for (api::LinkId link = 0; link < mesh.link_count(); ++link) {
    out[link] = mesh.rest_length(link);
  }
  return lengths;
}

std::string mesh_in_words(const api::Mesh& mesh) {
  static constexpr std::array<const char*, 4> kinds{"", "chain", "surface", "volume"};
  return "<Mesh: " + std::string(kinds[std::size_t(mesh.object_dimension())]) + " of " +
         std::to_string(mesh.element_count()) + " elements and " + std::to_string(mesh.link_count()) + " links along " +
         mesh.axes() + ">";
}

api::LatticeOptions lattice_options(double spacing, std::optional<int> space_dimension) {
  return {spacing, space_dimension};
}

std::uint32_t size_of(const py::object& value, const char* name) {
  const auto size = whole_of(value);
  if (!size || *size < 1 || *size > std::numeric_limits<std::uint32_t>::max()) {
    throw api::Error(name, std::string(py::repr(value)).substr(0, 60) + " is no number of elements",
                     "use a number from 1");
  }
  return static_cast<std::uint32_t>(*size);
}

api::Mesh mesh_from(const py::object& positions, const py::object& links, const py::object& triangles,
                    const py::object& tetrahedra, const py::object& hexahedra, std::optional<int> space_dimension) {
  const std::vector<double> rest = positions_of(positions);
  const auto pairs = rows_of(links, "links", 2);
  const auto faces = rows_of(triangles, "triangles", 3);
  const auto cells = rows_of(tetrahedra, "tetrahedra", 4);
  const auto blocks = rows_of(hexahedra, "hexahedra", 8);
  const Unlocked unlocked;
  return api::make_mesh({rest, pairs, faces, cells, blocks, space_dimension});
}

void add_content(py::class_<api::Mesh>& mesh) {
  mesh.def_property_readonly("element_count", &api::Mesh::element_count,
                             "Number of elements. Their ids are 0 to element_count - 1.")
      .def_property_readonly("link_count", &api::Mesh::link_count,
                             "Number of links. Their ids are 0 to link_count - 1.")
      .def_property_readonly(
          "links", [](const api::Mesh& one) { return shown(one, one.links()); },
          "The two elements of each link, the smaller id first: shape (link_count, 2), dtype uint32.\n"
          "A read-only view.")
      .def_property_readonly(
          "triangles", [](const api::Mesh& one) { return shown(one, one.triangles()); },
          "Corners of the triangles: shape (n, 3), dtype uint32. A read-only view.")
      .def_property_readonly(
          "tetrahedra", [](const api::Mesh& one) { return shown(one, one.tetrahedra()); },
          "Corners of the tetrahedra: shape (n, 4), dtype uint32. A read-only view.")
      .def_property_readonly(
          "hexahedra", [](const api::Mesh& one) { return shown(one, one.hexahedra()); },
          "Corners of the hexahedra: shape (n, 8), dtype uint32. A read-only view.")
      .def(
          "rest_positions", [](const api::Mesh& one) { return array_of(one.rest_positions(), 3); },
          "Returns the positions at rest: shape (element_count, 3), dtype float64 (mesh units). A copy.")
      .def(
          "rest_position",
          [](const api::Mesh& one, const py::object& id) { return tuple_of(one.rest_position(id_of(id, "element"))); },
          py::arg("element"), "Returns the position (x, y, z) of an element at rest (mesh units).")
      .def("rest_lengths", &rest_lengths_of,
           "Returns the length of each link at rest: shape (link_count,), dtype float64 (mesh units). A copy.");
}

void add_connectivity(py::class_<api::Mesh>& mesh) {
  mesh.def(
          "neighbours",
          [](const api::Mesh& one, const py::object& id) { return array_of(one.neighbours(id_of(id, "element"))); },
          py::arg("element"),
          "Returns the elements that an element is linked to: in the order of the file if it lists them (.dat),\n"
          "otherwise ascending. Shape (n,), dtype uint32. A copy.")
      .def(
          "link",
          [](const api::Mesh& one, const py::object& id) {
            const auto ends = one.link(id_of(id, "link"));
            return py::make_tuple(ends[0], ends[1]);
          },
          py::arg("link"), "Returns the two elements of a link, the smaller id first.")
      .def(
          "find_link",
          [](const api::Mesh& one, const py::object& a, const py::object& b) {
            return one.find_link(id_of(a, "element"), id_of(b, "element"));
          },
          py::arg("a"), py::arg("b"), "Returns the id of the link between two elements, or None.")
      .def(
          "side", [](const api::Mesh& one, const std::string& name) { return array_of(one.side(name)); },
          py::arg("name"),
          "Returns the elements at a side, ascending: shape (n,), dtype uint32.\n\n"
          "The sides are left (lowest x), right, bottom (lowest y), top, back (lowest z), front and boundary (outer\n"
          "surface, open edges or ends). Raises Error for another name, and if the mesh has no such side.");
}

void add_facts(py::class_<api::Mesh>& mesh) {
  mesh.def_property_readonly("mean_rest_length", &api::Mesh::mean_rest_length,
                             "Mean length of the links at rest (mesh units); 0 without links.")
      .def_property_readonly(
          "bounds",
          [](const api::Mesh& one) { return py::make_tuple(tuple_of(one.bounds()[0]), tuple_of(one.bounds()[1])); },
          "Lowest and highest corner (x, y, z) of the box around the rest positions (mesh units).")
      .def_property_readonly("object_dimension", &api::Mesh::object_dimension,
                             "1 for a chain, 2 for a surface, 3 for a volume.")
      .def_property_readonly("space_dimension", &api::Mesh::space_dimension,
                             "Number of coordinates that exist: on a line there is no y, in a plane no z.")
      .def_property_readonly("axes", &api::Mesh::axes, "The axes that exist: 'xyz', or 'xy' in a plane.")
      .def_property_readonly("part_count", &api::Mesh::part_count, "Number of parts that no link joins.")
      .def_property_readonly(
          "lattice",
          [](const api::Mesh& one) -> py::object {
            const auto size = one.lattice();
            return size ? py::object(py::make_tuple((*size)[0], (*size)[1], (*size)[2])) : py::none();
          },
          "Numbers of elements along x, y and z, if the elements are in a lattice, or None.")
      .def_property_readonly("is_grid", &api::Mesh::is_grid,
                             "True for a lattice whose links run along the axes only. 3D ChainMail needs one.")
      .def_property_readonly("remark", &api::Mesh::remark, "What the reader of a file remarks about it. Usually empty.")
      .def("__eq__",
           [](const api::Mesh& one, const py::object& other) {
             return py::isinstance<api::Mesh>(other) && one == other.cast<const api::Mesh&>();
           })
      .def("__hash__", [](const api::Mesh& one) { return std::hash<const void*>()(one.identity()); })
      .def("__repr__", &mesh_in_words);
}

void add_generators(py::module_& module) {
  const py::arg_v spacing_argument = py::arg("spacing") = 1.0;
  const py::arg_v space_argument = py::arg("space_dimension") = py::none();
  module.def(
      "make_line",
      [](const py::object& length, double spacing, std::optional<int> space) {
        return api::make_line(size_of(length, "length"), lattice_options(spacing, space));
      },
      py::arg("length"), py::kw_only(), spacing_argument, space_argument,
      "Returns a chain of elements along x.\n\n"
      "`spacing` is the distance between neighbours (mesh units), above 0. `space_dimension` is the number of\n"
      "coordinates, 1 to 3: 3 lets the object leave its line or plane. Default: as many as it extends along.");
  module.def(
      "make_grid",
      [](const py::object& width, const py::object& height, double spacing, std::optional<int> space) {
        return api::make_grid(size_of(width, "width"), size_of(height, "height"), lattice_options(spacing, space));
      },
      py::arg("width"), py::arg("height"), py::kw_only(), spacing_argument, space_argument,
      "Returns a grid in the plane of x and y, with links along the axes. See make_line() for the options.");
  module.def(
      "make_cloth",
      [](const py::object& width, const py::object& height, double spacing, std::optional<int> space) {
        return api::make_cloth(size_of(width, "width"), size_of(height, "height"), lattice_options(spacing, space));
      },
      py::arg("width"), py::arg("height"), py::kw_only(), spacing_argument, space_argument,
      "Returns a sheet of triangles: a grid whose squares are split by a diagonal. See make_line() for the options.");
  module.def(
      "make_block",
      [](const py::object& width, const py::object& height, const py::object& depth, double spacing,
         std::optional<int> space) {
        return api::make_block(size_of(width, "width"), size_of(height, "height"), size_of(depth, "depth"),
                               lattice_options(spacing, space));
      },
      py::arg("width"), py::arg("height"), py::arg("depth"), py::kw_only(), spacing_argument, space_argument,
      "Returns a block of elements with links along the three axes. See make_line() for the options.");
  module.def(
      "make_tetra",
      [](const py::object& width, const py::object& height, const py::object& depth, double spacing,
         std::optional<int> space) {
        return api::make_tetra(size_of(width, "width"), size_of(height, "height"), size_of(depth, "depth"),
                               lattice_options(spacing, space));
      },
      py::arg("width"), py::arg("height"), py::arg("depth"), py::kw_only(), spacing_argument, space_argument,
      "Returns a block of tetrahedra: each cube is split into six. See make_line() for the options.");
}

}  // namespace

void add_mesh(py::module_& module) {
  py::class_<api::Mesh> mesh(
      module, "Mesh",
      "An object at rest: elements, the links between them, faces and cells. It does not change.\n\n"
      "Every function that takes an id raises Error if there is no such element or link.");
  add_content(mesh);
  add_connectivity(mesh);
  add_facts(mesh);
  add_mesh_pickling(mesh);
  add_generators(module);
  module.def(
      "make_mesh", &mesh_from, py::arg("positions"), py::arg("links") = py::none(), py::kw_only(),
      py::arg("triangles") = py::none(), py::arg("tetrahedra") = py::none(), py::arg("hexahedra") = py::none(),
      py::arg("space_dimension") = py::none(),
      "Returns a mesh from arrays, which are copied.\n\n"
      "`positions` has the shape (n, 3), (n, 2) or (n, 1): x, y and z at rest (mesh units). The others are ids:\n"
      "`links` (m, 2), `triangles` (k, 3), `tetrahedra` (k, 4) and `hexahedra` (k, 8). The edges of faces and\n"
      "cells are links, too. Raises Error for a wrong shape or type, a coordinate that is not finite, an id\n"
      "without a position, a link, face or cell that uses an element twice or is there twice, and if there is\n"
      "no link.");
}

}  // namespace chainmail::python
