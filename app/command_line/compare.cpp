#include "command_line/compare.h"

#include <algorithm>

#include "calibrate/for_report.h"
#include "files/session/moves.h"
#include "files/session/softness_presets.h"
#include "report/run/drags.h"
#include "report/run/physics_cases.h"
#include "report/run/preparing.h"
#include "report/table/format.h"
#include "simulate/move_history.h"

namespace chainmail::command_line {
namespace {

constexpr int moves_if_quick = 6;
constexpr double quick_seconds = 0.3;
/// The longest that a contestant may take on one object (s).
struct Longest {
  double against_exact, against_physics;

  double of(bool physics) const { return physics ? against_physics : against_exact; }
};
constexpr Longest if_quick{2, 10}, on_meshes{60, 15};

constexpr const char* about_objects =
    "Without MESH, six built-in objects are used, which takes about two minutes. Each object is dragged three times\n"
    "from rest: locally, as a whole, and back and forth. Writes report.html, report.json, report.csv and plots as SVG\n"
    "to FOLDER and prints the main table.\n\n"
    "--against physics: the reference is neo-Hookean FEM on the same cells. The methods of elasticity and an\n"
    "object that does not move are added. Without MESH, a bar and a sheet are used, which takes about five minutes.\n"
    "Each object is nudged, pulled and bent, near and far, at each handle, and cut once between two moves.\n\n"
    "With MESH, physics has one handle, fewer sweeps, and nothing is calibrated or grows. A MESH takes a few\n"
    "minutes, a large one more.\n"
    "--quick gives a first answer, mostly within a minute: one drag of each object (physics: one bend and one cut),\n"
    "few repetitions, nothing calibrated, turned or growing; of the methods of elasticity only linear FEM, FFD and\n"
    "quasi-Newton FEM.\n";

constexpr const char* about_moves =
    "Recorded moves are JSON. Other commands are release, pin, unpin, cut, uncut, softness, relax and reset:\n"
    "  {\"version\": 1, \"commands\": [{\"do\": \"pin\", \"elements\": [0]}, {\"do\": \"grab\", \"element\": 5},\n"
    "    {\"do\": \"drag\", \"target\": [1, 2, 0]}, {\"do\": \"drag\", \"target\": [2, 3, 0]},\n"
    "    {\"do\": \"grab\", \"elements\": [5, 6]}, {\"do\": \"drag\", \"by\": [1, 2, 0],\n"
    "     \"rotate\": {\"axis\": [0, 0, 1], \"degrees\": 20}}]}\n\n"
    "Example:\n"
    "  chainmail compare cloth.obj --algorithms natural-queue,exact --relax 0,10 -o report\n"
    "  chainmail compare organ.msh --against physics --pins bottom --poisson 0.45 -o report\n"
    "  chainmail compare organ.msh --against physics --pins bottom --quick -o report\n"
    "  chainmail compare --suite -o suite\n"
    "  chainmail compare --merge part1/report.json part2/report.json -o suite";

std::string about_limits() {
  const auto words = [](const Longest& longest) {
    return report::figure(longest.against_exact) + " s, against physics " + report::figure(longest.against_physics) +
           " s";
  };
  return "A contestant is left out, unless --algorithms names it, if it takes longer on an object than\n" +
         words(if_quick) + " (--quick) or " + words(on_meshes) + " (MESH).\n\n";
}

/// Reads the relaxation after each move: numbers of sweeps, and whether the equilibrium is one of the choices.
void read_relax(const CLI::Option* option, report::CompareOptions& result) {
  constexpr auto max_sweeps = std::uint32_t(parameters::relax_sweeps.highest);
  const auto list = value_of(option);
  if (!list) {
    return;
  }
  result.sweeps.clear();
  result.equilibrium = false;
  for (const std::string& word : words_of("--relax", *list)) {
    if (word == info(RelaxationScheme::equilibrium).name) {
      result.equilibrium = true;
      continue;
    }
    const auto count = parse_count(word);
    require(count && *count <= max_sweeps, "--relax", in_quotes(word) + " is not a number of sweeps",
            "write whole numbers up to " + std::to_string(max_sweeps) + ", or equilibrium, separated by commas");
    result.sweeps.push_back(static_cast<int>(*count));
  }
}

/// Sets what is not the same for all references, meshes and times. Options override it.
void set_defaults(CompareArguments& arguments) {
  report::PhysicsOptions& how = arguments.how;
  const bool is_quick = arguments.is_quick();
  how.equilibrium = true;
  how.turned = !is_quick;
  if (is_quick || arguments.has_meshes()) {
    how.growth_seconds = 0;
    arguments.handles = 1;
  }
}

/// Returns the ChainMail family and the methods of elasticity that answer an organ of 2,000 elements in seconds.
std::vector<Algorithm> quick_algorithms() {
  std::vector<Algorithm> quick;
  std::ranges::transform(algorithms(), std::back_inserter(quick), &AlgorithmInfo::algorithm);
  quick.insert(quick.end(), {Algorithm::linear_fem, Algorithm::free_form, Algorithm::quasi_newton});
  return quick;
}

/// Sets what depends on the options that were read.
void complete(CompareArguments& arguments) {
  report::PhysicsOptions& how = arguments.how;
  const bool is_quick = arguments.is_quick();
  if (!arguments.against_physics) {
    const report::CompareOptions usual;
    how.own_limit = usual.own_limit;
    how.seconds = usual.seconds;
    how.sweeps = usual.sweeps;
  }
  if (is_quick || arguments.has_meshes()) {
    how.sweeps = report::CompareOptions().sweeps;  // many sweeps take most of the time, and are not close
  }
  read_relax(arguments.options.app().get_option("--relax"), how);
  std::ranges::sort(how.sweeps);  // because a curve connects them
  how.seconds = is_quick ? quick_seconds : how.seconds;
  if (how.algorithms.empty()) {
    how.algorithms = is_quick && arguments.against_physics ? quick_algorithms() : std::vector<Algorithm>();
    how.longest = is_quick                 ? if_quick.of(arguments.against_physics)
                  : arguments.has_meshes() ? on_meshes.of(arguments.against_physics)
                                           : 0;
  }
  if (arguments.calibrated.value_or(!is_quick && !arguments.has_meshes())) {
    how.calibrate = calibrator_for_reports(how.scheme);
  }
  if (arguments.refined) {
    how.refine = ConvergingOptions();
  }
}

// Objects

/// Returns the softness of a built-in preset, or of a file with one preset.
LinkSoftness preset_of(const std::string& name) {
  std::string names;
  for (const BuiltInPreset& preset : built_in_presets()) {
    if (preset.name == name) {
      return preset.softness;
    }
    names += (names.empty() ? "" : ", ") + std::string(preset.name);
  }
  const std::filesystem::path path = name;
  std::error_code error;
  require(std::filesystem::exists(path, error), "--preset", in_quotes(name) + " is neither a preset nor a file",
          "use a file, or one of " + names);
  const std::vector<SoftnessPreset> presets = read_presets(path);
  require(presets.size() == 1, shown(path), "it contains " + std::to_string(presets.size()) + " presets",
          "keep only one of them");
  return presets.front().softness;
}

/// Returns the softness of all links: that of the preset, where single options override its values.
Softness softness_of(const CompareArguments& arguments) {
  return softness_of(arguments.softness, arguments.preset ? preset_of(*arguments.preset) : LinkSoftness());
}

/// Reads a mesh as an object of the report: at rest, with its softness, without drags.
report::Case case_of(const std::string& file, const CompareArguments& arguments) {
  Softness softness = softness_of(arguments);
  const std::filesystem::path path = file;
  OpenedMesh opened = open_mesh(file);
  softness.links = std::move(opened.softness);
  softness.axes = axes_of(arguments.softness, *opened.mesh);
  return {printable(path.filename().string()), "mesh from a file", opened.mesh, {}, {}, std::move(softness), {}};
}

/// Returns the objects at rest. Only the built-in ones have drags.
std::vector<report::Case> objects_of(const CompareArguments& arguments) {
  std::vector<report::Case> cases;
  if (!arguments.has_meshes()) {
    require(!arguments.pins, "--pins", "the built-in objects have their own pins",
            "add a mesh, or leave out the option");
    const Softness softness = softness_of(arguments);
    cases = arguments.against_physics ? report::physics_cases(softness, arguments.elastic)
                                      : report::default_cases(softness);
    for (report::Case& one : cases) {
      one.softness.axes = axes_of(arguments.softness, *one.mesh);
    }
  }
  for (const std::string& file : arguments.meshes->results()) {
    report::Case& object = cases.emplace_back(case_of(file, arguments));
    object.elastic = arguments.elastic;
    if (arguments.pins || arguments.against_physics) {
      object.pins = pins_of(arguments.pins, object.name, *object.mesh);
    }
  }
  return cases;
}

/// Reads recorded moves of an object that a comparison can repeat.
report::RecordedMoves moves_of(const std::string& file, const MeshPointer& mesh, const Progress& progress) {
  const std::string name = printable(file);
  const std::filesystem::path path = file;
  progress.say("reading " + name);
  report::RecordedMoves moves{"recorded", "recorded in " + printable(path.filename().string()),
                              read_moves(path, mesh, progress)};
  require(last_mesh(mesh, moves.commands) == mesh, name, "its moves split the object, which a comparison cannot repeat",
          "save the split object, and record moves of it");
  require(report::count_moves(moves) > 0, name, "it contains no move", "write a grab and a drag, as in compare --help");
  return moves;
}

/// Returns the drags of an object: for a quick comparison, the first one, or against physics a bend and a cut.
std::vector<report::RecordedMoves> drags_of(const report::Case& object, const CompareArguments& arguments,
                                            const Progress& progress) {
  if (arguments.moves) {
    return {moves_of(*arguments.moves, object.mesh, progress)};
  }
  auto drags = arguments.against_physics
                   ? report::physics_drags(object, true, arguments.refined ? report::patch_share : 0, arguments.handles,
                                           arguments.is_quick() ? moves_if_quick : report::moves_of_drag)
               : object.drags.empty() ? report::three_drags(object, progress)
                                      : object.drags;
  if (arguments.is_quick() && arguments.against_physics) {
    std::erase_if(drags,
                  [](const report::RecordedMoves& one) { return one.name != "bend" && report::cuts_of(one).empty(); });
  } else if (arguments.is_quick()) {
    drags.resize(1);
  }
  return drags;
}

std::vector<report::Case> cases_of(const CompareArguments& arguments) {
  require(!arguments.moves || !arguments.against_physics, "--moves", "the comparison with physics uses its own drags",
          "leave out the option");
  require(!arguments.moves || arguments.has_meshes(), "--moves", "the mesh of the recorded moves is missing",
          "add its file");
  const std::vector<StrainLaw> laws = strain_laws_of(arguments.laws, arguments.elastic);
  std::vector<report::Case> cases = objects_of(arguments);
  for (report::Case& object : cases) {
    object.drags = watched("finding drags of " + object.name, {},
                           [&](const Progress& progress) { return drags_of(object, arguments, progress); });
  }
  return report::with_laws(cases, laws);
}

// Runs

/// Names, on standard error, the contestants that took too long.
void say_left_out(const report::Results& results, double longest) {
  std::vector<std::string> left_out;
  for (const report::Row& row : results.rows) {
    const std::string name = label(row.contestant);
    if (row.refusal == report::left_out_after(longest) && std::ranges::count(left_out, name) == 0) {
      left_out.push_back(name);
    }
  }
  if (!left_out.empty()) {
    say_note("left out, because they take longer than " + report::figure(longest) +
             " s: " + joined_words(left_out, "; "));
  }
}

/// Refuses options that work only with another one, `with`.
void refuse_without(const std::string& with, const CompareArguments& arguments, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    require(!arguments.options.has(name), name, "it works only with " + with, "add " + with);
  }
}

// Options

/// Shows options together in the help.
void group(CLI::App& app, const std::string& title, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    app.get_option(name)->group(title);
  }
}

const std::vector<std::string> of_elastic{"--young", "--poisson", "--lattice", "--iterations"};
const std::vector<std::string> only_physics{"--handles",  "--grow",       "--calibrated",   "--reference",
                                            "--material", "--gent-limit", "--fung-exponent"};

/// Returns the value of --relax that stands for the defaults of a comparison.
std::string relax_in_words(const report::CompareOptions& options) {
  std::string text;
  for (const int sweeps : options.sweeps) {
    text += std::to_string(sweeps) + ",";
  }
  return text + std::string(info(RelaxationScheme::equilibrium).name);
}

void add_contest(Options& options, CompareArguments& arguments) {
  report::PhysicsOptions& how = arguments.how;
  options.add("--against", Choices<bool>{{"exact", false}, {"physics", true}}, "reference for the errors [exact]",
              arguments.against_physics);
  add_algorithms(options, "algorithms to compare: see deform --help [all; against exact: the ChainMail family]",
                 every_algorithm, how.algorithms);
  add_value(options.app(), "--relax", "N,N,…",
            "numbers of relaxation sweeps after each move; equilibrium: Natural Queue and Exact also relax "
            "to the equilibrium [" +
                relax_in_words(report::CompareOptions()) +
                "; physics without MESH: " + relax_in_words(report::PhysicsOptions()) + "]");
  add_relaxation(options, true, how.scheme);
  options.add(parameters::relax_step, how.relax_step);
  add_precision(options, how.precision);
  options.add("--repetitions", "N",
              "runs of each drag [as many as fit into " + report::figure(report::CompareOptions().seconds) +
                  " s, at least 3; physics: " + report::figure(how.seconds) +
                  " s; --quick: " + report::figure(quick_seconds) + " s]",
              how.repetitions, count_from(1));
  options.app().add_flag("--quick")->description(
      "a first answer: one drag, few repetitions, and nobody who takes long, unless --algorithms names them");
}

void add_physics(Options& options, CompareArguments& arguments) {
  add_pins(options, arguments.pins);
  options.add_numbers(arguments.elastic, {"young", "poisson", "lattice", "iterations"});
  add_strain_laws(options, arguments.elastic, arguments.laws);
  options.add("--reference", Choices<bool>{{"same-cells", false}, {"refined", true}},
              "cells of the reference solution; refined: handles are patches, and the cells are refined until the "
              "answer changes by less than 2 % [same-cells]",
              arguments.refined);
  options.add("--handles", "N", "number of handles of each object, 1 to 3 [3; with MESH or --quick: 1]",
              arguments.handles, count_from(1, report::max_handles));
  options.add("--grow", "SECONDS",
              "time that each contestant may use on a growing bar and a growing sheet; 0: off [1; with MESH or "
              "--quick: 0]",
              arguments.how.growth_seconds, [](const std::string& where, const std::string& text) {
                const double seconds = parse_number_of(where, text);
                require(seconds >= 0, where, text + " is below 0", "use a number of seconds, or 0");
                return seconds;
              });
  options.add("--calibrated", on_or_off,
              "also calibrate Natural Queue and Exact on each object, with other drags and up to 10 "
              "sweeps [on; with MESH, --suite or --quick: off]",
              arguments.calibrated);
  group(options.app(), "Against physics", only_physics);
  group(options.app(), "Pins and methods of elasticity", {"--pins"});
  group(options.app(), "Pins and methods of elasticity", of_elastic);
}

void add_suite(Options& options, CompareArguments& arguments) {
  CLI::App& app = options.app();
  app.add_flag("--suite")->description(
      "run the suite of experiments, about 25 minutes: all contestants against closed forms and converged references");
  options.add("--experiments", "NAME,…", "only these experiments of the suite [all but fronts-…]",
              arguments.experiments);
  options.add("--shard", "I/N", "only part I of N of the suite, for several machines [1/1]", arguments.shard);
  app.add_flag("--merge")->description("join reports of parts of the suite: MESH are their report.json");
  app.add_flag("--cases")->description("write drags of the suite as files for other solvers, in the folder of -o");
  app.add_flag_callback(
      "--judge", [output = app.get_option("-o")] { output->required(false); },  // it writes a table only
      "measure what other solvers found: MESH are a file of --cases and the answers to it");
  group(app, "Suite", {"--suite", "--experiments", "--shard", "--merge", "--cases", "--judge"});
}

void add_arguments(Options& options, CompareArguments& arguments) {
  arguments.meshes = add_value(options.app(), "MESH", "", "mesh files: " + mesh_endings(FormatUse::read))
                         ->expected(-1)
                         ->allow_extra_args(true);
  add_contest(options, arguments);
  add_softness(options, arguments.softness);
  options.add("--preset", "NAME|FILE", "name of a built-in preset, or a preset file (for example from calibrate -o)",
              arguments.preset);
  options.add_input("--moves", "recorded moves (JSON) to run from rest, instead of the three drags", arguments.moves);
  options.add("-o", "FOLDER", "folder for the report; created if missing", arguments.output)->required();
  add_physics(options, arguments);
  add_suite(options, arguments);
}

void compare(CompareArguments& arguments) {
  using Mode = std::pair<const char*, void (*)(const CompareArguments&)>;
  for (const auto& [mode, run] : {Mode{"--merge", merge_suites}, Mode{"--judge", judge_answers},
                                  Mode{"--cases", write_cases}, Mode{"--suite", run_suite}}) {
    if (arguments.options.has(mode)) {
      return run(arguments);
    }
  }
  refuse_without("--suite", arguments, {"--experiments", "--shard"});
  set_defaults(arguments);
  arguments.options.read();
  if (!arguments.against_physics) {
    refuse_without("--against physics", arguments, only_physics);
  }
  if (!arguments.against_physics && !arguments.has_meshes()) {
    refuse_without("MESH or --against physics", arguments, of_elastic);
  }
  complete(arguments);
  OutputFolder folder(*arguments.output, report_files);
  const std::vector<report::Case> cases = cases_of(arguments);
  report::Results results = watched("comparing", {}, [&](const Progress& progress) {
    return arguments.against_physics ? report::compare_with_physics(cases, arguments.how, progress)
                                     : report::compare(cases, arguments.how, progress);
  });
  results.runs.push_back({origin_of(arguments.command_line)});
  folder.write_report(results);
  say_left_out(results, arguments.how.longest);
}

}  // namespace

Command add_compare(CLI::App& root, const std::string& command_line) {
  CLI::App* app = root.add_subcommand("compare", "Compare algorithms: a report of time against error");
  const auto arguments =
      std::make_shared<CompareArguments>(CompareArguments{.options = Options(*app), .command_line = command_line});
  add_arguments(arguments->options, *arguments);
  app->footer(about_objects + about_limits() + about_moves);
  return {app, [arguments] { compare(*arguments); }};
}

}  // namespace chainmail::command_line
