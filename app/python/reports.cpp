// Reports as tables: compare, calibrate, ramp.
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <variant>

#include "calibrate/calibrate.h"
#include "files/results/report_json.h"
#include "files/session/softness_presets.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#include "python/arguments.h"
#include "python/long_work.h"
#include "python/module.h"
#include "python/pickling.h"
#include "report/page/compared_figures.h"
#include "report/page/html.h"
#include "report/page/physics_figures.h"
#include "report/page/physics_html.h"
#include "report/page/physics_plot.h"
#include "report/page/ramp_page.h"
#include "report/page/svg.h"
#include "report/run/drags.h"
#include "report/run/physics_cases.h"
#include "report/run/ramp.h"

namespace chainmail::python {

enum class Reference { exact, physics };
template <>
const Words& words<Reference>() {
  static const Words all{"against", {"exact", "physics"}};
  return all;
}

namespace {

using report::Motion;

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

struct CompareOptions {
  report::PhysicsOptions physics;  // with the contest of both references
  Reference against = Reference::exact;
  std::string title;
  std::optional<std::filesystem::path> folder;
};

report::Case case_of(Object& object, const std::vector<Drag>& drags, const CompareOptions& options,
                     const Progress& progress) {
  const Body& body = object.body();
  const bool physics = options.against == Reference::physics;
  report::Case result = report::case_of(body, printable(options.title));
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
template <class Report>
void write_report(const std::filesystem::path& folder, const Report& report) {
  const report::Origin origin{report::this_machine(), "chainmail.compare", report::now_in_words(),
                              std::string("chainmail ") + CHAINMAIL_VERSION};
  make_folder(folder);
  Outputs outputs;
  outputs.add(folder / "report.html", [&](std::ostream& out) { write_html(out, report, origin); });
  outputs.add(folder / "report.json", [&](std::ostream& out) { write_json(out, report, origin); });
  outputs.add(folder / "report.csv", [&](std::ostream& out) { write_csv(out, report); });
  std::vector<report::PlotFile> plots;  // until they are written
  if constexpr (std::is_same_v<Report, report::PhysicsReport>) {
    plots = plots_of(report);
  }
  for (const report::PlotFile& one : plots) {
    outputs.add(folder / one.name, [&](std::ostream& out) { write_svg(out, one.plot, report::file_ink); });
  }
  outputs.commit();
}

using AnyReport = std::variant<report::Comparison, report::PhysicsReport>;

AnyReport compare_bodies(Object& object, const std::vector<Drag>& drags, const CompareOptions& options,
                         const Progress& progress) {
  const auto finished = [&](auto report) {
    if (report.stopped) {
      throw Cancelled();
    }
    if (options.folder) {
      write_report(*options.folder, report);
    }
    return AnyReport(std::move(report));
  };
  const std::vector<report::Case> cases{case_of(object, drags, options, progress)};
  return options.against == Reference::exact ? finished(report::compare(cases, options.physics.contest, progress))
                                             : finished(report::compare_with_physics(cases, options.physics, progress));
}

// Tables: a dictionary of columns, a list for each name, all of one length. pandas.DataFrame takes it as it is.

py::object to_python(const report::FigureValue& value) {
  return std::visit(
      []<class Value>(const Value& one) -> py::object {
        if constexpr (std::is_same_v<Value, TimeSpread>) {
          return py::float_(one.median);
        } else {
          return py::cast(one);
        }
      },
      static_cast<const report::FigureValue::variant&>(value));
}

void put(py::dict& table, const char* column, const py::object& value) {
  if (!table.contains(column)) {
    table[column] = py::list();
  }
  table[column].cast<py::list>().append(value);
}

/// Returns a figure of a row by its column in CSV; none if there is no such figure.
template <class Row>
py::object figure_of(std::span<const report::Figure<Row>> figures, std::string_view column, const Row& row) {
  const auto found = std::ranges::find(figures, column, &report::Figure<Row>::column);
  return column.empty() || found == figures.end() ? py::none() : to_python(found->value(row));
}

/// A column of the table, and the figures of both reports that it shows. Empty: it was not measured, and is None.
struct Column {
  const char* name;
  std::string_view exact, physics = {};
  std::string_view of_one_move = physics;  // a drag of one move has no later ones
  bool is_time = false;
};

constexpr Column columns[]{
    {"sweeps", "sweeps", "sweeps"},
    {"equilibrium", "equilibrium", "equilibrium"},
    {"refusal", "refusal", "refusal"},
    {"ms_per_move", "ms", "ms", "first_ms", true},
    {"ms_lower_quartile", "ms_lower_quartile", "ms_lower_quartile", "first_lower_quartile", true},
    {"ms_upper_quartile", "ms_upper_quartile", "ms_upper_quartile", "first_upper_quartile", true},
    {"prepare_ms", "", "prepare_ms", "prepare_ms", true},
    {"violation_max", "violation_max"},
    {"violation_rms", "violation_rms"},
    {"violation_fraction", "violation_fraction"},
    {"exact_distance_max", "exact_distance_max"},
    {"exact_distance_rms", "exact_distance_rms"},
    {"energy_over_exact", "energy_over_exact"},
    {"float_double_max", "float_double_max"},
    {"float_double_rms", "float_double_rms"},
    {"relative_error", "", "relative"},
    {"physical_error_rms", "", "error_rms"},
    {"physical_error_max", "", "error_max"},
};

void put_names(py::dict& table, const std::string& drag, std::string_view method, const std::string& label) {
  put(table, "drag", py::str(drag));
  put(table, "method", py::cast(method));
  put(table, "label", py::str(label));
}

py::dict table_of(const report::Comparison& comparison) {
  py::dict table;
  for (const report::DragResult& drag : comparison.cases.at(0).drags) {
    for (const report::Entry& entry : drag.entries) {
      put_names(table, drag.name, info(entry.contestant.algorithm).offered_name(), label(entry.contestant));
      for (const Column& column : columns) {
        const report::ComparedRow row{&comparison.cases.at(0), &drag, &entry};
        put(table, column.name, figure_of(report::compared_figures(), column.exact, row));
      }
    }
  }
  return table;
}

void put_row(py::dict& table, const report::PhysicsObject& object, const report::PhysicsDrag& drag,
             const report::PhysicsEntry& entry) {
  const report::PhysicsRow row{&object, &drag, &entry};
  for (const Column& column : columns) {
    const bool is_shown = entry.contestant.algorithm || !column.is_time;  // an object that does not move has no times
    const std::string_view figure = drag.moves > 1 ? column.physics : column.of_one_move;
    put(table, column.name, figure_of(report::physics_figures(), is_shown ? figure : "", row));
  }
}

py::dict table_of(const report::PhysicsReport& comparison) {
  py::dict table;
  const report::PhysicsObject& object = comparison.objects.at(0);
  for (const report::PhysicsDrag& drag : object.drags) {
    for (const report::PhysicsEntry& entry : drag.entries) {
      const auto& method = entry.contestant.algorithm;
      put_names(table, drag.name, method ? info(*method).offered_name() : "nothing", label(entry.contestant));
      put_row(table, object, drag, entry);
    }
    if (!drag.no_reference.empty()) {
      put_names(table, drag.name, "", "");
      put_row(table, object, drag, {.contestant = {}, .measurement = {}, .refusal = drag.no_reference});
    }
  }
  return table;
}

py::dict compare(const Used<Object>& object, const py::sequence& drags, const py::sequence& methods,
                 const py::sequence& sweeps, bool equilibrium, double relax_step, RelaxationScheme scheme,
                 Precision precision, std::optional<int> repetitions, double seconds, Reference against,
                 const std::string& title, const std::optional<std::filesystem::path>& folder, const Progress* job,
                 const py::object& progress) {
  CompareOptions options{.physics = {}, .against = against, .title = title, .folder = folder};
  report::CompareOptions& contest = options.physics.contest;
  contest.algorithms = methods_of(methods);
  contest.sweeps = list_of<int>(sweeps, "sweeps");
  contest.equilibrium = equilibrium;
  contest.relax_step = relax_step;
  contest.scheme = scheme;
  contest.precision = precision;
  contest.repetitions = repetitions;
  contest.seconds = seconds;
  options.physics.growth_seconds = 0;
  if (!(seconds >= 0) || !std::isfinite(seconds)) {
    throw Error("seconds", "the time is not a number from 0", "use a number of seconds");
  }
  check(contest);
  const auto all = list_of<Drag>(drags, "drags");
  const AnyReport report =
      run_long(job, progress, [&](const Progress& run) { return compare_bodies(*object, all, options, run); });
  return std::visit([](const auto& one) { return table_of(one); }, report);
}

// Calibration

#ifdef CHAINMAIL_HAS_CALIBRATE
constexpr bool has_calibrate = true;
#else
constexpr bool has_calibrate = false;
#endif

void put_errors(py::dict& table, const char* drags, const TestedDrags& tested) {
  using Errors = std::pair<const char*, const Residual&>;
  for (const auto& [state, residual] :
       {Errors("nothing", tested.nothing), Errors("before", tested.before), Errors("after", tested.after)}) {
    put(table, "drags", py::str(drags));
    put(table, "state", py::str(state));
    put(table, "relative", py::float_(residual.relative));
    put(table, "rms", py::float_(residual.rms));
    put(table, "max", py::float_(residual.max));
  }
}

py::dict result_of(const CalibrationOptions& options, const CalibrationResult& found) {
  py::dict errors;
  put_errors(errors, "fitted", found.fitted);
  put_errors(errors, "held_out", found.held_out);
  std::ostringstream json;
  write_json(json, options, found);
  return py::dict(py::arg("softness") = found.softness, py::arg("sweeps") = found.sweeps,
                  py::arg("evaluations") = found.evaluations, py::arg("errors") = errors, py::arg("json") = json.str());
}

void check_at_least(int lowest, const char* name, int value) {
  if (value < lowest) {
    throw Error(name, "it is below " + std::to_string(lowest), "use " + std::to_string(lowest) + " or more");
  }
}

py::dict calibrate(const Used<Object>& object, Algorithm method, std::uint64_t seed, int drags, int held_out,
                   int evaluations, int most_sweeps, RelaxationScheme scheme, const Progress* job,
                   const py::object& progress) {
  if constexpr (!has_calibrate) {
    throw Error("calibrate", "the library was built without NLopt", "install it, and build it again");
  } else {
    check_at_least(1, "drags", drags);
    check_at_least(1, "held_out", held_out);
    check_at_least(1, "evaluations", evaluations);
    check_at_least(0, "most_sweeps", most_sweeps);
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
    return result_of(options, run_long(job, progress, [&](const Progress& run) {
                       return chainmail::calibrate(body.mesh_pointer(), body.cuts(), options, run);
                     }));
  }
}

// Ramps

py::dict sizes_of(const report::Ramp& ramp) {
  py::dict table;
  for (const report::RampRow& row : ramp.rows) {
    for (const report::Figure<report::RampRow>& figure : report::ramp_figures()) {
      const bool is_method = figure.column == "algorithm";
      put(table, is_method ? "method" : figure.column.data(),
          is_method ? py::cast(row.algorithm) : to_python(figure.value(row)));
    }
  }
  return table;
}

py::dict verdicts_of(const report::Ramp& ramp) {
  py::dict table;
  for (const report::RampVerdict& verdict : ramp.verdicts) {
    put(table, "method", py::cast(verdict.algorithm));
    put(table, "largest_width", py::cast(verdict.largest_width));
    put(table, "lost", py::cast(verdict.lost));
    put(table, "growth_exponent", verdict.growth ? py::cast(verdict.growth->power) : py::none());
  }
  return table;
}

report::Ramp run_ramp(const report::RampOptions& options, const Progress& job) {
  const auto tell = [&](const report::RampProgress& at) {
    job.report(std::min(1.0, double(at.width) * at.width / double(options.largest)));
  };
  report::Ramp made = report::ramp(options, tell, job);
  if (made.stopped) {
    throw Cancelled();
  }
  return made;
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
  const report::Ramp found = run_long(job, progress, [&](const Progress& run) { return run_ramp(options, run); });
  return py::dict(py::arg("sizes") = sizes_of(found), py::arg("methods") = verdicts_of(found),
                  py::arg("seconds") = found.seconds);
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
      "report.html, report.json and report.csv. `progress` is called with the share that is done, 0 to 1.\n\n"
      "Returns a dictionary of columns (lists of equal length), one row per drag and method, for pandas.DataFrame:\n"
      "drag, method, label, sweeps, equilibrium, refusal (the reason why there is no result), ms_per_move,\n"
      "ms_lower_quartile, ms_upper_quartile, prepare_ms (ms), violation_max, violation_rms (rest lengths),\n"
      "violation_fraction, exact_distance_max, exact_distance_rms, float_double_max, float_double_rms (mean rest\n"
      "lengths), energy_over_exact, relative_error, physical_error_rms and physical_error_max. A figure that was\n"
      "not measured is None. All figures except times are the same on every machine.\n\n"
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
      "`errors`, and `json` with all figures, drag by drag. `errors` is a dictionary of columns for\n"
      "pandas.DataFrame: drags (`fitted` or `held_out`), state (`nothing` moves but the handle, `before`, `after`),\n"
      "relative, rms and max.\n\n"
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
