#pragma once

#include "chainmail/compare.h"
#include "chainmail/suite.h"
#include "command_line/folder.h"
#include "command_line/model.h"

namespace chainmail::command_line {

/// The options of `compare`, for both references.
struct CompareArguments {
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
CompareArguments add_compare_arguments(CLI::App& app);

/// Returns the settings of the comparison. `relax` is the default of --relax; `command_line` is shown in the report.
api::CompareOptions contest_of(const CompareArguments& arguments, const std::string& relax,
                               const std::string& command_line);
/// Returns the global softness and the kind of energy: those of the preset, where single options override its values.
SoftnessChoice softness_of(const CompareArguments& arguments);
/// Reads a mesh as an object of the report: at rest, with its softness, without drags.
api::ComparedObject object_of(const std::string& file, const CompareArguments& arguments);
/// Returns the built-in objects with the softness and the frame of the options. Throws Error if there are pins.
std::vector<api::ComparedObject> built_in_objects(api::Reference against, const CompareArguments& arguments,
                                                  const api::Elasticity& elasticity);

/// Returns true if contestants are calibrated; `by_default` without --calibrated.
bool is_calibrated(const CompareArguments& arguments, bool by_default);

/// Runs the experiments of the suite and writes the report. Throws Error before it writes anything.
void run_suite(const CLI::App& app, const CompareArguments& arguments, const std::string& command_line);
/// Joins reports of the suite. Throws Error before it writes anything.
void merge_suites(const CLI::App& app, const CompareArguments& arguments);

/// Writes drags of the suite as cases for other solvers. Throws Error before it writes anything.
void write_cases(const CLI::App& app, const CompareArguments& arguments);
/// Judges answers of other solvers to a case. Throws Error.
void judge_answers(const CLI::App& app, const CompareArguments& arguments);
/// Throws Error for an option that the given mode does not take.
void refuse_others(const CLI::App& app, const std::string& mode, const std::vector<const CLI::Option*>& taken);
/// Returns the organs of the samples whose files are there.
api::SampleOrgans sample_organs();
/// Writes files of a report into the folder, and a text to standard output. `read` are files that stay.
void write_report(OutputFolder& folder, const std::vector<api::ReportFile>& files, const std::string& text,
                  const std::vector<std::filesystem::path>& read = {});
/// Shows the progress of a report.
std::string report_progress(const api::Job& job);

/// Runs the comparison with physics and writes the report. Throws Error before it writes anything.
void compare_with_physics(const CompareArguments& arguments, const std::string& command_line);

}  // namespace chainmail::command_line
