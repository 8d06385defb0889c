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
  time_to_error  // error over time, in a drag of one object, in one move to its end, and perhaps after a cut
};

/// The solids of the experiments with an organ. Empty: its file was not found.
struct SampleOrgans {
  MeshPointer fine, coarse;
};

/// An experiment of the suite. To add one, add an entry to the table in suite_experiments.cpp.
struct SuiteExperiment {
  std::string_view name;         // value of --experiments, and in files
  std::string_view description;  // for readers
  SuiteKind kind;
  /// Returns its objects.
  std::vector<Case> (*cases)(const SampleOrgans& organs);
  /// Levels of its references, however long they take. 0: those that suite_reference() has time for.
  int reference_levels = 0;
  bool only_named = false;  // true: takes part only where it is named, because it takes long

  bool needs_organ() const { return name.find("organ") != std::string_view::npos; }
};

/// Returns how the suite refines its references.
ConvergingOptions suite_reference();
/// Returns how an experiment refines its references.
ConvergingOptions reference_of(const SuiteExperiment& experiment);

std::span<const SuiteExperiment> suite_experiments();

}  // namespace chainmail::report
