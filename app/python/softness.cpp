// Softness of a body: common, or of each link as arrays.
#include <pybind11/stl.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "chainmail/error.h"
#include "python/arrays.h"
#include "python/module.h"
#include "python/unlocked.h"

namespace chainmail::python {
namespace {

using api::Error;
using api::LinkId;

std::vector<LinkId> every_link(const api::Mesh& mesh) {
  std::vector<LinkId> links(mesh.link_count());
  std::iota(links.begin(), links.end(), 0);
  return links;
}

using Numbers = std::map<std::string, std::vector<double>>;

Numbers numbers_given(const py::kwargs& given, std::size_t links) {
  Numbers numbers;
  for (const auto& [key, value] : given) {
    const auto name = key.cast<std::string>();
    if (std::ranges::find(api::softness_numbers(), name, &api::SoftnessNumber::name) == api::softness_numbers().end()) {
      throw py::type_error("set_link_softness() has no argument '" + name + "'");
    }
    if (!value.is_none()) {
      numbers[name] = numbers_of(value, name, links);
    }
  }
  return numbers;
}

void put(api::LinkSoftness& softness, const Numbers& numbers, std::size_t at) {
  for (const api::SoftnessNumber& one : api::softness_numbers()) {
    if (const auto found = numbers.find(std::string(one.name)); found != numbers.end()) {
      softness.*one.value = found->second[at];
    }
  }
}

void set_link_softness(Object& object, const py::object& links, const py::kwargs& given) {
  const UseObject use(object);
  api::Body& body = object.body();
  const std::vector<LinkId> ids = links.is_none() ? every_link(body.mesh()) : ids_of(links, "link");
  const Numbers numbers = numbers_given(given, ids.size());
  const Unlocked unlocked;
  std::vector<api::LinkSoftness> next;
  next.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    put(next.emplace_back(body.softness(ids[i])), numbers, i);
  }
  body.set_link_softness(ids, next);
}

py::dict link_softness(Object& object) {
  const UseObject use(object);
  const std::vector<api::LinkSoftness> softness = object.body().link_softness();
  py::dict arrays;
  for (const api::SoftnessNumber& one : api::softness_numbers()) {
    py::array_t<double> numbers(py::ssize_t(softness.size()));
    std::ranges::transform(softness, numbers.mutable_data(), [&](const auto& link) { return link.*one.value; });
    arrays[py::str(std::string(one.name))] = numbers;
  }
  return arrays;
}

void set_softness(Object& object, const api::LinkSoftness& softness, const py::object& links) {
  const UseObject use(object);
  if (links.is_none()) {
    object.body().set_softness(softness);
  } else {
    object.body().set_softness(ids_of(links, "link"), softness);
  }
}

}  // namespace

void add_softness(BodyClass& body) {
  body.def_property_readonly(
          "softness",
          [](Object& one) {
            const UseObject use(one);
            return one.body().softness();
          },
          "The softness of all links that have none of their own.")
      .def("set_softness", &set_softness, py::arg("softness"), py::arg("links") = py::none(),
           "Sets the softness of all links that have none of their own, or gives these links their own.\n\n"
           "Nothing moves; the next move answers. Raises Error if a value is out of its range.")
      .def("set_link_softness", &set_link_softness, py::arg("links") = py::none(),
           "Gives links their own softness from arrays: compression, stretch, shear, lateral, stiffness, exponent.\n\n"
           "`links` are ids; default: all links in the order of their ids. Each other argument is one number, or an\n"
           "array with one number per link: shape (links,). Numbers that are left out stay as they are. Raises Error "
           "for\n"
           "another shape, a value out of its range, and a link that is given twice. Nothing has changed then.")
      .def(
          "clear_softness",
          [](Object& one, const py::object& links) {
            const UseObject use(one);
            one.body().clear_softness(links.is_none() ? every_link(one.body().mesh()) : ids_of(links, "link"));
          },
          py::arg("links") = py::none(),
          "Takes their own softness away from these links, or from all: the common one applies to them.")
      .def(
          "softness_of",
          [](Object& one, const py::object& link) {
            const UseObject use(one);
            return one.body().softness(id_of(link, "link"));
          },
          py::arg("link"), "Returns the softness of a link.")
      .def("link_softness", &link_softness,
           "Returns the softness of each link: a dictionary of arrays of the shape (link_count,), dtype float64, by "
           "the\n"
           "names of set_link_softness(). Copies.");
}

}  // namespace chainmail::python
