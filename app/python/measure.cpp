#include "chainmail/measure.h"

#include <pybind11/stl.h>

#include "python/arrays.h"
#include "python/long_work.h"
#include "python/module.h"
#include "python/pickling.h"
#include "python/unlocked.h"

namespace chainmail::python {
namespace {

py::dict named(const api::Spread& spread) {
  py::dict numbers;
  numbers["max"] = spread.max;
  numbers["rms"] = spread.rms;
  return numbers;
}

py::dict named(const api::PhysicalError& error) {
  py::dict numbers;
  numbers["relative"] = error.relative;
  numbers["rms"] = error.rms;
  numbers["max"] = error.max;
  return numbers;
}

py::dict named(const api::Violation& violation) {
  py::dict numbers;
  numbers["max"] = violation.max;
  numbers["rms"] = violation.rms;
  numbers["fraction"] = violation.fraction;
  numbers["links"] = violation.links;
  return numbers;
}

/// Computes a figure of a body without the lock of Python.
template <class Figure>
auto figure_of(Object& object, Figure figure) {
  const UseObject use(object);
  const Unlocked unlocked;
  return figure(std::as_const(object.body()));
}

api::Spread distance_to_positions(Object& object, const py::object& values) {
  const UseObject use(object);
  const std::vector<double> positions = positions_on(object.body().mesh(), values);
  const Unlocked unlocked;
  return api::distance(object.body(), positions);
}

py::dict distance(Object& object, const py::object& other) {
  if (!py::isinstance<Object>(other)) {
    return named(distance_to_positions(object, other));
  }
  Object& second = other.cast<Object&>();
  if (&second == &object) {
    return named(figure_of(object, [](const api::Body& body) { return api::distance(body, body); }));
  }
  const UseObject use(second);
  return named(figure_of(object, [&](const api::Body& body) { return api::distance(body, second.body()); }));
}

api::ReferenceSolution reference_solution(Object& object, const py::object& handle, const std::optional<api::Job>& job,
                                          const py::object& progress) {
  const UseObject use(object);
  const auto ids = ids_of(handle, "element");
  const api::Job watched = job.value_or(api::Job());
  return run_long(watched, progress, [&] { return api::reference_solution(object.body(), ids, watched); });
}

void add_figures(py::module_& module) {
  module.def(
      "violation",
      [](Object& object, const py::object& link) -> py::object {
        if (!link.is_none()) {
          const std::uint32_t id = id_of(link, "link");
          return py::float_(figure_of(object, [id](const api::Body& body) { return api::violation(body, id); }));
        }
        return named(figure_of(object, [](const api::Body& body) { return api::violation(body); }));
      },
      py::arg("body"), py::arg("link") = py::none(),
      "Returns how far links lie outside their valid regions, in rest lengths of the link. Cut links do not count.\n\n"
      "Without a link, a dictionary: the largest violation `max`, the root of the mean square `rms`, the share\n"
      "`fraction` of the links that are violated by more than 1e-4, and the number of measured `links`. With a link,\n"
      "its violation.");
  module.def(
      "displacement",
      [](Object& object) {
        return named(figure_of(object, [](const api::Body& body) { return api::displacement(body); }));
      },
      py::arg("body"),
      "Returns the displacement of the elements from rest (mesh units): a dictionary with the largest one `max` and "
      "the\n"
      "root of the mean square `rms`.");
  module.def("distance", &distance, py::arg("body"), py::arg("other"),
             "Returns the distance between the elements of two states of the same mesh, in mean rest lengths: a "
             "dictionary with\n"
             "`max` and `rms`. `other` is a body, or positions of the shape (element_count, 3). Raises Error if the "
             "meshes or\n"
             "shapes differ.");
  module.def(
      "elastic_energy",
      [](Object& object) { return figure_of(object, [](const api::Body& body) { return api::elastic_energy(body); }); },
      py::arg("body"), "Returns the elastic energy of the body's kind over the uncut links (see the C++ interface).");
}

void add_reference(py::module_& module) {
  py::class_<api::ReferenceSolution> reference(
      module, "ReferenceSolution",
      "The positions that a neo-Hookean elastic object has: converged finite elements on\n"
      "the object's own cells or faces.");
  reference
      .def(
          "positions", [](const api::ReferenceSolution& one) { return array_of(one.positions(), 3); },
          "Returns the positions: shape (element_count, 3), dtype float64 (mesh units). A copy.")
      .def_property_readonly("handle_displacement", &api::ReferenceSolution::handle_displacement,
                             "Largest displacement of an element of the handle (mesh units).")
      .def("__repr__", [](const api::ReferenceSolution&) { return "<ReferenceSolution>"; });
  refuse_pickling(reference, "it belongs to a mesh of this process",
                  "pickle its positions(), or compute it again there");
  module.def(
      "reference_solution", &reference_solution, py::arg("body"), py::arg("handle"), py::kw_only(),
      py::arg("job") = py::none(), py::arg("progress") = py::none(),
      "Returns the reference solution with the pins and these elements, the handle, at their current positions.\n\n"
      "`progress` is called with the share that is done, 0 to 1. Raises Error if an element does not exist, is\n"
      "given twice or is pinned, if the handle is at rest, if there are no cells or faces, if the pins are too\n"
      "few, or if it does not converge; and Cancelled.");
  module.def(
      "physical_error",
      [](Object& object, const api::ReferenceSolution& reference) {
        return named(figure_of(object, [&](const api::Body& body) { return api::physical_error(body, reference); }));
      },
      py::arg("body"), py::arg("reference"),
      "Returns the error of the current positions: a dictionary with `relative` (RMS of the error over RMS of the\n"
      "reference's displacements), and `rms` and `max` (over the handle's displacement).");
  module.def(
      "physical_error_of_rest",
      [](const api::ReferenceSolution& reference) { return named(api::physical_error_of_rest(reference)); },
      py::arg("reference"), "Returns the error of an object of which only handle and pins move, as physical_error().");
}

}  // namespace

void add_measure(py::module_& module) {
  add_figures(module);
  add_reference(module);
}

}  // namespace chainmail::python
