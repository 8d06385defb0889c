#include "chainmail/deformer.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <type_traits>

#include "chainmail/method.h"
#include "python/arrays.h"
#include "python/held_handle.h"
#include "python/long_work.h"
#include "python/module.h"
#include "python/mover.h"
#include "python/pickling.h"
#include "python/unlocked.h"
#include "python/words.h"

namespace chainmail::python {
namespace {

using MoverClass = py::class_<Mover>;

constexpr std::uint64_t quick_visits = 200'000;  // visits of elements that take a few ms

/// Runs work on a deformer without the lock of Python. Work that may take long looks for Ctrl-C meanwhile.
template <class Work>
auto run(Object& object, bool is_slow, Work work) {
  api::Deformer& deformer = object.deformer();
  if (!is_slow) {
    const Unlocked unlocked;
    return work(deformer);
  }
  const api::Job job = object.job();
  try {
    return run_long(job, py::none(), [&] { return work(deformer); });
  } catch (const py::error_already_set&) {
    object.set_job(api::Job());  // the cancelled one would cancel the next move, too
    throw;
  }
}

api::MoveResult move_handle(Object& object, HeldHandle& held, const py::object& target) {
  const Use use(held.busy, "handle");
  if (!py::isinstance<api::Pose>(target)) {
    throw py::type_error("the target of a handle is a Pose, such as handle.after((1, 0, 0))");
  }
  const auto pose = target.cast<api::Pose>();
  return run(object, object.is_slow(), [&](api::Deformer& deformer) { return deformer.move(held.handle, pose); });
}

api::MoveResult move(const Mover& mover, const py::object& what, const py::object& target) {
  Object& object = *mover.object();
  const UseObject use(object);
  if (!PyLong_CheckExact(what.ptr()) && py::isinstance<HeldHandle>(what)) {
    return move_handle(object, what.cast<HeldHandle&>(), target);
  }
  const std::uint32_t element = id_of(what, "element");
  const api::Vector3 to = vector_of(target, "target");
  return run(object, object.is_slow(), [&](api::Deformer& deformer) { return deformer.move(element, to); });
}

int relax(const Mover& mover, int sweeps, double step, const std::string& scheme, double until) {
  Object& object = *mover.object();
  const UseObject use(object);
  const api::RelaxOptions options{step, scheme_of(scheme), until};
  const std::uint64_t elements = object.body().mesh().element_count();
  const bool is_slow = options.scheme == api::RelaxationScheme::equilibrium ||
                       elements * std::uint64_t(std::max(sweeps, 0)) > quick_visits;
  return run(object, is_slow, [&](api::Deformer& deformer) { return deformer.relax(sweeps, options); });
}

/// Returns the trace as rows: element, sponsor or -1, and 1 if it moved.
py::array_t<std::int64_t> trace_of(const api::Deformer& deformer) {
  const auto trace = deformer.trace();
  py::array_t<std::int64_t> rows({py::ssize_t(trace.size()), py::ssize_t(3)});
  std::int64_t* out = rows.mutable_data();
  for (const api::TraceStep& step : trace) {
    *out++ = step.element;
    *out++ = step.sponsor == api::no_sponsor ? -1 : std::int64_t(step.sponsor);
    *out++ = step.moved ? 1 : 0;
  }
  return rows;
}

void add_results(py::module_& module) {
  py::class_<api::MoveResult> result(module, "MoveResult", "What a move did.");
  result.def_readonly("checked", &api::MoveResult::checked, "Number of candidates that the method processed.")
      .def_readonly("moved", &api::MoveResult::moved, "Number of elements that moved, without the handle.")
      .def_readonly("stopped", &api::MoveResult::stopped, "True if the handle stopped before its target.")
      .def_readonly("reached", &api::MoveResult::reached, "The pose where the handle is now.")
      .def_readonly("remark", &api::MoveResult::remark, "Reason why the move did not end as requested. Usually empty.")
      .def("__repr__", [](const api::MoveResult& one) {
        return "<MoveResult: " + std::to_string(one.moved) + " moved, " + std::to_string(one.checked) + " checked" +
               (one.stopped ? ", stopped" : "") + (one.remark.empty() ? "" : ", " + one.remark) + ">";
      });
  add_pickling(
      result,
      [](const api::MoveResult& one) {
        return py::make_tuple(one.checked, one.moved, one.stopped, one.reached, one.remark);
      },
      [](const py::tuple& state) {
        return api::MoveResult{state[0].cast<std::uint64_t>(), state[1].cast<std::uint64_t>(), state[2].cast<bool>(),
                               state[3].cast<api::Pose>(), state[4].cast<std::string>()};
      });
  py::class_<api::EquilibriumCertificate> certificate(module, "EquilibriumCertificate",
                                                      "How close an object is to the equilibrium.");
  certificate
      .def_readonly("violation", &api::EquilibriumCertificate::violation,
                    "Largest violation of a link, in rest lengths.")
      .def_readonly("residual", &api::EquilibriumCertificate::residual,
                    "Estimated distance from the equilibrium, in the norm of the energy, relative to its root.")
      .def_readonly("energy_gap", &api::EquilibriumCertificate::energy_gap,
                    "Energy above a lower bound of the energy of all valid states, relative to the energy. None for\n"
                    "corotated links and the material.")
      .def_readonly("regions_bind", &api::EquilibriumCertificate::regions_bind,
                    "True if valid regions change the equilibrium.")
      .def_readonly("iterations", &api::EquilibriumCertificate::iterations,
                    "Iterations since the handle, the pins or the object changed.")
      .def("__repr__", [](const api::EquilibriumCertificate& one) {
        return "<EquilibriumCertificate: residual " + std::string(py::repr(py::float_(one.residual))) + " after " +
               std::to_string(one.iterations) + " iterations>";
      });
  add_pickling(
      certificate,
      [](const api::EquilibriumCertificate& one) {
        return py::make_tuple(one.violation, one.residual, one.energy_gap, one.regions_bind, one.iterations);
      },
      [](const py::tuple& state) {
        return api::EquilibriumCertificate{state[0].cast<double>(), state[1].cast<double>(),
                                           state[2].cast<std::optional<double>>(), state[3].cast<bool>(),
                                           state[4].cast<int>()};
      });
}

void add_moves(MoverClass& deformer) {
  deformer
      .def(
          "grab",
          [](const Mover& mover, const py::object& elements) {
            Object& object = *mover.object();
            const UseObject use(object);
            return std::make_shared<HeldHandle>(object.deformer().grab(ids_of(elements, "element")));
          },
          py::arg("elements"), "Grabs elements; the same as Handle(deformer.body, elements).")
      .def("move", &move, py::arg("what"), py::arg("target"),
           "Moves the handle, and the method answers: one pass.\n\n"
           "move(element, (x, y, z)) moves one element to a position (mesh units). move(handle, pose) moves a handle "
           "to a\n"
           "pose, such as handle.after((1, 0, 0)). Coordinates that are left out are 0.\n\n"
           "Raises Error if an id does not exist, the handle is of another mesh, an element of it is pinned, the "
           "target\n"
           "is not finite or would leave the space of the object, and if the method has no answer; and Cancelled.\n"
           "Nothing has moved then.")
      .def(
          "moved",
          [](const Mover& mover) {
            const UseObject use(*mover.object());
            return array_of(mover.object()->deformer().moved());
          },
          "Returns the elements that the last move moved, in order of update, without the handle: shape (n,), dtype\n"
          "uint32. A copy.")
      .def(
          "release",
          [](const Mover& mover) {
            const UseObject use(*mover.object());
            mover.object()->deformer().release();
          },
          "Releases the handle of the last move: relaxation may move its elements.")
      .def(
          "set_tracing",
          [](const Mover& mover, bool on) {
            const UseObject use(*mover.object());
            mover.object()->deformer().set_tracing(on);
          },
          py::arg("on"), "Turns on or off that moves are traced.")
      .def(
          "trace",
          [](const Mover& mover) {
            const UseObject use(*mover.object());
            return trace_of(mover.object()->deformer());
          },
          "Returns the candidates of the last move, in order, if it was traced: shape (n, 3), dtype int64. The "
          "columns\n"
          "are the element, its sponsor (-1: none) and 1 if it moved. A copy.");
}

void add_relaxation(MoverClass& deformer) {
  const api::RelaxOptions defaults;
  deformer
      .def(
          "relax", &relax, py::arg("sweeps"), py::kw_only(), py::arg("step") = defaults.step,
          py::arg("scheme") = "mean", py::arg("until") = defaults.until,
          "Runs sweeps of relaxation about the elements of the last move, until nothing moves or this many have "
          "run.\n\n"
          "The handle and the pins stay, and each element stays in the valid regions of its neighbours. `step` is the\n"
          "share of the way that an element moves per sweep: above 0, to 1. `scheme` is `mean`, `link` or "
          "`equilibrium`,\n"
          "which runs iterations instead, for all elements, until the distance from the equilibrium is at most "
          "`until`.\n"
          "Returns the number of sweeps that ran; 0 for methods of elasticity, whose answers are equilibria. Raises\n"
          "Error for a number out of its range; and Cancelled, which keeps the positions that were reached.")
      .def(
          "certificate",
          [](const Mover& mover) {
            const UseObject use(*mover.object());
            return run(*mover.object(), false, [](api::Deformer& one) { return one.certificate(); });
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
          [](const Mover& mover) { return mover.object()->deformer().method(); }, "Name of the method.")
      .def(
          "set_method",
          [](const Mover& mover, const std::string& method) {
            const UseObject use(*mover.object());
            mover.object()->set_method(method);
          },
          py::arg("method"),
          "Continues with another method from the current positions. Raises Error if there is none with this name, if "
          "it\n"
          "does not work on the mesh, and if a view of the positions would not show positions any more.")
      .def(
          "set_threads",
          [](const Mover& mover, int threads) {
            const UseObject use(*mover.object());
            mover.object()->deformer().set_threads(threads);
          },
          py::arg("threads"),
          "Sets the number of threads that a move may use, at least 1, which is the default. Only `exact` uses more, "
          "for\n"
          "large objects, and no result depends on it.")
      .def(
          "set_job",
          [](const Mover& mover, const api::Job& job) {
            const UseObject use(*mover.object());
            mover.object()->set_job(job);
          },
          py::arg("job"),
          "Sets the job that long preparations, solutions and sweeps report to, and that can cancel them.")
      .def("__repr__", [](const Mover& mover) {
        return "<Deformer: " + mover.object()->deformer().method() + " on " +
               std::to_string(mover.object()->body().mesh().element_count()) + " elements>";
      });
}

py::array deform(const api::Mesh& mesh, const py::object& elements, const py::object& by, const std::string& method) {
  const auto ids = ids_of(elements, "element");
  const api::Vector3 displacement = vector_of(by, "by");
  return array_of(run_long(api::Job(), py::none(), [&] { return api::deform(mesh, method, ids, displacement); }), 3);
}

}  // namespace

void add_deformer(py::module_& module) {
  add_results(module);
  MoverClass deformer(
      module, "Deformer",
      "Deforms one object with one method.\n\n"
      "Deformer(body, method) moves this body: `deformer.body` is the same object. A body has one deformer\n"
      "at a time. Deformer(mesh, method, precision) makes a body at rest. Raises Error if there is no such\n"
      "method, or if it does not work on the mesh. One thread at a time may use a deformer and its body.\n"
      "A move lets other Python threads run.");
  deformer
      .def(py::init([](const ObjectPointer& body, const std::string& method) {
             return std::make_unique<Mover>(body, method);
           }),
           py::arg("body").none(false), py::arg("method") = "natural-queue")
      .def(py::init([](const api::Mesh& mesh, const std::string& method, const std::string& precision) {
             return std::make_unique<Mover>(std::make_shared<Object>(api::Body(mesh, precision_of(precision))), method);
           }),
           py::arg("mesh"), py::arg("method") = "natural-queue", py::arg("precision") = "double");
  add_moves(deformer);
  add_relaxation(deformer);
  add_settings(deformer);
  refuse_pickling(deformer, "it belongs to this process",
                  "make a Deformer there; for a copy here, use Deformer(body.copy(), method)");
  module.def(
      "deform", &deform, py::arg("mesh"), py::arg("elements"), py::arg("by"), py::kw_only(),
      py::arg("method") = "natural-queue",
      "Drags elements of an object from rest by a displacement (x, y, z) in one move, and returns the positions of\n"
      "all elements: shape (element_count, 3), dtype float64 (mesh units).\n\n"
      "A shortcut for a Deformer that is used once; raises the same.");
}

}  // namespace chainmail::python
