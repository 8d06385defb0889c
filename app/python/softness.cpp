// Softness of a body: common, or of each link as arrays.
#include <pybind11/stl.h>

#include <algorithm>
#include <map>

#include "api/access.h"
#include "python/arrays.h"
#include "python/module.h"
#include "python/own_softness.h"

namespace chainmail::python {
namespace {

using api::Access;
using api::Error;
using InnerSoftness = chainmail::LinkSoftness;

std::vector<LinkId> every_link(const chainmail::Mesh& mesh) {
  std::vector<LinkId> links(mesh.link_count());
  for (LinkId link = 0; link < mesh.link_count(); ++link) {
    links[link] = link;
  }
  return links;
}

std::vector<LinkId> links_or_all(const py::object& links, const chainmail::Mesh& mesh) {
  if (links.is_none()) {
    return every_link(mesh);
  }
  std::vector<LinkId> ids = ids_of(links, "link");
  api::check_link_ids(mesh, ids);
  return ids;
}

void check_unique(std::vector<LinkId> links) {
  std::ranges::sort(links);
  if (const auto twice = std::ranges::adjacent_find(links); twice != links.end()) {
    throw Error("link " + std::to_string(*twice), "it is given twice", "give each link once");
  }
}

/// Checks the softness of a link, and names the link in the error.
void check_softness(LinkId link, const InnerSoftness& softness) {
  try {
    check(softness);
  } catch (const chainmail::Error& error) {
    throw Error("link " + std::to_string(link) + ", " + error.where(), error.problem(), error.remedy());
  }
}

bool is_before(const InnerSoftness& one, const InnerSoftness& other) {
  const auto key = [](const InnerSoftness& softness) {
    std::array<double, softness_numbers.size()> numbers{};
    std::ranges::transform(softness_numbers, numbers.begin(),
                           [&](const SoftnessNumber& n) { return softness.*n.value; });
    return numbers;
  };
  return key(one) < key(other);
}

using Numbers = std::map<std::string, std::vector<double>>;

Numbers numbers_given(const py::kwargs& given, std::size_t links) {
  Numbers numbers;
  for (const auto& [key, value] : given) {
    const auto name = key.cast<std::string>();
    const bool known =
        std::ranges::any_of(softness_numbers, [&](const SoftnessNumber& one) { return one.parameter->name == name; });
    if (!known) {
      throw py::type_error("set_link_softness() has no argument '" + name + "'");
    }
    if (!value.is_none()) {
      numbers[name] = numbers_of(value, name, links);
    }
  }
  return numbers;
}

void put(InnerSoftness& softness, const Numbers& numbers, std::size_t at) {
  for (const SoftnessNumber& one : softness_numbers) {
    if (const auto found = numbers.find(std::string(one.parameter->name)); found != numbers.end()) {
      softness.*one.value = found->second[at];
    }
  }
}

void set_link_softness(Object& object, const py::object& links, const py::kwargs& given) {
  const UseObject use(object);
  auto& impl = Access::impl(object.body());
  const Softness& present = impl.body().softness();
  const std::vector<LinkId> ids = links_or_all(links, impl.body().mesh());
  check_unique(ids);
  const Numbers numbers = numbers_given(given, ids.size());
  const py::gil_scoped_release unlocked;
  std::vector<std::pair<LinkId, InnerSoftness>> entries;
  entries.reserve(ids.size() + present.links.size());
  std::vector<bool> is_new(impl.body().mesh().link_count());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    auto& [link, softness] = entries.emplace_back(ids[i], present.of(ids[i]));
    put(softness, numbers, i);
    check_softness(link, softness);
    is_new[link] = true;
  }
  for (const auto& [link, softness] : present.links) {
    if (!is_new[link]) {
      entries.emplace_back(link, softness);
    }
  }
  Softness next = present;
  next.links = grouped(std::move(entries));
  api::guarded([&] { impl.set_softness(next); });
}

py::dict link_softness(Object& object) {
  const UseObject use(object);
  const chainmail::Body& body = Access::body(object.body());
  py::dict arrays;
  for (const SoftnessNumber& one : softness_numbers) {
    py::array_t<double> numbers(body.mesh().link_count());
    double* out = numbers.mutable_data();
    for (LinkId link = 0; link < body.mesh().link_count(); ++link) {
      out[link] = body.softness().of(link).*one.value;
    }
    arrays[py::str(std::string(one.parameter->name))] = numbers;
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

OwnSoftness grouped(std::vector<std::pair<LinkId, LinkSoftness>> entries) {
  std::ranges::stable_sort(entries, [](const auto& a, const auto& b) { return is_before(a.second, b.second); });
  return OwnSoftness(entries.begin(), entries.end());
}

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
            one.body().clear_softness(links.is_none() ? every_link(*Access::pointer(one.body().mesh()))
                                                      : ids_of(links, "link"));
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
