#include "calibrate/calibrate.h"

#include <ostream>

#include "command_line/common.h"
#include "command_line/elastic.h"
#include "command_line/progress_line.h"
#include "command_line/softness.h"
#include "files/results/report_json.h"
#include "files/session/softness_presets.h"
#include "files/text/limits.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#include "report/page/figure_table.h"
#include "report/page/format.h"

namespace chainmail::command_line {
namespace {

using report::figure;

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
  if (const auto name = value_of(options.algorithm)) {
    result.algorithm = algorithm_of("--algorithm", *name, algorithms());
  }
  result.scheme = relaxation_of(options.relaxation, false, CalibrationOptions().scheme);
  result.energy = energy_of(options.energy, link_energy);
  result.drags = int(whole_number_of(options.drags, 1, std::uint32_t(result.drags)));
  result.seed = whole_number_of(options.seed, 0, std::uint32_t(result.seed));
  result.evaluations = int(whole_number_of(options.evaluations, 1, std::uint32_t(result.evaluations)));
  return result;
}

std::string read_name(const CalibrateArguments& options, const CalibrationOptions& how) {
  const std::filesystem::path path = *value_of(options.mesh.path);
  std::string name = printable(path.stem().string()).substr(0, limits::preset_name_bytes - 20);
  name = value_of(options.name).value_or(name + ", Poisson " + figure(how.elastic.material.poisson));
  if (const std::string fault = fault_of_name(name); !fault.empty()) {
    throw Error("--name", in_quotes(name) + " cannot name a preset", fault);
  }
  return name;
}

/// Writes rows of residuals: relative, RMS and max.
void write_residuals(std::ostream& out, const TestedDrags& tested, bool at_equilibrium) {
  std::vector<std::vector<std::string>> rows{{"", "relative", "RMS", "max"}};
  const auto add = [&](const std::string& what, const Residual& residual) {
    rows.push_back({what, figure(residual.relative), figure(residual.rms), figure(residual.max)});
  };
  add("nothing moves", tested.nothing);
  add(at_equilibrium ? "defaults" : "defaults, no sweeps", tested.before);
  add("calibrated", tested.after);
  for (const CalibrationDrag& drag : tested.drags) {
    add("  element " + std::to_string(drag.element) + ", before", drag.before);
    add("  element " + std::to_string(drag.element) + ", after", drag.after);
  }
  report::write_columns(out, rows);
}

void write_calibration(std::ostream& out, const CalibrationOptions& how, const CalibrationResult& result) {
  const bool at_equilibrium = !info(how.scheme).sweeps;
  out << info(how.algorithm).label << " comes closest to neo-Hookean FEM on the same cells (Young's modulus "
      << figure(how.elastic.material.young) << ", Poisson's ratio " << figure(how.elastic.material.poisson)
      << ") with\n  " << report::region_in_words(result.softness) << ", ";
  if (at_equilibrium) {
    out << report::energy_in_words(result.softness) << ", at equilibrium (" << info(how.energy).name << " energy)";
  } else {
    out << result.sweeps << " sweeps per move";
  }
  out << "\nRelative error, and RMS and max over the handle's displacement. An object that does not move has a\n"
         "relative error of about 1.\nDrags used by the search ("
      << result.fitted.drags.size() << ", " << result.evaluations << " evaluations):\n";
  write_residuals(out, result.fitted, at_equilibrium);
  out << "Drags not used by the search (" << result.held_out.drags.size() << "):\n";
  write_residuals(out, result.held_out, at_equilibrium);
}

void calibrate(const CalibrateArguments& options) {
  const OpenedMesh opened = open_mesh(options.mesh);
  const std::filesystem::path path = *value_of(options.mesh.path);
  const std::string object = printable(path.filename().string());
  const CalibrationOptions how = calibration_options(options, object, *opened.mesh);
  const SoftnessPreset preset{read_name(options, how), {}};
  const auto preset_file = value_of(options.preset), json_file = value_of(options.json);
  CalibrationResult result;
  {
    Watch watch("calibrating softness for " + object);
    try {
      result = chainmail::calibrate(opened.mesh, Cuts(opened.mesh), how, watch.progress());
    } catch (const Error& error) {
      throw at_option(error, {{"pins", "--pins"}, {"reference solution", object}, {"neo-Hookean FEM", object}});
    }
  }
  Outputs outputs;
  outputs.keep(path);
  if (preset_file) {
    outputs.add(*preset_file, [&](std::ostream& out) {
      write_presets(out, std::vector{SoftnessPreset{preset.name, result.softness}});
    });
  }
  if (json_file) {
    outputs.add(*json_file, [&](std::ostream& out) { write_json(out, how, result); });
  }
  if (preset_file != "-" && json_file != "-") {
    outputs.add("-", [&](std::ostream& out) { write_calibration(out, how, result); });
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
  return {app, [options] { calibrate(options); }};
}

}  // namespace chainmail::command_line
