#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "measure/converging_reference.h"
#include "report/run/cases.h"

namespace chainmail::report {

/// What an experiment of the suite measures.
enum class SuiteKind {
  drags,         // errors and times of each drag of one object
  refinement,    // errors on finer and finer meshes, one object each
  time_to_error  // times to come below an error, in the first drag of one object and in one move to its end
};

/// An experiment of the suite. To add one, add an entry to the table in suite_experiments.cpp.
struct SuiteExperiment {
  std::string_view name;         // value of --experiments, and in files
  std::string_view description;  // for readers
  SuiteKind kind;
  /// Returns its objects. `organ` is the organ of the samples.
  std::vector<Case> (*cases)(const MeshPointer& organ);

  bool needs_organ() const { return name.ends_with("organ"); }
};

/// Returns how the suite refines its references.
ConvergingOptions suite_reference();

std::span<const SuiteExperiment> suite_experiments();

}  // namespace chainmail::report
