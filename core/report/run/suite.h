#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/run/physics.h"
#include "report/run/suite_experiments.h"

namespace chainmail::report {

struct SuiteOptions {
  std::vector<Algorithm> algorithms;  // empty: all
  std::optional<int> repetitions;     // of each drag; none: as many as fit
  double seconds = 1;                 // for the repetitions of one drag with all contestants
  Calibrator calibrate;               // empty: no contestant is calibrated
  SampleOrgans organs;
};

/// A part of the suite: number `index` of `count`, from 1. Together, the parts have every experiment once.
struct Shard {
  int index = 1, count = 1;
};

/// Runs experiments of the suite by their names, in turns on the calling thread. Objects have the names of their
/// experiments; those of a refinement are a series. Throws Error for a name that does not exist.
Results run_suite(const std::vector<std::string>& names, const SuiteOptions& options, const Progress& progress = {});

/// Returns the names of all experiments, in their order.
std::vector<std::string> all_suite_names();
/// Returns the names of those that run if none is named.
std::vector<std::string> suite_names();
/// Returns every count-th of the names, from the index-th on. Long and short experiments follow each other, so that all
/// parts take about as long.
std::vector<std::string> part_of(const std::vector<std::string>& names, const Shard& shard);

/// Joins the results of several runs, in the order of experiments. Throws Error if an experiment occurs twice.
Results merged(const std::vector<Results>& parts);
/// Returns the names of the experiments that a suite lacks, without those that take part only where they are named.
std::vector<std::string> missing_from(const Results& suite);

}  // namespace chainmail::report
