// Small values: vectors, rotations, poses, softness, options.
#include <pybind11/operators.h>
#include <pybind11/stl.h>

#include <cctype>
#include <limits>
#include <sstream>

#include "chainmail/chainmail.h"
#include "python/arrays.h"
#include "python/module.h"
#include "python/pickling.h"
#include "python/words.h"

namespace chainmail::python {
namespace {

std::string text_of(const api::Vector3& vector) { return py::repr(tuple_of(vector)); }
std::string text_of(double number) { return py::repr(py::float_(number)); }

std::string text_of(const api::Rotation& rotation) {
  return "Rotation(axis=" + text_of(rotation.axis) + ", degrees=" + text_of(rotation.degrees) + ")";
}

py::dict numbers_of(const api::LinkSoftness& softness) {
  py::dict numbers;
  for (const api::SoftnessNumber& one : api::softness_numbers()) {
    numbers[py::str(std::string(one.name))] = softness.*one.value;
  }
  return numbers;
}

std::string text_of(const api::LinkSoftness& softness) {
  std::string text = "LinkSoftness(";
  for (const auto& [name, value] : numbers_of(softness)) {
    text += (text.back() == '(' ? "" : ", ") + std::string(py::str(name)) + "=" + std::string(py::repr(value));
  }
  return text + ")";
}

py::tuple values_of(const api::LinkSoftness& softness) {
  return py::tuple(py::list(numbers_of(softness).attr("values")()));
}

api::LinkSoftness softness_from(const py::tuple& values) {
  api::LinkSoftness softness;
  std::size_t i = 0;
  for (const api::SoftnessNumber& one : api::softness_numbers()) {
    softness.*one.value = values[i++].cast<double>();
  }
  return softness;
}

void add_rotation(py::module_& module) {
  py::class_<api::Rotation> rotation(
      module, "Rotation", "A rotation about an axis. In a plane only the axis across it is possible, on a line none.");
  rotation
      .def(py::init([](const py::object& axis, double degrees) {
             return api::Rotation{vector_of(axis, "axis"), degrees};
           }),
           py::arg("axis"), py::arg("degrees"))
      .def_property_readonly(
          "axis", [](const api::Rotation& one) { return tuple_of(one.axis); },
          "The axis (x, y, z), of any length above 0.")
      .def_readonly("degrees", &api::Rotation::degrees,
                    "The angle in degrees, counterclockwise as seen from the tip of the axis.")
      .def(py::self == py::self)
      .def("__repr__", [](const api::Rotation& one) { return text_of(one); })
      .attr("__hash__") = py::none();
  add_pickling(
      rotation, [](const api::Rotation& one) { return py::make_tuple(tuple_of(one.axis), one.degrees); },
      [](const py::tuple& state) {
        return api::Rotation{vector_of(state[0], "axis"), state[1].cast<double>()};
      });
}

void add_pose(py::module_& module) {
  py::class_<api::Pose> pose(module, "Pose", "Where a handle is: its pivot and its rotation since it was grabbed.");
  pose.def(py::init([](const py::object& pivot, const api::Rotation& rotation) {
             return api::Pose{vector_of(pivot, "pivot"), rotation};
           }),
           py::arg("pivot"), py::arg("rotation") = api::Rotation())
      .def_property_readonly(
          "pivot", [](const api::Pose& one) { return tuple_of(one.pivot); },
          "Position (x, y, z) of the pivot (mesh units).")
      .def_readonly("rotation", &api::Pose::rotation, "Rotation about the pivot since the handle was grabbed.")
      .def(py::self == py::self)
      .def("__repr__",
           [](const api::Pose& one) {
             return "Pose(pivot=" + text_of(one.pivot) +
                    (one.rotation.degrees == 0 ? "" : ", rotation=" + text_of(one.rotation)) + ")";
           })
      .attr("__hash__") = py::none();
  add_pickling(
      pose, [](const api::Pose& one) { return py::make_tuple(tuple_of(one.pivot), one.rotation); },
      [](const py::tuple& state) {
        return api::Pose{vector_of(state[0], "pivot"), state[1].cast<api::Rotation>()};
      });
}

/// Returns a docstring: `Shortest length … From 0 to 1.`
std::string help_of(const api::SoftnessNumber& number) {
  std::string help(number.help);
  help.front() = char(std::toupper(static_cast<unsigned char>(help.front())));
  const bool has_limit = number.highest < std::numeric_limits<double>::max();
  return help + ". From " + text_of(number.lowest) + (has_limit ? " to " + text_of(number.highest) : std::string()) +
         ".";
}

void add_link_softness(py::module_& module) {
  const api::LinkSoftness defaults;
  py::class_<api::LinkSoftness> softness(
      module, "LinkSoftness",
      "How far a link may shorten, lengthen and lean, relative to its rest vector, and how strongly relaxation\n"
      "returns it to its rest vector. A value object: it does not change.");
  softness
      .def(py::init(
               [](double compression, double stretch, double shear, double lateral, double stiffness, double exponent) {
                 return api::LinkSoftness{compression, stretch, shear, lateral, stiffness, exponent};
               }),
           py::kw_only(), py::arg("compression") = defaults.compression, py::arg("stretch") = defaults.stretch,
           py::arg("shear") = defaults.shear, py::arg("lateral") = defaults.lateral,
           py::arg("stiffness") = defaults.stiffness, py::arg("exponent") = defaults.exponent)
      .def("as_dict", &numbers_of, "Returns the six numbers by name.")
      .def(py::self == py::self)
      .def("__hash__", [](const api::LinkSoftness& one) { return py::hash(values_of(one)); })
      .def("__repr__", [](const api::LinkSoftness& one) { return text_of(one); });
  for (const api::SoftnessNumber& one : api::softness_numbers()) {
    softness.def_readonly(std::string(one.name).c_str(), one.value, help_of(one).c_str());
  }
  add_pickling(softness, &values_of, &softness_from);
}

void add_elasticity(py::module_& module) {
  const api::Elasticity defaults;
  py::class_<api::Elasticity> elasticity(
      module, "Elasticity",
      "Settings of the methods of elasticity, of free-form deformation and of relaxation to\n"
      "the material. A value object: it does not change.");
  elasticity
      .def(py::init([](double young, double poisson, const std::array<std::uint32_t, 3>& control_points,
                       std::uint32_t iterations, const std::string& law, double gent_limit, double fung_exponent,
                       double thickness) {
             return api::Elasticity{young,       poisson,    control_points, iterations,
                                    law_of(law), gent_limit, fung_exponent,  thickness};
           }),
           py::kw_only(), py::arg("young") = defaults.young, py::arg("poisson") = defaults.poisson,
           py::arg("control_points") = py::make_tuple(4, 4, 4), py::arg("iterations") = defaults.iterations,
           py::arg("law") = word_for(defaults.law), py::arg("gent_limit") = defaults.gent_limit,
           py::arg("fung_exponent") = defaults.fung_exponent, py::arg("thickness") = defaults.thickness)
      .def_readonly("young", &api::Elasticity::young,
                    "Young's modulus (force per square of a mesh unit), above 0. It does not change the shape.")
      .def_readonly("poisson", &api::Elasticity::poisson, "Poisson's ratio: 0 to below 0.5.")
      .def_property_readonly(
          "control_points",
          [](const api::Elasticity& one) {
            return py::make_tuple(one.control_points[0], one.control_points[1], one.control_points[2]);
          },
          "Number of control points of free-form deformation along x, y and z, 2 to 8.")
      .def_readonly("iterations", &api::Elasticity::iterations,
                    "Most iterations of a method that iterates, for one move, 1 to 100000.")
      .def_property_readonly(
          "law", [](const api::Elasticity& one) { return word_for(one.law); },
          "Law of relaxation to the material and of neo-Hookean FEM: `neo-hookean`, or `gent` or\n"
          "`fung`, which stiffen as they are stretched.")
      .def_readonly("gent_limit", &api::Elasticity::gent_limit,
                    "With `gent`: bound of I1 - 3, the sum of the squared principal stretches less 3.")
      .def_readonly("fung_exponent", &api::Elasticity::fung_exponent, "With `fung`: factor of I1 - 3 in the exponent.")
      .def_readonly("thickness", &api::Elasticity::thickness,
                    "Thickness of a surface in space in relaxation to the material, as a share of the longest side\n"
                    "of its bounds: 0.0001 to 1.")
      .def(py::self == py::self)
      .def("__repr__",
           [](const api::Elasticity& one) {
             std::ostringstream text;
             text << "Elasticity(young=" << text_of(one.young) << ", poisson=" << text_of(one.poisson)
                  << ", control_points=(" << one.control_points[0] << ", " << one.control_points[1] << ", "
                  << one.control_points[2] << "), iterations=" << one.iterations << ", law='" << word_for(one.law)
                  << "', gent_limit=" << text_of(one.gent_limit) << ", fung_exponent=" << text_of(one.fung_exponent)
                  << ", thickness=" << text_of(one.thickness) << ")";
             return text.str();
           })
      .attr("__hash__") = py::none();
  add_pickling(
      elasticity,
      [](const api::Elasticity& one) {
        return py::make_tuple(one.young, one.poisson, one.control_points, one.iterations, word_for(one.law),
                              one.gent_limit, one.fung_exponent, one.thickness);
      },
      [](const py::tuple& state) {
        return api::Elasticity{state[0].cast<double>(),
                               state[1].cast<double>(),
                               state[2].cast<std::array<std::uint32_t, 3>>(),
                               state[3].cast<std::uint32_t>(),
                               law_of(state[4].cast<std::string>()),
                               state[5].cast<double>(),
                               state[6].cast<double>(),
                               state[7].cast<double>()};
      });
}

void add_job(py::module_& module) {
  py::class_<api::Job> job(
      module, "Job",
      "The progress of long work. Another thread may read it, or cancel the work. All of it is safe to\n"
      "use from any thread.");
  job.def(py::init<>())
      .def_property_readonly("share", &api::Job::share, "The share of the work that is done, from 0 to 1.")
      .def("cancel", &api::Job::cancel,
           "Asks the work to stop: it raises Cancelled within about 100 ms. A job that is cancelled stays cancelled.")
      .def_property_readonly("is_cancelled", &api::Job::is_cancelled, "True if cancel() was called.")
      .def("__repr__", [](const api::Job& one) {
        return "<Job: " + std::to_string(int(100 * one.share())) + " % done" +
               (one.is_cancelled() ? ", cancelled>" : ">");
      });
  refuse_pickling(job, "it belongs to the work of this process", "make another one where it is needed");
}

}  // namespace

void add_types(py::module_& module) {
  add_rotation(module);
  add_pose(module);
  add_link_softness(module);
  add_elasticity(module);
  add_job(module);
}

}  // namespace chainmail::python
