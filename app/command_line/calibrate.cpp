#include "chainmail/calibrate.h"

#include <ostream>

#include "command_line/common.h"
#include "command_line/model.h"
#include "command_line/progress_line.h"

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

/// Returns the object: at rest, with pins, the material and the kind of energy.
api::Body body_of(const CalibrateArguments& options, const std::string& object, const api::Mesh& mesh) {
  api::Body body(mesh);
  body.set_elasticity(elastic_of(options.elastic));
  body.pin(pins_of(options.pins, object, mesh));
  body.set_energy(energy_of(options.energy, api::link_energy));
  return body;
}

api::CalibrateOptions calibration_options(const CalibrateArguments& options) {
  api::CalibrateOptions result;
  if (const auto name = value_of(options.algorithm)) {
    result.method = method_of("--algorithm", *name, chainmail_methods());
  }
  result.scheme = relaxation_of(options.relaxation, false, result.scheme);
  result.drags = int(whole_number_of(options.drags, 1, std::uint32_t(result.drags)));
  result.seed = whole_number_of(options.seed, 0, std::uint32_t(result.seed));
  result.evaluations = int(whole_number_of(options.evaluations, 1, std::uint32_t(result.evaluations)));
  return result;
}

std::string read_name(const CalibrateArguments& options, const api::Body& body) {
  const std::filesystem::path path = *value_of(options.mesh.path);
  std::string name = api::printable(path.stem().string()).substr(0, api::preset_name_bytes - 20);
  name = value_of(options.name).value_or(name + ", Poisson " + api::figure(body.elasticity().poisson));
  if (const std::string fault = api::fault_of_preset_name(name); !fault.empty()) {
    throw api::Error("--name", api::in_quotes(name) + " cannot name a preset", fault);
  }
  return name;
}

void calibrate(const CalibrateArguments& options) {
  const api::Mesh opened = open_mesh(options.mesh);
  const std::filesystem::path path = *value_of(options.mesh.path);
  const std::string object = api::printable(path.filename().string());
  const api::Body body = body_of(options, object, opened);
  const api::CalibrateOptions how = calibration_options(options);
  const std::string name = read_name(options, body);
  const auto preset_file = value_of(options.preset), json_file = value_of(options.json);
  const api::Calibration result = [&] {
    const Watch watch("calibrating softness for " + object);
    return in_options({{"pins", "--pins"}, {"reference solution", object}, {"neo-Hookean FEM", object}},
                      [&] { return api::calibrate(body, how, watch.job()); });
  }();
  api::Outputs outputs;
  outputs.keep(path);
  if (preset_file) {
    outputs.add(*preset_file, [&](std::ostream& out) {
      api::write_presets(out, std::vector{api::Preset{name, result.softness}});
    });
  }
  if (json_file) {
    outputs.add(*json_file, [&](std::ostream& out) { out << result.json; });
  }
  if (preset_file != "-" && json_file != "-") {
    outputs.add("-", [&](std::ostream& out) { out << result.text; });
  }
  outputs.commit();
}

}  // namespace

Command add_calibrate(CLI::App& root) {
  CLI::App* app = root.add_subcommand("calibrate", "Find the softness that is closest to an elastic material");
  CalibrateArguments options{};
  options.mesh = add_mesh_options(*app);
  options.mesh.space =
      add_value(*app, "--space", "1|2|3",
                "number of coordinates [from the file, otherwise the number of axes along which the mesh extends]");
  options.elastic = add_material(*app);
  options.pins = add_pins(*app);
  options.algorithm =
      add_value(*app, "--algorithm", "NAME", "an algorithm of the ChainMail family: see deform --help [natural-queue]");
  options.relaxation = add_relaxation(*app, false, api::CalibrateOptions().scheme);
  options.energy = add_energy(*app, api::link_energy);
  options.drags = add_value(*app, "--drags", "N", "number of drags to fit [4]");
  options.seed = add_value(*app, "--seed", "S", "random seed of the drags [1]");
  options.evaluations =
      add_value(*app, "--evaluations", "N", "largest number of evaluations; each runs all drags [200]");
  options.name = add_value(*app, "--name", "NAME", "name of the preset [the mesh and Poisson's ratio]");
  options.preset = add_value(*app, "-o", "FILE", "write the softness as a preset (JSON)");
  options.json = add_value(*app, "--json", "FILE", "write softness, sweeps and residuals as JSON");
  app->footer(calibrate_footer);
  return {app, [options] { calibrate(options); }};
}

}  // namespace chainmail::command_line
