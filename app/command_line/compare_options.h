#pragma once

#include "command_line/elastic.h"
#include "report/run/cases.h"
#include "report/run/compare.h"

namespace chainmail::command_line {

/// What `compare` is told, whatever it compares with.
struct CompareArguments {
  CLI::Option *meshes = nullptr, *output = nullptr, *against = nullptr;
  CLI::Option *algorithms = nullptr, *relax = nullptr, *relaxation = nullptr, *relax_step = nullptr,
              *precision = nullptr, *repetitions = nullptr;
  CLI::Option *compression = nullptr, *stretch = nullptr, *shear = nullptr, *preset = nullptr, *moves = nullptr;
  ElasticArguments elastic;
  CLI::Option *pins = nullptr, *grow = nullptr, *calibrated = nullptr;
};
CompareArguments add_compare_arguments(CLI::App& app);

/// Who takes part and how, of these algorithms; `sweeps` is the list where nobody says otherwise.
report::CompareOptions contest_of(const CompareArguments& arguments, std::span<const AlgorithmInfo> algorithms,
                                  const std::string& sweeps);
/// That of all links: a preset's, by its name or in a file, and what is given beside it.
LinkSoftness softness_of(const CompareArguments& arguments);
/// A mesh as the report calls it: `{name, …}` at rest, without drags.
report::Case case_of(const std::string& file, const LinkSoftness& softness);

/// The comparison with physics. Throws Error before anything is written.
void compare_with_physics(const CompareArguments& arguments, const std::string& command_line);

}  // namespace chainmail::command_line
