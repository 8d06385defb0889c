#pragma once

#include "command_line/folder.h"
#include "command_line/model.h"
#include "command_line/progress_line.h"
#include "files/results/report_json.h"
#include "files/results/suite_json.h"
#include "report/page/compared_figures.h"
#include "report/page/html.h"
#include "report/page/physics_figures.h"
#include "report/page/physics_html.h"
#include "report/page/physics_plot.h"
#include "report/page/physics_table.h"
#include "report/page/suite_page.h"
#include "report/page/suite_table.h"
#include "report/page/svg.h"
#include "report/page/table.h"
#include "report/run/machine.h"

namespace chainmail::command_line {

/// The options of `compare`, for both references and for the suite.
struct CompareArguments {
  const CLI::App* app = nullptr;
  std::string command_line;  // shown in the report
  CLI::Option *meshes = nullptr, *output = nullptr, *against = nullptr;
  CLI::Option *algorithms = nullptr, *relax = nullptr, *relaxation = nullptr, *relax_step = nullptr,
              *precision = nullptr, *repetitions = nullptr;
  SoftnessArguments softness;
  CLI::Option *preset = nullptr, *moves = nullptr;
  ElasticArguments elastic;
  StrainLawArguments laws;
  CLI::Option *pins = nullptr, *grow = nullptr, *calibrated = nullptr, *reference = nullptr;
  CLI::Option *suite = nullptr, *experiments = nullptr, *shard = nullptr, *merge = nullptr;
  CLI::Option *cases = nullptr, *judge = nullptr;
};

// Each of these functions throws Error before it writes anything.

/// Runs the experiments of the suite and writes the report.
void run_suite(const CompareArguments& arguments);
/// Joins reports of the suite.
void merge_suites(const CompareArguments& arguments);
/// Writes drags of the suite as cases for other solvers.
void write_cases(const CompareArguments& arguments);
/// Judges answers of other solvers to a case.
void judge_answers(const CompareArguments& arguments);

/// Returns the number of runs of each drag; none if it is left to the comparison.
std::optional<int> repetitions_of(const CompareArguments& arguments);
/// Returns where a report comes from, which ends now.
report::Origin origin_of(const CompareArguments& arguments);
/// Returns a function that shows the progress of a report on a line.
Progress progress_on(ProgressLine& line);

/// A file of a report.
struct ReportFile {
  std::string name;
  Outputs::Writer writer;
};
/// Writes files into the folder, and a text to standard output. `read` are files that stay.
void write_files(OutputFolder& folder, const std::vector<ReportFile>& files, const Outputs::Writer& text,
                 const std::vector<std::filesystem::path>& read = {});
/// Writes report.html, report.json, report.csv and plots into the folder, and the tables to standard output.
template <class Report, class... Origin>
void write_report(OutputFolder& folder, const Report& made, const std::vector<report::PlotFile>& plots,
                  const std::vector<std::filesystem::path>& read, const Origin&... origin) {
  std::vector<ReportFile> files{{"report.html", [&](std::ostream& out) { write_html(out, made, origin...); }},
                                {"report.json", [&](std::ostream& out) { write_json(out, made, origin...); }},
                                {"report.csv", [&](std::ostream& out) { write_csv(out, made); }}};
  for (const report::PlotFile& one : plots) {
    files.push_back({one.name, [&one](std::ostream& out) { write_svg(out, one.plot, report::file_ink); }});
  }
  write_files(
      folder, files, [&](std::ostream& out) { write_text(out, made); }, read);
}

}  // namespace chainmail::command_line
