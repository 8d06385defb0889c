// Small values: rotations, poses, softness, settings, and jobs.
#include <pybind11/operators.h>

#include <array>
#include <cctype>
#include <limits>
#include <string>

#include "python/module.h"
#include "python/value.h"

namespace chainmail::python {
namespace {

void add_rotation(py::module_& module) {
  py::class_<Rotation> rotation(
      module, "Rotation", "A rotation about an axis. In a plane only the axis across it is possible, on a line none.");
  const Part axis{"axis", &Rotation::axis, "The axis (x, y, z), of any length above 0."};
  const Part degrees{"degrees", &Rotation::degrees,
                     "The angle in degrees, counterclockwise as seen from the tip of the axis."};
  rotation
      .def(py::init([](const py::object& about, double angle) {
             return Rotation{vector_of(about, "axis"), angle};
           }),
           py::arg("axis"), py::arg("degrees"))
      .def(py::self == py::self)
      .def("__repr__", [=](Rotation& one) { return words_of(one, axis, degrees); })
      .attr("__hash__") = py::none();
  add_parts(rotation, axis, degrees);
}

void add_pose(py::module_& module) {
  py::class_<UserPose> pose(module, "Pose", "Where a handle is: its pivot and its rotation since it was grabbed.");
  const Part pivot{"pivot", &UserPose::pivot, "Position (x, y, z) of the pivot (mesh units)."};
  const Part turn{"rotation", &UserPose::rotation, "Rotation about the pivot since the handle was grabbed."};
  pose.def(py::init([](const py::object& at, const Rotation& rotation) {
             return UserPose{vector_of(at, "pivot"), rotation};
           }),
           py::arg("pivot"), py::arg("rotation") = Rotation())
      .def(py::self == py::self)
      .def("__repr__",
           [=](UserPose& one) { return one.rotation.degrees == 0 ? words_of(one, pivot) : words_of(one, pivot, turn); })
      .attr("__hash__") = py::none();
  add_parts(pose, pivot, turn);
}

/// Returns a docstring: `Shortest length … From 0 to 1.`
std::string help_of(const Parameter& number) {
  const auto text = [](double limit) { return std::string(py::repr(py::float_(limit))); };
  std::string help(number.help);
  help.front() = char(std::toupper(static_cast<unsigned char>(help.front())));
  const bool has_limit = number.highest < std::numeric_limits<double>::max();
  return help + ". From " + text(number.lowest) + (has_limit ? " to " + text(number.highest) : "") + ".";
}

Part<double LinkSoftness::*> part_of(const SoftnessNumber& number) {
  return {number.parameter->name.data(), number.value, help_of(*number.parameter)};
}

/// Adds the class with the numbers of core's table.
template <std::size_t... I>
void add_link_softness(py::module_& module, std::index_sequence<I...> /*numbers*/) {
  py::class_<LinkSoftness> softness(
      module, "LinkSoftness",
      "How far a link may shorten, lengthen and lean, relative to its rest vector, and how strongly relaxation\n"
      "returns it to its rest vector. A value object: it does not change.");
  const auto numbers = [](const LinkSoftness& one) {
    return py::dict(py::arg(softness_numbers[I].parameter->name.data()) = one.*softness_numbers[I].value...);
  };
  add_keywords(softness, part_of(softness_numbers[I])...);
  softness.def("as_dict", numbers, "Returns the six numbers by name.")
      .def(py::self == py::self)
      .def("__hash__", [=](const LinkSoftness& one) { return py::hash(py::tuple(numbers(one).attr("values")())); })
      .def("__repr__", [](LinkSoftness& one) { return words_of(one, part_of(softness_numbers[I])...); });
  add_parts(softness, part_of(softness_numbers[I])...);
}

void add_elasticity(py::module_& module) {
  using One = ElasticOptions;
  py::class_<One> elasticity(module, "Elasticity",
                             "Settings of the methods of elasticity, of free-form deformation and of relaxation to\n"
                             "the material. A value object: it does not change.");
  const auto add = [&](const auto&... parts) {
    add_keywords(elasticity, parts...);
    add_parts(elasticity, parts...);
    elasticity.def(py::self == py::self)
        .def("__repr__", [parts...](One& one) { return words_of(one, parts...); })
        .attr("__hash__") = py::none();
  };
  add(Part{"young", [](One& one) -> double& { return one.material.young; },
           "Young's modulus (force per square of a mesh unit), above 0. It does not change the shape."},
      Part{"poisson", [](One& one) -> double& { return one.material.poisson; }, "Poisson's ratio: 0 to below 0.5."},
      Part{"control_points", &One::lattice,
           "Number of control points of free-form deformation along x, y and z, 2 to 8."},
      Part{"iterations", &One::iterations, "Most iterations of a method that iterates, for one move, 1 to 100000."},
      Part{"law", [](One& one) -> StrainLaw::Kind& { return one.law.kind; },
           "Law of relaxation to the material and of neo-Hookean FEM: `neo-hookean`, or `gent` or\n"
           "`fung`, which stiffen as they are stretched."},
      Part{"gent_limit", [](One& one) -> double& { return one.law.gent_limit; },
           "With `gent`: bound of I1 - 3, the sum of the squared principal stretches less 3."},
      Part{"fung_exponent", [](One& one) -> double& { return one.law.fung_exponent; },
           "With `fung`: factor of I1 - 3 in the exponent."},
      Part{"thickness", &One::thickness,
           "Thickness of a surface in space in relaxation to the material, as a share of the longest side of its\n"
           "bounds: 0.0001 to 1."});
}

void add_job(py::module_& module) {
  py::class_<Progress> job(
      module, "Job",
      "The progress of long work. Another thread may read it, or cancel the work. All of it is safe to use from any\n"
      "thread.");
  job.def(py::init([] { return Progress::watched(); }))
      .def_property_readonly("share", &Progress::share, "The share of the work that is done, from 0 to 1.")
      .def(
          "cancel", [](const Progress& one) { one.cancel(); },
          "Asks the work to stop: it raises Cancelled within about 100 ms. A job that is cancelled stays cancelled.")
      .def_property_readonly("is_cancelled", &Progress::cancelled, "True if cancel() was called.")
      .def("__repr__", [](const Progress& one) {
        return "<Job: " + std::to_string(int(100 * one.share())) + " % done" + (one.cancelled() ? ", cancelled>" : ">");
      });
  refuse_pickling(job, "it belongs to the work of this process", "make another one where it is needed");
}

}  // namespace

void add_values(py::module_& module) {
  add_rotation(module);
  add_pose(module);
  add_link_softness(module, std::make_index_sequence<softness_numbers.size()>());
  add_elasticity(module);
  add_job(module);
}

}  // namespace chainmail::python
