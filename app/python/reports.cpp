// Reports as tables: compare, calibrate, ramp.
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>
#include <sstream>
#include <system_error>
#include <variant>

#include "calibrate/for_report.h"
#include "files/results/results_json.h"
#include "files/session/softness_presets.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#include "python/arguments.h"
#include "python/long_work.h"
#include "python/module.h"
#include "python/pickling.h"
#include "report/page/report.h"
#include "report/page/svg.h"
#include "report/page/tables.h"
#include "report/run/drags.h"
#include "report/run/physics_cases.h"
#include "report/run/ramp.h"
#include "report/table/summary.h"

namespace chainmail::python {

enum class Reference { exact, physics };
template <>
const Words& words<Reference>() {
  static const Words all{"against", {"exact", "physics"}};
  return all;
}

namespace {

using report::Motion;
using report::Results;
using report::Row;

/// A drag from rest: grabs elements, then moves them along a path, one pass per motion.
struct Drag {
  std::string name;
  std::vector<ElementId> elements;
  std::vector<Motion> path;
};

/// Returns the methods of names, which must be different.
std::vector<Algorithm> methods_of(const py::sequence& names) {
  std::vector<Algorithm> methods = list_of<Algorithm>(names, "methods");
  for (auto one = methods.begin(); one != methods.end(); ++one) {
    if (std::find(methods.begin(), one, *one) != one) {
      throw Error("method " + in_quotes(info(*one).offered_name()), "it is given twice", "name each method once");
    }
  }
  return methods;
}

/// Returns a motion from coordinates, or from coordinates and a rotation.
Motion motion_of(py::handle step) {
  if (py::isinstance<py::tuple>(step) && py::len(step) == 2) {
    const auto pair = step.cast<py::tuple>();
    if (py::isinstance<Rotation>(pair[1])) {
      return {vector_of(pair[0], "path"), pair[1].cast<Rotation>()};
    }
  }
  return {vector_of(step, "path"), {}};
}

constexpr std::size_t most_motions = 1'000'000;

Drag drag_from(const std::string& name, const Elements& elements, const py::iterable& path) {
  Drag drag{name, elements, {}};
  const py::iterator steps = py::iter(path);
  while (const py::object step = next_of(steps)) {
    if (drag.path.size() == most_motions) {
      throw Error("path", "it has more than " + std::to_string(most_motions) + " motions", "give fewer");
    }
    drag.path.push_back(motion_of(step));
  }
  return drag;
}

py::list path_of(const Drag& drag) {
  py::list path;
  for (const Motion& motion : drag.path) {
    const bool turns = motion.rotation.degrees != 0;
    path.append(turns ? py::object(py::make_tuple(tuple_of(motion.by), motion.rotation)) : tuple_of(motion.by));
  }
  return path;
}

report::Case case_of(Object& object, const std::vector<Drag>& drags, Reference against, const std::string& title,
                     const Progress& progress) {
  const Body& body = object.body();
  const bool physics = against == Reference::physics;
  report::Case result = report::case_of(body, printable(title));
  if (physics && !result.cuts.empty()) {
    throw Error("cuts", "the comparison with physics needs an object without cuts", "uncut its links");
  }
  for (const Drag& drag : drags) {
    const std::string name = printable(drag.name);
    result.drags.push_back(report::drag_along(name, body, drag.elements, drag.path));
    if (physics && drag.elements.size() > 1) {
      throw Error("drag " + in_quotes(name), "it grabs many elements", "compare with physics on drags of one element");
    }
  }
  if (drags.empty()) {
    result.drags = physics ? report::physics_drags(result) : report::three_drags(result, progress);
  }
  return result;
}

/// Makes a folder, if it is missing.
void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw Error(chainmail::shown(folder), "the folder cannot be created (" + error.message() + ")",
                "use another folder");
  }
}

/// Writes all files of a report, or none.
void write_report(const std::filesystem::path& folder, Results results) {
  results.runs = {{{report::this_machine(), "chainmail.compare", report::now_in_words(),
                    std::string("chainmail ") + CHAINMAIL_VERSION}}};
  make_folder(folder);
  Outputs outputs;
  outputs.add(folder / "report.html", [&](std::ostream& out) { write_html(out, results); });
  outputs.add(folder / "report.json", [&](std::ostream& out) { write_json(out, results); });
  outputs.add(folder / "report.csv", [&](std::ostream& out) { write_csv(out, results); });
  const std::vector<report::PlotFile> plots = plots_of(results);  // until they are written
  for (const report::PlotFile& one : plots) {
    outputs.add(folder / one.name, [&](std::ostream& out) { write_svg(out, one.plot, report::file_ink); });
  }
  outputs.commit();
}

/// Returns results that are complete.
Results finished(Results results) {
  if (results.stopped) {
    throw Cancelled();
  }
  return results;
}

// Tables: a dictionary of columns, a list for each name, all of one length. pandas.DataFrame takes it as it is.

void put(py::dict& table, const std::string& column, const py::object& value) {
  const py::str name(column);
  if (!table.contains(name)) {
    table[name] = py::list();
  }
  table[name].cast<py::list>().append(value);
}

py::object to_python(const report::Figure& figure, double number) {
  using report::FigureFormat;
  return figure.format == FigureFormat::yes_no  ? py::cast(number != 0)
         : figure.format == FigureFormat::count ? py::cast(std::llround(number))
                                                : py::cast(number);
}

/// Adds a figure, and the quartiles of a time, as columns. None where a row does not have it.
void put_figure(py::dict& table, const std::vector<Row>& rows, const report::Figure& figure) {
  const std::string key(figure.key);
  const auto spread_of = [&](const Row& row) {
    const report::Value* value = row.find(figure);
    return value != nullptr ? value->spread : std::nullopt;
  };
  const bool is_time = std::ranges::any_of(
      rows, [](const auto& spread) { return spread.has_value(); }, spread_of);
  for (const Row& row : rows) {
    const std::optional<double> number = row[figure];
    put(table, key, number ? to_python(figure, *number) : py::none());
    if (is_time) {
      const std::optional<TimeSpread> spread = spread_of(row);
      put(table, key + "_lower_quartile", spread ? py::cast(spread->lower_quartile) : py::none());
      put(table, key + "_upper_quartile", spread ? py::cast(spread->upper_quartile) : py::none());
    }
  }
}

/// Returns a table with the names of rows, and the figures that were measured.
py::dict table_of(const std::vector<Row>& rows, const std::function<void(py::dict& table, const Row& row)>& put_names) {
  py::dict table;
  for (const Row& row : rows) {
    put_names(table, row);
  }
  for (const report::Figure* figure : report::every_figure()) {
    if (std::ranges::any_of(rows, [&](const Row& row) { return row.find(*figure) != nullptr; })) {
      put_figure(table, rows, *figure);
    }
  }
  return table;
}

// Comparisons

/// Returns the table of the drags of the object. A drag without a reference has one row, with the reason.
py::dict table_by_drag(const Results& results) {
  std::vector<Row> rows;
  const auto& drags = results.objects.front().drags;
  for (std::size_t drag = 0; drag < drags.size(); ++drag) {
    const std::size_t before = rows.size();
    std::ranges::copy_if(results.rows, std::back_inserter(rows), [&](const Row& row) { return row.drag == drag; });
    if (rows.size() == before) {
      Row& missing = rows.emplace_back();
      missing.drag = drag;
      missing.refusal = drags[drag].no_reference;
    }
  }
  return table_of(rows, [&](py::dict& table, const Row& row) {
    const report::Contestant& who = row.contestant;
    const bool is_nobody = !who.algorithm && !row.has_figures();
    put(table, "drag", py::str(results.drag_of(row)->name));
    put(table, "method", who.algorithm ? py::cast(*who.algorithm) : py::str(is_nobody ? "" : name(who)));
    put(table, "label", py::str(is_nobody ? "" : label(who)));
    put(table, "sweeps", py::int_(who.sweeps));
    put(table, "equilibrium", py::bool_(who.equilibrium));
    put(table, "refusal", py::str(row.refusal));
  });
}

py::dict compare(const Used<Object>& object, const py::sequence& drags, const py::sequence& methods,
                 const py::sequence& sweeps, bool equilibrium, double relax_step, RelaxationScheme scheme,
                 Precision precision, std::optional<int> repetitions, double seconds, Reference against,
                 const std::string& title, const std::optional<std::filesystem::path>& folder, const Progress* job,
                 const py::object& progress) {
  report::CompareOptions with_exact;
  report::PhysicsOptions with_physics;
  const bool physics = against == Reference::physics;
  report::CompareOptions& options = physics ? with_physics : with_exact;
  options.algorithms = methods_of(methods);
  options.sweeps = list_of<int>(sweeps, "sweeps");
  options.equilibrium = equilibrium;
  options.relax_step = relax_step;
  options.scheme = scheme;
  options.precision = precision;
  options.repetitions = repetitions;
  options.seconds = seconds;
  with_physics.growth_seconds = 0;
  with_physics.turned = folder.has_value();  // only the report shows it
  if (!(seconds >= 0) || !std::isfinite(seconds)) {
    throw Error("seconds", "the time is not a number from 0", "use a number of seconds");
  }
  check(options);
  const auto all = list_of<Drag>(drags, "drags");
  const Results results = run_long(job, progress, [&](const Progress& run) {
    const std::vector<report::Case> cases{case_of(*object, all, against, title, run)};
    Results made = finished(physics ? report::compare_with_physics(cases, with_physics, run)
                                    : report::compare(cases, with_exact, run));
    if (folder) {
      write_report(*folder, made);
    }
    return made;
  });
  return table_by_drag(results);
}

// Calibration

#ifdef CHAINMAIL_HAS_CALIBRATE
constexpr bool has_calibrate = true;
#else
constexpr bool has_calibrate = false;
#endif

/// Returns the means over the drags of the search (`fitted`) and over the others (`held out`).
py::dict errors_of(const Results& results) {
  std::vector<Row> means;
  const auto& drags = results.objects.front().drags;
  for (std::size_t drag = 0; drag < drags.size(); ++drag) {
    if (drag > 0 && drags[drag].name == drags[drag - 1].name) {
      continue;
    }
    for (const report::Contestant& one : report::contestants_in(results, std::size_t(0))) {
      means.push_back(joined(results, 0, one, report::Drags::all, drags[drag].name).row);
      means.back().drag = drag;
    }
  }
  return table_of(means, [&](py::dict& table, const Row& row) {
    put(table, "drags", py::str(results.drag_of(row)->name));
    put(table, "state", py::str(row.contestant.calibrated ? "after" : row.contestant.algorithm ? "before" : "nothing"));
  });
}

py::dict result_of(const CalibrationResult& found, const Results& results) {
  std::ostringstream json;
  write_json(json, results);
  return py::dict(py::arg("softness") = found.softness, py::arg("sweeps") = found.sweeps,
                  py::arg("evaluations") = found.evaluations, py::arg("errors") = errors_of(results),
                  py::arg("json") = json.str());
}

py::dict calibrate(const Used<Object>& object, Algorithm method, std::uint64_t seed, int drags, int held_out,
                   int evaluations, int most_sweeps, RelaxationScheme scheme, const Progress* job,
                   const py::object& progress) {
  if constexpr (!has_calibrate) {
    throw Error("calibrate", "the library was built without NLopt", "install it, and build it again");
  } else {
    const Body& body = object->body();
    const CalibrationOptions options{.elastic = body.elastic(),
                                     .pins = {body.pins().begin(), body.pins().end()},
                                     .algorithm = method,
                                     .seed = seed,
                                     .drags = drags,
                                     .held_out = held_out,
                                     .evaluations = evaluations,
                                     .max_sweeps = most_sweeps,
                                     .not_these = {},
                                     .scheme = scheme,
                                     .energy = energy_of_links(body.softness().energy)};
    const CalibrationResult found = run_long(job, progress, [&](const Progress& run) {
      return chainmail::calibrate(body.mesh_pointer(), body.cuts(), options, run);
    });
    return result_of(found, results_of("object", body.mesh(), options, found));
  }
}

// Ramps

py::dict sizes_of(const Results& results) {
  return table_of(results.rows, [&](py::dict& table, const Row& row) {
    const report::ObjectInfo& grid = results.object_of(row);
    put(table, "width", py::int_(width_of(grid)));
    put(table, "elements", py::int_(grid.elements));
    put(table, "links", py::int_(grid.links));
    put(table, "method", py::cast(*row.contestant.algorithm));
  });
}

py::dict verdicts_of(const Results& results) {
  py::dict table;
  for (const report::RampVerdict& verdict : ramp_verdicts(results)) {
    put(table, "method", py::cast(verdict.algorithm));
    put(table, "largest_width", verdict.largest ? py::cast(width_of(results.objects[*verdict.largest])) : py::none());
    put(table, "lost", py::cast(verdict.lost));
    put(table, "growth_exponent", verdict.growth ? py::cast(verdict.growth->power) : py::none());
  }
  return table;
}

py::dict ramp(const py::sequence& methods, std::uint64_t seed, double budget, std::uint64_t largest, int drags,
              int moves, Precision precision, const LinkSoftness& softness, const Progress* job,
              const py::object& progress) {
  const report::RampOptions options{.algorithms = methods_of(methods),
                                    .seed = seed,
                                    .budget = budget,
                                    .softness = softness,
                                    .precision = precision,
                                    .largest = largest,
                                    .drags = drags,
                                    .moves = moves};
  check(options);
  const Results found =
      run_long(job, progress, [&](const Progress& run) { return finished(report::ramp(options, run)); });
  const auto seconds = std::ranges::find(found.settings, "seconds", &report::Setting::first);
  return py::dict(py::arg("sizes") = sizes_of(found), py::arg("methods") = verdicts_of(found),
                  py::arg("seconds") = std::get<double>(seconds->second));
}

void add_drag(py::module_& module) {
  py::class_<Drag> type(
      module, "Drag",
      "A drag from rest: grabs elements, then moves them along a path, one pass per motion.\n\n"
      "Each motion of the path is a displacement (x, y, z) from where they were grabbed (mesh units), or a pair of\n"
      "a displacement and a Rotation.");
  type.def(py::init(&drag_from), py::arg("name"), py::arg("elements"), py::arg("path"))
      .def_readonly("name", &Drag::name, "Name in tables.")
      .def_property_readonly(
          "elements", [](const Drag& drag) { return array_of(drag.elements); },
          "The grabbed elements: shape (n,), dtype uint32. A copy.")
      .def_property_readonly("path", &path_of, "The motions from where they were grabbed.")
      .def("__repr__", [](const Drag& drag) {
        return "<Drag: " + std::string(py::repr(py::str(drag.name))) + ", " + std::to_string(drag.elements.size()) +
               " elements, " + std::to_string(drag.path.size()) + " moves>";
      });
  add_pickling(
      type, [](const Drag& drag) { return py::make_tuple(drag.name, drag.elements, path_of(drag)); },
      [](const py::tuple& state) {
        return drag_from(state[0].cast<std::string>(), {ids_of(state[1], "element")}, state[2]);
      });
}

void add_compare(py::module_& module) {
  const report::CompareOptions defaults;
  module.def(
      "compare", &compare, py::arg("body"), py::arg("drags") = py::list(), py::kw_only(),
      py::arg("methods") = py::list(), py::arg("sweeps") = py::make_tuple(0),
      py::arg("equilibrium") = defaults.equilibrium, py::arg("relax_step") = defaults.relax_step,
      py::arg("scheme") = defaults.scheme, py::arg("precision") = defaults.precision,
      py::arg("repetitions") = py::none(), py::arg("seconds") = defaults.seconds, py::arg("against") = Reference::exact,
      py::arg("title") = "object", py::arg("folder") = py::none(), py::arg("job") = py::none(),
      py::arg("progress") = py::none(),
      "Compares methods on an object and drags: times, and errors at the end of each drag.\n\n"
      "The object gives its mesh, cuts, pins, softness and elasticity; drags start at rest, whatever its positions\n"
      "are. Without drags, there are three standard ones. `methods` are names; default: the ChainMail family, and\n"
      "against `physics` all. `sweeps` are numbers of sweeps of relaxation after each move, a row for each.\n"
      "`against` is `exact` (Exact ChainMail in double) or `physics` (neo-Hookean finite elements; the object needs\n"
      "pins). `seconds` is the time for all runs of one drag, unless `repetitions` is given. `folder` receives\n"
      "report.html, report.json, report.csv and the plots. `progress` is called with the share that is done, 0 to "
      "1.\n\n"
      "Returns a dictionary of columns (lists of equal length), one row per drag and method, for pandas.DataFrame:\n"
      "drag, method, label, sweeps, equilibrium, refusal (the reason why there is no result), then a column for each\n"
      "figure that was measured. Its name is the key in report.json, where `figures` has all keys with their units "
      "and\n"
      "definitions: ms_per_move (ms), violation_max (rest lengths), exact_distance_rms (mean rest lengths) …; against\n"
      "physics relative, error_rms … (ratios). Times also have KEY_lower_quartile and KEY_upper_quartile. None stands\n"
      "for a figure that a row does not have. All figures except times and bytes are the same on every machine.\n\n"
      "Raises Error for an unknown method, an option out of its range, or a drag that is empty, not finite, or\n"
      "grabs elements that do not exist or are pinned; against physics also if the object has cuts or no pins; and\n"
      "Cancelled.");
}

void add_calibrate(py::module_& module) {
  const CalibrationOptions defaults;
  module.def(
      "calibrate", &calibrate, py::arg("body"), py::kw_only(), py::arg("method") = defaults.algorithm,
      py::arg("seed") = defaults.seed, py::arg("drags") = defaults.drags, py::arg("held_out") = defaults.held_out,
      py::arg("evaluations") = defaults.evaluations, py::arg("most_sweeps") = defaults.max_sweeps,
      py::arg("scheme") = defaults.scheme, py::arg("job") = py::none(), py::arg("progress") = py::none(),
      "Finds one softness for all links, and the number of sweeps, that together have the lowest mean relative\n"
      "error against neo-Hookean finite elements on the same cells.\n\n"
      "The object gives its mesh, cuts, pins, elasticity and kind of energy; it does not change. `drags` and\n"
      "`held_out` are numbers of drags, for the search and to test the result. The same options give the same\n"
      "result on every machine. `progress` is called with the share that is done, 0 to 1.\n\n"
      "Returns a dictionary: `softness` (LinkSoftness), `sweeps` after each move, the number of `evaluations`,\n"
      "`errors`, and `json`, a report with all figures, drag by drag. `errors` is a dictionary of columns for\n"
      "pandas.DataFrame: drags (`fitted` or `held out`), state (`nothing` moves but the handle, `before`, `after`),\n"
      "relative, error_rms (means) and error_max.\n\n"
      "Raises Error if nothing is pinned, if the method is unknown or not of the ChainMail family, if an option is\n"
      "out of its range, if the object has no static solution, and if no reference solution converges; and\n"
      "Cancelled.");
  module.def(
      "write_preset",
      [](const std::filesystem::path& path, const std::string& name, const LinkSoftness& softness) {
        write_preset(path, {name, softness});
      },
      py::arg("path"), py::arg("name"), py::arg("softness"), py::call_guard<Unlocked>(),
      "Writes a softness as a preset (JSON), which the workbench and `chainmail compare --preset` open.");
}

void add_ramp(py::module_& module) {
  constexpr std::uint64_t largest = 1'000'000;  // takes less memory than the largest that the command line tries
  const report::RampOptions defaults;
  module.def(
      "ramp", &ramp, py::arg("methods") = py::list(), py::kw_only(), py::arg("seed") = defaults.seed,
      py::arg("budget") = defaults.budget, py::arg("largest") = largest, py::arg("drags") = defaults.drags,
      py::arg("moves") = defaults.moves, py::arg("precision") = defaults.precision,
      py::arg("softness") = LinkSoftness(), py::arg("job") = py::none(), py::arg("progress") = py::none(),
      "Finds the largest square grid on which each method runs in real time (Dean 2004, chapter 6).\n\n"
      "Grids grow from 4 x 4 up to `largest` elements. At each size, all methods run the same drags. A method stops\n"
      "when the 99th percentile of its pass times exceeds the `budget` (s) in two attempts. `methods` are names;\n"
      "default: the ChainMail family. `progress` is called with the share of the largest grid, 0 to 1.\n\n"
      "Returns a dictionary: `sizes` and `methods`, which are dictionaries of columns for pandas.DataFrame, and\n"
      "`seconds`. The columns of `sizes` are width, elements, links, method, passes, median_ms, p99_ms, mean_moved,\n"
      "repeated and real_time; those of `methods` are method, largest_width (None: never in real time), lost\n"
      "(False: there was no next size) and growth_exponent of the median. Raises Error for an unknown method or an\n"
      "option out of its range; and Cancelled.");
}

}  // namespace

void add_reports(py::module_& module) {
  add_drag(module);
  add_compare(module);
  add_calibrate(module);
  add_ramp(module);
}

}  // namespace chainmail::python
