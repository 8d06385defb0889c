// Small values: rotations, poses, softness, settings, and jobs.
#include <pybind11/operators.h>
#include <pybind11/stl.h>

#include <array>
#include <cctype>
#include <limits>
#include <string>

#include "body/softness.h"
#include "python/arrays.h"
#include "python/module.h"
#include "python/pickling.h"

namespace chainmail::python {
namespace {

std::string text_of(const Point& vector) { return py::repr(tuple_of(vector)); }
std::string text_of(double number) { return py::repr(py::float_(number)); }

std::string text_of(const Rotation& rotation) {
  return "Rotation(axis=" + text_of(rotation.axis) + ", degrees=" + text_of(rotation.degrees) + ")";
}

py::dict numbers_of(const LinkSoftness& softness) {
  py::dict numbers;
  for (const SoftnessNumber& one : softness_numbers) {
    numbers[py::str(std::string(one.parameter->name))] = softness.*one.value;
  }
  return numbers;
}

std::string text_of(const LinkSoftness& softness) {
  std::string text = "LinkSoftness(";
  for (const auto& [name, value] : numbers_of(softness)) {
    text += (text.back() == '(' ? "" : ", ") + std::string(py::str(name)) + "=" + std::string(py::repr(value));
  }
  return text + ")";
}

py::tuple values_of(const LinkSoftness& softness) { return py::tuple(py::list(numbers_of(softness).attr("values")())); }

LinkSoftness softness_from(const py::tuple& values) {
  LinkSoftness softness;
  std::size_t i = 0;
  for (const SoftnessNumber& one : softness_numbers) {
    softness.*one.value = values[i++].cast<double>();
  }
  return softness;
}

void add_rotation(py::module_& module) {
  py::class_<Rotation> rotation(
      module, "Rotation", "A rotation about an axis. In a plane only the axis across it is possible, on a line none.");
  rotation
      .def(py::init([](const py::object& axis, double degrees) {
             return Rotation{vector_of(axis, "axis"), degrees};
           }),
           py::arg("axis"), py::arg("degrees"))
      .def_property_readonly(
          "axis", [](const Rotation& one) { return tuple_of(one.axis); }, "The axis (x, y, z), of any length above 0.")
      .def_readonly("degrees", &Rotation::degrees,
                    "The angle in degrees, counterclockwise as seen from the tip of the axis.")
      .def(py::self == py::self)
      .def("__repr__", [](const Rotation& one) { return text_of(one); })
      .attr("__hash__") = py::none();
  add_pickling(
      rotation, [](const Rotation& one) { return py::make_tuple(tuple_of(one.axis), one.degrees); },
      [](const py::tuple& state) {
        return Rotation{vector_of(state[0], "axis"), state[1].cast<double>()};
      });
}

void add_pose(py::module_& module) {
  py::class_<UserPose> pose(module, "Pose", "Where a handle is: its pivot and its rotation since it was grabbed.");
  pose.def(py::init([](const py::object& pivot, const Rotation& rotation) {
             return UserPose{vector_of(pivot, "pivot"), rotation};
           }),
           py::arg("pivot"), py::arg("rotation") = Rotation())
      .def_property_readonly(
          "pivot", [](const UserPose& one) { return tuple_of(one.pivot); },
          "Position (x, y, z) of the pivot (mesh units).")
      .def_readonly("rotation", &UserPose::rotation, "Rotation about the pivot since the handle was grabbed.")
      .def(py::self == py::self)
      .def("__repr__",
           [](const UserPose& one) {
             return "Pose(pivot=" + text_of(one.pivot) +
                    (one.rotation.degrees == 0 ? "" : ", rotation=" + text_of(one.rotation)) + ")";
           })
      .attr("__hash__") = py::none();
  add_pickling(
      pose, [](const UserPose& one) { return py::make_tuple(tuple_of(one.pivot), one.rotation); },
      [](const py::tuple& state) {
        return UserPose{vector_of(state[0], "pivot"), state[1].cast<Rotation>()};
      });
}

/// Returns a docstring: `Shortest length … From 0 to 1.`
std::string help_of(const Parameter& number) {
  std::string help(number.help);
  help.front() = char(std::toupper(static_cast<unsigned char>(help.front())));
  const bool has_limit = number.highest < std::numeric_limits<double>::max();
  return help + ". From " + text_of(number.lowest) + (has_limit ? " to " + text_of(number.highest) : std::string()) +
         ".";
}

void add_link_softness(py::module_& module) {
  const LinkSoftness defaults;
  py::class_<LinkSoftness> softness(
      module, "LinkSoftness",
      "How far a link may shorten, lengthen and lean, relative to its rest vector, and how strongly relaxation\n"
      "returns it to its rest vector. A value object: it does not change.");
  softness
      .def(py::init(
               [](double compression, double stretch, double shear, double lateral, double stiffness, double exponent) {
                 return LinkSoftness{compression, stretch, shear, lateral, stiffness, exponent};
               }),
           py::kw_only(), py::arg("compression") = defaults.compression, py::arg("stretch") = defaults.stretch,
           py::arg("shear") = defaults.shear, py::arg("lateral") = defaults.lateral,
           py::arg("stiffness") = defaults.stiffness, py::arg("exponent") = defaults.exponent)
      .def("as_dict", &numbers_of, "Returns the six numbers by name.")
      .def(py::self == py::self)
      .def("__hash__", [](const LinkSoftness& one) { return py::hash(values_of(one)); })
      .def("__repr__", [](const LinkSoftness& one) { return text_of(one); });
  for (const SoftnessNumber& one : softness_numbers) {
    softness.def_readonly(std::string(one.parameter->name).c_str(), one.value, help_of(*one.parameter).c_str());
  }
  add_pickling(softness, &values_of, &softness_from);
}

std::string text_of(const ElasticOptions& one) {
  const auto [x, y, z] = one.lattice;
  return "Elasticity(young=" + text_of(one.material.young) + ", poisson=" + text_of(one.material.poisson) +
         ", control_points=(" + std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z) +
         "), iterations=" + std::to_string(one.iterations) + ", law='" + std::string(word_for(one.law.kind)) +
         "', gent_limit=" + text_of(one.law.gent_limit) + ", fung_exponent=" + text_of(one.law.fung_exponent) +
         ", thickness=" + text_of(one.thickness) + ")";
}

ElasticOptions elasticity_from(double young, double poisson, const std::array<std::uint32_t, 3>& control_points,
                               std::uint32_t iterations, const std::string& law, double gent_limit,
                               double fung_exponent, double thickness) {
  return {{young, poisson},
          control_points,
          iterations,
          {named<StrainLaw::Kind>("law", law), gent_limit, fung_exponent},
          thickness};
}

py::tuple parts_of(const ElasticOptions& one) {
  return py::make_tuple(one.material.young, one.material.poisson, one.lattice, one.iterations, word_for(one.law.kind),
                        one.law.gent_limit, one.law.fung_exponent, one.thickness);
}

void add_elasticity(py::module_& module) {
  const ElasticOptions defaults;
  py::class_<ElasticOptions> elasticity(
      module, "Elasticity",
      "Settings of the methods of elasticity, of free-form deformation and of relaxation to\n"
      "the material. A value object: it does not change.");
  const auto number = [&elasticity](const char* name, auto get, const char* help) {
    elasticity.def_property_readonly(name, get, help);
  };
  elasticity.def(py::init(&elasticity_from), py::kw_only(), py::arg("young") = defaults.material.young,
                 py::arg("poisson") = defaults.material.poisson,
                 py::arg("control_points") = py::tuple(py::cast(defaults.lattice)),
                 py::arg("iterations") = defaults.iterations, py::arg("law") = word_for(defaults.law.kind),
                 py::arg("gent_limit") = defaults.law.gent_limit, py::arg("fung_exponent") = defaults.law.fung_exponent,
                 py::arg("thickness") = defaults.thickness);
  number(
      "young", [](const ElasticOptions& one) { return one.material.young; },
      "Young's modulus (force per square of a mesh unit), above 0. It does not change the shape.");
  number(
      "poisson", [](const ElasticOptions& one) { return one.material.poisson; }, "Poisson's ratio: 0 to below 0.5.");
  number(
      "control_points", [](const ElasticOptions& one) { return py::tuple(py::cast(one.lattice)); },
      "Number of control points of free-form deformation along x, y and z, 2 to 8.");
  number(
      "iterations", [](const ElasticOptions& one) { return one.iterations; },
      "Most iterations of a method that iterates, for one move, 1 to 100000.");
  number(
      "law", [](const ElasticOptions& one) { return word_for(one.law.kind); },
      "Law of relaxation to the material and of neo-Hookean FEM: `neo-hookean`, or `gent` or\n"
      "`fung`, which stiffen as they are stretched.");
  number(
      "gent_limit", [](const ElasticOptions& one) { return one.law.gent_limit; },
      "With `gent`: bound of I1 - 3, the sum of the squared principal stretches less 3.");
  number(
      "fung_exponent", [](const ElasticOptions& one) { return one.law.fung_exponent; },
      "With `fung`: factor of I1 - 3 in the exponent.");
  number(
      "thickness", [](const ElasticOptions& one) { return one.thickness; },
      "Thickness of a surface in space in relaxation to the material, as a share of the longest side\n"
      "of its bounds: 0.0001 to 1.");
  elasticity.def(py::self == py::self)
      .def("__repr__", [](const ElasticOptions& one) { return text_of(one); })
      .attr("__hash__") = py::none();
  add_pickling(elasticity, &parts_of, [](const py::tuple& state) {
    return elasticity_from(state[0].cast<double>(), state[1].cast<double>(),
                           state[2].cast<std::array<std::uint32_t, 3>>(), state[3].cast<std::uint32_t>(),
                           state[4].cast<std::string>(), state[5].cast<double>(), state[6].cast<double>(),
                           state[7].cast<double>());
  });
}

void add_job(py::module_& module) {
  py::class_<Progress> job(
      module, "Job",
      "The progress of long work. Another thread may read it, or cancel the work. All of it is safe to\n"
      "use from any thread.");
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
  add_link_softness(module);
  add_elasticity(module);
  add_job(module);
}

}  // namespace chainmail::python
