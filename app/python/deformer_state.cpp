// Deformers and handles as bytes, for another process: pickle.
#include <pybind11/stl.h>

#include <utility>

#include "api/state.h"
#include "python/arrays.h"
#include "python/module.h"
#include "python/pickling.h"
#include "python/words.h"

namespace chainmail::python {
namespace {

using api::Access;

/// Returns three numbers for each step: the element, its sponsor, and 1 if it moved.
std::vector<std::uint32_t> flat_trace(const std::vector<api::TraceStep>& trace) {
  std::vector<std::uint32_t> flat;
  for (const api::TraceStep& step : trace) {
    flat.insert(flat.end(), {step.element, step.sponsor, step.moved ? 1U : 0U});
  }
  return flat;
}

std::vector<api::TraceStep> trace_from(const StateFields& state) {
  const std::vector<std::uint32_t> flat = state.ids("trace");
  if (flat.size() % 3 != 0) {
    state.refuse("trace");
  }
  std::vector<api::TraceStep> trace;
  for (std::size_t i = 0; i < flat.size(); i += 3) {
    trace.push_back({flat[i], flat[i + 1], flat[i + 2] != 0});
  }
  return trace;
}

py::object deformer_parts(const Mover& mover) {
  const UseObject use(*mover.object());
  const auto [method, is_tracing, trace, memory] = api::hand_over(mover.object()->deformer());
  py::dict state;
  state["body"] = mover.object();
  state["method"] = method;
  state["is_tracing"] = is_tracing;
  state["trace"] = bytes_of(flat_trace(trace));
  state["scheme"] = scheme_words[std::size_t(memory.relaxation)];
  state["threads"] = memory.threads;
  state["moved"] = bytes_of(memory.moved);
  state["relaxes_now"] = bytes_of(memory.pending.now);
  state["relaxes_next"] = bytes_of(memory.pending.next);
  state["in_sweep"] = memory.pending.in_sweep;
  state["largest_step"] = memory.pending.largest_step;
  state["is_awake"] = memory.is_awake;
  state["memory"] = bytes_of(memory.method);
  return state;
}

api::DeformerState deformer_state_from(const StateFields& state) {
  return {.method = state.get<std::string>("method"),
          .is_tracing = state.get<bool>("is_tracing"),
          .trace = trace_from(state),
          .memory = {.relaxation = api::scheme_of(scheme_of(state.get<std::string>("scheme"))),
                     .threads = state.get<int>("threads"),
                     .moved = state.ids("moved"),
                     .pending = {state.ids("relaxes_now"), state.ids("relaxes_next"), state.get<bool>("in_sweep"),
                                 state.get<double>("largest_step")},
                     .is_awake = state.get<bool>("is_awake"),
                     .method = state.reals("memory")}};
}

std::unique_ptr<Mover> deformer_from(const py::object& parts) {
  const StateFields fields("Deformer", parts);
  const api::DeformerState state = deformer_state_from(fields);
  const auto body = fields.get<ObjectPointer>("body");
  if (body == nullptr) {
    fields.refuse("body");
  }
  auto mover = std::make_unique<Mover>(body, state.method);
  api::take_over(mover->object()->deformer(), state);
  return mover;
}

py::object handle_parts(HeldHandle& held) {
  const Use use(held.busy, "handle");
  const auto& [handle, mesh] = Access::impl(std::as_const(held.handle));
  const HandleState from = handle.state();
  std::vector<double> positions;
  for (const Point& position : from.positions) {
    positions.insert(positions.end(), position.begin(), position.end());
  }
  py::dict state;
  state["mesh"] = shared_mesh(mesh);
  state["elements"] = bytes_of(from.elements);
  state["positions"] = bytes_of(positions);
  state["pivot"] = tuple_of(api::vector_of(from.pose.pivot));
  state["rotation"] = tuple_of(api::vector_of(from.pose.rotation));
  return state;
}

std::shared_ptr<HeldHandle> handle_from(const py::object& parts) {
  const StateFields fields("Handle", parts);
  const auto mesh = fields.get<api::Mesh>("mesh");
  const std::vector<double> numbers = fields.reals("positions");
  if (numbers.size() % 3 != 0) {
    fields.refuse("positions");
  }
  HandleState state{fields.ids("elements"), {}, {}};
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    state.positions.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  }
  state.pose = {api::point_of(vector_of(fields.object("pivot"), "pivot")),
                api::point_of(vector_of(fields.object("rotation"), "rotation"))};
  return api::guarded([&] {
    return std::make_shared<HeldHandle>(
        Access::handle(chainmail::Handle(*Access::pointer(mesh), std::move(state)), mesh));
  });
}

std::shared_ptr<HeldHandle> copied_handle(HeldHandle& held) {
  const Use use(held.busy, "handle");
  return std::make_shared<HeldHandle>(held.handle);
}

}  // namespace

void add_handle_state(HandleClass& handle) {
  add_pickling(handle, &handle_parts, &handle_from);
  handle.def("__copy__", &copied_handle)
      .def(
          "__deepcopy__", [](HeldHandle& one, const py::object& /*memo*/) { return copied_handle(one); },
          py::arg("memo"));
}

void add_deformer_state(MoverClass& deformer) {
  add_pickling(deformer, &deformer_parts, &deformer_from);
  // A body has one deformer, so a copy has a copy of the body, too.
  const auto copy = [](const py::object& self) { return py::module_::import("copy").attr("deepcopy")(self); };
  deformer
      .def("copy", copy,
           "Returns an independent deformer of a copy of the body, which continues as this one would, bit for bit.\n\n"
           "Jobs are not copied. Raises Error for a method that a program has registered.")
      .def("__copy__", copy);
}

}  // namespace chainmail::python
