#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "chainmail/compare.h"
#include "chainmail/job.h"
#include "chainmail/mesh.h"

namespace chainmail::api {

struct Access;

// The suite: experiments in which all methods are measured against closed forms and converged references.

/// An experiment of the suite.
struct SuiteExperiment {
  std::string name = {};         ///< Its name.
  std::string description = {};  ///< What it measures, for readers.
  bool needs_organ = false;      ///< True if it needs SuiteOptions::organs.
  bool only_named = false;       ///< True if it takes part only where it is named, because it takes long.
};
/// Returns all experiments, in their order.
std::vector<SuiteExperiment> suite_experiments();
/// Returns part `index` of `count` of some experiments, from 1: every count-th. Together, the parts have every one
/// once. Long and short experiments follow each other, so that all parts take about as long. Throws Error if `index` is
/// not within 1 to `count`.
std::vector<std::string> part_of_suite(const std::vector<std::string>& experiments, int index, int count);

/// The solids of the experiments with an organ: samples of the project, `organ.msh` and `organ-coarse.msh`.
struct SampleOrgans {
  std::optional<Mesh> fine = {};    ///< The organ.
  std::optional<Mesh> coarse = {};  ///< The same with fewer and larger cells, for a reference on refined ones.
};

/// Options of a run of the suite.
struct SuiteOptions {
  std::vector<std::string> experiments = {};          ///< Names of experiments. Empty: all but those `only_named`.
  std::vector<std::string> methods = {};              ///< Names of methods. Empty: all.
  std::optional<int> repetitions = {};                ///< Number of runs of each drag. Default: as many as fit.
  bool calibrated = false;                            ///< Whether some methods are also calibrated on each object.
  SampleOrgans organs = {};                           ///< The solids of the experiments with an organ.
  std::string part = "1/1";                           ///< Which part of the suite this is, for the report.
  std::string command = "chainmail::api::run_suite";  ///< The command line, for the report.
  std::string program = {};                           ///< Program and version, for the report. Empty: the library's.
};

/// The result of the suite. Copies share the data.
class Suite {
 public:
  /// Returns the tables as aligned text.
  std::string text() const;
  /// Returns the report as a self-contained page.
  std::string html() const;
  /// Returns all figures as JSON. Throws Error if the library was built without nlohmann/json.
  std::string json() const;
  /// Returns all figures as CSV.
  std::string csv() const;
  /// Returns the files of the report, as those of a Comparison, with plots (SVG).
  std::vector<ReportFile> files() const;
  /// Writes these files into a folder, which is created if it is missing: all or none. Throws Error.
  void write(const std::filesystem::path& folder) const;

 private:
  friend struct Access;
  struct Impl;
  explicit Suite(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

/// Runs experiments. All figures except times are the same on every machine. Throws Error for an unknown experiment or
/// method; with `calibrated`, if the library was built without NLopt; and Cancelled.
Suite run_suite(const SuiteOptions& options = {}, const Job& job = {});
/// Joins parts of the suite: their report.json. Throws Error for a file that is not one, if an experiment occurs twice,
/// and if the library was built without nlohmann/json.
Suite merge_suites(const std::vector<std::filesystem::path>& reports);

/// Returns drags of the suite as files for other solvers (JSON). Without an organ, its drags are missing. Throws Error
/// if the library was built without nlohmann/json.
std::vector<ReportFile> suite_cases(const SampleOrgans& organs = {});
/// Measures what other solvers found for one of these files, as the suite does; returns a table for readers. Throws
/// Error for a file that is not a case or an answer to it, and if the library was built without nlohmann/json.
std::string judge_answers(const std::filesystem::path& suite_case, const std::vector<std::filesystem::path>& answers);

}  // namespace chainmail::api
