#include "command_line/compare.h"

#include <algorithm>

#include "chainmail/preset.h"
#include "command_line/progress_line.h"
#include "version/version.h"

namespace chainmail::command_line {

namespace {

/// Reads the relaxation after each move: numbers of sweeps, and whether the equilibrium is one of the choices.
void read_relax(const CLI::Option* option, const std::string& usual, api::CompareOptions& result) {
  constexpr std::uint32_t max_sweeps = 1'000'000;
  result.sweeps.clear();
  for (const std::string& word : words_of("--relax", value_of(option).value_or(usual))) {
    if (word == info(api::RelaxationScheme::equilibrium).name) {
      result.equilibrium = true;
      continue;
    }
    const auto count = api::parse_count(word);
    if (!count || *count > max_sweeps) {
      throw api::Error("--relax", api::in_quotes(word) + " is not a number of sweeps",
                       "write whole numbers up to 1000000, or equilibrium, separated by commas");
    }
    result.sweeps.push_back(static_cast<int>(*count));
  }
}

/// Returns the softness of a built-in preset, or of a file with one preset.
api::LinkSoftness preset_of(const std::string& name) {
  std::string names;
  for (const api::Preset& preset : api::built_in_presets()) {
    if (preset.name == name) {
      return preset.softness;
    }
    names += (names.empty() ? "" : ", ") + preset.name;
  }
  const std::filesystem::path path = name;
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    throw api::Error("--preset", api::in_quotes(name) + " is neither a preset nor a file",
                     "use a file, or one of " + names);
  }
  const std::vector<api::Preset> presets = api::read_presets(path);
  if (presets.size() != 1) {
    throw api::Error(api::shown(path), "it contains " + std::to_string(presets.size()) + " presets",
                     "keep only one of them");
  }
  return presets.front().softness;
}

void add_contest(CLI::App& app, CompareArguments& options) {
  options.against = add_value(app, "--against", "exact|physics", "reference for the errors [exact]");
  options.algorithms = add_value(app, "--algorithms", "A,B,…",
                                 "algorithms to compare: see deform --help [all; against exact: the ChainMail family]");
  options.relax =
      add_value(app, "--relax", "N,N,…",
                "numbers of relaxation sweeps after each move; equilibrium: Natural Queue and Exact also relax "
                "to the equilibrium [0,10,equilibrium; physics: 0,1,3,10,30,100,equilibrium]");
  options.relaxation = add_relaxation(app, true);
  options.relax_step = add_parameter(app, api::parameter("relax-step"));
  options.precision = add_precision(app, api::Precision::single_precision);
  options.repetitions = add_value(
      app, "--repetitions", "N", "runs of each drag [as many as fit into 4 s, at least 5; physics: 1.5 s, at least 3]");
}

void add_physics(CLI::App& app, CompareArguments& options) {
  options.pins = add_pins(app);
  options.elastic = add_elastic(app);
  options.laws = add_strain_laws(app);
  options.reference =
      add_value(app, "--reference", "same-cells|refined",
                "cells of the reference solution; refined: handles are patches, and the cells are refined until the "
                "answer changes by less than 2 % [same-cells]");
  options.grow = add_value(app, "--grow", "SECONDS",
                           "time that each contestant may use on a growing bar and a growing sheet; 0: off [1]");
  options.calibrated = add_value(app, "--calibrated", "on|off",
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

}  // namespace

bool is_calibrated(const CompareArguments& arguments, bool by_default) {
  const std::string calibrated = value_of(arguments.calibrated).value_or(by_default ? "on" : "off");
  check_word("--calibrated", calibrated, {"on", "off"});
  return calibrated == "on";
}

api::CompareOptions contest_of(const CompareArguments& options, const std::string& relax,
                               const std::string& command_line) {
  api::CompareOptions result;
  result.methods = methods_of(options.algorithms, api::methods());
  read_relax(options.relax, relax, result);
  result.scheme = relaxation_of(options.relaxation, true);
  result.relax_step = value_of(options.relax_step, api::parameter("relax-step"));
  result.precision = precision_of(options.precision, api::Precision::single_precision);
  if (options.repetitions->count() > 0) {
    result.repetitions = static_cast<int>(whole_number_of(options.repetitions, 1, 1));
  }
  result.command = command_line;
  result.program = version_in_words("chainmail");
  return result;
}

SoftnessChoice softness_of(const CompareArguments& arguments) {
  const auto preset = value_of(arguments.preset);
  return softness_of(arguments.softness, preset ? preset_of(*preset) : api::LinkSoftness());
}

api::ComparedObject object_of(const std::string& file, const CompareArguments& arguments) {
  const SoftnessChoice softness = softness_of(arguments);
  const std::filesystem::path path = file;
  api::ComparedObject object{path.filename().string(), api::Body(api::read_mesh(path)), "mesh from a file"};
  softness.apply_to(object.body);
  turn_axes(arguments.softness, object.body);
  return object;
}

std::vector<api::ComparedObject> built_in_objects(api::Reference against, const CompareArguments& arguments,
                                                  const api::Elasticity& elasticity) {
  if (arguments.pins->count() > 0) {
    throw api::Error("--pins", "the built-in objects have their own pins", "add a mesh, or leave out the option");
  }
  const SoftnessChoice softness = softness_of(arguments);
  auto objects = api::built_in_objects(against, softness.links, softness.energy, elasticity);
  for (api::ComparedObject& one : objects) {
    turn_axes(arguments.softness, one.body);
  }
  return objects;
}

void write_report(OutputFolder& folder, const std::vector<api::ReportFile>& files, const std::string& text,
                  const std::vector<std::filesystem::path>& read) {
  folder.make();
  api::Outputs outputs;
  for (const auto& path : read) {
    outputs.keep(path);
  }
  std::set<std::string> written;
  for (const api::ReportFile& file : files) {
    outputs.add(folder.path() / file.name, [&](std::ostream& out) { out << file.content; });
    written.insert(file.name);
  }
  outputs.add("-", [&](std::ostream& out) { out << text; });
  outputs.commit();
  folder.keep();
  folder.say_older_plots(written);
}

std::string report_progress(const api::Job& job) {
  const std::string text = job.text();
  return text.empty() ? text : percent(job.share()) + text;
}

CompareArguments add_compare_arguments(CLI::App& app) {
  CompareArguments options;
  const std::string help = "mesh files: " + api::file_endings(api::FileUse::read);
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

namespace {

api::CompareOptions physics_options(const CompareArguments& arguments, const std::string& command_line) {
  api::CompareOptions options = contest_of(arguments, "0,1,3,10,30,100,equilibrium", command_line);
  options.against = api::Reference::physics;
  options.seconds = 1.5;
  std::ranges::sort(options.sweeps);  // in ascending order, because a curve connects them
  options.calibrated = is_calibrated(arguments, true);
  const std::string reference = value_of(arguments.reference).value_or("same-cells");
  check_word("--reference", reference, {"same-cells", "refined"});
  options.refined = reference == "refined";
  const auto seconds = value_of(arguments.grow);
  options.growth_seconds = seconds ? parse_number_of("--grow", *seconds) : 1;
  if (options.growth_seconds < 0) {
    throw api::Error("--grow", *seconds + " is below 0", "use a number of seconds, or 0");
  }
  return options;
}

std::vector<api::ComparedObject> physics_objects(const CompareArguments& arguments, const api::Elasticity& elastic) {
  if (arguments.moves->count() > 0) {
    throw api::Error("--moves", "the comparison with physics uses its own drags", "leave out the option");
  }
  if (arguments.meshes->count() == 0) {
    return built_in_objects(api::Reference::physics, arguments, elastic);
  }
  std::vector<api::ComparedObject> objects;
  for (const std::string& file : arguments.meshes->results()) {
    api::ComparedObject object = object_of(file, arguments);
    object.body.pin(pins_of(arguments.pins, api::printable(object.name), object.body.mesh()));
    object.body.set_elasticity(elastic);
    objects.push_back(std::move(object));
  }
  return objects;
}

}  // namespace

void compare_with_physics(const CompareArguments& arguments, const std::string& command_line) {
  api::CompareOptions options = physics_options(arguments, command_line);
  OutputFolder folder(*value_of(arguments.output));
  const api::Elasticity elastic = elastic_of(arguments.elastic);
  options.materials = strain_laws_of(arguments.laws, elastic);
  const auto objects = physics_objects(arguments, elastic);
  const api::Comparison comparison = [&] {
    const Watch watch(report_progress);
    return api::compare(objects, options, watch.job());
  }();
  write_report(folder, comparison.files(), comparison.text());
}

namespace {

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

/// Reads recorded moves of an object that a comparison can repeat.
api::RecordedMoves moves_of(const std::string& file, const api::Mesh& mesh) {
  const std::string name = api::printable(file);
  const Watch watch("reading " + name);
  api::RecordedMoves moves = api::read_moves(file, mesh, watch.job());
  if (!(moves.last_mesh() == mesh)) {
    throw api::Error(name, "its moves split the object, which a comparison cannot repeat",
                     "save the split object, and record moves of it");
  }
  if (moves.pass_count() == 0) {
    throw api::Error(name, "it contains no move", "write a grab and a drag, as in compare --help");
  }
  return moves;
}

std::vector<api::ComparedObject> objects_to_compare(const CompareArguments& options) {
  const auto recorded = value_of(options.moves);
  if (options.meshes->count() == 0 && recorded) {
    throw api::Error("--moves", "the mesh of the recorded moves is missing", "add its file");
  }
  if (options.meshes->count() == 0) {
    return built_in_objects(api::Reference::exact, options, {});
  }
  std::vector<api::ComparedObject> objects;
  for (const std::string& name : options.meshes->results()) {
    api::ComparedObject object = object_of(name, options);
    object.body.set_elasticity(elastic_of(options.elastic));
    if (options.pins->count() > 0) {
      object.body.pin(pins_of(options.pins, api::printable(object.name), object.body.mesh()));
    }
    if (recorded) {
      object.recorded.push_back(moves_of(*recorded, object.body.mesh()));
    }
    objects.push_back(std::move(object));
  }
  return objects;
}

void refuse_physics(const CompareArguments& arguments) {
  for (const CLI::Option* option : {arguments.grow, arguments.calibrated, arguments.reference, arguments.laws.materials,
                                    arguments.laws.gent_limit, arguments.laws.fung_exponent}) {
    if (option->count() > 0) {
      throw api::Error(option->get_name(), "it works only with --against physics", "add --against physics");
    }
  }
}

void refuse_suite(const CompareArguments& arguments) {
  for (const CLI::Option* option : {arguments.experiments, arguments.shard}) {
    if (option->count() > 0) {
      throw api::Error(option->get_name(), "it works only with --suite", "add --suite");
    }
  }
}

void compare(const CompareArguments& options, const std::string& command_line) {
  const api::CompareOptions how = contest_of(options, "0,10,equilibrium", command_line);
  OutputFolder folder(*value_of(options.output));
  const auto objects = objects_to_compare(options);
  const api::Comparison comparison = [&] {
    const Watch watch(report_progress);
    return api::compare(objects, how, watch.job());
  }();
  write_report(folder, comparison.files(), comparison.text());
}

}  // namespace

Command add_compare(CLI::App& root, const std::string& command_line) {
  CLI::App* app = root.add_subcommand("compare", "Compare algorithms: a report of time against error");
  const CompareArguments arguments = add_compare_arguments(*app);
  app->footer(compare_footer);
  return {app, [app, arguments, command_line] {
            if (arguments.merge->count() > 0) {
              return merge_suites(*app, arguments);
            }
            if (arguments.judge->count() > 0) {
              return judge_answers(*app, arguments);
            }
            if (arguments.cases->count() > 0) {
              return write_cases(*app, arguments);
            }
            if (arguments.suite->count() > 0) {
              return run_suite(*app, arguments, command_line);
            }
            refuse_suite(arguments);
            const std::string against = value_of(arguments.against).value_or("exact");
            check_word("--against", against, {"exact", "physics"});
            if (against == "physics") {
              compare_with_physics(arguments, command_line);
            } else {
              refuse_physics(arguments);
              compare(arguments, command_line);
            }
          }};
}

}  // namespace chainmail::command_line
