#include <map>
#include <ostream>

#include "command_line/model.h"
#include "command_line/script.h"
#include "files/results/summary.h"
#include "files/results/trace_csv.h"
#include "files/session/moves.h"
#include "files/session/softness_csv.h"
#include "simulate/deformation.h"
#include "simulate/move_history.h"

namespace chainmail::command_line {
namespace {

/// The passes of each move, and what follows them.
struct Schedule {
  std::uint32_t steps = 1;
  std::optional<int> relax;  // sweeps, or iterations, after each pass
  commands::SetRelaxation how;
  double until = parameters::relax_until.default_value;
};

struct DeformArguments {
  std::shared_ptr<MeshArguments> mesh;
  Algorithm algorithm = {};
  Precision precision = Precision::double_precision;
  SoftnessArguments global = {};
  ElasticOptions elastic = {};
  StrainLawArguments law = {};
  Schedule schedule = {};
  std::map<const CLI::Option*, Action::Kind> actions = {};
  std::optional<std::string> softness = {}, script = {};
  std::optional<std::string> positions = {}, trace = {}, json = {};
};

constexpr const char* example =
    "Passes, orders and ids in the output count from 0. A sponsor of -1 means none. \"links\" includes cut links.\n\n"
    "Example:\n"
    "  chainmail deform grid.dat --algorithm natural-queue --cut 30-31 --by 31:3,2 --steps 10 \\\n"
    "      --relax 20 --positions moved.csv --json -";

/// Returns the actions in the order of their options on the command line.
std::vector<Action> read_actions(const DeformArguments& arguments) {
  std::map<const CLI::Option*, std::size_t> taken;
  std::vector<Action> actions;
  for (const CLI::Option* option : arguments.mesh->options.app().parse_order()) {
    if (const auto kind = arguments.actions.find(option); kind != arguments.actions.end()) {
      add_action(actions, parse_action(kind->second, option->get_name(), option->results()[taken[option]++]));
    }
  }
  return actions;
}

/// Returns the format of the positions. On standard output, they are a CSV table.
const MeshFormat& positions_format(const std::string& path) {
  return *error_at("--positions " + printable(path), [&] {
    return &mesh_format(path == "-" ? "standard_output.csv" : path, FormatUse::write_positions);
  });
}

void write_positions(std::ostream& out, const std::string& path, const Body& body) {
  const MeshFormat& format = positions_format(path);
  check_holds(format, body.mesh(), path);
  write_mesh(out, format, {body.mesh(), body.cuts(), body.positions(), body.softness()});
}

std::vector<std::string> inputs_of(const DeformArguments& arguments) {
  std::vector<std::string> inputs{arguments.mesh->path()};
  for (const auto& input : {arguments.softness, arguments.script}) {
    inputs.insert(inputs.end(), input ? 1 : 0, input.value_or(""));
  }
  return inputs;
}

void write_results(const DeformArguments& arguments, Deformation& deformation) {
  const DeformSummary summary = deformation.summary();
  write_outputs(
      inputs_of(arguments),
      {{arguments.positions,
        [&](std::ostream& out) { write_positions(out, *arguments.positions, deformation.simulation().body()); }},
       {arguments.trace, [&](std::ostream& out) { write_trace_csv(out, deformation.traces()); }},
       {arguments.json, [&](std::ostream& out) { write_json(out, summary); }},
       {arguments.positions || arguments.trace || arguments.json ? std::nullopt : standard_output,
        [&](std::ostream& out) { write_text(out, summary); }}});
  std::ranges::for_each(notes_of(summary), say_note);
}

/// Checks and completes the options that depend on others. Recorded moves begin with the energy of links.
void complete(DeformArguments& arguments) {
  Schedule& schedule = arguments.schedule;
  const bool sweeps = info(schedule.how.scheme).sweeps;
  require(!sweeps || !arguments.mesh->options.has("--relax-until"), "--relax-until",
          "it works only with --relaxation equilibrium", "add --relaxation equilibrium");
  require(!sweeps || !schedule.how.local, "--local", "it works only with --relaxation equilibrium",
          "add --relaxation equilibrium");
  schedule.relax = schedule.relax.value_or(sweeps ? 0 : equilibrium_iterations);
  if (arguments.script && !arguments.global.energy) {
    arguments.global.energy = link_energy;
  }
  const std::vector<StrainLaw> laws = strain_laws_of(arguments.law, arguments.elastic);
  require(laws.size() == 1, "--material", "it names several materials", "name one");
  arguments.elastic.law = laws.front();
  if (arguments.positions) {
    positions_format(*arguments.positions);
  }
  check_outputs(inputs_of(arguments), {arguments.positions, arguments.trace, arguments.json});
}

/// Returns the softness of all links, and of those that have their own by their file or by that of the mesh.
Softness softness_for(const DeformArguments& arguments, const OpenedMesh& opened) {
  Softness softness = softness_of(arguments.global);
  softness.links = opened.softness;
  softness.axes = axes_of(arguments.global, *opened.mesh);
  error_at("--algorithm " + *value_of(arguments.mesh->options.app().get_option("--algorithm")),
           [&] { check(arguments.algorithm, *opened.mesh); });
  if (arguments.softness) {
    for (const auto& [link, own] : read_softness(std::filesystem::path(*arguments.softness), *opened.mesh)) {
      softness.links.set(link, own);
    }
  }
  return softness;
}

std::vector<chainmail::Command> recorded_moves(const DeformArguments& arguments, const MeshPointer& mesh) {
  if (!arguments.script) {
    return {};
  }
  return watched("reading " + printable(*arguments.script), {}, [&](const Progress& progress) {
    return read_moves(std::filesystem::path(*arguments.script), mesh, progress);
  });
}

void deform(DeformArguments& arguments) {
  arguments.mesh->options.read();
  complete(arguments);
  const Schedule& schedule = arguments.schedule;
  const std::vector<Action> actions = read_actions(arguments);
  const OpenedMesh opened = open_mesh(*arguments.mesh);
  check(arguments.precision, *opened.mesh);
  const Softness softness = softness_for(arguments, opened);
  const std::vector<chainmail::Command> recorded = recorded_moves(arguments, opened.mesh);
  check_actions(actions, *last_mesh(opened.mesh, recorded), schedule.steps);

  std::optional<Watch> watch("deforming " + shown(arguments.mesh->path()));
  const auto passes = double(passes_of(recorded, actions, schedule.steps));
  const auto on_end = [&, done = 0.0]() mutable { watch->progress().show(++done / passes); };
  Deformation deformation(opened.mesh, arguments.algorithm, arguments.precision,
                          {*schedule.relax, schedule.until, arguments.trace.has_value(), on_end});
  deformation.apply(commands::SetSoftness{softness});
  deformation.apply(commands::SetElastic{arguments.elastic});
  deformation.apply(schedule.how);
  carry_out(deformation, recorded, actions, schedule.steps);
  watch.reset();
  write_results(arguments, deformation);
}

void add_actions(CLI::App& app, DeformArguments& arguments) {
  using enum Action::Kind;
  const auto add = [&](Action::Kind kind, const std::string& name, const std::string& type, const std::string& help) {
    CLI::Option* option = add_value(app, name, type, help);
    option->group("Actions (may be repeated; they run in the given order)");
    arguments.actions[option] = kind;
  };
  add(move, "--move", "ID:X[,Y[,Z]]", "drag an element to a position; omitted coordinates stay");
  add(by, "--by", "ID:DX[,DY[,DZ]]",
      "drag an element by a distance; without ID, drag the handle of --grab: DX,DY[,DZ]");
  add(grab, "--grab", "IDS|LAYER", "grab elements, such as 3,7,20-29, or all of a layer: they move as one rigid body");
  add(rotate, "--rotate", "AXIS:DEGREES", "rotate the handle of --grab about its middle; AXIS is x, y, z or X,Y,Z");
  add(cut, "--cut", "A-B", "cut the link between two elements");
  add(blade, "--split", "X,Y,Z;X,Y,Z;…", "divide cells, or faces, along a line of points where the object then is");
  add(along, "--along", "DX,DY,DZ", "direction along which the line of the --split before it is swept both ways");
  add(pin, "--pin", "ID|LAYER", "pin an element at its current position, or all elements of " + pin_names());
}

void add_model(Options& options, DeformArguments& arguments) {
  Schedule& schedule = arguments.schedule;
  options
      .add("--algorithm", "NAME", joined_words(names_of(every_algorithm()), "|"), arguments.algorithm,
           [](const std::string& where, const std::string& name) {
             return algorithm_of(where, name, every_algorithm());
           })
      ->required();
  add_softness(options, arguments.global);
  options.add_input("--softness",
                    "softness of single links: CSV rows a,b," + softness_names(",", 0, region_numbers) + " or a,b," +
                        softness_names(","),
                    arguments.softness);
  options.add("--relax", "N",
              "sweeps of relaxation after each pass, or largest number of iterations [0; equilibrium: " +
                  std::to_string(equilibrium_iterations) + "]",
              schedule.relax, count_from(0));
  add_relaxation(options, false, schedule.how.scheme);
  options.add_numbers(schedule.how);
  options.add(parameters::relax_until, schedule.until);
  options.add("--local", Choices<bool>{{"off", false}, {"on", true}},
              std::string(parameters::fine_where_needed) + " [off]", schedule.how.local);
  add_precision(options, arguments.precision);
  add_elastic(options, arguments.elastic, arguments.law);
  add_space(*arguments.mesh);
}

}  // namespace

Command add_deform(CLI::App& root) {
  CLI::App* app =
      root.add_subcommand("deform", "Drag elements of a mesh, pin elements, cut links, split cells and faces");
  const auto arguments = std::make_shared<DeformArguments>(DeformArguments{add_mesh(*app)});
  Options& options = arguments->mesh->options;
  add_model(options, *arguments);
  add_actions(*app, *arguments);
  options.add("--steps", "N", "passes per move, in equal steps [1]", arguments->schedule.steps, count_from(1));
  options.add_input("--script",
                    "recorded moves (JSON) saved by the workbench, which run before all actions; the default of "
                    "--energy is then corotated",
                    arguments->script);
  options.add("--positions", "FILE", "write the final positions: " + mesh_endings(FormatUse::write_positions),
              arguments->positions);
  options.add("--trace", "FILE", "write every processed candidate as CSV pass,order,element,sponsor,moved",
              arguments->trace);
  options.add("--json", "FILE", "write passes, violation, energy, displacement and figures of cells as JSON",
              arguments->json);
  app->footer("Algorithms:\n" + algorithms_help(every_algorithm()) + "\nFormats of positions:\n" +
              mesh_formats_help(FormatUse::write_positions) + "\n" + example);
  return {app, [arguments] { deform(*arguments); }};
}

}  // namespace chainmail::command_line
