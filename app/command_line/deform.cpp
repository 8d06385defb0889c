#include <map>
#include <ostream>

#include "chainmail/simulation.h"
#include "command_line/common.h"
#include "command_line/model.h"
#include "command_line/progress_line.h"
#include "command_line/script.h"

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
  api::RelaxOptions how;
};

Schedule read_schedule(const DeformArguments& options, api::RelaxationScheme scheme) {
  if (info(scheme).sweeps && options.relax_until->count() > 0) {
    throw api::Error("--relax-until", "it works only with --relaxation equilibrium", "add --relaxation equilibrium");
  }
  return {whole_number_of(options.steps, 1, 1),
          int(whole_number_of(options.relax, 0, info(scheme).sweeps ? 0 : api::usual_iterations)),
          {value_of(options.relax_step, api::parameter("relax-step")), scheme,
           value_of(options.relax_until, api::parameter("relax-until"))}};
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

/// Returns a name with the ending of the positions. On standard output, they are a CSV table.
std::string positions_name(const std::string& path) {
  std::string name = path == "-" ? "standard_output.csv" : path;
  try {
    api::check_format(name, api::FileUse::write_positions);
  } catch (const api::Error& error) {
    throw error.at("--positions " + api::printable(path));
  }
  return name;
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
    positions_name(*targets.positions);
  }
  return targets;
}

void write_results(const Targets& targets, const api::Simulation& simulation) {
  api::Outputs outputs;
  for (const std::string& input : targets.inputs) {
    outputs.keep(input);
  }
  if (targets.positions) {
    outputs.add(*targets.positions,
                [&](std::ostream& out) { api::write_mesh(out, positions_name(*targets.positions), simulation); });
  }
  if (targets.trace) {
    outputs.add(*targets.trace, [&](std::ostream& out) { out << simulation.trace_csv(); });
  }
  if (targets.json) {
    outputs.add(*targets.json, [&](std::ostream& out) { out << simulation.json(); });
  }
  if (targets.none()) {
    outputs.add("-", [&](std::ostream& out) { out << simulation.text(); });
  }
  outputs.commit();
  for (const std::string& note : simulation.notes()) {
    say_note(note);
  }
}

/// Gives a body the softness, the energy and the axes of the options.
void soften(const DeformArguments& options, const SoftnessChoice& softness, api::Body& body) {
  softness.apply_to(body);
  if (options.script->count() > 0 && options.global.energy->count() == 0) {
    body.set_energy(api::link_energy);  // recorded moves begin with it
  }
  turn_axes(options.global, body);
}

void deform(const DeformArguments& options) {
  const std::string method = method_of("--algorithm", *value_of(options.algorithm), api::methods());
  const api::Precision precision = precision_of(options.precision, api::Precision::double_precision);
  const api::RelaxationScheme relaxation = relaxation_of(options.relaxation, false);
  const SoftnessChoice softness = softness_of(options.global);
  api::Elasticity elastic = elastic_of(options.elastic);
  read_own_law(options.law, elastic);
  elastic.thickness = value_of(options.thickness, api::parameter("thickness"));
  const Targets targets = read_targets(options);
  const Schedule schedule = read_schedule(options, relaxation);
  const std::vector<Action> actions = read_actions(options);
  const api::Mesh mesh = open_mesh(options.mesh);
  api::Body body(mesh, precision);
  soften(options, softness, body);
  body.set_elasticity(elastic);
  try {
    api::check_method(method, mesh);
  } catch (const api::Error& error) {
    throw error.at("--algorithm " + *value_of(options.algorithm));
  }
  if (const auto file = value_of(options.softness)) {
    api::read_softness(*file, body);
  }
  std::optional<api::RecordedMoves> recorded;
  if (const auto file = value_of(options.script)) {
    const Watch watch("reading " + api::printable(*file));
    recorded = api::read_moves(*file, mesh, watch.job());
  }
  check_actions(actions, recorded ? recorded->last_mesh() : mesh, schedule.steps);

  api::Simulation simulation(body, method);
  simulation.set_relaxation(schedule.relax, schedule.how);
  simulation.set_tracing(targets.trace.has_value());
  carry_out(simulation, recorded, actions, schedule.steps);
  write_results(targets, simulation);
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

/// Returns the names of the first numbers of softness, for a file with a column for each.
std::string softness_names(std::size_t count) {
  std::string names;
  for (const api::SoftnessNumber& one : api::softness_numbers().first(count)) {
    names += (names.empty() ? "" : ",") + std::string(one.name);
  }
  return names;
}

void add_model(CLI::App& app, DeformArguments& options) {
  std::string names;
  for (const std::string& name : names_of(api::methods())) {
    names += (names.empty() ? "" : "|") + name;
  }
  options.algorithm = add_value(app, "--algorithm", "NAME", names)->required();
  options.global = add_softness(app);
  options.softness = add_value(app, "--softness", "FILE",
                               "softness of single links: CSV rows a,b," + softness_names(region_numbers) + " or a,b," +
                                   softness_names(api::softness_numbers().size()));
  options.relax = add_value(app, "--relax", "N",
                            "sweeps of relaxation after each pass, or largest number of iterations [0; equilibrium: " +
                                std::to_string(api::usual_iterations) + "]");
  options.relaxation = add_relaxation(app, false);
  options.relax_step = add_parameter(app, api::parameter("relax-step"));
  options.relax_until = add_parameter(app, api::parameter("relax-until"));
  options.precision = add_precision(app, api::Precision::double_precision);
  options.elastic = add_elastic(app);
  options.law = add_strain_law(app);
  options.thickness = add_parameter(app, api::parameter("thickness"));
  options.mesh.space =
      add_value(app, "--space", "1|2|3",
                "number of coordinates [from the file, otherwise the number of axes along which the mesh extends]");
}

void add_outputs(CLI::App& app, DeformArguments& options) {
  options.positions = add_value(app, "--positions", "FILE",
                                "write the final positions: " + api::file_endings(api::FileUse::write_positions));
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
  app->footer("Algorithms:\n" + methods_help(api::methods()) + "\nFormats of positions:\n" +
              api::file_formats_help(api::FileUse::write_positions) + "\n" + example);
  return {app, [options] { deform(options); }};
}

}  // namespace chainmail::command_line
