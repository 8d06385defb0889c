#include "command_line/compare.h"

#include <algorithm>

#include "calibrate/for_report.h"
#include "files/session/moves.h"
#include "files/session/softness_presets.h"
#include "report/run/drags.h"
#include "report/run/physics_cases.h"
#include "report/run/runner.h"
#include "simulate/move_history.h"
#include "version/version.h"

namespace chainmail::command_line {
namespace {

/// What errors refer to.
enum class Reference { exact, physics };
const Choices<Reference> references{{"exact", Reference::exact}, {"physics", Reference::physics}};
/// The cells of the reference solution: those of the object, or refined ones.
enum class ReferenceCells { same, refined };
const Choices<ReferenceCells> cells_of_reference{{"same-cells", ReferenceCells::same},
                                                 {"refined", ReferenceCells::refined}};

constexpr const char* compare_footer =
    "Without MESH, six built-in objects are used, which takes about two minutes. Each object is dragged three times\n"
    "from rest: locally, as a whole, and back and forth. Writes report.html, report.json and report.csv to FOLDER and\n"
    "prints the main table.\n\n"
    "--against physics: the reference is neo-Hookean FEM on the same cells. The methods of elasticity and an\n"
    "object that does not move are added. Without MESH, a bar and a sheet are used. Each object is nudged, pulled and\n"
    "bent, near and far, at three handles, and cut once between two moves. FOLDER also receives the plots as SVG.\n\n"
    "Recorded moves are JSON. Other commands are release, pin, unpin, cut, uncut, softness, relax and reset:\n"
    "  {\"version\": 1, \"commands\": [{\"do\": \"pin\", \"elements\": [0]}, {\"do\": \"grab\", \"element\": 5},\n"
    "    {\"do\": \"drag\", \"target\": [1, 2, 0]}, {\"do\": \"drag\", \"target\": [2, 3, 0]},\n"
    "    {\"do\": \"grab\", \"elements\": [5, 6]}, {\"do\": \"drag\", \"by\": [1, 2, 0],\n"
    "     \"rotate\": {\"axis\": [0, 0, 1], \"degrees\": 20}}]}\n\n"
    "Example:\n"
    "  chainmail compare cloth.obj --algorithms natural-queue,exact --relax 0,10 -o report\n"
    "  chainmail compare organ.msh --against physics --pins bottom --poisson 0.45 -o report\n"
    "  chainmail compare --suite -o suite\n"
    "  chainmail compare --merge part1/report.json part2/report.json -o suite";

/// Reads the relaxation after each move: numbers of sweeps, and whether the equilibrium is one of the choices.
void read_relax(const CLI::Option* option, const std::string& usual, report::CompareOptions& result) {
  constexpr std::uint32_t max_sweeps = 1'000'000;
  result.sweeps.clear();
  for (const std::string& word : words_of("--relax", value_of(option).value_or(usual))) {
    if (word == info(RelaxationScheme::equilibrium).name) {
      result.equilibrium = true;
      continue;
    }
    const auto count = parse_count(word);
    if (!count || *count > max_sweeps) {
      throw Error("--relax", in_quotes(word) + " is not a number of sweeps",
                  "write whole numbers up to 1000000, or equilibrium, separated by commas");
    }
    result.sweeps.push_back(static_cast<int>(*count));
  }
}

/// Returns the settings of the comparison. `relax` is the default of --relax.
report::CompareOptions contest_of(const CompareArguments& options, const std::string& relax) {
  report::CompareOptions result;
  result.algorithms = algorithms_of(options.algorithms, every_algorithm());
  read_relax(options.relax, relax, result);
  result.scheme = choice_of(options.relaxation, schemes(true), result.scheme);
  result.relax_step = value_of(options.relax_step, parameters::relax_step);
  result.precision = choice_of(options.precision, precisions(result.precision), result.precision);
  result.repetitions = repetitions_of(options);
  return result;
}

report::PhysicsOptions physics_options(const CompareArguments& arguments) {
  report::PhysicsOptions options;
  const double seconds = options.contest.seconds;
  options.contest = contest_of(arguments, "0,1,3,10,30,100,equilibrium");
  options.contest.seconds = seconds;
  std::ranges::sort(options.contest.sweeps);  // in ascending order, because a curve connects them
  if (choice_of(arguments.calibrated, on_or_off, true)) {
    options.calibrate = calibrator_for_reports(options.contest.scheme);
  }
  if (choice_of(arguments.reference, cells_of_reference, ReferenceCells::same) == ReferenceCells::refined) {
    options.refine = ConvergingOptions();
  }
  options.growth_seconds = number_of(arguments.grow, options.growth_seconds);
  if (options.growth_seconds < 0) {
    throw Error("--grow", *value_of(arguments.grow) + " is below 0", "use a number of seconds, or 0");
  }
  return options;
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
  if (!std::filesystem::exists(path, error)) {
    throw Error("--preset", in_quotes(name) + " is neither a preset nor a file", "use a file, or one of " + names);
  }
  const std::vector<SoftnessPreset> presets = read_presets(path);
  if (presets.size() != 1) {
    throw Error(shown(path), "it contains " + std::to_string(presets.size()) + " presets", "keep only one of them");
  }
  return presets.front().softness;
}

/// Returns the softness of all links: that of the preset, where single options override its values.
Softness softness_of(const CompareArguments& arguments) {
  const auto preset = value_of(arguments.preset);
  return softness_of(arguments.softness, preset ? preset_of(*preset) : LinkSoftness());
}

/// Reads a mesh as an object of the report: at rest, with its softness, without drags.
report::Case case_of(const std::string& file, const CompareArguments& arguments) {
  Softness softness = softness_of(arguments);
  const std::filesystem::path path = file;
  OpenedMesh opened = chainmail::open_mesh(path);
  softness.links = std::move(opened.softness);
  softness.axes = axes_of(arguments.softness, *opened.mesh);
  return {printable(path.filename().string()), "mesh from a file", opened.mesh, {}, {}, std::move(softness), {}};
}

std::vector<report::Case> with_axes(std::vector<report::Case> cases, const CompareArguments& arguments) {
  for (report::Case& one : cases) {
    one.softness.axes = axes_of(arguments.softness, *one.mesh);
  }
  return cases;
}

void refuse_pins(const CompareArguments& arguments) {
  if (arguments.pins->count() > 0) {
    throw Error("--pins", "the built-in objects have their own pins", "add a mesh, or leave out the option");
  }
}

/// Reads recorded moves of an object that a comparison can repeat.
report::RecordedMoves moves_of(const std::string& file, const MeshPointer& mesh) {
  const std::string name = printable(file);
  const std::filesystem::path path = file;
  Watch watch("reading " + name);
  report::RecordedMoves moves{"recorded", "recorded in " + printable(path.filename().string()),
                              read_moves(path, mesh, watch.progress())};
  if (last_mesh(mesh, moves.commands) != mesh) {
    throw Error(name, "its moves split the object, which a comparison cannot repeat",
                "save the split object, and record moves of it");
  }
  if (report::count_moves(moves) == 0) {
    throw Error(name, "it contains no move", "write a grab and a drag, as in compare --help");
  }
  return moves;
}

std::vector<report::Case> cases_of(const CompareArguments& arguments) {
  const auto recorded = value_of(arguments.moves);
  if (arguments.meshes->count() == 0 && recorded) {
    throw Error("--moves", "the mesh of the recorded moves is missing", "add its file");
  }
  if (arguments.meshes->count() == 0) {
    refuse_pins(arguments);
    return with_axes(report::default_cases(softness_of(arguments)), arguments);
  }
  std::vector<report::Case> cases;
  for (const std::string& file : arguments.meshes->results()) {
    report::Case& object = cases.emplace_back(case_of(file, arguments));
    object.elastic = elastic_of(arguments.elastic);
    if (arguments.pins->count() > 0) {
      object.pins = pins_of(arguments.pins, object.name, *object.mesh);
    }
    if (recorded) {
      object.drags.push_back(moves_of(*recorded, object.mesh));
    }
  }
  for (report::Case& object : cases) {
    if (!recorded) {
      object.drags = report::three_drags(object);
    }
  }
  return cases;
}

std::vector<report::Case> physics_cases_of(const CompareArguments& arguments, const ElasticOptions& elastic,
                                           double radius_share) {
  if (arguments.moves->count() > 0) {
    throw Error("--moves", "the comparison with physics uses its own drags", "leave out the option");
  }
  std::vector<report::Case> cases;
  if (arguments.meshes->count() == 0) {
    refuse_pins(arguments);
    cases = with_axes(report::physics_cases(softness_of(arguments), elastic), arguments);
  }
  for (const std::string& file : arguments.meshes->results()) {
    report::Case& object = cases.emplace_back(case_of(file, arguments));
    object.pins = pins_of(arguments.pins, object.name, *object.mesh);
    object.elastic = elastic;
  }
  for (report::Case& object : cases) {
    if (object.drags.empty() || radius_share > 0) {
      object.drags = report::physics_drags(object, true, radius_share);
    }
  }
  return cases;
}

// Runs

void compare_with_exact(const CompareArguments& arguments) {
  const report::CompareOptions options = contest_of(arguments, "0,10,equilibrium");
  OutputFolder folder(*value_of(arguments.output));
  const report::Comparison comparison = [&] {
    ProgressLine line;
    return report::compare(cases_of(arguments), options, progress_on(line));
  }();
  write_report(folder, comparison, {}, {}, origin_of(arguments));
}

void compare_with_physics(const CompareArguments& arguments) {
  const report::PhysicsOptions options = physics_options(arguments);
  OutputFolder folder(*value_of(arguments.output));
  const ElasticOptions elastic = elastic_of(arguments.elastic);
  const std::vector<StrainLaw> laws = strain_laws_of(arguments.laws, elastic.material);
  const auto cases = physics_cases_of(arguments, elastic, options.refine ? report::patch_share : 0);
  const report::PhysicsReport report = [&] {
    ProgressLine line;
    return report::compare_with_physics(report::with_laws(cases, laws), options, progress_on(line));
  }();
  write_report(folder, report, plots_of(report), {}, origin_of(arguments));
}

/// Refuses options that work only with another one, `with`.
void refuse_without(const std::string& with, const std::vector<const CLI::Option*>& options) {
  for (const CLI::Option* option : options) {
    if (option->count() > 0) {
      throw Error(option->get_name(), "it works only with " + with, "add " + with);
    }
  }
}

// Options

void add_contest(CLI::App& app, CompareArguments& options) {
  options.against = add_choice(app, "--against", references, "reference for the errors [exact]");
  options.algorithms = add_value(app, "--algorithms", "A,B,…",
                                 "algorithms to compare: see deform --help [all; against exact: the ChainMail family]");
  options.relax =
      add_value(app, "--relax", "N,N,…",
                "numbers of relaxation sweeps after each move; equilibrium: Natural Queue and Exact also relax "
                "to the equilibrium [0,10,equilibrium; physics: 0,1,3,10,30,100,equilibrium]");
  options.relaxation = add_relaxation(app, true);
  options.relax_step = add_parameter(app, parameters::relax_step);
  options.precision = add_precision(app, Precision::single_precision);
  options.repetitions = add_value(
      app, "--repetitions", "N", "runs of each drag [as many as fit into 4 s, at least 5; physics: 1.5 s, at least 3]");
}

void add_physics(CLI::App& app, CompareArguments& options) {
  options.pins = add_pins(app);
  options.elastic = add_elastic(app);
  options.laws = add_strain_laws(app);
  options.reference =
      add_choice(app, "--reference", cells_of_reference,
                 "cells of the reference solution; refined: handles are patches, and the cells are refined until the "
                 "answer changes by less than 2 % [same-cells]");
  options.grow = add_value(app, "--grow", "SECONDS",
                           "time that each contestant may use on a growing bar and a growing sheet; 0: off [1]");
  options.calibrated =
      add_choice(app, "--calibrated", on_or_off,
                 "also calibrate Natural Queue and Exact on each object, with other drags and up to 10 "
                 "sweeps [on; with --suite: off]");
  for (CLI::Option* option : {options.grow, options.calibrated, options.reference, options.laws.materials,
                              options.laws.gent_limit, options.laws.fung_exponent}) {
    option->group("Against physics");
  }
  for (CLI::Option* option : {options.pins, options.elastic.young, options.elastic.poisson, options.elastic.lattice,
                              options.elastic.iterations}) {
    option->group("Pins and methods of elasticity");
  }
}

void add_suite(CLI::App& app, CompareArguments& options) {
  options.suite = app.add_flag("--suite")->description(
      "run the suite of experiments, about 25 minutes: all contestants against closed forms and converged references");
  options.experiments =
      add_value(app, "--experiments", "NAME,…", "only these experiments of the suite [all but fronts-…]");
  options.shard = add_value(app, "--shard", "I/N", "only part I of N of the suite, for several machines [1/1]");
  options.merge =
      app.add_flag("--merge")->description("join reports of parts of the suite: MESH are their report.json");
  options.cases =
      app.add_flag("--cases")->description("write drags of the suite as files for other solvers, in the folder of -o");
  options.judge = app.add_flag_callback(
      "--judge", [output = options.output] { output->required(false); },  // it writes a table only
      "measure what other solvers found: MESH are a file of --cases and the answers to it");
  for (CLI::Option* option :
       {options.suite, options.experiments, options.shard, options.merge, options.cases, options.judge}) {
    option->group("Suite");
  }
}

CompareArguments add_compare_arguments(CLI::App& app, const std::string& command_line) {
  CompareArguments options;
  options.app = &app;
  options.command_line = command_line;
  const std::string help = "mesh files: " + mesh_endings(FormatUse::read);
  options.meshes = app.add_option("MESH", help)
                       ->type_name("")
                       ->expected(-1)
                       ->allow_extra_args(true)
                       ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_contest(app, options);
  options.softness = add_softness(app);
  options.preset = add_value(app, "--preset", "NAME|FILE",
                             "name of a built-in preset, or a preset file (for example from calibrate -o)");
  options.moves =
      add_value(app, "--moves", "FILE", "recorded moves (JSON) to run from rest, instead of the three drags");
  options.output = add_value(app, "-o", "FOLDER", "folder for the report; created if missing")->required();
  add_physics(app, options);
  add_suite(app, options);
  return options;
}

void compare(const CompareArguments& arguments) {
  if (arguments.merge->count() > 0) {
    return merge_suites(arguments);
  }
  if (arguments.judge->count() > 0) {
    return judge_answers(arguments);
  }
  if (arguments.cases->count() > 0) {
    return write_cases(arguments);
  }
  if (arguments.suite->count() > 0) {
    return run_suite(arguments);
  }
  refuse_without("--suite", {arguments.experiments, arguments.shard});
  if (choice_of(arguments.against, references, Reference::exact) == Reference::physics) {
    return compare_with_physics(arguments);
  }
  refuse_without("--against physics",
                 {arguments.grow, arguments.calibrated, arguments.reference, arguments.laws.materials,
                  arguments.laws.gent_limit, arguments.laws.fung_exponent});
  compare_with_exact(arguments);
}

}  // namespace

std::optional<int> repetitions_of(const CompareArguments& arguments) {
  return arguments.repetitions->count() > 0 ? std::optional(int(whole_number_of(arguments.repetitions, 1, 1)))
                                            : std::nullopt;
}

report::Origin origin_of(const CompareArguments& arguments) {
  return {report::this_machine(), arguments.command_line, report::now_in_words(), version_in_words("chainmail")};
}

Progress progress_on(ProgressLine& line) {
  return Progress::watched(
      [&line](double share, const std::string& text) { line.show([&] { return percent(share) + text; }); });
}

void write_files(OutputFolder& folder, const std::vector<ReportFile>& files, const Outputs::Writer& text,
                 const std::vector<std::filesystem::path>& read) {
  folder.make();
  Outputs outputs;
  for (const auto& path : read) {
    outputs.keep(path);
  }
  std::set<std::string> written;
  for (const ReportFile& file : files) {
    outputs.add(folder.path() / file.name, file.writer);
    written.insert(file.name);
  }
  outputs.add("-", text);
  outputs.commit();
  folder.keep();
  folder.say_older_plots(written);
}

Command add_compare(CLI::App& root, const std::string& command_line) {
  CLI::App* app = root.add_subcommand("compare", "Compare algorithms: a report of time against error");
  const CompareArguments arguments = add_compare_arguments(*app, command_line);
  app->footer(compare_footer);
  return {app, [arguments] { compare(arguments); }};
}

}  // namespace chainmail::command_line
