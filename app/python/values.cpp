// Small values: rotations, poses, softness, settings, and jobs.
#include <pybind11/operators.h>

#include <array>
#include <cctype>
#include <string>
#include <type_traits>
#include <utility>

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

// Settings that core describes

/// The lattice of control points has a name of its own, because a mesh may have a lattice, too.
const char* name_of(const MemberInfo& member) { return member.key == "lattice" ? "control_points" : member.key.data(); }

/// Returns a docstring: `Shortest length … Range: 0 to 1 (of rest length).`
std::string help_of(const MemberInfo& member) {
  std::string help = std::string(member.help) + ". ";
  help.front() = char(std::toupper(static_cast<unsigned char>(help.front())));
  if (member.number) {
    return help + "Range: " + range_of(*member.number) + " (" + std::string(member.number->unit) + ").";
  }
  for (const std::string_view name : member.names) {
    help += (name == member.names.front() ? "One of `" : ", `") + std::string(name) + "`";
  }
  return help + ".";
}

/// Returns a member as Python has it: a choice is a word, and an array is a tuple.
template <class Struct>
py::object value_of(const Member<Struct>& member, const Struct& all) {
  py::list items;
  for (std::size_t i = 0; i < member.count; ++i) {
    const double value = member.get(all, i);
    if (!member.names.empty()) {
      items.append(member.names[std::size_t(value)]);
    } else {
      items.append(member.is_whole ? py::object(py::int_(std::uint64_t(value))) : py::float_(value));
    }
  }
  return member.count == 1 ? py::object(items[0]) : py::tuple(items);
}

template <class Struct>
py::dict values_of(const Struct& all) {
  py::dict values;
  for (const Member<Struct>& member : members_of<Struct>) {
    values[name_of(member)] = value_of(member, all);
  }
  return values;
}

/// What Python gives for a member.
template <class Struct, std::size_t I, const auto& All = members_of<Struct>,
          class Number = std::conditional_t<All[I].is_whole, std::uint32_t, double>,
          class Numbers = std::conditional_t<All[I].count == 1, Number, std::array<Number, All[I].count>>>
using Keyword = std::conditional_t<All[I].names.empty(), Numbers, std::string>;

template <class Struct, class Value>
void set(const Member<Struct>& member, Struct& all, const Value& given) {
  if constexpr (std::is_same_v<Value, std::string>) {
    member.set(all, 0, double(index_of({name_of(member), {member.names.begin(), member.names.end()}}, given)));
  } else if constexpr (std::is_arithmetic_v<Value>) {
    member.set(all, 0, given);
  } else {
    for (std::size_t i = 0; i < member.count; ++i) {
      member.set(all, i, given[i]);
    }
  }
}

/// Adds the constructor, which takes the members by their names, and makes the objects known to pickle. The defaults
/// are those of the struct.
template <class Struct, std::size_t... I>
void add_constructor(py::class_<Struct>& type, std::index_sequence<I...> /*members*/) {
  constexpr const auto& members = members_of<Struct>;
  const auto made = [](const Keyword<Struct, I>&... given) {
    Struct all;
    (set(members[I], all, given), ...);
    return all;
  };
  type.def(py::init(made), py::kw_only(), (py::arg(name_of(members[I])) = value_of(members[I], Struct()))...);
  add_pickling(
      type, [](const Struct& one) { return py::tuple(values_of(one).attr("values")()); },
      [=](const py::tuple& state) { return made(state[I].template cast<Keyword<Struct, I>>()...); });
}

/// Adds a class with the members of a described struct.
template <class Struct>
py::class_<Struct> add_described(py::module_& module, const char* name, const char* help) {
  py::class_<Struct> type(module, name, help);
  add_constructor(type, std::make_index_sequence<members_of<Struct>.size()>());
  for (const Member<Struct>& member : members_of<Struct>) {
    type.def_property_readonly(
        name_of(member), [&member](const Struct& one) { return value_of(member, one); }, help_of(member).c_str());
  }
  type.def(py::self == py::self).def("__repr__", [](const Struct& one) { return words_of<Struct>(values_of(one)); });
  return type;
}

void add_described_values(py::module_& module) {
  add_described<LinkSoftness>(
      module, "LinkSoftness",
      "How far a link may shorten, lengthen and lean, relative to its rest vector, and how strongly relaxation\n"
      "returns it to its rest vector. A value object: it does not change.")
      .def("as_dict", &values_of<LinkSoftness>, "Returns the numbers by name.")
      .def("__hash__", [](const LinkSoftness& one) { return py::hash(py::tuple(values_of(one).attr("values")())); });
  add_described<ElasticOptions>(module, "Elasticity",
                                "Settings of the methods of elasticity, of free-form deformation and of relaxation to\n"
                                "the material. A value object: it does not change.")
      .attr("__hash__") = py::none();
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
  add_described_values(module);
  add_job(module);
}

}  // namespace chainmail::python
