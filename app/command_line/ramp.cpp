#include "chainmail/ramp.h"

#include <unistd.h>

#include <algorithm>

#include "command_line/common.h"
#include "command_line/progress_line.h"

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
  if (largest > api::element_limit) {
    throw api::Error("--largest", std::to_string(largest) + " is more elements than a mesh may have",
                     "use " + std::to_string(smallest_grid) + " to " + std::to_string(api::element_limit));
  }
  return largest;
}

double read_budget(const RampArguments& options, double default_value) {
  const auto text = value_of(options.budget);
  const double budget = text ? parse_number_of("--budget", *text) : default_value;
  if (!(budget > 0)) {
    throw api::Error("--budget", *text + " is not above 0", "write a number of seconds above 0, like 0.0167");
  }
  return budget;
}

api::RampOptions ramp_options(const RampArguments& options) {
  api::RampOptions result;
  result.methods = methods_of(options.algorithms, chainmail_methods());
  result.seed = whole_number_of(options.seed, 0, static_cast<std::uint32_t>(result.seed));
  result.budget = read_budget(options, result.budget);
  result.softness = {value_of(options.compression, api::parameter("compression")),
                     value_of(options.stretch, api::parameter("stretch")),
                     value_of(options.shear, api::parameter("shear"))};
  result.precision = precision_of(options.precision, result.precision);
  result.largest = read_largest(options, 4'000'000);
  return result;
}

struct Target {
  std::filesystem::path path;
  api::Outputs::Writer writer;
};

void write(const std::vector<Target>& targets, bool is_trial) {
  api::Outputs outputs;
  for (const Target& target : targets) {
    outputs.add(target.path, is_trial ? [](std::ostream&) {} : target.writer);
  }
  if (!is_trial) {
    outputs.commit();
  }
}

void ramp(const RampArguments& options) {
  const api::RampOptions how = ramp_options(options);
  api::Ramp result;
  std::vector<Target> targets;
  if (const auto path = value_of(options.json)) {
    targets.push_back({*path, [&](std::ostream& out) { out << result.json; }});
  }
  if (const auto path = value_of(options.csv)) {
    targets.push_back({*path, [&](std::ostream& out) { out << result.csv; }});
  }
  if (const auto path = value_of(options.svg)) {
    targets.push_back({*path, [&](std::ostream& out) { out << result.svg; }});
  }
  if (std::none_of(targets.begin(), targets.end(), [](const Target& target) { return target.path == "-"; })) {
    targets.push_back({"-", [&](std::ostream& out) { out << result.text; }});
  }
  write(targets, true);  // if an output cannot be written, this fails before minutes of work
  {
    const Watch watch([](const api::Job& job) { return job.text(); });
    result = api::ramp(how, watch.job());
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
  options.precision = add_precision(*app, api::Precision::single_precision);
  options.compression = add_parameter(*app, api::parameter("compression"));
  options.stretch = add_parameter(*app, api::parameter("stretch"));
  options.shear = add_parameter(*app, api::parameter("shear"));
  options.json = add_value(*app, "--json", "FILE", "write all results as JSON");
  options.csv = add_value(*app, "--csv", "FILE", "write one row per algorithm and size as CSV");
  options.svg = add_value(*app, "--svg", "FILE", "write a plot of the times against the number of elements as SVG");
  app->footer(ramp_footer);
  return {app, [options] { ramp(options); }};
}

}  // namespace chainmail::command_line
