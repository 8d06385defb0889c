#include "report/run/ramp.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "command_line/common.h"
#include "files/results/report_json.h"
#include "files/text/outputs.h"
#include "files/text/text.h"
#include "mesh/error.h"
#include "report/page/ramp_table.h"

namespace chainmail::command_line {
namespace {

struct Options {
  CLI::Option *algorithms, *seed, *budget, *largest, *precision;
  CLI::Option *compression, *stretch, *shear;
  CLI::Option *json, *csv;
};

constexpr std::uint32_t smallest_grid = 16;

constexpr const char* footer =
    "Square grids grow from 4x4. At each size all algorithms answer the same drags, whose steps are a share of\n"
    "the grid's width, as on a screen. One is out when 99% of its passes no longer keep the budget, twice.\n\n"
    "Example:\n"
    "  chainmail ramp --algorithms generalized,natural-queue,exact --csv ramp.csv";

std::vector<Algorithm> read_algorithms(const Options& options) {
  std::vector<std::string> names;
  for (const AlgorithmInfo& one : algorithms()) {
    names.emplace_back(one.name);
  }
  std::vector<Algorithm> chosen;
  const auto list = value_of(options.algorithms);
  for (std::size_t begin = 0; list && begin <= list->size();) {
    const std::size_t end = std::min(list->find(',', begin), list->size());
    const std::string word = list->substr(begin, end - begin);
    check_word("--algorithms", word, names);
    if (std::find(chosen.begin(), chosen.end(), *find_algorithm(word)) != chosen.end()) {
      throw Error("--algorithms", in_quotes(word) + " stands there twice", "name each once");
    }
    chosen.push_back(*find_algorithm(word));
    begin = end + 1;
  }
  return chosen;
}

/// The options' own limit, or what half of the memory holds where that is less.
std::uint64_t largest_for_memory(std::uint64_t limit) {
  constexpr std::uint64_t bytes_an_element = 400;  // mesh and two solvers in double, with their lists
  const auto memory =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return std::min(limit, memory / 2 / bytes_an_element);
}

std::uint64_t read_largest(const Options& options, std::uint64_t limit) {
  if (options.largest->count() == 0) {
    return largest_for_memory(limit);
  }
  const std::uint32_t largest = whole_number_of(options.largest, smallest_grid, 0);
  if (largest > element_limit) {
    throw Error("--largest", std::to_string(largest) + " is more than a mesh may have",
                "use " + std::to_string(smallest_grid) + " to " + std::to_string(element_limit));
  }
  return largest;
}

double read_budget(const Options& options, double standard) {
  const auto text = value_of(options.budget);
  const double budget = text ? parse_number_of("--budget", *text) : standard;
  if (!(budget > 0)) {
    throw Error("--budget", *text + " leaves no time", "write seconds above 0, like 0.0167");
  }
  return budget;
}

report::RampOptions read_options(const Options& options) {
  report::RampOptions result;
  result.algorithms = read_algorithms(options);
  result.seed = whole_number_of(options.seed, 0, static_cast<std::uint32_t>(result.seed));
  result.budget = read_budget(options, result.budget);
  result.softness = {value_of(options.compression, parameters::compression),
                     value_of(options.stretch, parameters::stretch), value_of(options.shear, parameters::shear)};
  const std::string precision = value_of(options.precision).value_or("float");
  check_word("--precision", precision, {"float", "double"});
  result.precision = precision == "float" ? Precision::single_precision : Precision::double_precision;
  result.largest = read_largest(options, result.largest);
  return result;
}

struct Target {
  std::filesystem::path path;
  Outputs::Writer writer;
};

void write(const std::vector<Target>& targets, bool is_trial) {
  Outputs outputs;
  for (const Target& target : targets) {
    outputs.add(target.path, is_trial ? [](std::ostream&) {} : target.writer);
  }
  if (!is_trial) {
    outputs.commit();
  }
}

/// A line on standard error, where that is a terminal; it goes when this does.
class ProgressLine {
 public:
  ProgressLine() = default;
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() {
    if (is_terminal_) {
      std::cerr << "\r\x1b[K" << std::flush;
    }
  }

  void show(const report::RampProgress& progress) const {
    if (is_terminal_) {
      std::cerr << "\r\x1b[K" << progress.width << 'x' << progress.width << ", drag " << progress.drag << " of "
                << progress.drags << (progress.repeated ? ", once more" : "")
                << ", in real time so far: " << progress.in_race.size() << std::flush;
    }
  }

 private:
  bool is_terminal_ = isatty(STDERR_FILENO) != 0;
};

void ramp(const Options& options) {
  const report::RampOptions how = read_options(options);
  report::Ramp result;
  const report::Machine machine = report::this_machine();
  std::vector<Target> targets;
  if (const auto path = value_of(options.json)) {
    targets.push_back({*path, [&](std::ostream& out) { write_json(out, result, machine); }});
  }
  if (const auto path = value_of(options.csv)) {
    targets.push_back({*path, [&](std::ostream& out) { write_csv(out, result); }});
  }
  if (std::none_of(targets.begin(), targets.end(), [](const Target& target) { return target.path == "-"; })) {
    targets.push_back({"-", [&](std::ostream& out) { write_text(out, result, machine); }});
  }
  write(targets, true);  // minutes of work must not end at a folder that is not there
  {
    const ProgressLine line;
    result = report::ramp(how, [&](const report::RampProgress& progress) { line.show(progress); });
  }
  write(targets, false);
}

}  // namespace

Command add_ramp(CLI::App& root) {
  CLI::App* app = root.add_subcommand("ramp", "Find the largest grid that each algorithm moves in real time");
  Options options{};
  options.algorithms = add_value(*app, "--algorithms", "A,B,…", "who takes part, by the names of deform [all]");
  options.seed = add_value(*app, "--seed", "N", "of the random drags [1]");
  options.budget = add_value(*app, "--budget", "SECONDS", "for a pass [a sixtieth]");
  options.largest = add_value(*app, "--largest", "ELEMENTS", "no grid beyond this [4000000, or what memory holds]");
  options.precision = add_value(*app, "--precision", "float|double", "the numbers to compute in [float]");
  options.compression = add_parameter(*app, parameters::compression);
  options.stretch = add_parameter(*app, parameters::stretch);
  options.shear = add_parameter(*app, parameters::shear);
  options.json = add_value(*app, "--json", "FILE", "everything as JSON");
  options.csv = add_value(*app, "--csv", "FILE", "a row an algorithm and size");
  app->footer(footer);
  return {app, [options] { ramp(options); }};
}

}  // namespace chainmail::command_line
