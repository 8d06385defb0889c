// Bodies: state, cuts, pins, softness, and positions as arrays: copies, and views of what the solver stores.
#include <pybind11/operators.h>

#include <algorithm>
#include <numeric>

#include "body/body_view.h"
#include "python/arguments.h"
#include "python/long_work.h"
#include "python/module.h"
#include "python/pickling.h"

namespace chainmail::python {
namespace {

using BodyClass = py::class_<Object, ObjectPointer>;
using UsedBody = const Used<Object>&;

/// The positions of an object at one time.
struct SnapshotObject {
  Snapshot snapshot;
  MeshPointer mesh;
  Precision precision;
  bool operator==(const SnapshotObject&) const = default;
};

/// Works also while another thread moves the body: a debugger shows it then, too.
std::string body_in_words(Object& object) {
  const Body& body = object.body();
  const std::string text = "<Body: " + std::to_string(body.mesh().element_count()) + " elements in " +
                           std::string(word_for(body.precision()));
  if (object.is_used()) {
    return text + ", in use>";
  }
  const auto count = [](std::size_t number, const char* word) {
    return number == 0 ? "" : ", " + std::to_string(number) + " " + word;
  };
  return text + count(body.pins().size(), "pinned") + count(body.cuts().count(), "links cut") + ">";
}

ObjectPointer copy_of(UsedBody object) { return std::make_shared<Object>(*object); }

void restore(UsedBody object, const SnapshotObject& snapshot) {
  if (snapshot.mesh != object->body().mesh_pointer() || snapshot.precision != object->body().precision()) {
    throw Error("snapshot", "it is of another mesh or precision", "restore it into a body of the same mesh");
  }
  object->deformer().restore(snapshot.snapshot);
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

void cut(UsedBody object, const py::object& links, const py::object& other) {
  if (other.is_none()) {
    object->deformer().cut(ids_of(links, "link"));
  } else {
    const LinkId link = link_between(object->mesh(), {id_of(links, "element"), id_of(other, "element")});
    object->deformer().cut(std::span(&link, 1));
  }
}

// Softness: common, or of each link as arrays

template <class Change>
void change_softness(UsedBody object, Change change) {
  Softness next = object->body().softness();
  change(next);
  object->deformer().set_softness(next);
}

std::vector<LinkId> every_link(const Mesh& mesh) {
  std::vector<LinkId> links(mesh.link_count());
  std::iota(links.begin(), links.end(), 0);
  return links;
}

/// Returns the given links, each once, or all. Throws Error if one does not exist.
std::vector<LinkId> unique_links(const Mesh& mesh, std::optional<Links> given) {
  if (!given) {
    return every_link(mesh);
  }
  check_links(mesh, *given);
  std::ranges::sort(*given);
  given->erase(std::unique(given->begin(), given->end()), given->end());
  return *given;
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

void set_link_softness(UsedBody object, const std::optional<Links>& links, const py::kwargs& given) {
  const std::vector<LinkId> ids = links ? std::vector<LinkId>(*links) : every_link(object->mesh());
  const Numbers numbers = numbers_given(given, ids.size());
  const Unlocked unlocked;
  check_links(object->mesh(), ids);
  std::vector<LinkSoftness> own;
  own.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    own.push_back(object->body().softness().of(ids[i]));
    for (const auto& [number, values] : numbers) {
      own.back().*number = values[i];
    }
  }
  change_softness(object, [&](Softness& softness) { set_own(softness, object->mesh(), ids, own); });
}

py::dict link_softness(UsedBody object) {
  const Softness& softness = object->body().softness();
  py::dict arrays;
  for (const SoftnessNumber& one : softness_numbers) {
    py::array_t<double> numbers(py::ssize_t(object->mesh().link_count()));
    double* const out = numbers.mutable_data();
    std::fill_n(out, numbers.size(), softness.global.*one.value);
    for (const auto& [link, own] : softness.links) {
      out[link] = own.*one.value;
    }
    arrays[one.parameter->name.data()] = numbers;
  }
  return arrays;
}

void set_softness(UsedBody object, const LinkSoftness& given, const std::optional<Links>& links) {
  const std::vector<LinkId> own = links ? unique_links(object->mesh(), links) : std::vector<LinkId>();
  check(given);
  change_softness(object, [&](Softness& softness) {
    if (links) {
      softness.links.set(own, given);
    } else {
      softness.global = given;
    }
  });
}

void clear_softness(UsedBody object, const std::optional<Links>& given) {
  const std::vector<LinkId> links = unique_links(object->mesh(), given);
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

py::array_t<double> checked_out(const py::object& out, py::ssize_t rows) {
  if (py::isinstance<py::array_t<double, py::array::c_style>>(out)) {
    const auto array = py::reinterpret_borrow<py::array_t<double>>(out);
    if (array.ndim() == 2 && array.shape(0) == rows && array.shape(1) == 3 && array.writeable()) {
      return array;
    }
  }
  throw Error("out", "it is not an array that takes the positions",
              "give a writable C-contiguous array of the shape (" + std::to_string(rows) + ", 3) and dtype float64");
}

/// Writes x, y and z of each element without the lock of Python.
void write_positions(const Body& body, double* out) {
  const Unlocked unlocked;
  const Mesh& mesh = body.mesh();
  if (mesh.space_dimension == 3) {
    body.copy_positions(std::span(out, std::size_t{3} * mesh.element_count()));
  } else {
    const PositionView positions = body.positions();
    write_points(mesh, out, [&](ElementId e) { return point_of(mesh, positions, e); });
  }
}

py::array_t<double> positions(UsedBody object, const py::object& out) {
  const auto count = py::ssize_t(object->mesh().element_count());
  auto array = out.is_none() ? py::array_t<double>({count, py::ssize_t(3)}) : checked_out(out, count);
  write_positions(object->body(), array.mutable_data());
  return array;
}

py::array view(const ObjectPointer& object) {
  const Used use(*object);
  Body& body = object->body();
  constexpr const char* where = "stored positions";
  constexpr const char* what_to_do = "use positions(), which copies";
  if (body.stores_displacements()) {
    throw Error(where, "the body stores displacements from rest, not positions", what_to_do);
  }
  if (body.region_axes().is_turned()) {
    throw Error(where, "the body stores coordinates along turned axes", what_to_do);
  }
  const py::capsule owner = kept<Lease>(object);
  return body.with_view([&]<class View>(const View& view) {
    return shown(view.positions[0].at, view.positions.size(), View::Dimension, sizeof(view.positions[0]), owner);
  });
}

void set_positions(UsedBody object, const py::object& values) {
  const std::vector<double> all = positions_on(object->mesh(), values);
  const Unlocked unlocked;
  object->deformer().set_positions(all);
}

void add_state(BodyClass& body) {
  body.def(py::init<MeshObjectPointer, Precision>(), py::arg("mesh").none(false),
           py::arg("precision") = Precision::double_precision)
      // They change only with the lock of Python, so both may be asked for at any time.
      .def_property_readonly(
          "mesh", [](Object& one) { return one.mesh_object(); }, "The object at rest. A split replaces it.")
      .def_property_readonly(
          "precision", [](Object& one) { return one.body().precision(); },
          "Type of the numbers that store the positions: `double` or `float`.")
      .def(
          "position",
          [](UsedBody one, Element element) {
            return tuple_of(point_of(one->mesh(), one->body().positions(), element.in(one->mesh())));
          },
          py::arg("element"), "Returns the position (x, y, z) of an element (mesh units).")
      .def(
          "reset", [](UsedBody one) { one->deformer().reset(); },
          "Moves all elements to rest. Cuts, pins and softness stay.")
      .def(
          "snapshot",
          [](UsedBody one) {
            const Body& now = one->body();
            return SnapshotObject{now.snapshot(), now.mesh_pointer(), now.precision()};
          },
          "Returns the positions, to restore them later. Cuts, pins and softness are not part of it.")
      .def("restore", &restore, py::arg("snapshot"),
           "Restores positions, bit for bit. Raises Error if the snapshot is of another mesh or precision.")
      .def("copy", &copy_of, "Returns an independent copy of the state, without a deformer. The mesh is the same.")
      .def("__copy__", &copy_of)
      .def(
          "__deepcopy__", [](UsedBody one, const py::object&) { return copy_of(one); }, py::arg("memo"))
      .def("__repr__", &body_in_words);
}

void add_cuts_and_pins(BodyClass& body) {
  body.def("cut", &cut, py::arg("links"), py::arg("other") = py::none(),
           "cut(links) cuts links by their ids. cut(a, b) cuts the link between two elements.\n\n"
           "Nothing is renumbered. Links that are cut already stay cut. Raises Error for an id that does not exist,\n"
           "and if the two elements are not linked. Nothing has changed then.")
      .def(
          "uncut", [](UsedBody one, const Links& ids) { one->deformer().uncut(ids); }, py::arg("links"),
          "Restores cut links.")
      .def(
          "cuts", [](UsedBody one) { return array_of(one->body().cuts().links()); },
          "Returns the ids of the cut links, ascending: shape (n,), dtype uint32. A copy.")
      .def(
          "is_cut", [](UsedBody one, Link link) { return one->body().cuts().is_cut(link.in(one->mesh())); },
          py::arg("link"), "Returns True if the link is cut.")
      .def(
          "pin", [](UsedBody one, const Elements& ids) { one->deformer().pin(ids); }, py::arg("elements"),
          "Pins elements at their current positions: no method moves them, and a move of a pinned element is an error.")
      .def(
          "unpin", [](UsedBody one, const Elements& ids) { one->deformer().unpin(ids); }, py::arg("elements"),
          "Unpins elements.")
      .def(
          "pins", [](UsedBody one) { return array_of(one->body().pins()); },
          "Returns the pinned elements, ascending: shape (n,), dtype uint32. A copy.")
      .def(
          "is_pinned", [](UsedBody one, Element element) { return one->body().is_pinned(element.in(one->mesh())); },
          py::arg("element"), "Returns True if the element is pinned.");
}

void add_energy(BodyClass& body) {
  body.def_property_readonly(
          "energy", [](UsedBody one) { return one->body().softness().energy; },
          "The kind of elastic energy, which relaxation lowers: `material` for a new body, `isotropic`, `axial` or\n"
          "`corotated`.")
      .def(
          "set_energy",
          [](UsedBody one, EnergyKind kind) {
            change_softness(one, [&](Softness& softness) { set_energy(softness, kind); });
          },
          py::arg("kind"),
          "Sets the kind of elastic energy: `isotropic`, `axial`, `corotated` or `material`. Nothing moves.")
      .def_property_readonly(
          "elasticity", [](UsedBody one) { return one->body().elastic(); },
          "The settings of the methods of elasticity.")
      .def(
          "set_elasticity",
          [](UsedBody one, const ElasticOptions& elasticity) {
            check(elasticity);
            one->body().set_elastic(elasticity);
          },
          py::arg("elasticity"),
          "Sets the settings of the methods of elasticity. Raises Error if a value is out of its range.");
}

void add_frame(BodyClass& body) {
  body.def_property_readonly(
          "frame", [](UsedBody one) { return Rotation::of(one->body().softness().axes.rotation()); },
          "The rotation from the axes of the world to those along which valid regions lie.")
      .def(
          "set_frame",
          [](UsedBody one, const Rotation& rotation) {
            one->check_no_views("turn the axes");
            change_softness(one, [&](Softness& softness) { softness.axes = axes_after(rotation, one->mesh()); });
          },
          py::arg("rotation"),
          "Turns the axes along which valid regions lie, of all links. Nothing moves; the next move answers.\n\n"
          "Raises Error if the rotation has no axis or leaves the space of the object, and while a view exists.")
      .def(
          "set_frame_of_object",
          [](UsedBody one) {
            one->check_no_views("turn the axes");
            const PrincipalAxes principal = principal_axes(one->mesh());
            change_softness(one, [&](Softness& softness) { softness.axes = principal.axes; });
            return principal.are_unique;
          },
          "Turns these axes to the principal axes of the object at rest. Returns False if some do not exist, as for\n"
          "a cube: the axes nearest to those of the world are used then.");
}

void add_softness(BodyClass& body) {
  body.def_property_readonly(
          "softness", [](UsedBody one) { return one->body().softness().global; },
          "The softness of all links that have none of their own.")
      .def("set_softness", &set_softness, py::arg("softness"), py::arg("links") = py::none(),
           "Sets the softness of all links that have none of their own, or gives these links their own.\n\n"
           "Nothing moves; the next move answers. Raises Error if a value is out of its range.")
      .def("set_link_softness", &set_link_softness, py::arg("links") = py::none(),
           ("Gives links their own softness from arrays: " + softness_names(", ") +
            ".\n\n"
            "`links` are ids; default: all links in the order of their ids. Each other argument is one number, or an\n"
            "array with one number per link: shape (links,). Numbers that are left out stay as they are. Raises\n"
            "Error for another shape, a value out of its range, and a link that is given twice. Nothing has changed\n"
            "then.")
               .c_str())
      .def("clear_softness", &clear_softness, py::arg("links") = py::none(),
           "Takes their own softness away from these links, or from all: the common one applies to them.")
      .def(
          "softness_of", [](UsedBody one, Link link) { return one->body().softness().of(link.in(one->mesh())); },
          py::arg("link"), "Returns the softness of a link.")
      .def("link_softness", &link_softness,
           "Returns the softness of each link: a dictionary of arrays of the shape (link_count,), dtype float64, by\n"
           "the names of set_link_softness(). Copies.");
}

void add_position_view(BodyClass& body) {
  body.def("positions", &positions, py::arg("out") = py::none(),
           "Returns the positions of all elements: shape (element_count, 3), dtype float64 (mesh units). A copy.\n\n"
           "`out` is an array that receives them, if given: writable and C-contiguous, of this shape and dtype.\n"
           "Nothing is allocated then.")
      .def("view", &view,
           "Returns a read-only view of the positions as they are stored: shape (element_count, space_dimension),\n"
           "dtype float64 or float32 (mesh units). Its columns are the axes that exist (Mesh.axes).\n\n"
           "Nothing is copied: the array shows every later move, and keeps the body alive. Do not read it while\n"
           "another thread moves the body. Raises Error if the body does not store positions: with the method\n"
           "`exact`, which stores displacements from rest, in float32 far from the origin, and along turned axes.\n"
           "While a view exists, such a method and other axes are refused.")
      .def("set_positions", &set_positions, py::arg("positions"),
           "Sets the positions of all elements, also of pinned ones: shape (element_count, 3) or, for the axes that\n"
           "exist, (element_count, space_dimension) (mesh units). They are rounded to the precision.\n\n"
           "Raises Error for another shape, a coordinate that is not finite, and one on an axis that does not\n"
           "exist. Nothing has changed then.");
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
      "Body(mesh, precision='double') is an object at rest, without cuts and pins. One thread at a time may use a\n"
      "body: Error is raised in a thread that tries while another one moves it. Ids are whole numbers; many ids are\n"
      "a sequence or a one-dimensional array. Every function that takes ids raises Error if one does not exist;\n"
      "nothing has changed then.");
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
