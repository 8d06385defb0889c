#include <algorithm>

#include "calibrate/for_report.h"
#include "command_line/compare_options.h"
#include "command_line/folder.h"
#include "command_line/progress_line.h"
#include "command_line/report_origin.h"
#include "files/results/report_json.h"
#include "files/text/outputs.h"
#include "report/page/physics_csv.h"
#include "report/page/physics_html.h"
#include "report/page/physics_plot.h"
#include "report/page/physics_table.h"
#include "report/page/svg.h"
#include "report/run/physics_cases.h"

namespace chainmail::command_line {
namespace {

report::PhysicsOptions physics_options(const CompareArguments& arguments) {
  report::PhysicsOptions options;
  const double seconds_per_drag = options.contest.seconds;
  options.contest = contest_of(arguments, every_algorithm(), "0,1,3,10,30,100,equilibrium");
  options.contest.seconds = seconds_per_drag;
  std::ranges::sort(options.contest.sweeps);  // in ascending order, because a curve connects them
  if (is_calibrated(arguments, true)) {
    options.calibrate = calibrator_for_reports(options.contest.scheme);
  }
  const std::string reference = value_of(arguments.reference).value_or("same-cells");
  check_word("--reference", reference, {"same-cells", "refined"});
  if (reference == "refined") {
    options.refine = ConvergingOptions();
  }
  if (const auto seconds = value_of(arguments.grow)) {
    options.growth_seconds = parse_number_of("--grow", *seconds);
    if (options.growth_seconds < 0) {
      throw Error("--grow", *seconds + " is below 0", "use a number of seconds, or 0");
    }
  }
  return options;
}

std::vector<report::Case> physics_cases(const CompareArguments& arguments) {
  const Softness softness = softness_of(arguments);
  const ElasticOptions elastic = elastic_of(arguments.elastic);
  if (arguments.moves->count() > 0) {
    throw Error("--moves", "the comparison with physics uses its own drags", "leave out the option");
  }
  if (arguments.meshes->count() == 0) {
    refuse_pins(arguments);
    return with_axes(report::physics_cases(softness, elastic), arguments);
  }
  std::vector<report::Case> cases;
  for (const std::string& file : arguments.meshes->results()) {
    report::Case object = case_of(file, arguments);
    object.pins = pins_of(arguments.pins, object.name, *object.mesh);
    object.elastic = elastic;
    object.drags = report::physics_drags(object);
    cases.push_back(std::move(object));
  }
  return cases;
}

/// Returns each case with each material of the reference solution. Names say the material, except neo-Hookean alone.
std::vector<report::Case> with_materials(const std::vector<report::Case>& cases, const std::vector<StrainLaw>& laws) {
  std::vector<report::Case> all;
  for (const report::Case& object : cases) {
    for (const StrainLaw& law : laws) {
      all.push_back(object);
      all.back().law = law;
      if (laws.size() > 1 || law.kind != StrainLaw::Kind::neo_hookean) {
        all.back().name += ", " + label(law);
      }
    }
  }
  return all;
}

/// Adds the plots to the outputs. Returns their names.
std::set<std::string> add_plots(Outputs& outputs, const std::filesystem::path& folder,
                                const report::PhysicsReport& report) {
  std::set<std::string> names;
  const auto add = [&](const std::string& name, const report::Plot& plot) {
    outputs.add(folder / name, [plot](std::ostream& out) { write_svg(out, plot, plot_ink); });
    names.insert(name);
  };
  if (report.objects.size() > 1) {
    add("overview.svg", physics_overview(report));
  }
  for (std::size_t i = 0; i < report.objects.size(); ++i) {
    add(object_plot(i + 1), physics_plot(report.objects[i]));
  }
  if (!report.growths.empty()) {
    add("growth-time.svg", growth_time_plot(report.growths));
    add("growth-prepare.svg", growth_prepare_plot(report.growths));
    add("growth-error.svg", growth_error_plot(report.growths));
  }
  return names;
}

}  // namespace

void compare_with_physics(const CompareArguments& arguments, const std::string& command_line) {
  const report::PhysicsOptions options = physics_options(arguments);
  OutputFolder folder(*value_of(arguments.output));
  const std::vector<StrainLaw> laws = strain_laws_of(arguments.laws, elastic_of(arguments.elastic).material);
  std::vector<report::Case> objects = physics_cases(arguments);
  if (options.refine) {
    for (report::Case& object : objects) {
      object.drags = report::physics_drags(object, true, report::patch_share);
    }
  }
  const std::vector<report::Case> cases = with_materials(objects, laws);
  ProgressLine line;
  const report::PhysicsReport report = report::compare_with_physics(
      cases, options,
      [&](double fraction, const std::string& text) { line.show([&] { return percent(fraction) + text; }); });
  const report::Origin origin = origin_of(command_line);

  folder.make();
  Outputs outputs;
  outputs.add(folder.path() / "report.html", [&](std::ostream& out) { write_html(out, report, origin); });
  outputs.add(folder.path() / "report.json", [&](std::ostream& out) { write_json(out, report, origin); });
  outputs.add(folder.path() / "report.csv", [&](std::ostream& out) { write_csv(out, report); });
  const auto plots = add_plots(outputs, folder.path(), report);
  outputs.add("-", [&](std::ostream& out) { write_text(out, report); });
  outputs.commit();
  folder.keep();
  folder.say_older_plots(plots);
}

}  // namespace chainmail::command_line
