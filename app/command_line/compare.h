#pragma once

#include "command_line/model.h"
#include "report/run/physics.h"
#include "report/run/physics_cases.h"

namespace chainmail::command_line {

/// The options of `compare`, for both references and for the suite.
struct CompareArguments {
  Options options;
  std::string command_line;  // shown in the report
  CLI::Option* meshes = nullptr;
  std::optional<std::string> output = {}, preset = {}, moves = {}, experiments = {}, shard = {};
  std::optional<PinnedElements> pins = {};
  bool against_physics = false,
       refined = false;             // what errors refer to: physics, on the object's cells or refined ones
  report::PhysicsOptions how = {};  // against Exact, only what both comparisons have
  SoftnessArguments softness = {};
  ElasticOptions elastic = {};
  StrainLawArguments laws = {};
  std::optional<bool> calibrated = {};
  std::size_t handles = report::max_handles;

  bool has_meshes() const { return meshes->count() > 0; }
  bool is_quick() const { return options.has("--quick"); }
};

/// The files of every report; it also has plots.
inline const std::string report_html = "report.html", report_json = "report.json", report_csv = "report.csv";
inline const std::vector<std::string> report_files{report_html, report_json, report_csv};

/// A folder for results. It is created if it is missing, and removed again if the results are not written.
class OutputFolder {
 public:
  /// Throws Error if the folder cannot be created, or if one of these files cannot be written into it, so that a wrong
  /// name is found before any long work. Does not create it yet.
  explicit OutputFolder(std::filesystem::path path, const std::vector<std::string>& files = {});
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  /// Removes the folders that were created, unless the files were written.
  ~OutputFolder();

  /// Creates the folder and writes the files into it, or to standard output. `read` are files that stay.
  void write(std::vector<OutputFile> files, const std::vector<std::string>& read = {});
  /// Writes report.html, report.json, report.csv and plots, and the tables to standard output. Notes on standard error
  /// which plots in the folder are of an earlier report. They stay, because only the user knows whether somebody needs
  /// them.
  void write_report(const report::Results& results, const std::vector<std::string>& read = {});

 private:
  void make();

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

}  // namespace chainmail::command_line
