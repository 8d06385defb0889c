#include "report/run/ramp.h"

#include <unistd.h>

#include <algorithm>

#include "command_line/common.h"
#include "files/results/results_json.h"
#include "report/page/plots.h"
#include "report/page/report.h"
#include "report/page/svg.h"

namespace chainmail::command_line {
namespace {

struct RampArguments {
  Options options;
  std::string command_line;  // shown in the JSON
  report::RampOptions how = {};
  std::optional<std::string> json = {}, csv = {}, svg = {};
};

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

void run_ramp(RampArguments& arguments) {
  arguments.options.read();
  in_options({{"budget", "--budget"}, {"largest", "--largest"}}, [&] { check(arguments.how); });
  check_outputs({}, {arguments.json, arguments.csv, arguments.svg});
  report::Results result;
  const std::vector<OutputFile> files{
      {arguments.json, [&](std::ostream& out) { write_json(out, result); }},
      {arguments.csv, [&](std::ostream& out) { write_csv(out, result); }},
      {arguments.svg, [&](std::ostream& out) { write_svg(out, ramp_plot(result), report::file_ink); }},
      {free_output({arguments.json, arguments.csv, arguments.svg}),
       [&](std::ostream& out) { write_text(out, result); }}};
  // The share does not count, because a ramp may end long before the largest grid.
  result = watched("running grids", {},
                   [&](const Progress& progress) { return report::ramp(arguments.how, progress.part(0, 0)); });
  result.runs.push_back({origin_of(arguments.command_line)});
  write_outputs({}, files);
}

}  // namespace

Command add_ramp(CLI::App& root, const std::string& command_line) {
  CLI::App* app = root.add_subcommand("ramp", "Find the largest grid on which each algorithm runs in real time");
  const auto arguments = std::make_shared<RampArguments>(RampArguments{Options(*app), command_line});
  Options& options = arguments->options;
  report::RampOptions& how = arguments->how;
  how.largest = largest_for_memory(how.largest);
  add_algorithms(options, "algorithms to run: see deform --help [all]", algorithms, how.algorithms);
  options.add("--seed", "N", help_of("random seed of the drags", double(how.seed)), how.seed, count_from(0));
  options.add("--budget", "SECONDS", "time per pass [1/60]", how.budget, parse_number_of);
  options.add("--largest", "ELEMENTS",
              "largest number of elements in a grid [" + std::to_string(report::RampOptions().largest) +
                  ", or as many as fit into memory]",
              how.largest, count_from(1));
  add_precision(options, how.precision);
  for (const Member<LinkSoftness>& member : std::span(members_of<LinkSoftness>).first(region_numbers)) {
    options.add(member, how.softness);
  }
  options.add("--json", "FILE", "write all results as JSON", arguments->json);
  options.add("--csv", "FILE", "write one row per algorithm and size as CSV", arguments->csv);
  options.add("--svg", "FILE", "write a plot of the times against the number of elements as SVG", arguments->svg);
  app->footer(ramp_footer);
  return {app, [arguments] { run_ramp(*arguments); }};
}

}  // namespace chainmail::command_line
