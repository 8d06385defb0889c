#include "python/long_work.h"

namespace chainmail::python {
namespace {

namespace py = pybind11;

constexpr std::chrono::milliseconds between_looks(50);

/// Reports progress and looks for signals. Throws what Python has raised.
void look(const Progress& job, const py::object& progress) {
  if (PyErr_CheckSignals() != 0) {
    throw py::error_already_set();
  }
  if (!progress.is_none()) {
    const py::float_ share(job.share());
    const auto shown =
        outlive_python([&] { return PyObject_CallFunctionObjArgs(progress.ptr(), share.ptr(), nullptr); });
    if (!py::reinterpret_steal<py::object>(shown)) {
      throw py::error_already_set();
    }
  }
}

}  // namespace

void wait_for_work(const Progress& job, const py::object& progress,
                   const std::function<bool(std::chrono::milliseconds)>& is_done_within) {
  const auto is_done = [&](std::chrono::milliseconds time) {
    const Unlocked unlocked;
    return is_done_within(time);
  };
  while (!is_done(between_looks)) {
    try {
      look(job, progress);
    } catch (const py::error_already_set&) {
      job.cancel();
      while (!is_done(between_looks)) {
      }
      throw;
    }
  }
}

}  // namespace chainmail::python
