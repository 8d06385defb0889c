// Bodies: state, cuts, pins, softness, and positions as arrays: copies, and views of what the solver stores.
#include <pybind11/operators.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <numeric>

#include "body/body_view.h"
#include "python/arrays.h"
#include "python/long_work.h"
#include "python/module.h"
#include "python/pickling.h"

namespace chainmail::python {
namespace {

using BodyClass = py::class_<Object, ObjectPointer>;

/// The positions of an object at one time.
struct SnapshotObject {
  Snapshot snapshot;
  MeshPointer mesh;
  Precision precision;
  bool operator==(const SnapshotObject&) const = default;
};

/// Makes a function of ids a method of the Python class.
template <class Function>
auto used_with_ids(const char* what, Function function) {
  return used<const py::object&>(
      [what, function](Object& object, const py::object& ids) { function(object.deformer(), ids_of(ids, what)); });
}

/// Makes a function of an element a method of the Python class. Throws Error if it does not exist.
template <class Function>
auto used_with_element(Function function) {
  return used<const py::object&>([function](Object& object, const py::object& id) {
    const ElementId element = id_of(id, "element");
    check_element(object.mesh(), element);
    return function(object.body(), element);
  });
}

/// The same for a link.
template <class Function>
auto used_with_link(Function function) {
  return used<const py::object&>([function](Object& object, const py::object& id) {
    const LinkId link = id_of(id, "link");
    check_links(object.mesh(), std::span(&link, 1));
    return function(object.body(), link);
  });
}

/// Works also while another thread moves the body: a debugger shows it then, too.
std::string body_in_words(Object& object) {
  const Body& body = object.body();
  const std::string text = "<Body: " + std::to_string(body.mesh().element_count()) + " elements in " +
                           std::string(word_for(body.precision()));
  if (object.busy().is_used()) {
    return text + ", in use>";
  }
  const auto count = [](std::size_t number, const char* word) {
    return number == 0 ? "" : ", " + std::to_string(number) + " " + word;
  };
  return text + count(body.pins().size(), "pinned") + count(body.cuts().count(), "links cut") + ">";
}

ObjectPointer copy_of(Object& object) {
  const UseObject use(object);
  return std::make_shared<Object>(object);
}

SnapshotObject snapshot_of(Object& object) {
  return {object.body().snapshot(), object.body().mesh_pointer(), object.body().precision()};
}

void restore(Object& object, const SnapshotObject& snapshot) {
  if (snapshot.mesh != object.body().mesh_pointer() || snapshot.precision != object.body().precision()) {
    throw Error("snapshot", "it is of another mesh or precision", "restore it into a body of the same mesh");
  }
  object.deformer().restore(snapshot.snapshot);
}

LinkId link_between(const Mesh& mesh, const std::array<ElementId, 2>& ends) {
  check_elements(mesh, ends);
  const auto link = find_link(mesh, ends[0], ends[1]);
  if (!link) {
    throw Error("elements " + std::to_string(ends[0]) + " and " + std::to_string(ends[1]), "they are not linked",
                "use the two ends of a link");
  }
  return *link;
}

void cut(Object& object, const py::object& links, const py::object& other) {
  if (other.is_none()) {
    object.deformer().cut(ids_of(links, "link"));
  } else {
    const LinkId link = link_between(object.mesh(), {id_of(links, "element"), id_of(other, "element")});
    object.deformer().cut(std::span(&link, 1));
  }
}

// Softness: common, or of each link as arrays

template <class Change>
void change_softness(Object& object, Change change) {
  Softness next = object.body().softness();
  change(next);
  object.deformer().set_softness(next);
}

std::vector<LinkId> every_link(const Mesh& mesh) {
  std::vector<LinkId> links(mesh.link_count());
  std::iota(links.begin(), links.end(), 0);
  return links;
}

/// Returns links, each once. Throws Error if one does not exist.
std::vector<LinkId> unique_links(const Mesh& mesh, const py::object& given) {
  std::vector<LinkId> links = ids_of(given, "link");
  check_links(mesh, links);
  std::ranges::sort(links);
  links.erase(std::unique(links.begin(), links.end()), links.end());
  return links;
}

using Numbers = std::vector<std::pair<double LinkSoftness::*, std::vector<double>>>;

Numbers numbers_given(const py::kwargs& given, std::size_t links) {
  Numbers numbers;
  for (const auto& [key, value] : given) {
    const auto name = key.cast<std::string>();
    const auto found = std::ranges::find(softness_numbers, std::string_view(name),
                                         [](const SoftnessNumber& one) { return one.parameter->name; });
    if (found == softness_numbers.end()) {
      throw py::type_error("set_link_softness() has no argument '" + name + "'");
    }
    if (!value.is_none()) {
      numbers.emplace_back(found->value, numbers_of(value, name, links));
    }
  }
  return numbers;
}

void set_link_softness(Object& object, const py::object& links, const py::kwargs& given) {
  const UseObject use(object);
  const std::vector<LinkId> ids = links.is_none() ? every_link(object.mesh()) : ids_of(links, "link");
  const Numbers numbers = numbers_given(given, ids.size());
  const Unlocked unlocked;
  check_links(object.mesh(), ids);
  std::vector<LinkSoftness> own;
  own.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    own.push_back(object.body().softness().of(ids[i]));
    for (const auto& [number, values] : numbers) {
      own.back().*number = values[i];
    }
  }
  change_softness(object, [&](Softness& softness) { set_own(softness, object.mesh(), ids, own); });
}

py::dict link_softness(Object& object) {
  const Softness& softness = object.body().softness();
  py::dict arrays;
  for (const SoftnessNumber& one : softness_numbers) {
    py::array_t<double> numbers(py::ssize_t(object.mesh().link_count()));
    double* const out = numbers.mutable_data();
    std::fill_n(out, numbers.size(), softness.global.*one.value);
    for (const auto& [link, own] : softness.links) {
      out[link] = own.*one.value;
    }
    arrays[py::str(std::string(one.parameter->name))] = numbers;
  }
  return arrays;
}

void set_softness(Object& object, const LinkSoftness& given, const py::object& links) {
  const std::vector<LinkId> own = links.is_none() ? std::vector<LinkId>() : unique_links(object.mesh(), links);
  check(given);
  change_softness(object, [&](Softness& softness) {
    if (links.is_none()) {
      softness.global = given;
    } else {
      softness.links.set(own, given);
    }
  });
}

void clear_softness(Object& object, const py::object& given) {
  const std::vector<LinkId> links = given.is_none() ? every_link(object.mesh()) : unique_links(object.mesh(), given);
  change_softness(object, [&](Softness& softness) { softness.links.erase(links); });
}

// Positions as arrays

/// Keeps an object alive as long as an array shows its positions.
struct Lease {
  explicit Lease(ObjectPointer shown) : object(std::move(shown)) { object->add_view(); }
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;
  ~Lease() { object->remove_view(); }
  ObjectPointer object;
};

py::array checked_out(const py::object& out, std::size_t rows) {
  const bool fits = py::isinstance<py::array_t<double, py::array::c_style>>(out) &&
                    py::cast<py::array>(out).ndim() == 2 && py::cast<py::array>(out).shape(1) == 3 &&
                    std::size_t(py::cast<py::array>(out).shape(0)) == rows && py::cast<py::array>(out).writeable();
  if (!fits) {
    throw Error("out", "it is not an array that takes the positions",
                "give a writable C-contiguous array of the shape (" + std::to_string(rows) + ", 3) and dtype float64");
  }
  return py::cast<py::array>(out);
}

/// Writes x, y and z of each element without the lock of Python.
void copy_points(const Body& body, double* out) {
  const Unlocked unlocked;
  if (body.mesh().space_dimension == 3) {
    body.copy_positions(std::span(out, std::size_t{3} * body.mesh().element_count()));
    return;
  }
  const PositionView positions = body.positions();
  for (ElementId e = 0; e < body.mesh().element_count(); ++e) {
    out = std::ranges::copy(point_of(body.mesh(), positions, e), out).out;
  }
}

py::array positions(Object& object, const py::object& out) {
  const auto count = py::ssize_t(object.mesh().element_count());
  py::array array =
      out.is_none() ? py::array(py::array_t<double>({count, py::ssize_t(3)})) : checked_out(out, std::size_t(count));
  copy_points(object.body(), static_cast<double*>(array.mutable_data()));
  return array;
}

py::array view(const ObjectPointer& object) {
  const UseObject use(*object);
  Body& body = object->body();
  constexpr const char* where = "stored positions";
  constexpr const char* what_to_do = "use positions(), which copies";
  if (body.stores_displacements()) {
    throw Error(where, "the body stores displacements from rest, not positions", what_to_do);
  }
  if (body.region_axes().is_turned()) {
    throw Error(where, "the body stores coordinates along turned axes", what_to_do);
  }
  const py::capsule owner(new Lease(object), [](void* lease) { delete static_cast<Lease*>(lease); });
  return body.with_view([&]<class View>(const View& view) {
    return shown(view.positions[0].at, view.positions.size(), View::Dimension, sizeof(view.positions[0]), owner);
  });
}

void set_positions(Object& object, const py::object& values) {
  const std::vector<double> all = positions_on(object.mesh(), values);
  const Unlocked unlocked;
  object.deformer().set_positions(all);
}

void add_state(BodyClass& body) {
  body.def(py::init([](const MeshObjectPointer& mesh, const std::string& precision) {
             return std::make_shared<Object>(mesh, named<Precision>("precision", precision));
           }),
           py::arg("mesh").none(false), py::arg("precision") = "double")
      // Neither changes while a body exists, so both may be asked for at any time.
      .def_property_readonly(
          "mesh", [](Object& one) { return one.mesh_object(); }, "The object at rest.")
      .def_property_readonly(
          "precision", [](Object& one) { return word_for(one.body().precision()); },
          "Type of the numbers that store the positions: `double` or `float`.")
      .def("position", used_with_element([](const Body& one, ElementId element) {
             return tuple_of(point_of(one.mesh(), one.positions(), element));
           }),
           py::arg("element"), "Returns the position (x, y, z) of an element (mesh units).")
      .def("reset", used([](Object& one) { one.deformer().reset(); }),
           "Moves all elements to rest. Cuts, pins and softness stay.")
      .def("snapshot", used(&snapshot_of),
           "Returns the positions, to restore them later. Cuts, pins and softness are not part of it.")
      .def("restore", used<const SnapshotObject&>(&restore), py::arg("snapshot"),
           "Restores positions, bit for bit. Raises Error if the snapshot is of another mesh or precision.")
      .def("copy", &copy_of, "Returns an independent copy of the state, without a deformer. The mesh is the same.")
      .def("__copy__", &copy_of)
      .def(
          "__deepcopy__", [](Object& one, const py::object&) { return copy_of(one); }, py::arg("memo"))
      .def("__repr__", &body_in_words);
}

void add_cuts_and_pins(BodyClass& body) {
  body.def("cut", used<const py::object&, const py::object&>(&cut), py::arg("links"), py::arg("other") = py::none(),
           "cut(links) cuts links by their ids. cut(a, b) cuts the link between two elements.\n\n"
           "Nothing is renumbered. Links that are cut already stay cut. Raises Error for an id that does not exist, "
           "and\n"
           "if the two elements are not linked. Nothing has changed then.")
      .def("uncut", used_with_ids("link", [](Deformer& one, const auto& ids) { one.uncut(ids); }), py::arg("links"),
           "Restores cut links.")
      .def("cuts", used([](Object& one) { return array_of(one.body().cuts().links()); }),
           "Returns the ids of the cut links, ascending: shape (n,), dtype uint32. A copy.")
      .def("is_cut", used_with_link([](const Body& one, LinkId link) { return one.cuts().is_cut(link); }),
           py::arg("link"), "Returns True if the link is cut.")
      .def(
          "pin", used_with_ids("element", [](Deformer& one, const auto& ids) { one.pin(ids); }), py::arg("elements"),
          "Pins elements at their current positions: no method moves them, and a move of a pinned element is an error.")
      .def("unpin", used_with_ids("element", [](Deformer& one, const auto& ids) { one.unpin(ids); }),
           py::arg("elements"), "Unpins elements.")
      .def("pins", used([](Object& one) { return array_of(one.body().pins()); }),
           "Returns the pinned elements, ascending: shape (n,), dtype uint32. A copy.")
      .def("is_pinned", used_with_element([](const Body& one, ElementId element) { return one.is_pinned(element); }),
           py::arg("element"), "Returns True if the element is pinned.");
}

void add_energy(BodyClass& body) {
  body.def_property_readonly("energy", used([](Object& one) { return word_for(one.body().softness().energy); }),
                             "The kind of elastic energy, which relaxation lowers: `material` for a new body,\n"
                             "`isotropic`, `axial` or `corotated`.")
      .def("set_energy", used<const std::string&>([](Object& one, const std::string& kind) {
             const auto energy = named<EnergyKind>("energy", kind);
             change_softness(one, [&](Softness& softness) { set_energy(softness, energy); });
           }),
           py::arg("kind"),
           "Sets the kind of elastic energy: `isotropic`, `axial`, `corotated` or `material`. Nothing moves.")
      .def_property_readonly("elasticity", used([](Object& one) { return one.body().elastic(); }),
                             "The settings of the methods of elasticity.")
      .def("set_elasticity", used<const ElasticOptions&>([](Object& one, const ElasticOptions& elasticity) {
             check(elasticity);
             one.body().set_elastic(elasticity);
           }),
           py::arg("elasticity"),
           "Sets the settings of the methods of elasticity. Raises Error if a value is out of its range.");
}

void add_frame(BodyClass& body) {
  body.def_property_readonly("frame",
                             used([](Object& one) { return Rotation::of(one.body().softness().axes.rotation()); }),
                             "The rotation from the axes of the world to those along which valid regions lie.")
      .def("set_frame", used<const Rotation&>([](Object& one, const Rotation& rotation) {
             one.check_no_views("turn the axes");
             const RegionAxes axes = axes_after(rotation, one.mesh());
             change_softness(one, [&](Softness& softness) { softness.axes = axes; });
           }),
           py::arg("rotation"),
           "Turns the axes along which valid regions lie, of all links. Nothing moves; the next move answers.\n\n"
           "Raises Error if the rotation has no axis or leaves the space of the object, and while a view exists.")
      .def(
          "set_frame_of_object", used([](Object& one) {
            one.check_no_views("turn the axes");
            const PrincipalAxes principal = principal_axes(one.mesh());
            change_softness(one, [&](Softness& softness) { softness.axes = principal.axes; });
            return principal.are_unique;
          }),
          "Turns these axes to the principal axes of the object at rest. Returns False if some do not exist, as for a\n"
          "cube: the axes nearest to those of the world are used then.");
}

void add_softness(BodyClass& body) {
  body.def_property_readonly("softness", used([](Object& one) { return one.body().softness().global; }),
                             "The softness of all links that have none of their own.")
      .def("set_softness", used<const LinkSoftness&, const py::object&>(&set_softness), py::arg("softness"),
           py::arg("links") = py::none(),
           "Sets the softness of all links that have none of their own, or gives these links their own.\n\n"
           "Nothing moves; the next move answers. Raises Error if a value is out of its range.")
      .def("set_link_softness", &set_link_softness, py::arg("links") = py::none(),
           "Gives links their own softness from arrays: compression, stretch, shear, lateral, stiffness, exponent.\n\n"
           "`links` are ids; default: all links in the order of their ids. Each other argument is one number, or an\n"
           "array with one number per link: shape (links,). Numbers that are left out stay as they are. Raises Error "
           "for\n"
           "another shape, a value out of its range, and a link that is given twice. Nothing has changed then.")
      .def("clear_softness", used<const py::object&>(&clear_softness), py::arg("links") = py::none(),
           "Takes their own softness away from these links, or from all: the common one applies to them.")
      .def("softness_of", used_with_link([](const Body& one, LinkId link) { return one.softness().of(link); }),
           py::arg("link"), "Returns the softness of a link.")
      .def("link_softness", used(&link_softness),
           "Returns the softness of each link: a dictionary of arrays of the shape (link_count,), dtype float64, by "
           "the\n"
           "names of set_link_softness(). Copies.");
}

void add_position_view(BodyClass& body) {
  body.def("positions", used<const py::object&>(&positions), py::arg("out") = py::none(),
           "Returns the positions of all elements: shape (element_count, 3), dtype float64 (mesh units). A copy.\n\n"
           "`out` is an array that receives them, if given: writable and C-contiguous, of this shape and dtype. "
           "Nothing\n"
           "is allocated then.")
      .def("view", &view,
           "Returns a read-only view of the positions as they are stored: shape (element_count, space_dimension), "
           "dtype\n"
           "float64 or float32 (mesh units). Its columns are the axes that exist (Mesh.axes).\n\n"
           "Nothing is copied: the array shows every later move, and keeps the body alive. Do not read it while "
           "another\n"
           "thread moves the body. Raises Error if the body does not store positions: with the method `exact`, which\n"
           "stores displacements from rest, in float32 far from the origin, and along turned axes. While a view\n"
           "exists, such a method and other axes are refused.")
      .def("set_positions", used<const py::object&>(&set_positions), py::arg("positions"),
           "Sets the positions of all elements, also of pinned ones: shape (element_count, 3) or, for the axes that\n"
           "exist, (element_count, space_dimension) (mesh units). They are rounded to the precision.\n\n"
           "Raises Error for another shape, a coordinate that is not finite, and one on an axis that does not exist.\n"
           "Nothing has changed then.");
}

}  // namespace

void add_body(py::module_& module) {
  py::class_<SnapshotObject> snapshot(module, "Snapshot", "The positions of an object at one time.");
  snapshot.def(py::self == py::self)
      .def("__repr__", [](const SnapshotObject&) { return "<Snapshot>"; })
      .attr("__hash__") = py::none();
  BodyClass body(
      module, "Body",
      "The state of one object: positions, cuts, pins and softness.\n\n"
      "Body(mesh, precision='double') is an object at rest, without cuts and pins. One thread at a time may\n"
      "use a body: Error is raised in a thread that tries while another one moves it. Ids are whole numbers;\n"
      "many ids are a sequence or a one-dimensional array. Every function that takes ids raises Error if one\n"
      "does not exist; nothing has changed then.");
  add_state(body);
  add_cuts_and_pins(body);
  add_softness(body);
  add_energy(body);
  add_frame(body);
  add_position_view(body);
  refuse_pickling(snapshot, "it belongs to a body of this process", "pickle the mesh and positions()");
  refuse_pickling(body, "it belongs to this process", "pickle its mesh and what you changed, and make a Body there");
}

}  // namespace chainmail::python
