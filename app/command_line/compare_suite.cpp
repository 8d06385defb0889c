#include <algorithm>

#include "calibrate/for_report.h"
#include "command_line/compare_options.h"
#include "command_line/folder.h"
#include "command_line/progress_line.h"
#include "command_line/report_origin.h"
#include "command_line/samples.h"
#include "files/results/suite_json.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#include "report/page/suite_csv.h"
#include "report/page/suite_html.h"
#include "report/page/suite_plot.h"
#include "report/page/suite_table.h"
#include "report/page/svg.h"
#include "report/run/suite_experiments.h"
#ifdef CHAINMAIL_HAS_BULLET
#include "bullet/deformable_fem.h"
#include "bullet/soft_body.h"
#endif

namespace chainmail::command_line {
namespace {

constexpr int max_shards = 1000;

/// Adds Bullet's methods. Its FEM needs minutes for an experiment, so that it takes part only where it is named.
void add_bullet([[maybe_unused]] bool with_fem) {
#ifdef CHAINMAIL_HAS_BULLET
  add_algorithm(bullet_soft_body());
  if (with_fem) {
    add_algorithm(bullet_fem());
  }
#endif
}

report::Shard shard_of(const CLI::Option* option) {
  const std::string text = value_of(option).value_or("1/1");
  const auto slash = text.find('/');
  const auto index = slash == std::string::npos ? std::nullopt : parse_count(text.substr(0, slash));
  const auto count = slash == std::string::npos ? std::nullopt : parse_count(text.substr(slash + 1));
  if (!index || !count || *index < 1 || *count < 1 || *index > *count || *count > max_shards) {
    throw Error("--shard", in_quotes(text) + " is not a part of a whole", "write I/N, such as 2/4, with N up to 1000");
  }
  return {int(*index), int(*count)};
}

/// Returns the experiments of --experiments, or all, as far as they are in the shard.
std::vector<std::string> experiments_of(const CompareArguments& arguments) {
  std::vector<std::string> names = report::suite_names();
  if (const auto list = value_of(arguments.experiments)) {
    const auto wanted = words_of("--experiments", *list);
    names = report::all_suite_names();
    std::ranges::for_each(wanted, [&](const std::string& name) { check_word("--experiments", name, names); });
    std::erase_if(names, [&](const std::string& name) { return std::ranges::find(wanted, name) == wanted.end(); });
  }
  names = report::part_of(names, shard_of(arguments.shard));
  if (names.empty()) {
    throw Error("--shard", "no experiment is in this part", "use a smaller number of parts");
  }
  return names;
}

bool needs_organ(const std::vector<std::string>& names) {
  return std::ranges::any_of(report::suite_experiments(), [&](const report::SuiteExperiment& one) {
    return one.needs_organ() && std::ranges::count(names, one.name) > 0;
  });
}

void write(const report::Suite& suite, OutputFolder& folder, const std::vector<std::filesystem::path>& read) {
  folder.make();
  Outputs outputs;
  std::ranges::for_each(read, [&](const auto& path) { outputs.keep(path); });
  outputs.add(folder.path() / "report.html", [&](std::ostream& out) { write_html(out, suite); });
  outputs.add(folder.path() / "report.json", [&](std::ostream& out) { write_json(out, suite); });
  outputs.add(folder.path() / "report.csv", [&](std::ostream& out) { write_csv(out, suite); });
  std::set<std::string> plots;
  for (const report::SpeedAgainstError& measure : report::speeds_against_error) {
    if (const report::Plot plot = suite_plot(suite, measure); !plot.panels.empty()) {
      const std::string name = std::string(measure.file) + ".svg";
      plots.insert(name);
      outputs.add(folder.path() / name, [plot](std::ostream& out) { write_svg(out, plot, plot_ink); });
    }
  }
  outputs.add("-", [&](std::ostream& out) { write_text(out, suite); });
  outputs.commit();
  folder.keep();
  folder.say_older_plots(plots);
}

}  // namespace

void refuse_others(const CLI::App& app, const std::string& mode, const std::vector<const CLI::Option*>& taken) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() > 0 && std::ranges::find(taken, option) == taken.end()) {
      throw Error(option->get_name(), "it does not work with " + mode, "leave it out");
    }
  }
}

report::SampleOrgans sample_organs() {
  const auto opened = [](const char* name) {
    const auto file = samples_folder() / name;
    std::error_code none;
    return std::filesystem::is_regular_file(file, none) ? chainmail::open_mesh(file).mesh : nullptr;
  };
  return {opened("organ.msh"), opened("organ-coarse.msh")};
}

void run_suite(const CLI::App& app, const CompareArguments& arguments, const std::string& command_line) {
  refuse_others(app, "--suite",
                {arguments.suite, arguments.shard, arguments.experiments, arguments.algorithms, arguments.repetitions,
                 arguments.calibrated, arguments.output});
  add_bullet(value_of(arguments.algorithms).value_or("").find("bullet-fem") != std::string::npos);
  report::SuiteOptions options;
  options.algorithms = algorithms_of(arguments.algorithms, every_algorithm());
  if (arguments.repetitions->count() > 0) {
    options.repetitions = static_cast<int>(whole_number_of(arguments.repetitions, 1, 1));
  }
  if (is_calibrated(arguments, false)) {
    options.calibrate = calibrator_for_reports(RelaxationScheme::mean);
  }
  const std::vector<std::string> names = experiments_of(arguments);
  OutputFolder folder(*value_of(arguments.output));
  if (needs_organ(names)) {
    options.organs = sample_organs();
  }
  ProgressLine line;
  report::Suite suite = report::run_suite(names, options, [&](double fraction, const std::string& text) {
    line.show([&] { return percent(fraction) + text; });
  });
  suite.runs = {{origin_of(command_line), value_of(arguments.shard).value_or("1/1"), names}};
  write(suite, folder, {});
}

void merge_suites(const CLI::App& app, const CompareArguments& arguments) {
  refuse_others(app, "--merge", {arguments.merge, arguments.meshes, arguments.output});
  if (arguments.meshes->count() == 0) {
    throw Error("--merge", "the files are missing", "name the report.json of each part");
  }
  add_bullet(true);
  OutputFolder folder(*value_of(arguments.output));
  std::vector<report::Suite> parts;
  std::vector<std::filesystem::path> read;
  for (const std::string& file : arguments.meshes->results()) {
    read.emplace_back(file);
    parts.push_back(read_suite(read.back()));
  }
  write(report::merged(parts), folder, read);
}

}  // namespace chainmail::command_line
