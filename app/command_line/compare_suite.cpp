#include <algorithm>

#include "chainmail/suite.h"
#include "command_line/compare.h"
#include "command_line/progress_line.h"
#include "version/version.h"
#ifdef CHAINMAIL_HAS_BULLET
#include "bullet/register_bullet.h"
#endif

namespace chainmail::command_line {

namespace {

constexpr int max_shards = 1000;

void add_bullet() {
#ifdef CHAINMAIL_HAS_BULLET
  register_bullet();
#endif
}

/// A part of the suite: number `index` of `count`, from 1.
struct Shard {
  int index, count;
};

Shard shard_of(const CLI::Option* option) {
  const std::string text = value_of(option).value_or("1/1");
  const auto slash = text.find('/');
  const auto index = slash == std::string::npos ? std::nullopt : api::parse_count(text.substr(0, slash));
  const auto count = slash == std::string::npos ? std::nullopt : api::parse_count(text.substr(slash + 1));
  if (!index || !count || *index < 1 || *count < 1 || *index > *count || *count > max_shards) {
    throw api::Error("--shard", api::in_quotes(text) + " is not a part of a whole",
                     "write I/N, such as 2/4, with N up to 1000");
  }
  return {int(*index), int(*count)};
}

/// Returns the experiments of --experiments, or those that run if none is named, as far as they are in the shard.
std::vector<std::string> experiments_of(const CompareArguments& arguments) {
  const auto list = value_of(arguments.experiments);
  std::vector<std::string> names;
  for (const api::SuiteExperiment& one : api::suite_experiments()) {
    if (list || !one.only_named) {
      names.push_back(one.name);
    }
  }
  if (list) {
    const auto wanted = words_of("--experiments", *list);
    std::ranges::for_each(wanted, [&](const std::string& name) { check_word("--experiments", name, names); });
    std::erase_if(names, [&](const std::string& name) { return std::ranges::find(wanted, name) == wanted.end(); });
  }
  const Shard shard = shard_of(arguments.shard);
  names = api::part_of_suite(names, shard.index, shard.count);
  if (names.empty()) {
    throw api::Error("--shard", "no experiment is in this part", "use a smaller number of parts");
  }
  return names;
}

bool needs_organ(const std::vector<std::string>& names) {
  return std::ranges::any_of(api::suite_experiments(), [&](const api::SuiteExperiment& one) {
    return one.needs_organ && std::ranges::count(names, one.name) > 0;
  });
}

}  // namespace

void refuse_others(const CLI::App& app, const std::string& mode, const std::vector<const CLI::Option*>& taken) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() > 0 && std::ranges::find(taken, option) == taken.end()) {
      throw api::Error(option->get_name(), "it does not work with " + mode, "leave it out");
    }
  }
}

api::SampleOrgans sample_organs() {
  const auto opened = [](const char* name) {
    const auto file = samples_folder() / name;
    std::error_code none;
    return std::filesystem::is_regular_file(file, none) ? std::optional(api::read_mesh(file)) : std::nullopt;
  };
  return {opened("organ.msh"), opened("organ-coarse.msh")};
}

void run_suite(const CLI::App& app, const CompareArguments& arguments, const std::string& command_line) {
  refuse_others(app, "--suite",
                {arguments.suite, arguments.shard, arguments.experiments, arguments.algorithms, arguments.repetitions,
                 arguments.calibrated, arguments.output});
  add_bullet();
  api::SuiteOptions options;
  options.methods = methods_of(arguments.algorithms, api::methods());
  if (arguments.repetitions->count() > 0) {
    options.repetitions = static_cast<int>(whole_number_of(arguments.repetitions, 1, 1));
  }
  options.calibrated = is_calibrated(arguments, false);
  options.experiments = experiments_of(arguments);
  options.part = value_of(arguments.shard).value_or("1/1");
  options.command = command_line;
  options.program = version_in_words("chainmail");
  OutputFolder folder(*value_of(arguments.output));
  if (needs_organ(options.experiments)) {
    options.organs = sample_organs();
  }
  const api::Suite suite = [&] {
    const Watch watch(report_progress);
    return api::run_suite(options, watch.job());
  }();
  write_report(folder, suite.files(), suite.text());
}

void merge_suites(const CLI::App& app, const CompareArguments& arguments) {
  refuse_others(app, "--merge", {arguments.merge, arguments.meshes, arguments.output});
  if (arguments.meshes->count() == 0) {
    throw api::Error("--merge", "the files are missing", "name the report.json of each part");
  }
  add_bullet();
  OutputFolder folder(*value_of(arguments.output));
  const auto& names = arguments.meshes->results();
  const std::vector<std::filesystem::path> reports(names.begin(), names.end());
  const api::Suite suite = api::merge_suites(reports);
  write_report(folder, suite.files(), suite.text(), reports);
}

void write_cases(const CLI::App& app, const CompareArguments& arguments) {
  refuse_others(app, "--cases", {arguments.cases, arguments.output});
  OutputFolder folder(*value_of(arguments.output));
  const auto cases = api::suite_cases(sample_organs());
  folder.make();
  api::Outputs outputs;
  for (const api::ReportFile& one : cases) {
    outputs.add(folder.path() / one.name, [&one](std::ostream& out) { out << one.content; });
  }
  outputs.commit();
  folder.keep();
}

void judge_answers(const CLI::App& app, const CompareArguments& arguments) {
  refuse_others(app, "--judge", {arguments.judge, arguments.meshes});
  const std::vector<std::string> files = arguments.meshes->results();
  if (files.size() < 2) {
    throw api::Error("--judge", "the files are missing", "name a case, then one or more answers to it");
  }
  const std::string table = api::judge_answers(files.front(), {files.begin() + 1, files.end()});
  api::write_file("-", [&](std::ostream& out) { out << table; });
}

}  // namespace chainmail::command_line
