// Reports as tables: compare, calibrate, ramp.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <variant>

#include "files/results/report_json.h"
#include "files/session/softness_presets.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#include "python/arrays.h"
#include "python/long_work.h"
#include "python/module.h"
#include "python/pickling.h"
#include "report/page/compared_figures.h"
#include "report/page/html.h"
#include "report/page/physics_figures.h"
#include "report/page/physics_html.h"
#include "report/page/physics_plot.h"
#include "report/page/svg.h"
#include "report/run/drags.h"
#include "report/run/physics_cases.h"
#include "report/run/ramp.h"
#ifdef CHAINMAIL_HAS_CALIBRATE
#include "calibrate/calibrate.h"
#endif

namespace chainmail::python {
namespace {

using report::Motion;

/// A drag from rest: grabs elements, then moves them along a path, one pass per motion.
struct Drag {
  std::string name;
  std::vector<ElementId> elements;
  std::vector<Motion> path;
};

/// Returns the algorithms of names, which must be different.
std::vector<Algorithm> algorithms_of(const py::sequence& methods) {
  std::vector<Algorithm> algorithms;
  for (const std::string& name : list_of<std::string>(methods, "methods")) {
    const Algorithm algorithm = algorithm_of(name);
    if (std::ranges::find(algorithms, algorithm) != algorithms.end()) {
      throw Error("method " + in_quotes(name), "it is given twice", "name each method once");
    }
    algorithms.push_back(algorithm);
  }
  return algorithms;
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

Drag drag_from(const std::string& name, const py::object& elements, const py::iterable& path) {
  Drag drag{name, ids_of(elements, "element"), {}};
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

enum class Reference { exact, physics };

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

std::vector<report::PlotFile> plots_of(const report::Comparison& /*report*/) { return {}; }

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
  const std::vector<report::PlotFile> plots = plots_of(report);
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

// The rows of the table. All have the same columns; a figure that was not measured is None.

template <class Figures>
std::optional<double> part(const std::optional<Figures>& figures, double Figures::*number) {
  return figures ? std::optional((*figures).*number) : std::nullopt;
}

/// A row with nothing measured.
struct Row {
  std::string drag, method, label;
  int sweeps = 0;
  bool equilibrium = false;
  std::string refusal;
  std::optional<TimeSpread> ms;
  std::optional<double> prepare_ms;
  std::optional<report::Errors> errors = {};
  std::optional<PhysicalError> to_physics = {};
};

void put_row(Table& table, const Row& row) {
  const auto& errors = row.errors;
  const auto violation = errors ? std::optional(errors->violation) : std::nullopt;
  const auto to_exact = errors ? errors->to_exact : std::nullopt;
  const auto to_double = errors ? std::optional(errors->float_to_double) : std::nullopt;
  table.put("drag", row.drag);
  table.put("method", row.method);
  table.put("label", row.label);
  table.put("sweeps", row.sweeps);
  table.put("equilibrium", row.equilibrium);
  table.put("refusal", row.refusal);
  table.put("ms_per_move", part(row.ms, &TimeSpread::median));
  table.put("ms_lower_quartile", part(row.ms, &TimeSpread::lower_quartile));
  table.put("ms_upper_quartile", part(row.ms, &TimeSpread::upper_quartile));
  table.put("prepare_ms", row.prepare_ms);
  table.put("violation_max", part(violation, &Violation::max));
  table.put("violation_rms", part(violation, &Violation::rms));
  table.put("violation_fraction", part(violation, &Violation::fraction));
  table.put("exact_distance_max", part(to_exact, &Distance::max));
  table.put("exact_distance_rms", part(to_exact, &Distance::rms));
  table.put("energy_over_exact", errors ? errors->energy_over_exact : std::nullopt);
  table.put("float_double_max", part(to_double, &Distance::max));
  table.put("float_double_rms", part(to_double, &Distance::rms));
  table.put("relative_error", part(row.to_physics, &PhysicalError::relative));
  table.put("physical_error_rms", part(row.to_physics, &PhysicalError::rms));
  table.put("physical_error_max", part(row.to_physics, &PhysicalError::max));
}

void put_rows(Table& table, const report::Comparison& comparison) {
  for (const report::DragResult& drag : comparison.cases.at(0).drags) {
    for (const auto& [contestant, measured, refusal] : drag.entries) {
      Row row{drag.name,
              std::string(info(contestant.algorithm).offered_name()),
              label(contestant),
              contestant.sweeps,
              contestant.equilibrium,
              refusal,
              {},
              {}};
      if (measured) {
        row.ms = measured->ms_per_move;
        row.errors = measured->errors;
      }
      put_row(table, row);
    }
  }
}

void put_rows(Table& table, const report::PhysicsReport& comparison) {
  for (const report::PhysicsDrag& drag : comparison.objects.at(0).drags) {
    for (const report::PhysicsEntry& entry : drag.entries) {
      const auto& one = entry.contestant;
      Row row{drag.name,
              one.algorithm ? std::string(info(*one.algorithm).offered_name()) : "nothing",
              label(one),
              one.sweeps,
              one.equilibrium,
              entry.refusal,
              {},
              {}};
      if (const auto& measured = entry.measurement) {
        row.to_physics = measured->error;
        if (one.algorithm) {
          row.ms = drag.moves > 1 ? measured->ms_per_move : measured->first_move;  // one move has no later ones
          row.prepare_ms = measured->prepare.ms();
        }
      }
      put_row(table, row);
    }
    if (!drag.no_reference.empty()) {
      put_row(table, {drag.name, "", "", 0, false, drag.no_reference, {}, {}});
    }
  }
}

py::dict compare(Object& object, const py::sequence& drags, const py::sequence& methods, const py::sequence& sweeps,
                 bool equilibrium, double relax_step, const std::string& scheme, const std::string& precision,
                 std::optional<int> repetitions, double seconds, const std::string& against, const std::string& title,
                 const std::optional<std::filesystem::path>& folder, const Progress* job, const py::object& progress) {
  CompareOptions options;
  report::CompareOptions& contest = options.physics.contest;
  contest.algorithms = algorithms_of(methods);
  contest.sweeps = list_of<int>(sweeps, "sweeps");
  contest.equilibrium = equilibrium;
  contest.relax_step = relax_step;
  contest.scheme = named<RelaxationScheme>("scheme", scheme);
  contest.precision = named<Precision>("precision", precision);
  contest.repetitions = repetitions;
  contest.seconds = seconds;
  options.physics.growth_seconds = 0;
  options.against = static_cast<Reference>(index_of("against", against, {"exact", "physics"}));
  options.title = title;
  options.folder = folder;
  if (!(seconds >= 0) || !std::isfinite(seconds)) {
    throw Error("seconds", "the time is not a number from 0", "use a number of seconds");
  }
  check(contest);
  const auto all = list_of<Drag>(drags, "drags");
  const Progress watched = job_or_new(job);
  const UseObject use(object);
  const AnyReport report = run_long(watched, progress, [&] { return compare_bodies(object, all, options, watched); });
  Table table;
  std::visit([&](const auto& one) { put_rows(table, one); }, report);
  return table.columns();
}

// Calibration

#ifdef CHAINMAIL_HAS_CALIBRATE

void put_errors(Table& table, const char* drags, const TestedDrags& tested) {
  const auto put = [&](const char* state, const Residual& residual) {
    table.put("drags", drags);
    table.put("state", state);
    table.put("relative", residual.relative);
    table.put("rms", residual.rms);
    table.put("max", residual.max);
  };
  put("nothing", tested.nothing);
  put("before", tested.before);
  put("after", tested.after);
}

py::dict result_of(const CalibrationOptions& options, const CalibrationResult& found) {
  Table errors;
  put_errors(errors, "fitted", found.fitted);
  put_errors(errors, "held_out", found.held_out);
  std::ostringstream json;
  write_json(json, options, found);
  py::dict result;
  result["softness"] = found.softness;
  result["sweeps"] = found.sweeps;
  result["evaluations"] = found.evaluations;
  result["errors"] = errors.columns();
  result["json"] = json.str();
  return result;
}

void check_at_least(int lowest, const char* name, int value) {
  if (value < lowest) {
    throw Error(name, "it is below " + std::to_string(lowest), "use " + std::to_string(lowest) + " or more");
  }
}

py::dict calibrate(Object& object, const std::string& method, std::uint64_t seed, int drags, int held_out,
                   int evaluations, int most_sweeps, const std::string& scheme, const Progress* job,
                   const py::object& progress) {
  check_at_least(1, "drags", drags);
  check_at_least(1, "held_out", held_out);
  check_at_least(1, "evaluations", evaluations);
  check_at_least(0, "most_sweeps", most_sweeps);
  const UseObject use(object);
  const Body& body = object.body();
  CalibrationOptions options{.elastic = body.elastic(),
                             .pins = {body.pins().begin(), body.pins().end()},
                             .algorithm = algorithm_of(method),
                             .seed = seed,
                             .drags = drags,
                             .held_out = held_out,
                             .evaluations = evaluations,
                             .max_sweeps = most_sweeps,
                             .not_these = {},
                             .scheme = named<RelaxationScheme>("scheme", scheme),
                             .energy = energy_of_links(body.softness().energy)};
  const Progress watched = job_or_new(job);
  return result_of(options, run_long(watched, progress, [&] {
                     return chainmail::calibrate(body.mesh_pointer(), body.cuts(), options, watched);
                   }));
}

#else

py::dict calibrate(Object& /*object*/, const std::string& /*method*/, std::uint64_t /*seed*/, int /*drags*/,
                   int /*held_out*/, int /*evaluations*/, int /*most_sweeps*/, const std::string& /*scheme*/,
                   const Progress* /*job*/, const py::object& /*progress*/) {
  throw Error("calibrate", "the library was built without NLopt", "install it, and build it again");
}

#endif

// Ramps

py::dict columns_of(const std::vector<report::RampRow>& rows) {
  Table table;
  for (const report::RampRow& row : rows) {
    table.put("width", row.width);
    table.put("elements", row.elements);
    table.put("links", row.links);
    table.put("method", info(row.algorithm).offered_name());
    table.put("passes", row.passes);
    table.put("median_ms", row.median_ms);
    table.put("p99_ms", row.p99_ms);
    table.put("mean_moved", row.mean_moved);
    table.put("repeated", row.repeated);
    table.put("real_time", row.in_real_time);
  }
  return table.columns();
}

py::dict columns_of(const std::vector<report::RampVerdict>& verdicts) {
  Table table;
  for (const report::RampVerdict& verdict : verdicts) {
    table.put("method", info(verdict.algorithm).offered_name());
    table.put("largest_width", verdict.largest_width);
    table.put("lost", verdict.lost);
    table.put("growth_exponent", verdict.growth ? std::optional(verdict.growth->power) : std::nullopt);
  }
  return table.columns();
}

py::dict ramp(const py::sequence& methods, std::uint64_t seed, double budget, std::uint64_t largest, int drags,
              int moves, const std::string& precision, const LinkSoftness& softness, const Progress* job,
              const py::object& progress) {
  report::RampOptions options;
  options.algorithms = algorithms_of(methods);
  options.seed = seed;
  options.budget = budget;
  options.largest = largest;
  options.drags = drags;
  options.moves = moves;
  options.precision = named<Precision>("precision", precision);
  options.softness = softness;
  check(options);
  const Progress watched = job_or_new(job);
  const report::Ramp found = run_long(watched, progress, [&] {
    const auto tell = [&](const report::RampProgress& at) {
      watched.report(std::min(1.0, double(at.width) * at.width / double(options.largest)));
    };
    report::Ramp made = report::ramp(options, tell, watched);
    if (made.stopped) {
      throw Cancelled();
    }
    return made;
  });
  py::dict result;
  result["sizes"] = columns_of(found.rows);
  result["methods"] = columns_of(found.verdicts);
  result["seconds"] = found.seconds;
  return result;
}

void add_drag(py::module_& module) {
  py::class_<Drag> type(
      module, "Drag",
      "A drag from rest: grabs elements, then moves them along a path, one pass per motion.\n\n"
      "Each motion of the path is a displacement (x, y, z) from where they were grabbed (mesh units), or a\n"
      "pair of a displacement and a Rotation.");
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
      [](const py::tuple& state) { return drag_from(state[0].cast<std::string>(), state[1], state[2]); });
}

void add_compare(py::module_& module) {
  const report::CompareOptions defaults;
  module.def(
      "compare", &compare, py::arg("body"), py::arg("drags") = py::list(), py::kw_only(),
      py::arg("methods") = py::list(), py::arg("sweeps") = py::make_tuple(0),
      py::arg("equilibrium") = defaults.equilibrium, py::arg("relax_step") = defaults.relax_step,
      py::arg("scheme") = word_for(defaults.scheme), py::arg("precision") = word_for(defaults.precision),
      py::arg("repetitions") = py::none(), py::arg("seconds") = defaults.seconds, py::arg("against") = "exact",
      py::arg("title") = "object", py::arg("folder") = py::none(), py::arg("job") = py::none(),
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

void add_calibrate(py::module_& module) {
  const CalibrationOptions defaults;
  module.def(
      "calibrate", &calibrate, py::arg("body"), py::kw_only(),
      py::arg("method") = info(defaults.algorithm).offered_name(), py::arg("seed") = defaults.seed,
      py::arg("drags") = defaults.drags, py::arg("held_out") = defaults.held_out,
      py::arg("evaluations") = defaults.evaluations, py::arg("most_sweeps") = defaults.max_sweeps,
      py::arg("scheme") = word_for(defaults.scheme), py::arg("job") = py::none(), py::arg("progress") = py::none(),
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
      py::arg("moves") = defaults.moves, py::arg("precision") = word_for(defaults.precision),
      py::arg("softness") = LinkSoftness(), py::arg("job") = py::none(), py::arg("progress") = py::none(),
      "Finds the largest square grid on which each method runs in real time (Dean 2004, chapter 6).\n\n"
      "Grids grow from 4 x 4 up to `largest` elements. At each size, all methods run the same drags. A method stops "
      "when\n"
      "the 99th percentile of its pass times exceeds the `budget` (s) in two attempts. `methods` are names; default: "
      "the\n"
      "ChainMail family. `progress` is called with the share of the largest grid, 0 to 1.\n\n"
      "Returns a dictionary: `sizes` and `methods`, which are dictionaries of columns for pandas.DataFrame, and "
      "`seconds`.\n"
      "The columns of `sizes` are width, elements, links, method, passes, median_ms, p99_ms, mean_moved, repeated and\n"
      "real_time; those of `methods` are method, largest_width (None: never in real time), lost (False: there was no\n"
      "next size) and growth_exponent of the median. Raises Error for an unknown method or an option out of its "
      "range;\n"
      "and Cancelled.");
}

}  // namespace

void add_reports(py::module_& module) {
  add_drag(module);
  add_compare(module);
  add_calibrate(module);
  add_ramp(module);
}

}  // namespace chainmail::python
