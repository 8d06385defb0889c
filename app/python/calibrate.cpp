#include "chainmail/calibrate.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "python/long_work.h"
#include "python/module.h"
#include "python/table.h"
#include "python/unlocked.h"
#include "python/words.h"

namespace chainmail::python {
namespace {

void put_error(Table& table, const char* drags, const char* state, const api::PhysicalError& error) {
  table.put("drags", drags);
  table.put("state", state);
  table.put("relative", error.relative);
  table.put("rms", error.rms);
  table.put("max", error.max);
}

void put_errors(Table& table, const char* drags, const api::CalibrationErrors& errors) {
  put_error(table, drags, "nothing", errors.nothing);
  put_error(table, drags, "before", errors.before);
  put_error(table, drags, "after", errors.after);
}

py::dict calibrate(Object& object, const api::CalibrateOptions& options, const api::Job& job,
                   const py::object& progress) {
  const UseObject use(object);
  const api::Calibration found = run_long(job, progress, [&] { return api::calibrate(object.body(), options, job); });
  Table errors;
  put_errors(errors, "fitted", found.fitted);
  put_errors(errors, "held_out", found.held_out);
  py::dict result;
  result["softness"] = found.softness;
  result["sweeps"] = found.sweeps;
  result["evaluations"] = found.evaluations;
  result["errors"] = errors.columns();
  result["json"] = found.json;
  return result;
}

}  // namespace

void add_calibrate(py::module_& module) {
  const api::CalibrateOptions defaults;
  module.def(
      "calibrate",
      [](Object& body, const std::string& method, std::uint64_t seed, int drags, int held_out, int evaluations,
         int most_sweeps, const std::string& scheme, const std::optional<api::Job>& job, const py::object& progress) {
        return calibrate(body, {method, seed, drags, held_out, evaluations, most_sweeps, scheme_of(scheme)},
                         job.value_or(api::Job()), progress);
      },
      py::arg("body"), py::kw_only(), py::arg("method") = defaults.method, py::arg("seed") = defaults.seed,
      py::arg("drags") = defaults.drags, py::arg("held_out") = defaults.held_out,
      py::arg("evaluations") = defaults.evaluations, py::arg("most_sweeps") = defaults.most_sweeps,
      py::arg("scheme") = "equilibrium", py::arg("job") = py::none(), py::arg("progress") = py::none(),
      "Finds one softness for all links, and the number of sweeps, that together have the lowest mean relative error\n"
      "against neo-Hookean finite elements on the same cells.\n\n"
      "The object gives its mesh, cuts, pins, elasticity and kind of energy; it does not change. `drags` and "
      "`held_out`\n"
      "are numbers of drags, for the search and to test the result. The same options give the same result on every\n"
      "machine. `progress` is called with the share that is done, 0 to 1.\n\n"
      "Returns a dictionary: `softness` (LinkSoftness), `sweeps` after each move, the number of `evaluations`, "
      "`errors`,\n"
      "and `json` with all figures, drag by drag. `errors` is a dictionary of columns for pandas.DataFrame: drags\n"
      "(`fitted` or `held_out`), state (`nothing` moves but the handle, `before`, `after`), relative, rms and max.\n\n"
      "Raises Error if nothing is pinned, if the method is unknown or not of the ChainMail family, if an option is "
      "out\n"
      "of its range, if the object has no static solution, and if no reference solution converges; and Cancelled.");
  module.def("write_preset", &api::write_preset, py::arg("path"), py::arg("name"), py::arg("softness"),
             py::call_guard<Unlocked>(),
             "Writes a softness as a preset (JSON), which the workbench and `chainmail compare --preset` open.");
}

}  // namespace chainmail::python
