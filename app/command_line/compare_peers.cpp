#include "command_line/compare_options.h"

namespace chainmail::command_line {

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
