#include "calibrate/for_report.h"
#include "command_line/compare.h"
#include "files/results/peer_json.h"
#include "files/results/results_json.h"
#include "report/page/report.h"
#include "report/run/peer.h"
#include "report/run/suite.h"
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

report::Shard shard_of(const std::string& text) {
  const auto parts = split(text, '/');
  const auto index = parse_count(parts.front()), count = parse_count(parts.back());
  require(parts.size() == 2 && index && count && *index >= 1 && *count >= 1 && *index <= *count && *count <= max_shards,
          "--shard", in_quotes(text) + " is not a part of a whole", "write I/N, such as 2/4, with N up to 1000");
  return {int(*index), int(*count)};
}

/// Returns the experiments of --experiments, or those that run if none is named, as far as they are in the shard.
std::vector<std::string> experiments_of(const CompareArguments& arguments) {
  const auto& list = arguments.experiments;
  std::vector<std::string> names = list ? report::all_suite_names() : report::suite_names();
  if (list) {
    const auto wanted = words_of("--experiments", *list);
    std::ranges::for_each(wanted, [&](const std::string& name) { check_word("--experiments", name, names); });
    std::erase_if(names, [&](const std::string& name) { return std::ranges::find(wanted, name) == wanted.end(); });
  }
  names = report::part_of(names, shard_of(arguments.shard.value_or("1/1")));
  require(!names.empty(), "--shard", "no experiment is in this part", "use a smaller number of parts");
  return names;
}

bool needs_organ(const std::vector<std::string>& names) {
  return std::ranges::any_of(report::suite_experiments(), [&](const report::SuiteExperiment& one) {
    return one.needs_organ() && std::ranges::count(names, one.name) > 0;
  });
}

/// Throws Error for an option that the given mode does not take, and reads the others.
void read_only(const CompareArguments& arguments, const std::string& mode, const std::vector<std::string>& taken) {
  for (const CLI::Option* option : arguments.options.app().get_options()) {
    const std::string name = option->get_name();
    require(option->count() == 0 || name == mode || std::ranges::find(taken, name) != taken.end(), name,
            "it does not work with " + mode, "leave it out");
  }
  arguments.options.read();
}

/// Returns the organs of the samples whose files are there.
report::SampleOrgans sample_organs() {
  const auto opened = [](const char* name) {
    const auto file = samples_folder() / name;
    std::error_code none;
    return std::filesystem::is_regular_file(file, none) ? read_mesh(file) : nullptr;
  };
  return {opened("organ.msh"), opened("organ-coarse.msh")};
}

}  // namespace

void run_suite(const CompareArguments& arguments) {
  add_bullet();
  read_only(arguments, "--suite", {"--shard", "--experiments", "--algorithms", "--repetitions", "--calibrated", "-o"});
  report::SuiteOptions options;
  options.algorithms = arguments.how.algorithms;
  options.repetitions = arguments.how.repetitions;
  if (arguments.calibrated.value_or(false)) {
    options.calibrate = calibrator_for_reports(RelaxationScheme::mean);
  }
  const std::vector<std::string> experiments = experiments_of(arguments);
  OutputFolder folder(*arguments.output, report_files);
  if (needs_organ(experiments)) {
    options.organs = sample_organs();
  }
  report::Results suite = watched("running the suite", {}, [&](const Progress& progress) {
    return report::run_suite(experiments, options, progress);
  });
  suite.runs.push_back({origin_of(arguments.command_line), arguments.shard.value_or("1/1"), experiments});
  folder.write_report(suite);
}

void merge_suites(const CompareArguments& arguments) {
  read_only(arguments, "--merge", {"MESH", "-o"});
  const std::vector<std::string> reports = arguments.meshes->results();
  require(!reports.empty(), "--merge", "the files are missing", "name the report.json of each part");
  add_bullet();
  OutputFolder folder(*arguments.output, report_files);
  std::vector<report::Results> parts;
  for (const std::string& file : reports) {
    const report::Results& part = parts.emplace_back(read_results(file));
    require(part.kind == report::ReportKind::suite, shown(file), "it is not a report of compare --suite",
            "give the report.json of each part of a suite");
  }
  folder.write_report(report::merged(parts), reports);
}

void write_cases(const CompareArguments& arguments) {
  read_only(arguments, "--cases", {"-o"});
  OutputFolder folder(*arguments.output);
  const auto cases = report::peer_cases_of_suite(sample_organs());
  std::vector<OutputFile> files;
  files.reserve(cases.size());
  for (const report::PeerCase& one : cases) {
    files.push_back({one.name + ".json", [&one](std::ostream& out) { write_json(out, one); }});
  }
  folder.write(files);
}

void judge_answers(const CompareArguments& arguments) {
  read_only(arguments, "--judge", {"MESH"});
  const std::vector<std::string> files = arguments.meshes->results();
  require(files.size() >= 2, "--judge", "the files are missing", "name a case, then one or more answers to it");
  const report::PeerCase object = read_peer_case(files.front());
  std::vector<report::PeerAnswer> answers;
  std::transform(files.begin() + 1, files.end(), std::back_inserter(answers), read_peer_answer);
  const report::Results judged = report::judge(object, answers);
  write_file("-", [&](std::ostream& out) { write_text(out, judged); });
}

}  // namespace chainmail::command_line
