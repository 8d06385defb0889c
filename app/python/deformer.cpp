// Deformers: methods, handles, moves and relaxation.
#include <algorithm>

#include "body/blade.h"
#include "python/long_work.h"
#include "python/module.h"
#include "python/value.h"

namespace chainmail::python {
namespace {

using MoverClass = py::class_<Mover>;

constexpr std::uint64_t quick_visits = 200'000;  // visits of elements that take a few ms

/// What a move did.
struct MoveResult {
  std::uint64_t checked = 0, moved = 0;
  bool stopped = false;
  UserPose reached;
  std::string remark;
};

/// Runs work on a deformer without the lock of Python. Work that may take long looks for Ctrl-C meanwhile.
template <class Work>
auto run(Object& object, bool is_slow, Work work) {
  if (!is_slow) {
    const Unlocked unlocked;
    return work(object.deformer());
  }
  try {
    return run_long(&object.job(), py::none(), [&](const Progress&) { return work(object.deformer()); });
  } catch (const py::error_already_set&) {
    object.set_job(Progress::watched());  // the cancelled one would cancel the next move, too
    throw;
  }
}

/// Moves a handle, or an element, to what it is given. Returns all but the pose that was reached. Methods of elasticity
/// prepare, which may take long.
template <class Moved, class Target>
MoveResult pass(Object& object, Moved& moved, const Target& target) {
  return run(object, info(object.method()).family() == Family::elastic, [&](Deformer& deformer) {
    const PassCount count = deformer.move(moved, target, object.new_trace());
    return MoveResult{count.checked, count.moved, count.stopped, {}, deformer.remark()};
  });
}

MoveResult move_handle(Object& object, HeldHandle& held, const py::object& target) {
  const Used use(held);
  if (!py::isinstance<UserPose>(target)) {
    throw py::type_error("the target of a handle is a Pose, such as handle.after((1, 0, 0))");
  }
  const auto pose = target.cast<UserPose>();
  if (held.mesh != object.body().mesh_pointer()) {
    throw Error("handle", "it is of another mesh", "grab elements of this object");
  }
  check_position(object.mesh(), "pivot", pose.pivot);
  check(pose.rotation, object.mesh());
  MoveResult result = pass(object, held.handle, pose.pose());
  result.reached = UserPose::of(held.handle.pose());
  return result;
}

MoveResult move(const Used<Mover>& object, const py::object& what, const py::object& target) {
  if (!PyLong_CheckExact(what.ptr()) && py::isinstance<HeldHandle>(what)) {
    return move_handle(*object, what.cast<HeldHandle&>(), target);
  }
  const ElementId element = id_of(what, "element");
  const Point to = vector_of(target, "target");
  check_element(object->mesh(), element);
  check_position(object->mesh(), "target", to);
  MoveResult result = pass(*object, element, to);
  result.reached.pivot = point_of(object->mesh(), object->body().positions(), element);
  return result;
}

std::size_t split(const Used<Mover>& object, const py::sequence& line, const py::object& along) {
  Blade blade;
  for (const py::object& point : list_of<py::object>(line, "line")) {
    blade.line.push_back(vector_of(point, "line"));
  }
  if (!along.is_none()) {
    blade.along = vector_of(along, "along");
  }
  const auto found = run(*object, false, [&](Deformer& deformer) { return split_along(blade, deformer.body()); });
  if (!found) {
    return 0;
  }
  object->split(found);
  return found->edit().elements.size();
}

int relax(const Used<Mover>& object, int sweeps, double step, RelaxationScheme scheme, double until, bool local) {
  const std::uint64_t visits = std::uint64_t{object->mesh().element_count()} * std::uint64_t(std::max(sweeps, 0));
  return run(*object, scheme == RelaxationScheme::equilibrium || visits > quick_visits, [&](Deformer& deformer) {
    return deformer.relax(sweeps, {step, scheme, until, local}).sweeps;
  });
}

/// Returns the trace as rows: element, sponsor or -1, and 1 if it moved.
py::array_t<std::int64_t> trace_of(const Used<Mover>& object) {
  py::array_t<std::int64_t> rows({py::ssize_t(object->trace().size()), py::ssize_t(3)});
  std::int64_t* out = rows.mutable_data();
  for (const TraceRow& row : object->trace()) {
    *out++ = row.element;
    *out++ = row.sponsor == no_element ? -1 : std::int64_t(row.sponsor);
    *out++ = row.moved ? 1 : 0;
  }
  return rows;
}

py::list rows_of_methods() {
  py::list rows;
  for (const AlgorithmInfo& one : every_algorithm()) {
    rows.append(py::dict(py::arg("name") = one.offered_name(), py::arg("label") = one.label,
                         py::arg("source") = one.source, py::arg("summary") = one.summary,
                         py::arg("family") = one.family() == Family::chainmail ? "chainmail" : "elastic",
                         py::arg("needs_grid") = one.needs_grid, py::arg("needs_pins") = one.needs_pins,
                         py::arg("holds_links") = one.holds_links));
  }
  return rows;
}

std::string refusal(Algorithm method, const MeshObject& mesh) {
  try {
    check(method, *mesh.mesh);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

template <class Owner>
std::shared_ptr<HeldHandle> grab(const Used<Owner>& object, const Elements& elements) {
  return std::make_shared<HeldHandle>(*object, elements);
}

std::string handle_in_words(const HeldHandle& held) {
  const auto elements = held.handle.elements();
  const std::string text = "<Handle: " + (elements.size() == 1 ? "element " + std::to_string(elements.front())
                                                               : std::to_string(elements.size()) + " elements");
  return held.is_used() ? text + ", in use>"
                        : text + " at " + std::string(py::repr(tuple_of(held.handle.pose().pivot))) + ">";
}

void add_results(py::module_& module) {
  py::class_<MoveResult> result(module, "MoveResult", "What a move did.");
  add_parts(result, Part{"checked", &MoveResult::checked, "Number of candidates that the method processed."},
            Part{"moved", &MoveResult::moved, "Number of elements that moved, without the handle."},
            Part{"stopped", &MoveResult::stopped, "True if the handle stopped before its target."},
            Part{"reached", &MoveResult::reached, "The pose where the handle is now."},
            Part{"remark", &MoveResult::remark, "Reason why the move did not end as requested. Usually empty."});
  result.def("__repr__", [](const MoveResult& one) {
    return "<MoveResult: " + std::to_string(one.moved) + " moved, " + std::to_string(one.checked) + " checked" +
           (one.stopped ? ", stopped" : "") + (one.remark.empty() ? "" : ", " + one.remark) + ">";
  });
  using One = EquilibriumCertificate;
  py::class_<One> certificate(module, "EquilibriumCertificate", "How close an object is to the equilibrium.");
  add_parts(certificate, Part{"violation", &One::violation, "Largest violation of a link, in rest lengths."},
            Part{"residual", &One::residual,
                 "Estimated distance from the equilibrium, in the norm of the energy, relative to its root."},
            Part{"energy_gap", &One::gap,
                 "Energy above a lower bound of the energy of all valid states, relative to the energy. None for\n"
                 "corotated links and the material."},
            Part{"regions_bind", &One::binds, "True if valid regions change the equilibrium."},
            Part{"iterations", &One::iterations, "Iterations since the handle, the pins or the object changed."});
  certificate.def("__repr__", [](const One& one) {
    return "<EquilibriumCertificate: residual " + std::string(py::repr(py::float_(one.residual))) + " after " +
           std::to_string(one.iterations) + " iterations>";
  });
}

void add_moves(MoverClass& deformer) {
  deformer
      .def("grab", &grab<Mover>, py::arg("elements"), "Grabs elements; the same as Handle(deformer.body, elements).")
      .def("move", &move, py::arg("what"), py::arg("target"),
           "Moves the handle, and the method answers: one pass.\n\n"
           "move(element, (x, y, z)) moves one element to a position (mesh units). move(handle, pose) moves a\n"
           "handle to a pose, such as handle.after((1, 0, 0)). Coordinates that are left out are 0.\n\n"
           "Raises Error if an id does not exist, the handle is of another mesh, an element of it is pinned, the\n"
           "target is not finite or would leave the space of the object, and if the method has no answer; and\n"
           "Cancelled. Nothing has moved then.")
      .def(
          "moved", [](const Used<Mover>& object) { return array_of(object->deformer().moved()); },
          "Returns the elements that the last move moved, in order of update, without the handle: shape (n,), dtype\n"
          "uint32. A copy.")
      .def("split", &split, py::arg("line"), py::arg("along") = py::none(),
           "Splits the object along a blade: a line of points (x, y, z) where the elements are now (mesh units),\n"
           "swept both ways along a direction. Divides cells, or faces if there are no cells, and moves nothing.\n\n"
           "Returns the number of new elements; 0 if nothing came apart. All elements keep their ids; links get new\n"
           "ones. `body.mesh` is another mesh then: grab handles again. In a plane, `along` may be left out. Raises\n"
           "Error if the object has neither cells nor faces, or is a lattice of faces, for fewer than two points, for\n"
           "coordinates that are not finite or leave the space of the object, for a direction of length 0 or in the\n"
           "plane of the object, if the method does not work after the split, and while a view of the positions\n"
           "exists. Nothing has changed then.")
      .def(
          "release", [](const Used<Mover>& object) { object->deformer().release(); },
          "Releases the handle of the last move: relaxation may move its elements.")
      .def(
          "set_tracing", [](const Used<Mover>& object, bool on) { object->set_tracing(on); }, py::arg("on"),
          "Turns on or off that moves are traced.")
      .def("trace", &trace_of,
           "Returns the candidates of the last move, in order, if it was traced: shape (n, 3), dtype int64. The\n"
           "columns are the element, its sponsor (-1: none) and 1 if it moved. A copy.");
}

void add_relaxation(MoverClass& deformer) {
  const RelaxOptions defaults;
  deformer
      .def("relax", &relax, py::arg("sweeps"), py::kw_only(), py::arg("step") = defaults.step,
           py::arg("scheme") = defaults.scheme, py::arg("until") = defaults.until, py::arg("local") = defaults.local,
           "Runs sweeps of relaxation about the elements of the last move, until nothing moves or this many have\n"
           "run.\n\n"
           "The handle and the pins stay, and each element stays in the valid regions of its neighbours. `step` is\n"
           "the share of the way that an element moves per sweep: above 0, to 1. `scheme` is `mean`, `link` or\n"
           "`equilibrium`, which runs iterations instead, for all elements, until the distance from the equilibrium\n"
           "is at most `until`. With `local`, after a move of a large object with open regions, they are fine only\n"
           "near the handle and cuts. Returns the number of sweeps that ran; 0 for methods of elasticity, whose\n"
           "answers are equilibria. Raises Error for a number out of its range; and Cancelled, which keeps the\n"
           "positions that were reached.")
      .def(
          "certificate",
          [](const Used<Mover>& object) {
            const Unlocked unlocked;
            return object->deformer().certificate().value_or(EquilibriumCertificate());
          },
          "Returns how close the object is to the equilibrium; all zeros if it was not relaxed to it.");
}

void add_settings(MoverClass& deformer) {
  deformer
      .def_property_readonly(
          "body", [](const Mover& mover) { return mover.object(); },
          "The object. Its cuts, pins, softness and positions may be changed between moves.")
      .def_property_readonly(
          "method",
          // It changes only with the lock of Python.
          [](const Mover& mover) { return mover.object()->method(); }, "Name of the method.")
      .def(
          "set_method", [](const Used<Mover>& object, Algorithm method) { object->set_method(method); },
          py::arg("method"),
          "Continues with another method from the current positions. Raises Error if there is none with this name,\n"
          "if it does not work on the mesh, and if a view of the positions would not show positions any more.")
      .def(
          "set_threads", [](const Used<Mover>& object, int threads) { object->deformer().set_threads(threads); },
          py::arg("threads"),
          "Sets the number of threads that a move may use, at least 1, which is the default. Only `exact` uses\n"
          "more, for large objects, and no result depends on it.")
      .def(
          "set_job", [](const Used<Mover>& object, const Progress& job) { object->set_job(job); }, py::arg("job"),
          "Sets the job that long preparations, solutions and sweeps report to, and that can cancel them.")
      .def("__repr__", [](const Mover& mover) {
        return "<Deformer: " + std::string(info(mover.object()->method()).offered_name()) + " on " +
               std::to_string(mover.object()->mesh().element_count()) + " elements>";
      });
}

py::array deform(const MeshObjectPointer& mesh, const Elements& elements, const py::object& by, Algorithm method) {
  const Point displacement = vector_of(by, "by");
  const Mover mover(std::make_shared<Object>(mesh, Precision::double_precision), method);
  Object& object = *mover.object();
  HeldHandle held(object, elements);
  check_displacement(*mesh->mesh, "displacement", displacement);
  const Pose target{held.handle.grabbed().pivot + displacement, Point::Zero()};
  run_long(&object.job(), py::none(), [&](const Progress&) { return object.deformer().move(held.handle, target); });
  const PositionView positions = object.body().positions();
  return array_of_points(*mesh->mesh, [&](ElementId e) { return point_of(*mesh->mesh, positions, e); });
}

void add_handle(py::module_& module) {
  py::class_<HeldHandle, std::shared_ptr<HeldHandle>> handle(
      module, "Handle",
      "What is grabbed: one element, or many that move together as one rigid body.\n\n"
      "Handle(body, elements) grabs elements at their current positions; nothing moves. The pivot is the mean of\n"
      "these positions. Raises Error if there is none, or if one does not exist, is given twice or is pinned. After\n"
      "positions were set, restored or reset, grab again.");
  handle.def(py::init(&grab<Object>), py::arg("body"), py::arg("elements"))
      .def_property_readonly(
          "elements", [](const Used<HeldHandle>& one) { return array_of(one->handle.elements()); },
          "The grabbed elements, ascending: shape (n,), dtype uint32. A copy.")
      .def_property_readonly(
          "grabbed", [](const Used<HeldHandle>& one) { return UserPose::of(one->handle.grabbed()); },
          "The pose at which it was grabbed.")
      .def_property_readonly(
          "pose", [](const Used<HeldHandle>& one) { return UserPose::of(one->handle.pose()); },
          "The pose that the last move reached.")
      .def(
          "after",
          [](const Used<HeldHandle>& held, const py::object& by, const Rotation& rotation) {
            return UserPose{held->handle.grabbed().pivot + vector_of(by, "by"), rotation};
          },
          py::arg("by"), py::arg("rotation") = Rotation(),
          "Returns the pose after a motion from where it was grabbed: a displacement (x, y, z) of the pivot (mesh\n"
          "units) and a rotation about the pivot.")
      .def("__repr__", &handle_in_words);
  refuse_pickling(handle, "it is of a mesh of this process", "grab its elements there");
}

void add_methods(py::module_& module) {
  module.def(
      "methods", &rows_of_methods,
      "Returns all methods, a dictionary each: name, label, source (publication), summary, family (`chainmail` or\n"
      "`elastic`), needs_grid, needs_pins and holds_links (True if no link is violated after a move).");
  module.def(
      "refusal", &refusal, py::arg("method"), py::arg("mesh"),
      "Returns the reason why a method does not work on a mesh, in one sentence; empty if it does. Raises Error for\n"
      "an unknown name.");
}

}  // namespace

void add_deformer(py::module_& module) {
  add_methods(module);
  add_handle(module);
  add_results(module);
  MoverClass deformer(
      module, "Deformer",
      "Deforms one object with one method.\n\n"
      "Deformer(body, method) moves this body: `deformer.body` is the same object. A body has one deformer at a\n"
      "time. Deformer(mesh, method, precision) makes a body at rest. Raises Error if there is no such method, or if\n"
      "it does not work on the mesh. One thread at a time may use a deformer and its body. A move lets other Python\n"
      "threads run.");
  deformer
      .def(py::init([](const ObjectPointer& body, Algorithm method) { return std::make_unique<Mover>(body, method); }),
           py::arg("body").none(false), py::arg("method") = Algorithm::natural_queue)
      .def(py::init([](const MeshObjectPointer& mesh, Algorithm method, Precision precision) {
             return std::make_unique<Mover>(std::make_shared<Object>(mesh, precision), method);
           }),
           py::arg("mesh").none(false), py::arg("method") = Algorithm::natural_queue,
           py::arg("precision") = Precision::double_precision);
  add_moves(deformer);
  add_relaxation(deformer);
  add_settings(deformer);
  refuse_pickling(deformer, "it belongs to this process",
                  "make a Deformer there; for a copy here, use Deformer(body.copy(), method)");
  module.def(
      "deform", &deform, py::arg("mesh").none(false), py::arg("elements"), py::arg("by"), py::kw_only(),
      py::arg("method") = Algorithm::natural_queue,
      "Drags elements of an object from rest by a displacement (x, y, z) in one move, and returns the positions of\n"
      "all elements: shape (element_count, 3), dtype float64 (mesh units).\n\n"
      "A shortcut for a Deformer that is used once; raises the same.");
}

}  // namespace chainmail::python
