#include "chainmail/body.h"

#include <pybind11/operators.h>
#include <pybind11/stl.h>

#include "chainmail/measure.h"
#include "python/arrays.h"
#include "python/module.h"
#include "python/pickling.h"
#include "python/words.h"

namespace chainmail::python {
namespace {

/// Makes a function of a body a method that marks the body as used.
template <class Function>
auto used(Function function) {
  return [function](Object& object) {
    const UseObject use(object);
    return function(object.body());
  };
}

/// The same for functions of ids.
template <class Function>
auto used_with_ids(const char* what, Function function) {
  return [what, function](Object& object, const py::object& ids) {
    const UseObject use(object);
    function(object.body(), ids_of(ids, what));
  };
}

/// Works also while another thread moves the body: a debugger shows it then, too.
std::string body_in_words(Object& object) {
  const api::Body& body = object.body();
  const std::string text = "<Body: " + std::to_string(body.mesh().element_count()) + " elements in " +
                           std::string(word_for(body.precision()));
  if (object.busy().is_used()) {
    return text + ", in use>";
  }
  const auto count = [](std::size_t number, const char* word) {
    return number == 0 ? "" : ", " + std::to_string(number) + " " + word;
  };
  return text + count(body.pins().size(), "pinned") + count(body.cuts().size(), "links cut") + ">";
}

ObjectPointer copy_of(Object& object) {
  const UseObject use(object);
  return std::make_shared<Object>(object.body());
}

void cut(Object& object, const py::object& links, const py::object& other) {
  const UseObject use(object);
  if (other.is_none()) {
    object.body().cut(ids_of(links, "link"));
  } else {
    object.body().cut(id_of(links, "element"), id_of(other, "element"));
  }
}

void add_state(BodyClass& body) {
  body.def(py::init([](const api::Mesh& mesh, const std::string& precision) {
             return std::make_shared<Object>(api::Body(mesh, precision_of(precision)));
           }),
           py::arg("mesh"), py::arg("precision") = "double")
      // Neither changes while a body exists, so both may be asked for at any time.
      .def_property_readonly(
          "mesh", [](Object& one) { return one.body().mesh(); }, "The object at rest.")
      .def_property_readonly(
          "precision", [](Object& one) { return word_for(one.body().precision()); },
          "Type of the numbers that store the positions: `double` or `float`.")
      .def(
          "position",
          [](Object& one, const py::object& element) {
            const UseObject use(one);
            return tuple_of(one.body().position(id_of(element, "element")));
          },
          py::arg("element"), "Returns the position (x, y, z) of an element (mesh units).")
      .def("reset", used([](api::Body& one) { one.reset(); }),
           "Moves all elements to rest. Cuts, pins and softness stay.")
      .def("snapshot", used([](const api::Body& one) { return one.snapshot(); }),
           "Returns the positions, to restore them later. Cuts, pins and softness are not part of it.")
      .def(
          "restore",
          [](Object& one, const api::Snapshot& snapshot) {
            const UseObject use(one);
            one.body().restore(snapshot);
          },
          py::arg("snapshot"),
          "Restores positions, bit for bit. Raises Error if the snapshot is of another mesh or precision.")
      .def("copy", &copy_of, "Returns an independent copy of the state, without a deformer. The mesh is the same.")
      .def("__copy__", &copy_of)
      .def(
          "__deepcopy__", [](Object& one, const py::object&) { return copy_of(one); }, py::arg("memo"))
      .def("__repr__", &body_in_words);
}

void add_cuts_and_pins(BodyClass& body) {
  body.def("cut", &cut, py::arg("links"), py::arg("other") = py::none(),
           "cut(links) cuts links by their ids. cut(a, b) cuts the link between two elements.\n\n"
           "Nothing is renumbered. Links that are cut already stay cut. Raises Error for an id that does not exist, "
           "and\n"
           "if the two elements are not linked. Nothing has changed then.")
      .def("uncut", used_with_ids("link", [](api::Body& one, const auto& ids) { one.uncut(ids); }), py::arg("links"),
           "Restores cut links.")
      .def("cuts", used([](const api::Body& one) { return array_of(one.cuts()); }),
           "Returns the ids of the cut links, ascending: shape (n,), dtype uint32. A copy.")
      .def(
          "is_cut",
          [](Object& one, const py::object& link) {
            const UseObject use(one);
            return one.body().is_cut(id_of(link, "link"));
          },
          py::arg("link"), "Returns True if the link is cut.")
      .def(
          "pin", used_with_ids("element", [](api::Body& one, const auto& ids) { one.pin(ids); }), py::arg("elements"),
          "Pins elements at their current positions: no method moves them, and a move of a pinned element is an error.")
      .def("unpin", used_with_ids("element", [](api::Body& one, const auto& ids) { one.unpin(ids); }),
           py::arg("elements"), "Unpins elements.")
      .def("pins", used([](const api::Body& one) { return array_of(one.pins()); }),
           "Returns the pinned elements, ascending: shape (n,), dtype uint32. A copy.")
      .def(
          "is_pinned",
          [](Object& one, const py::object& element) {
            const UseObject use(one);
            return one.body().is_pinned(id_of(element, "element"));
          },
          py::arg("element"), "Returns True if the element is pinned.");
}

void add_energy(BodyClass& body) {
  body.def_property_readonly("energy", used([](const api::Body& one) { return word_for(one.energy()); }),
                             "The kind of elastic energy, which relaxation lowers: `material` for a new body,\n"
                             "`isotropic`, `axial` or `corotated`.")
      .def(
          "set_energy",
          [](Object& one, const std::string& kind) {
            const UseObject use(one);
            one.body().set_energy(energy_of(kind));
          },
          py::arg("kind"),
          "Sets the kind of elastic energy: `isotropic`, `axial`, `corotated` or `material`. Nothing moves.")
      .def_property_readonly("elasticity", used([](const api::Body& one) { return one.elasticity(); }),
                             "The settings of the methods of elasticity.")
      .def(
          "set_elasticity",
          [](Object& one, const api::Elasticity& elasticity) {
            const UseObject use(one);
            one.body().set_elasticity(elasticity);
          },
          py::arg("elasticity"),
          "Sets the settings of the methods of elasticity. Raises Error if a value is out of its range.");
}

void add_frame(BodyClass& body) {
  body.def_property_readonly("frame", used([](const api::Body& one) { return one.frame(); }),
                             "The rotation from the axes of the world to those along which valid regions lie.")
      .def(
          "set_frame",
          [](Object& one, const api::Rotation& rotation) {
            const UseObject use(one);
            one.check_no_views("turn the axes");
            one.body().set_frame(rotation);
          },
          py::arg("rotation"),
          "Turns the axes along which valid regions lie, of all links. Nothing moves; the next move answers.\n\n"
          "Raises Error if the rotation has no axis or leaves the space of the object, and while a view exists.")
      .def(
          "set_frame_of_object",
          [](Object& one) {
            const UseObject use(one);
            one.check_no_views("turn the axes");
            return one.body().set_frame_of_object();
          },
          "Turns these axes to the principal axes of the object at rest. Returns False if some do not exist, as for a\n"
          "cube: the axes nearest to those of the world are used then.");
}

}  // namespace

void add_body(py::module_& module) {
  py::class_<api::Snapshot> snapshot(module, "Snapshot", "The positions of an object at one time.");
  snapshot.def(py::self == py::self)
      .def("__repr__", [](const api::Snapshot&) { return "<Snapshot>"; })
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
