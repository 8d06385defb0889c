#pragma once

#include <set>

#include "command_line/model.h"
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
#include "report/table/machine.h"
#include "report/run/physics.h"

namespace chainmail::command_line {

/// The options of `compare`, for both references and for the suite.
struct CompareArguments {
  Options options;
  std::string command_line;  // shown in the report
  CLI::Option* meshes = nullptr;
  std::optional<std::string> output = {}, preset = {}, moves = {}, pins = {}, experiments = {}, shard = {};
  bool against_physics = false,
       refined = false;  // what errors refer to: physics, on the object's cells or refined ones
  report::CompareOptions contest = {};
  SoftnessArguments softness = {};
  Options elastic_options;  // apart: they are read only for meshes
  ElasticOptions elastic = {};
  StrainLawArguments laws = {};
  double growth_seconds = report::PhysicsOptions().growth_seconds;
  std::optional<bool> calibrated = {};
};

/// A folder for results. It is created if it is missing, and removed again if the results are not written.
class OutputFolder {
 public:
  /// Throws Error if the folder cannot be created, so that a wrong name is found before any long work. Does not create
  /// it yet.
  explicit OutputFolder(std::filesystem::path path);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  /// Removes the folders that were created, unless the files were written.
  ~OutputFolder();

  /// Creates the folder and writes the files into it, and a text to standard output. `read` are files that stay.
  /// Notes on standard error which plots in the folder are of an earlier report. They stay, because only the user knows
  /// whether somebody needs them.
  void write(const std::vector<std::pair<std::string, Outputs::Writer>>& files, const Outputs::Writer& text = {},
             const std::vector<std::string>& read = {});

 private:
  void make();
  void say_older_plots(const std::set<std::string>& written) const;

  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  // outermost first
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

/// Returns where a report comes from, which ends now.
report::Origin origin_of(const CompareArguments& arguments);

/// Writes report.html, report.json, report.csv and plots into the folder, and the tables to standard output.
template <class Report, class... Origin>
void write_report(OutputFolder& folder, const Report& made, const std::vector<report::PlotFile>& plots,
                  const std::vector<std::string>& read, const Origin&... origin) {
  std::vector<std::pair<std::string, Outputs::Writer>> files{
      {"report.html", [&](std::ostream& out) { write_html(out, made, origin...); }},
      {"report.json", [&](std::ostream& out) { write_json(out, made, origin...); }},
      {"report.csv", [&](std::ostream& out) { write_csv(out, made); }}};
  for (const report::PlotFile& one : plots) {
    files.emplace_back(one.name, [&one](std::ostream& out) { write_svg(out, one.plot, report::file_ink); });
  }
  folder.write(
      files, [&](std::ostream& out) { write_text(out, made); }, read);
}

}  // namespace chainmail::command_line
