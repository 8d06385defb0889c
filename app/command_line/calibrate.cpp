#include "calibrate/calibrate.h"

#include "calibrate/for_report.h"
#include "command_line/model.h"
#include "files/results/results_json.h"
#include "files/results/summary.h"
#include "files/session/softness_presets.h"
#include "files/text/limits.h"
#include "report/page/report.h"
#include "report/table/format.h"

namespace chainmail::command_line {
namespace {

struct CalibrateArguments {
  std::shared_ptr<MeshArguments> mesh;
  CalibrationOptions how = {};
  std::optional<EnergyKind> energy = {};
  std::optional<PinnedElements> pins = {};
  std::optional<std::string> name = {}, preset = {}, json = {};
};

constexpr const char* calibrate_footer =
    "The reference solution is neo-Hookean FEM on the same cells. Drags are random: elements away from the pins, by\n"
    "5 to 20 % of the object's size. The search lowers the relative error at the end of the drags: the RMS of the\n"
    "error over the RMS of the reference's displacements. The result is also tested on drags that the search did not\n"
    "use. The saved preset opens in the workbench and in compare --preset. It contains the softness, not the\n"
    "relaxation and the kind of energy. At equilibrium, the search also varies lateral and exponent; with sweeps, it\n"
    "varies their number.\n\n"
    "Example:\n"
    "  chainmail calibrate organ.msh --young 3000 --poisson 0.45 --pins bottom -o liver.json";

std::string name_of(const CalibrateArguments& arguments, const std::filesystem::path& path) {
  const std::string usual = printable(path.stem().string()).substr(0, limits::preset_name_bytes - 20) + ", Poisson " +
                            report::figure(arguments.how.elastic.material.poisson);
  std::string name = arguments.name.value_or(usual);
  const std::string fault = fault_of_name(name);
  require(fault.empty(), "--name", in_quotes(name) + " cannot name a preset", fault);
  return name;
}

void calibrate_file(CalibrateArguments& arguments) {
  arguments.mesh->options.read();
  const std::filesystem::path path = arguments.mesh->path();
  const std::string name = name_of(arguments, path);
  check_outputs({path}, {arguments.preset, arguments.json});
  const MeshPointer mesh = open_mesh(*arguments.mesh).mesh;
  const std::string object = printable(path.filename().string());
  CalibrationOptions& how = arguments.how;
  how.pins = pins_of(arguments.pins, object, *mesh);
  how.energy = energy_of_links(arguments.energy.value_or(how.energy));
  const CalibrationResult result =
      watched("calibrating softness for " + object,
              {{"pins", "--pins"}, {"reference solution", object}, {"neo-Hookean FEM", object}},
              [&](const Progress& progress) { return calibrate(mesh, Cuts(mesh), how, progress); });
  const report::Results table = results_of(object, *mesh, how, result);
  const std::vector presets{SoftnessPreset{name, result.softness}};
  write_outputs({path}, {{arguments.preset, [&](std::ostream& out) { write_presets(out, presets); }},
                         {arguments.json, [&](std::ostream& out) { write_json(out, table); }},
                         {free_output({arguments.preset, arguments.json}), [&](std::ostream& out) {
                            write_text(out, how, result);
                            write_text(out, table);
                          }}});
}

}  // namespace

Command add_calibrate(CLI::App& root) {
  CLI::App* app = root.add_subcommand("calibrate", "Find the softness that is closest to an elastic material");
  const auto arguments = std::make_shared<CalibrateArguments>(CalibrateArguments{add_mesh(*app)});
  Options& options = arguments->mesh->options;
  CalibrationOptions& how = arguments->how;
  add_space(*arguments->mesh);
  options.add_numbers(how.elastic, {"young", "poisson"});
  add_pins(options, arguments->pins);
  options.add(
      "--algorithm", "NAME", "an algorithm of the ChainMail family: see deform --help [natural-queue]", how.algorithm,
      [](const std::string& where, const std::string& name) { return algorithm_of(where, name, algorithms()); });
  add_relaxation(options, false, how.scheme);
  add_energy(options, std::string(info(link_energy).name), arguments->energy);
  options.add_numbers(how, {"drags"});
  options.add("--seed", "S", help_of("random seed of the drags", double(how.seed)), how.seed, count_from(0));
  options.add_numbers(how, {"evaluations"});
  options.add("--name", "NAME", "name of the preset [the mesh and Poisson's ratio]", arguments->name);
  options.add("-o", "FILE", "write the softness as a preset (JSON)", arguments->preset);
  options.add("--json", "FILE", "write softness, sweeps and residuals as JSON", arguments->json);
  app->footer(calibrate_footer);
  return {app, [arguments] { calibrate_file(*arguments); }};
}

}  // namespace chainmail::command_line
