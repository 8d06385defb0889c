// Figures of a body, and reference solutions.
#include "files/formats/mesh_state.h"
#include "measure/distance.h"
#include "measure/physical_error.h"
#include "measure/violation.h"
#include "python/arguments.h"
#include "python/long_work.h"
#include "python/module.h"
#include "python/pickling.h"

namespace chainmail::python {
namespace {

/// A reference solution, with the mesh that it belongs to.
struct ReferenceObject {
  MeshPointer mesh;
  ReferenceSolution solution;
};

template <class Figures>
py::dict max_and_rms(const Figures& figures) {
  return py::dict(py::arg("max") = figures.max, py::arg("rms") = figures.rms);
}

py::dict errors_in(const PhysicalError& error) {
  return py::dict(py::arg("relative") = error.relative, py::arg("rms") = error.rms, py::arg("max") = error.max);
}

/// Computes a figure of a body without the lock of Python.
template <class Figure>
auto figure_of(const Used<Object>& object, Figure figure) {
  const Unlocked unlocked;
  return figure(std::as_const(object->body()));
}

py::object violation(const Used<Object>& object, const std::optional<Link>& link) {
  if (link) {
    return py::float_(figure_of(object, [&](const Body& body) { return link_violation(body, link->number); }));
  }
  const Violation all = figure_of(object, [](const Body& body) { return measure_violation(body); });
  py::dict numbers = max_and_rms(all);
  numbers["fraction"] = all.fraction;
  numbers["links"] = all.links;
  return numbers;
}

Distance distance_to_positions(const Used<Object>& object, const py::object& values) {
  const std::vector<double> positions = positions_on(object->mesh(), values);
  return figure_of(object, [&](const Body& body) {
    const Mesh& mesh = body.mesh();
    const std::vector<double> other = coordinates_of(mesh, positions, Precision::double_precision);
    const std::size_t bytes = sizeof(double) * std::size_t(mesh.space_dimension);
    return measure_distance(mesh, body.positions(), PositionView{other.data(), bytes, Precision::double_precision});
  });
}

Distance distance_between(const Used<Object>& one, Object& other) {
  const Body& second = other.body();
  return figure_of(one, [&](const Body& body) {
    if (body.mesh_pointer() != second.mesh_pointer()) {
      throw Error("distance", "the two objects have different meshes", "use two bodies of one mesh");
    }
    return measure_distance(body.mesh(), body.positions(), second.positions());
  });
}

py::dict distance(const Used<Object>& object, const py::object& other) {
  if (!py::isinstance<Object>(other)) {
    return max_and_rms(distance_to_positions(object, other));
  }
  auto& second = other.cast<Object&>();
  if (&second == &*object) {
    return max_and_rms(distance_between(object, second));
  }
  return max_and_rms(distance_between(object, *Used(second)));
}

ReferenceObject solve_reference(const Used<Object>& object, const Elements& handle, const Progress* job,
                                const py::object& progress) {
  const Body& body = object->body();
  return {body.mesh_pointer(),
          run_long(job, progress, [&](const Progress& run) { return reference_solution(body, handle, run); })};
}

py::array_t<double> positions_of_solution(const ReferenceObject& one) {
  const Mesh& mesh = *one.mesh;
  std::vector<double> all = mesh.rest;
  std::ranges::transform(all, one.solution.displacements, all.begin(), std::plus<>());
  return array_of_points(
      mesh, [&](ElementId e) { return mesh.to_point(&all[std::size_t{e} * std::size_t(mesh.space_dimension)]); });
}

py::dict error_of(const Used<Object>& object, const ReferenceObject& reference) {
  return errors_in(figure_of(object, [&](const Body& body) {
    if (reference.mesh != body.mesh_pointer()) {
      throw Error("reference solution", "it is of another mesh", "compute it for this object");
    }
    return measure_physical_error(body.mesh(), body.positions(), reference.solution);
  }));
}

void add_figures(py::module_& module) {
  module.def(
      "violation", &violation, py::arg("body"), py::arg("link") = py::none(),
      "Returns how far links lie outside their valid regions, in rest lengths of the link. Cut links do not count.\n\n"
      "Without a link, a dictionary: the largest violation `max`, the root of the mean square `rms`, the share\n"
      "`fraction` of the links that are violated by more than 1e-4, and the number of measured `links`. With a\n"
      "link, its violation.");
  module.def(
      "displacement",
      [](const Used<Object>& object) {
        return max_and_rms(
            figure_of(object, [](const Body& body) { return measure_displacement(body.mesh(), body.positions()); }));
      },
      py::arg("body"),
      "Returns the displacement of the elements from rest (mesh units): a dictionary with the largest one `max` and\n"
      "the root of the mean square `rms`.");
  module.def("distance", &distance, py::arg("body"), py::arg("other"),
             "Returns the distance between the elements of two states of the same mesh, in mean rest lengths: a\n"
             "dictionary with `max` and `rms`. `other` is a body, or positions of the shape (element_count, 3).\n"
             "Raises Error if the meshes or shapes differ.");
  module.def(
      "elastic_energy",
      [](const Used<Object>& object) {
        return figure_of(object, [](const Body& body) { return elastic_energy(body); });
      },
      py::arg("body"), "Returns the elastic energy of the body's kind over the uncut links (see the C++ interface).");
}

void add_reference(py::module_& module) {
  py::class_<ReferenceObject> reference(
      module, "ReferenceSolution",
      "The positions that a neo-Hookean elastic object has: converged finite elements on the object's own cells or\n"
      "faces.");
  reference
      .def("positions", &positions_of_solution,
           "Returns the positions: shape (element_count, 3), dtype float64 (mesh units). A copy.")
      .def_property_readonly(
          "handle_displacement", [](const ReferenceObject& one) { return one.solution.handle_displacement; },
          "Largest displacement of an element of the handle (mesh units).")
      .def("__repr__", [](const ReferenceObject&) { return "<ReferenceSolution>"; });
  refuse_pickling(reference, "it belongs to a mesh of this process",
                  "pickle its positions(), or compute it again there");
  module.def(
      "reference_solution", &solve_reference, py::arg("body"), py::arg("handle"), py::kw_only(),
      py::arg("job") = py::none(), py::arg("progress") = py::none(),
      "Returns the reference solution with the pins and these elements, the handle, at their current positions.\n\n"
      "`progress` is called with the share that is done, 0 to 1. Raises Error if an element does not exist, is\n"
      "given twice or is pinned, if the handle is at rest, if there are no cells or faces, if the pins are too few,\n"
      "or if it does not converge; and Cancelled.");
  module.def(
      "physical_error", &error_of, py::arg("body"), py::arg("reference"),
      "Returns the error of the current positions: a dictionary with `relative` (RMS of the error over RMS of the\n"
      "reference's displacements), and `rms` and `max` (over the handle's displacement).");
  module.def(
      "physical_error_of_rest",
      [](const ReferenceObject& one) { return errors_in(error_of_nothing_moving(*one.mesh, one.solution)); },
      py::arg("reference"), "Returns the error of an object of which only handle and pins move, as physical_error().");
}

}  // namespace

void add_measure(py::module_& module) {
  add_figures(module);
  add_reference(module);
}

}  // namespace chainmail::python
