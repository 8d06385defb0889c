#include "calibrate/calibrate.h"

#include "command_line/common.h"
#include "command_line/model.h"
#include "command_line/progress_line.h"
#include "files/results/report_json.h"
#include "files/results/summary.h"
#include "files/session/softness_presets.h"
#include "files/text/limits.h"
#include "report/page/format.h"

namespace chainmail::command_line {
namespace {

struct CalibrateArguments {
  MeshOptions mesh;
  ElasticArguments elastic;
  CLI::Option *pins, *algorithm, *relaxation, *energy, *drags, *seed, *evaluations;
  CLI::Option *name, *preset, *json;
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

CalibrationOptions calibration_options(const CalibrateArguments& options, const std::string& object, const Mesh& mesh) {
  CalibrationOptions result;
  result.elastic = elastic_of(options.elastic);
  result.pins = pins_of(options.pins, object, mesh);
  result.energy = energy_of_links(energy_of(options.energy, link_energy));
  if (const auto name = value_of(options.algorithm)) {
    result.algorithm = algorithm_of("--algorithm", *name, algorithms());
  }
  result.scheme = choice_of(options.relaxation, schemes(false), result.scheme);
  result.drags = int(whole_number_of(options.drags, 1, std::uint32_t(result.drags)));
  result.seed = whole_number_of(options.seed, 0, std::uint32_t(result.seed));
  result.evaluations = int(whole_number_of(options.evaluations, 1, std::uint32_t(result.evaluations)));
  return result;
}

std::string read_name(const CalibrateArguments& options, const Material& material) {
  const std::filesystem::path path = *value_of(options.mesh.path);
  std::string name = printable(path.stem().string()).substr(0, limits::preset_name_bytes - 20);
  name = value_of(options.name).value_or(name + ", Poisson " + report::figure(material.poisson));
  if (const std::string fault = fault_of_name(name); !fault.empty()) {
    throw Error("--name", in_quotes(name) + " cannot name a preset", fault);
  }
  return name;
}

void calibrate_file(const CalibrateArguments& options) {
  const MeshPointer mesh = open_mesh(options.mesh).mesh;
  const std::filesystem::path path = *value_of(options.mesh.path);
  const std::string object = printable(path.filename().string());
  const CalibrationOptions how = calibration_options(options, object, *mesh);
  const std::string name = read_name(options, how.elastic.material);
  const auto preset_file = value_of(options.preset), json_file = value_of(options.json);
  const CalibrationResult result = [&] {
    Watch watch("calibrating softness for " + object);
    return in_options({{"pins", "--pins"}, {"reference solution", object}, {"neo-Hookean FEM", object}},
                      [&] { return calibrate(mesh, Cuts(mesh), how, watch.progress()); });
  }();
  Outputs outputs;
  outputs.keep(path);
  if (preset_file) {
    outputs.add(*preset_file, [&](std::ostream& out) {
      write_presets(out, std::vector{SoftnessPreset{name, result.softness}});
    });
  }
  if (json_file) {
    outputs.add(*json_file, [&](std::ostream& out) { write_json(out, how, result); });
  }
  if (preset_file != "-" && json_file != "-") {
    outputs.add("-", [&](std::ostream& out) { write_text(out, how, result); });
  }
  outputs.commit();
}

}  // namespace

Command add_calibrate(CLI::App& root) {
  CLI::App* app = root.add_subcommand("calibrate", "Find the softness that is closest to an elastic material");
  CalibrateArguments options{};
  options.mesh = add_mesh_options(*app);
  options.mesh.space = add_space(*app);
  options.elastic = add_material(*app);
  options.pins = add_pins(*app);
  options.algorithm =
      add_value(*app, "--algorithm", "NAME", "an algorithm of the ChainMail family: see deform --help [natural-queue]");
  options.relaxation = add_relaxation(*app, false, CalibrationOptions().scheme);
  options.energy = add_energy(*app, link_energy);
  options.drags = add_value(*app, "--drags", "N", "number of drags to fit [4]");
  options.seed = add_value(*app, "--seed", "S", "random seed of the drags [1]");
  options.evaluations =
      add_value(*app, "--evaluations", "N", "largest number of evaluations; each runs all drags [200]");
  options.name = add_value(*app, "--name", "NAME", "name of the preset [the mesh and Poisson's ratio]");
  options.preset = add_value(*app, "-o", "FILE", "write the softness as a preset (JSON)");
  options.json = add_value(*app, "--json", "FILE", "write softness, sweeps and residuals as JSON");
  app->footer(calibrate_footer);
  return {app, [options] { calibrate_file(options); }};
}

}  // namespace chainmail::command_line
