#include <map>
#include <ostream>

#include "command_line/common.h"
#include "command_line/model.h"
#include "command_line/progress_line.h"
#include "command_line/script.h"
#include "files/results/summary.h"
#include "files/results/trace_csv.h"
#include "files/session/moves.h"
#include "files/session/softness_csv.h"
#include "simulate/deformation.h"
#include "simulate/move_history.h"

namespace chainmail::command_line {
namespace {

struct DeformArguments {
  CLI::App* app = nullptr;
  MeshOptions mesh;
  ElasticArguments elastic;
  StrainLawArguments law;
  CLI::Option* thickness;
  SoftnessArguments global;
  CLI::Option *algorithm, *precision, *softness;
  CLI::Option *move, *by, *cut, *pin, *grab, *rotate;
  CLI::Option* script;
  CLI::Option *steps, *relax, *relaxation, *relax_step, *relax_until;
  CLI::Option *positions, *trace, *json;
};

/// Output files for the results.
struct Targets {
  std::optional<std::string> positions, trace, json;
  std::vector<std::string> inputs;  // input files, which no output may replace
  bool none() const { return !positions && !trace && !json; }
};

constexpr const char* example =
    "Passes, orders and ids in the output count from 0. A sponsor of -1 means none. \"links\" includes cut links.\n\n"
    "Example:\n"
    "  chainmail deform grid.dat --algorithm natural-queue --cut 30-31 --by 31:3,2 --steps 10 \\\n"
    "      --relax 20 --positions moved.csv --json -";

/// The passes of each move, and what follows them.
struct Schedule {
  std::uint32_t steps = 1;
  int relax = 0;  // sweeps, or iterations, after each pass
  commands::SetRelaxation how;
  double until = 0;
};

Schedule read_schedule(const DeformArguments& options, RelaxationScheme scheme) {
  const bool sweeps = info(scheme).sweeps;
  if (sweeps && options.relax_until->count() > 0) {
    throw Error("--relax-until", "it works only with --relaxation equilibrium", "add --relaxation equilibrium");
  }
  return {whole_number_of(options.steps, 1, 1),
          int(whole_number_of(options.relax, 0, sweeps ? 0 : equilibrium_iterations)),
          {false, value_of(options.relax_step, parameters::relax_step), scheme},
          value_of(options.relax_until, parameters::relax_until)};
}

/// Returns the actions in the order of their options on the command line.
std::vector<Action> read_actions(const DeformArguments& options) {
  const std::map<const CLI::Option*, Action::Kind> kinds{
      {options.move, Action::Kind::move}, {options.by, Action::Kind::by},     {options.cut, Action::Kind::cut},
      {options.pin, Action::Kind::pin},   {options.grab, Action::Kind::grab}, {options.rotate, Action::Kind::rotate}};
  std::map<const CLI::Option*, std::size_t> taken;
  std::vector<Action> actions;
  for (const CLI::Option* option : options.app->parse_order()) {
    if (const auto kind = kinds.find(option); kind != kinds.end()) {
      actions.push_back(parse_action(kind->second, option->get_name(), option->results()[taken[option]++]));
    }
  }
  return actions;
}

/// Returns the format of the positions. On standard output, they are a CSV table.
const MeshFormat& positions_format(const std::string& path) {
  try {
    return mesh_format(path == "-" ? "standard_output.csv" : path, FormatUse::write_positions);
  } catch (const Error& error) {
    throw error.at("--positions " + printable(path));
  }
}

Targets read_targets(const DeformArguments& options) {
  Targets targets{
      value_of(options.positions), value_of(options.trace), value_of(options.json), {*value_of(options.mesh.path)}};
  for (const CLI::Option* option : {options.softness, options.script}) {
    if (const auto file = value_of(option)) {
      targets.inputs.push_back(*file);
    }
  }
  if (targets.positions) {
    positions_format(*targets.positions);
  }
  return targets;
}

void write_positions(std::ostream& out, const std::string& path, const Simulation& simulation) {
  const Body& body = simulation.body();
  const MeshFormat& format = positions_format(path);
  check_holds(format, body.mesh(), path);
  write_mesh(out, format, {body.mesh(), body.cuts(), body.positions(), body.softness()});
}

void write_results(const Targets& targets, Deformation& deformation) {
  const DeformSummary summary = deformation.summary();
  Outputs outputs;
  for (const std::string& input : targets.inputs) {
    outputs.keep(input);
  }
  if (targets.positions) {
    outputs.add(*targets.positions,
                [&](std::ostream& out) { write_positions(out, *targets.positions, deformation.simulation()); });
  }
  if (targets.trace) {
    outputs.add(*targets.trace, [&](std::ostream& out) { write_trace_csv(out, deformation.traces()); });
  }
  if (targets.json) {
    outputs.add(*targets.json, [&](std::ostream& out) { write_json(out, summary); });
  }
  if (targets.none()) {
    outputs.add("-", [&](std::ostream& out) { write_text(out, summary); });
  }
  outputs.commit();
  for (const std::string& note : notes_of(summary)) {
    say_note(note);
  }
}

/// Returns the softness of the options. Recorded moves begin with the energy of links.
Softness softness_to_begin_with(const DeformArguments& options) {
  Softness softness = softness_of(options.global);
  if (options.script->count() > 0 && options.global.energy->count() == 0) {
    set_energy(softness, link_energy);
  }
  return softness;
}

ElasticOptions elastic_options_of(const DeformArguments& options) {
  ElasticOptions elastic = elastic_of(options.elastic);
  elastic.law = own_law_of(options.law, elastic.material);
  elastic.thickness = value_of(options.thickness, parameters::thickness);
  return elastic;
}

/// Throws Error, with the option, if the algorithm does not work on the mesh.
void check_algorithm(const DeformArguments& options, Algorithm algorithm, const Mesh& mesh) {
  try {
    check(algorithm, mesh);
  } catch (const Error& error) {
    throw error.at("--algorithm " + *value_of(options.algorithm));
  }
}

std::vector<chainmail::Command> recorded_moves(const DeformArguments& options, const MeshPointer& mesh) {
  const auto file = value_of(options.script);
  if (!file) {
    return {};
  }
  Watch watch("reading " + printable(*file));
  return read_moves(std::filesystem::path(*file), mesh, watch.progress());
}

void deform(const DeformArguments& options) {
  const Algorithm algorithm = algorithm_of("--algorithm", *value_of(options.algorithm), every_algorithm());
  const Precision precision =
      choice_of(options.precision, precisions(Precision::double_precision), Precision::double_precision);
  const RelaxationScheme scheme = choice_of(options.relaxation, schemes(false), RelaxationScheme::mean);
  Softness softness = softness_to_begin_with(options);
  const ElasticOptions elastic = elastic_options_of(options);
  const Targets targets = read_targets(options);
  const Schedule schedule = read_schedule(options, scheme);
  const std::vector<Action> actions = read_actions(options);

  OpenedMesh opened = open_mesh(options.mesh);
  const MeshPointer mesh = opened.mesh;
  check(precision, *mesh);
  softness.links = std::move(opened.softness);
  softness.axes = axes_of(options.global, *mesh);
  check_algorithm(options, algorithm, *mesh);
  if (const auto file = value_of(options.softness)) {
    for (const auto& [link, own] : read_softness(std::filesystem::path(*file), *mesh)) {
      softness.links.set(link, own);
    }
  }
  const std::vector<chainmail::Command> recorded = recorded_moves(options, mesh);
  check_actions(actions, *last_mesh(mesh, recorded), schedule.steps);

  std::optional<ProgressLine> line(std::chrono::seconds(1));
  const std::string of_all = " of " + std::to_string(passes_of(recorded, actions, schedule.steps));
  const auto on_end = [&, done = 0]() mutable {
    ++done;
    line->show([&] { return "pass " + std::to_string(done) + of_all; });
  };
  Deformation deformation(mesh, algorithm, precision,
                          {schedule.relax, schedule.until, targets.trace.has_value(), on_end});
  deformation.apply(commands::SetSoftness{softness});
  deformation.apply(commands::SetElastic{elastic});
  deformation.apply(schedule.how);
  carry_out(deformation, recorded, actions, schedule.steps);
  line.reset();
  write_results(targets, deformation);
}

void add_acts(CLI::App& app, DeformArguments& options) {
  options.move = add_value(app, "--move", "ID:X[,Y[,Z]]", "drag an element to a position; omitted coordinates stay");
  options.by = add_value(app, "--by", "ID:DX[,DY[,DZ]]",
                         "drag an element by a distance; without ID, drag the handle of --grab: DX,DY[,DZ]");
  options.grab = add_value(app, "--grab", "IDS|LAYER",
                           "grab elements, such as 3,7,20-29, or all of a layer: they move as one rigid body");
  options.rotate = add_value(app, "--rotate", "AXIS:DEGREES",
                             "rotate the handle of --grab about its middle; AXIS is x, y, z or X,Y,Z");
  options.cut = add_value(app, "--cut", "A-B", "cut the link between two elements");
  options.pin =
      add_value(app, "--pin", "ID|LAYER", "pin an element at its current position, or all elements of " + pin_names());
  for (CLI::Option* option : {options.move, options.by, options.grab, options.rotate, options.cut, options.pin}) {
    option->group("Actions (may be repeated; they run in the given order)");
  }
  options.steps = add_value(app, "--steps", "N", "passes per move, in equal steps [1]");
  options.script =
      add_value(app, "--script", "FILE", "recorded moves (JSON) saved by the workbench; they run before all actions");
}

void add_model(CLI::App& app, DeformArguments& options) {
  options.algorithm = add_value(app, "--algorithm", "NAME", joined_words(names_of(every_algorithm()), "|"))->required();
  options.global = add_softness(app);
  options.softness = add_value(app, "--softness", "FILE",
                               "softness of single links: CSV rows a,b," + softness_names(",", 0, region_numbers) +
                                   " or a,b," + softness_names(","));
  options.relax = add_value(app, "--relax", "N",
                            "sweeps of relaxation after each pass, or largest number of iterations [0; equilibrium: " +
                                std::to_string(equilibrium_iterations) + "]");
  options.relaxation = add_relaxation(app, false);
  options.relax_step = add_parameter(app, parameters::relax_step);
  options.relax_until = add_parameter(app, parameters::relax_until);
  options.precision = add_precision(app, Precision::double_precision);
  options.elastic = add_elastic(app);
  options.law = add_strain_law(app);
  options.thickness = add_parameter(app, parameters::thickness);
  options.mesh.space = add_space(app);
}

void add_outputs(CLI::App& app, DeformArguments& options) {
  options.positions =
      add_value(app, "--positions", "FILE", "write the final positions: " + mesh_endings(FormatUse::write_positions));
  options.trace =
      add_value(app, "--trace", "FILE", "write every processed candidate as CSV pass,order,element,sponsor,moved");
  options.json = add_value(app, "--json", "FILE", "write passes, violation, energy and displacement as JSON");
}

}  // namespace

Command add_deform(CLI::App& root) {
  CLI::App* app = root.add_subcommand("deform", "Drag elements of a mesh, pin elements, cut links");
  DeformArguments options{};
  options.app = app;
  options.mesh = add_mesh_options(*app);
  add_model(*app, options);
  add_acts(*app, options);
  add_outputs(*app, options);
  app->footer("Algorithms:\n" + algorithms_help(every_algorithm()) + "\nFormats of positions:\n" +
              mesh_formats_help(FormatUse::write_positions) + "\n" + example);
  return {app, [options] { deform(options); }};
}

}  // namespace chainmail::command_line
