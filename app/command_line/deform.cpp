#include <algorithm>
#include <map>
#include <ostream>

#include "command_line/common.h"
#include "command_line/elastic.h"
#include "command_line/progress_line.h"
#include "command_line/script.h"
#include "command_line/softness.h"
#include "files/results/trace_csv.h"
#include "files/session/moves.h"
#include "files/session/softness_csv.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#include "measure/inverted_cells.h"
#include "measure/principal_stretch.h"
#include "measure/volume_change.h"
#include "mesh/error.h"
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

/// Throws Error, with the option, if the algorithm does not support the mesh.
void check_algorithm(const DeformArguments& options, Algorithm algorithm, const Mesh& mesh) {
  try {
    check(algorithm, mesh);
  } catch (const Error& error) {
    throw error.at("--algorithm " + *value_of(options.algorithm));
  }
}

Precision read_precision(const DeformArguments& options) {
  const std::string word = value_of(options.precision).value_or("double");
  check_word("--precision", word, {"double", "float"});
  return word == "float" ? Precision::single_precision : Precision::double_precision;
}

Schedule read_schedule(const DeformArguments& options, RelaxationScheme scheme, const Targets& targets) {
  if (info(scheme).sweeps && options.relax_until->count() > 0) {
    throw Error("--relax-until", "it works only with --relaxation equilibrium", "add --relaxation equilibrium");
  }
  return {whole_number_of(options.steps, 1, 1),
          whole_number_of(options.relax, 0, info(scheme).sweeps ? 0 : equilibrium_iterations),
          value_of(options.relax_step, parameters::relax_step), value_of(options.relax_until, parameters::relax_until),
          targets.trace.has_value()};
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

/// Returns the format of the positions. On standard output, it is a CSV table.
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

DeformSummary summarize(Simulation& simulation, const Run& run) {
  const Mesh& mesh = simulation.mesh();
  const auto positions = simulation.body().positions();
  simulation.refresh_statistics(true);
  const Statistics& statistics = simulation.statistics();
  return {std::string(info(statistics.algorithm).name),
          mesh.element_count(),
          mesh.link_count(),
          run.passes,
          statistics.violation,
          elastic_energy(mesh, simulation.softness(), simulation.body().cuts(), positions, simulation.body().elastic()),
          measure_displacement(mesh, positions),
          volume_change(mesh, positions),
          inverted_cells(mesh, positions),
          largest_principal_stretch(mesh, positions),
          info(simulation.relaxation().scheme).sweeps ? std::nullopt : simulation.certificate()};
}

void write_positions(std::ostream& out, const std::string& path, const Simulation& simulation) {
  const Solver& solver = simulation.solver();
  check_holds(positions_format(path), simulation.mesh(), path);
  write_mesh(out, positions_format(path),
             {simulation.mesh(), solver.body().cuts(), solver.body().positions(), simulation.softness()});
}

void write_deformation(std::ostream& out, const AlgorithmInfo& algorithm, const DeformSummary& summary) {
  out << algorithm.offered_name() << " on " << summary.elements << " elements, " << summary.links << " links\n";
  for (std::size_t i = 0; i < summary.passes.size(); ++i) {
    const auto& pass = summary.passes[i];
    const auto point = [&out](const Point& at) { out << '(' << at.x() << ", " << at.y() << ", " << at.z() << ')'; };
    out << "pass " << i << ": ";
    pass.handle.size() == 1 ? out << "element " << pass.handle.front() : out << pass.handle.size() << " elements";
    out << " to ";
    point(pass.target);
    if (pass.rotation.degrees != 0) {
      out << ", rotated by " << pass.rotation.degrees << " degrees about ";
      point(pass.rotation.axis);
    }
    out << ", " << pass.checked << " checked, " << pass.moved << " moved, " << pass.milliseconds << " ms";
    if (pass.stopped_at) {
      out << (pass.remark.empty() ? ", stopped by pins at " : ", stopped at ");
      point(*pass.stopped_at);
    }
    out << (pass.remark.empty() ? "" : ", ") << pass.remark << '\n';
  }
  out << "violation: max " << summary.violation.max << " rest lengths, RMS " << summary.violation.rms << ", "
      << 100 * summary.violation.fraction << "% of links\n";
  if (const auto& found = summary.equilibrium) {
    out << "equilibrium: residual " << found->residual << " after " << found->iterations << " iterations, ";
    if (found->gap) {
      out << "energy about " << 100 * *found->gap << "% above the least, ";
    }
    out << "largest violation " << found->violation << " rest lengths, valid regions "
        << (found->binds ? "bind" : "do not bind") << '\n';
  }
}

std::string share_of(std::size_t count, std::size_t all) {
  return all == 1 ? "the pass" : std::to_string(count) + " of " + std::to_string(all) + " passes";
}

/// Says what did not go as requested, so that a script notices it, too.
void say_what_failed(const std::vector<DeformSummary::Pass>& passes) {
  std::map<std::string, std::size_t> remarks;
  std::size_t stopped = 0;
  const DeformSummary::Pass* last = nullptr;
  for (const auto& pass : passes) {
    if (!pass.remark.empty()) {
      ++remarks[pass.remark];
    }
    if (pass.stopped_at) {
      ++stopped;
      last = &pass;
    }
  }
  for (const auto& [remark, count] : remarks) {
    say_note(share_of(count, passes.size()) + ": " + remark);
  }
  if (last != nullptr) {
    const auto words = [](const Point& at) {
      std::string text;
      for (int k = 0; k < 3; ++k) {
        text += k == 0 ? "(" : ", ";
        append_number(text, at[k]);
      }
      return text + ")";
    };
    say_note(share_of(stopped, passes.size()) + " stopped before the target; the last at " + words(*last->stopped_at) +
             " instead of " + words(last->target));
  }
}

void write_results(const Targets& targets, const Simulation& simulation, const Run& run, const DeformSummary& summary) {
  Outputs outputs;
  for (const std::string& input : targets.inputs) {
    outputs.keep(input);
  }
  if (targets.positions) {
    outputs.add(*targets.positions, [&](std::ostream& out) { write_positions(out, *targets.positions, simulation); });
  }
  if (targets.trace) {
    outputs.add(*targets.trace, [&](std::ostream& out) { write_trace_csv(out, run.traces); });
  }
  if (targets.json) {
    outputs.add(*targets.json, [&](std::ostream& out) { write_json(out, summary); });
  }
  if (targets.none()) {
    outputs.add("-",
                [&](std::ostream& out) { write_deformation(out, info(simulation.statistics().algorithm), summary); });
  }
  outputs.commit();
  say_what_failed(summary.passes);
}

void deform(const DeformArguments& options) {
  const Algorithm algorithm = algorithm_of("--algorithm", *value_of(options.algorithm), every_algorithm());
  const Precision precision = read_precision(options);
  const RelaxationScheme relaxation = relaxation_of(options.relaxation, false);
  Softness softness = softness_of(options.global);
  if (options.script->count() > 0 && options.global.energy->count() == 0) {
    set_energy(softness, link_energy);  // recorded moves begin with it
  }
  ElasticOptions elastic = elastic_of(options.elastic);
  elastic.law = own_law_of(options.law, elastic.material);
  elastic.thickness = value_of(options.thickness, parameters::thickness);
  const Targets targets = read_targets(options);
  const Schedule schedule = read_schedule(options, relaxation, targets);
  const std::vector<Action> actions = read_actions(options);
  OpenedMesh opened = open_mesh(options.mesh);
  const MeshPointer mesh = opened.mesh;
  softness.links = std::move(opened.softness);
  softness.axes = axes_of(options.global, *mesh);
  check_algorithm(options, algorithm, *mesh);
  if (const auto file = value_of(options.softness)) {
    for (const auto& [link, own] : read_softness(std::filesystem::path(*file), *mesh)) {
      softness.links.set(link, own);
    }
  }
  std::vector<chainmail::Command> moves;
  if (const auto file = value_of(options.script)) {
    Watch watch("reading " + printable(*file));
    moves = read_moves(std::filesystem::path(*file), mesh, watch.progress());
  }

  check_actions(actions, *last_mesh(mesh, moves));

  Simulation simulation(mesh, algorithm, precision);
  simulation.apply(commands::SetSoftness{softness});
  simulation.apply(commands::SetElastic{elastic});
  simulation.apply(commands::SetRelaxation{false, schedule.relax_step, relaxation});
  const Run run = carry_out(simulation, moves, actions, schedule);
  write_results(targets, simulation, run, summarize(simulation, run));
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
  std::string names;
  for (const std::string& name : names_of(every_algorithm())) {
    names += (names.empty() ? "" : "|") + name;
  }
  options.algorithm = add_value(app, "--algorithm", "NAME", names)->required();
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
  options.precision = add_value(app, "--precision", "double|float", "precision of the solver [double]");
  options.elastic = add_elastic(app);
  options.law = add_strain_law(app);
  options.thickness = add_parameter(app, parameters::thickness);
  options.mesh.space =
      add_value(app, "--space", "1|2|3",
                "number of coordinates [from the file, otherwise the number of axes along which the mesh extends]");
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
