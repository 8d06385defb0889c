#include "report/run/ramp.h"

#include <unistd.h>

#include <algorithm>

#include "command_line/common.h"
#include "command_line/progress_line.h"
#include "files/results/report_json.h"
#include "report/page/ramp_page.h"
#include "report/page/svg.h"
#include "report/run/machine.h"

namespace chainmail::command_line {
namespace {

struct RampArguments {
  CLI::Option *algorithms, *seed, *budget, *largest, *precision;
  CLI::Option *compression, *stretch, *shear;
  CLI::Option *json, *csv, *svg;
};

constexpr std::uint32_t smallest_grid = 16;

constexpr const char* ramp_footer =
    "Runs square grids from 4x4 upward. At each size all algorithms run the same drags, with steps in proportion to\n"
    "the grid's width, as on a screen. An algorithm stops when the 99th percentile of its pass times exceeds the\n"
    "budget twice.\n\n"
    "Example:\n"
    "  chainmail ramp --algorithms generalized,natural-queue,exact --csv ramp.csv";

/// Returns the limit, or the number of elements that fit into half of the memory if that is less.
std::uint64_t largest_for_memory(std::uint64_t limit) {
  constexpr std::uint64_t bytes_per_element = 400;  // the mesh and two solvers in double, with their lists
  const auto memory =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return std::min(limit, memory / 2 / bytes_per_element);
}

std::uint64_t read_largest(const RampArguments& options, std::uint64_t limit) {
  if (options.largest->count() == 0) {
    return largest_for_memory(limit);
  }
  const std::uint32_t largest = whole_number_of(options.largest, smallest_grid, 0);
  if (largest > element_limit) {
    throw Error("--largest", std::to_string(largest) + " is more elements than a mesh may have",
                "use " + std::to_string(smallest_grid) + " to " + std::to_string(element_limit));
  }
  return largest;
}

double read_budget(const RampArguments& options, double default_value) {
  const double budget = number_of(options.budget, default_value);
  if (!(budget > 0)) {
    throw Error("--budget", *value_of(options.budget) + " is not above 0",
                "write a number of seconds above 0, like 0.0167");
  }
  return budget;
}

report::RampOptions ramp_options(const RampArguments& options) {
  report::RampOptions result;
  result.algorithms = algorithms_of(options.algorithms, algorithms());
  result.seed = whole_number_of(options.seed, 0, static_cast<std::uint32_t>(result.seed));
  result.budget = read_budget(options, result.budget);
  result.softness = {value_of(options.compression, parameters::compression),
                     value_of(options.stretch, parameters::stretch), value_of(options.shear, parameters::shear)};
  result.precision = choice_of(options.precision, precisions(result.precision), result.precision);
  result.largest = read_largest(options, result.largest);
  return result;
}

std::string in_words(const report::RampProgress& at) {
  const std::string width = std::to_string(at.width);
  return width + 'x' + width + ", drag " + std::to_string(at.drag) + " of " + std::to_string(at.drags) +
         (at.repeated ? ", repeated" : "") + ", in real time so far: " + std::to_string(at.in_race.size());
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

void run_ramp(const RampArguments& options) {
  const report::RampOptions how = ramp_options(options);
  const report::Machine machine = report::this_machine();
  report::Ramp result;
  std::vector<Target> targets;
  if (const auto path = value_of(options.json)) {
    targets.push_back({*path, [&](std::ostream& out) { write_json(out, result, machine); }});
  }
  if (const auto path = value_of(options.csv)) {
    targets.push_back({*path, [&](std::ostream& out) { write_csv(out, result); }});
  }
  if (const auto path = value_of(options.svg)) {
    targets.push_back({*path, [&](std::ostream& out) { write_svg(out, ramp_plot(result), report::file_ink); }});
  }
  if (std::ranges::find(targets, "-", &Target::path) == targets.end()) {
    targets.push_back({"-", [&](std::ostream& out) { write_text(out, result, machine); }});
  }
  write(targets, true);  // if an output cannot be written, this fails before minutes of work
  {
    ProgressLine line;
    result = report::ramp(how, [&](const report::RampProgress& at) { line.show([&] { return in_words(at); }); });
  }
  write(targets, false);
}

}  // namespace

Command add_ramp(CLI::App& root) {
  CLI::App* app = root.add_subcommand("ramp", "Find the largest grid on which each algorithm runs in real time");
  RampArguments options{};
  options.algorithms = add_value(*app, "--algorithms", "A,B,…", "algorithms to run: see deform --help [all]");
  options.seed = add_value(*app, "--seed", "N", "random seed of the drags [1]");
  options.budget = add_value(*app, "--budget", "SECONDS", "time per pass [1/60]");
  options.largest = add_value(*app, "--largest", "ELEMENTS",
                              "largest number of elements in a grid [4000000, or as many as fit into memory]");
  options.precision = add_precision(*app, Precision::single_precision);
  options.compression = add_parameter(*app, parameters::compression);
  options.stretch = add_parameter(*app, parameters::stretch);
  options.shear = add_parameter(*app, parameters::shear);
  options.json = add_value(*app, "--json", "FILE", "write all results as JSON");
  options.csv = add_value(*app, "--csv", "FILE", "write one row per algorithm and size as CSV");
  options.svg = add_value(*app, "--svg", "FILE", "write a plot of the times against the number of elements as SVG");
  app->footer(ramp_footer);
  return {app, [options] { run_ramp(options); }};
}

}  // namespace chainmail::command_line
