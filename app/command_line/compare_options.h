#pragma once

#include "command_line/elastic.h"
#include "command_line/softness.h"
#include "report/run/cases.h"
#include "report/run/compare.h"
#include "report/run/suite_experiments.h"

namespace chainmail::command_line {

/// The colour of axes and words in plots: readable on light and dark backgrounds.
inline constexpr const char* plot_ink = "#808080";

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

/// Returns the settings of the comparison. `algorithms` are the allowed ones; `relax` is the default of --relax.
report::CompareOptions contest_of(const CompareArguments& arguments, std::span<const AlgorithmInfo> algorithms,
                                  const std::string& relax);
/// Returns the global softness and the kind of energy: those of the preset, where single options override its values.
Softness softness_of(const CompareArguments& arguments);
/// Reads a mesh as a case of the report: at rest, without drags.
report::Case case_of(const std::string& file, const CompareArguments& arguments);
/// Throws Error if there are pins: built-in objects have their own, or none.
void refuse_pins(const CompareArguments& arguments);
/// Gives built-in objects the frame of the option.
std::vector<report::Case> with_axes(std::vector<report::Case> cases, const CompareArguments& arguments);

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
/// Returns the organ of the samples; null if its file is missing.
report::SampleOrgans sample_organs();

/// Runs the comparison with physics and writes the report. Throws Error before it writes anything.
void compare_with_physics(const CompareArguments& arguments, const std::string& command_line);

}  // namespace chainmail::command_line
