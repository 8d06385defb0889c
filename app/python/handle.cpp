#include "chainmail/handle.h"

#include "python/arrays.h"
#include "python/held_handle.h"
#include "python/module.h"
#include "python/pickling.h"

namespace chainmail::python {
namespace {

template <class Function>
auto used_handle(Function function) {
  return [function](HeldHandle& held) {
    const Use use(held.busy, "handle");
    return function(held.handle);
  };
}

std::string handle_in_words(const HeldHandle& held) {
  const auto elements = held.handle.elements();
  const std::string text = "<Handle: " + (elements.size() == 1 ? "element " + std::to_string(elements.front())
                                                               : std::to_string(elements.size()) + " elements");
  return held.busy.is_used() ? text + ", in use>"
                             : text + " at " + std::string(py::repr(tuple_of(held.handle.pose().pivot))) + ">";
}

}  // namespace

void add_handle(py::module_& module) {
  py::class_<HeldHandle, std::shared_ptr<HeldHandle>> handle(
      module, "Handle",
      "What is grabbed: one element, or many that move together as one rigid body.\n\n"
      "Handle(body, elements) grabs elements at their current positions; nothing moves. The pivot is the mean of "
      "these\n"
      "positions. Raises Error if there is none, or if one does not exist, is given twice or is pinned. After "
      "positions\n"
      "were set, restored or reset, grab again.");
  handle
      .def(py::init([](Object& object, const py::object& elements) {
             const UseObject use(object);
             return std::make_shared<HeldHandle>(api::Handle(object.body(), ids_of(elements, "element")));
           }),
           py::arg("body"), py::arg("elements"))
      .def_property_readonly("elements", used_handle([](const api::Handle& one) { return array_of(one.elements()); }),
                             "The grabbed elements, ascending: shape (n,), dtype uint32. A copy.")
      .def_property_readonly("grabbed", used_handle([](const api::Handle& one) { return one.grabbed(); }),
                             "The pose at which it was grabbed.")
      .def_property_readonly("pose", used_handle([](const api::Handle& one) { return one.pose(); }),
                             "The pose that the last move reached.")
      .def(
          "after",
          [](HeldHandle& held, const py::object& by, const api::Rotation& rotation) {
            const Use use(held.busy, "handle");
            return held.handle.after({vector_of(by, "by"), rotation});
          },
          py::arg("by"), py::arg("rotation") = api::Rotation(),
          "Returns the pose after a motion from where it was grabbed: a displacement (x, y, z) of the pivot (mesh "
          "units)\n"
          "and a rotation about the pivot.")
      .def("__repr__", &handle_in_words);
  refuse_pickling(handle, "it is of a mesh of this process", "grab its elements there");
}

}  // namespace chainmail::python
