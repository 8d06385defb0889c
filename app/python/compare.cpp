#include "chainmail/compare.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "python/arrays.h"
#include "python/long_work.h"
#include "python/module.h"
#include "python/pickling.h"
#include "python/table.h"
#include "python/words.h"

namespace chainmail::python {
namespace {

/// Returns a motion from coordinates, or from coordinates and a rotation.
api::Motion motion_of(py::handle step) {
  if (py::isinstance<py::tuple>(step) && py::len(step) == 2) {
    const auto pair = step.cast<py::tuple>();
    if (py::isinstance<api::Rotation>(pair[1])) {
      return {vector_of(pair[0], "path"), pair[1].cast<api::Rotation>()};
    }
  }
  return {vector_of(step, "path"), {}};
}

constexpr std::size_t most_motions = 1'000'000;

api::Drag drag_from(const std::string& name, const py::object& elements, const py::iterable& path) {
  api::Drag drag{name, ids_of(elements, "element"), {}};
  const py::iterator steps = py::iter(path);
  while (const py::object step = next_of(steps)) {
    if (drag.path.size() == most_motions) {
      throw api::Error("path", "it has more than " + std::to_string(most_motions) + " motions", "give fewer");
    }
    drag.path.push_back(motion_of(step));
  }
  return drag;
}

py::list path_of(const api::Drag& drag) {
  py::list path;
  for (const api::Motion& motion : drag.path) {
    const bool turns = motion.rotation.degrees != 0;
    path.append(turns ? py::object(py::make_tuple(tuple_of(motion.by), motion.rotation)) : tuple_of(motion.by));
  }
  return path;
}

template <class Figures>
std::optional<double> part(const std::optional<Figures>& figures, double Figures::*number) {
  return figures ? std::optional((*figures).*number) : std::nullopt;
}

void put_row(Table& table, const api::ComparisonRow& row) {
  table.put("drag", row.drag);
  table.put("method", row.method);
  table.put("label", row.label);
  table.put("sweeps", row.sweeps);
  table.put("equilibrium", row.equilibrium);
  table.put("refusal", row.refusal);
  table.put("ms_per_move", row.ms_per_move);
  table.put("ms_lower_quartile", row.lower_quartile);
  table.put("ms_upper_quartile", row.upper_quartile);
  table.put("prepare_ms", row.prepare_ms);
  table.put("violation_max", part(row.violation, &api::Violation::max));
  table.put("violation_rms", part(row.violation, &api::Violation::rms));
  table.put("violation_fraction", part(row.violation, &api::Violation::fraction));
  table.put("exact_distance_max", part(row.to_exact, &api::Spread::max));
  table.put("exact_distance_rms", part(row.to_exact, &api::Spread::rms));
  table.put("energy_over_exact", row.energy_over_exact);
  table.put("float_double_max", part(row.float_to_double, &api::Spread::max));
  table.put("float_double_rms", part(row.float_to_double, &api::Spread::rms));
  table.put("relative_error", part(row.to_physics, &api::PhysicalError::relative));
  table.put("physical_error_rms", part(row.to_physics, &api::PhysicalError::rms));
  table.put("physical_error_max", part(row.to_physics, &api::PhysicalError::max));
}

struct Options {
  api::CompareOptions compare;
  std::optional<std::filesystem::path> folder;
};

py::dict compare(Object& object, const std::vector<api::Drag>& drags, const Options& options, const api::Job& job,
                 const py::object& progress) {
  const UseObject use(object);
  const api::Comparison comparison = run_long(job, progress, [&] {
    api::Comparison result = api::compare(object.body(), drags, options.compare, job);
    if (options.folder) {
      result.write(*options.folder);
    }
    return result;
  });
  Table table;
  for (const api::ComparisonRow& row : comparison.rows()) {
    put_row(table, row);
  }
  return table.columns();
}

void add_drag(py::module_& module) {
  py::class_<api::Drag> type(
      module, "Drag",
      "A drag from rest: grabs elements, then moves them along a path, one pass per motion.\n\n"
      "Each motion of the path is a displacement (x, y, z) from where they were grabbed (mesh units), or a\n"
      "pair of a displacement and a Rotation.");
  type.def(py::init(&drag_from), py::arg("name"), py::arg("elements"), py::arg("path"))
      .def_readonly("name", &api::Drag::name, "Name in tables.")
      .def_property_readonly(
          "elements", [](const api::Drag& drag) { return array_of(drag.elements); },
          "The grabbed elements: shape (n,), dtype uint32. A copy.")
      .def_property_readonly("path", &path_of, "The motions from where they were grabbed.")
      .def("__repr__", [](const api::Drag& drag) {
        return "<Drag: " + std::string(py::repr(py::str(drag.name))) + ", " + std::to_string(drag.elements.size()) +
               " elements, " + std::to_string(drag.path.size()) + " moves>";
      });
  add_pickling(
      type, [](const api::Drag& drag) { return py::make_tuple(drag.name, drag.elements, path_of(drag)); },
      [](const py::tuple& state) { return drag_from(state[0].cast<std::string>(), state[1], state[2]); });
}

}  // namespace

void add_compare(py::module_& module) {
  add_drag(module);
  const api::CompareOptions defaults;
  module.def(
      "compare",
      [](Object& body, const py::sequence& drags, const py::sequence& methods, const py::sequence& sweeps,
         bool equilibrium, double relax_step, const std::string& scheme, const std::string& precision,
         std::optional<int> repetitions, double seconds, const std::string& against, const std::string& title,
         const std::optional<std::filesystem::path>& folder, const std::optional<api::Job>& job,
         const py::object& progress) {
        const Options options{
            {title, list_of<std::string>(methods, "methods"), list_of<int>(sweeps, "sweeps"), equilibrium, relax_step,
             scheme_of(scheme), precision_of(precision), repetitions, seconds, reference_of(against)},
            folder};
        return compare(body, list_of<api::Drag>(drags, "drags"), options, job.value_or(api::Job()), progress);
      },
      py::arg("body"), py::arg("drags") = py::list(), py::kw_only(), py::arg("methods") = py::list(),
      py::arg("sweeps") = py::make_tuple(0), py::arg("equilibrium") = defaults.equilibrium,
      py::arg("relax_step") = defaults.relax_step, py::arg("scheme") = "mean", py::arg("precision") = "float",
      py::arg("repetitions") = py::none(), py::arg("seconds") = defaults.seconds, py::arg("against") = "exact",
      py::arg("title") = defaults.title, py::arg("folder") = py::none(), py::arg("job") = py::none(),
      py::arg("progress") = py::none(),
      "Compares methods on an object and drags: times, and errors at the end of each drag.\n\n"
      "The object gives its mesh, cuts, pins, softness and elasticity; drags start at rest, whatever its positions "
      "are.\n"
      "Without drags, there are three standard ones. `methods` are names; default: the ChainMail family, and against\n"
      "`physics` all. `sweeps` are numbers of sweeps of relaxation after each move, a row for each. `against` is "
      "`exact`\n"
      "(Exact ChainMail in double) or `physics` (neo-Hookean finite elements; the object needs pins). `seconds` is "
      "the\n"
      "time for all runs of one drag, unless `repetitions` is given. `folder` receives report.html, report.json and\n"
      "report.csv. `progress` is called with the share that is done, 0 to 1.\n\n"
      "Returns a dictionary of columns (lists of equal length), one row per drag and method, for pandas.DataFrame: "
      "drag,\n"
      "method, label, sweeps, equilibrium, refusal (the reason why there is no result), ms_per_move, "
      "ms_lower_quartile,\n"
      "ms_upper_quartile, prepare_ms (ms), violation_max, violation_rms (rest lengths), violation_fraction,\n"
      "exact_distance_max, exact_distance_rms, float_double_max, float_double_rms (mean rest lengths),\n"
      "energy_over_exact, relative_error, physical_error_rms and physical_error_max. A figure that was not measured "
      "is\n"
      "None. All figures except times are the same on every machine.\n\n"
      "Raises Error for an unknown method, an option out of its range, or a drag that is empty, not finite, or grabs\n"
      "elements that do not exist or are pinned; against physics also if the object has cuts or no pins; and "
      "Cancelled.");
}

}  // namespace chainmail::python
