// The ramp is not part of the public C++ interface: this calls what `chainmail ramp` calls.
#include "report/run/ramp.h"

#include <pybind11/stl.h>

#include <cmath>
#include <stop_token>

#include "api/access.h"
#include "python/long_work.h"
#include "python/module.h"
#include "python/table.h"
#include "python/words.h"

namespace chainmail::python {
namespace {

using api::Error;

constexpr std::uint64_t smallest_grid = 16;

void check_range(const char* name, bool is_in_range, const char* problem, const char* remedy) {
  if (!is_in_range) {
    throw Error(name, problem, remedy);
  }
}

void check_options(const report::RampOptions& options) {
  check_range("budget", options.budget > 0 && std::isfinite(options.budget), "it is not a number above 0",
              "use a number of seconds, such as 1 / 60");
  check_range("largest", options.largest >= smallest_grid && options.largest <= element_limit,
              "no grid has so many elements", "use 16 to 20000000");
  check_range("drags", options.drags >= 1, "it is below 1", "use 1 or more");
  check_range("moves", options.moves >= 1, "it is below 1", "use 1 or more");
}

std::string name_of(Algorithm algorithm) { return std::string(info(algorithm).offered_name()); }

void put_row(Table& table, const report::RampRow& row) {
  table.put("width", row.width);
  table.put("elements", row.elements);
  table.put("links", row.links);
  table.put("method", name_of(row.algorithm));
  table.put("passes", row.passes);
  table.put("median_ms", row.median_ms);
  table.put("p99_ms", row.p99_ms);
  table.put("mean_moved", row.mean_moved);
  table.put("repeated", row.repeated);
  table.put("real_time", row.in_real_time);
}

void put_verdict(Table& table, const report::RampVerdict& verdict) {
  table.put("method", name_of(verdict.algorithm));
  table.put("largest_width", verdict.largest_width);
  table.put("lost", verdict.lost);
  table.put("growth_exponent", verdict.growth ? std::optional(verdict.growth->power) : std::nullopt);
}

py::dict named(const report::Ramp& ramp) {
  Table sizes;
  for (const report::RampRow& row : ramp.rows) {
    put_row(sizes, row);
  }
  Table methods;
  for (const report::RampVerdict& verdict : ramp.verdicts) {
    put_verdict(methods, verdict);
  }
  py::dict result;
  result["sizes"] = sizes.columns();
  result["methods"] = methods.columns();
  result["seconds"] = ramp.seconds;
  return result;
}

/// Runs the ramp. The job receives the share of the largest grid that is done.
report::Ramp run(const report::RampOptions& options, const api::Job& job) {
  const Progress progress = api::Access::progress(job);
  const auto tell = [&](const report::RampProgress& at) {
    progress.report(std::min(1.0, double(at.width) * at.width / double(options.largest)));
  };
  report::Ramp result = api::guarded([&] { return report::ramp(options, tell, api::Access::stop(job)); });
  if (result.stopped) {
    throw api::Cancelled();
  }
  return result;
}

py::dict ramp(const report::RampOptions& options, const api::Job& job, const py::object& progress) {
  check_options(options);
  api::guarded([&] { check(options.softness); });
  return named(run_long(job, progress, [&] { return run(options, job); }));
}

std::vector<Algorithm> algorithms_of(const std::vector<std::string>& names) {
  std::vector<Algorithm> algorithms;
  for (const std::string& name : names) {
    algorithms.push_back(api::algorithm_of(name));
    if (info(algorithms.back()).family() != Family::chainmail) {
      throw Error("method '" + name + "'", "it is not of the ChainMail family", "use one that is");
    }
  }
  return algorithms;
}

}  // namespace

void add_ramp(py::module_& module) {
  const report::RampOptions defaults;
  module.def(
      "ramp",
      [](const std::vector<std::string>& methods, std::uint64_t seed, double budget, std::uint64_t largest, int drags,
         int moves, const std::string& precision, const api::LinkSoftness& softness, const std::optional<api::Job>& job,
         const py::object& progress) {
        report::RampOptions options;
        options.algorithms = algorithms_of(methods);
        options.seed = seed;
        options.budget = budget;
        options.largest = largest;
        options.drags = drags;
        options.moves = moves;
        options.precision = api::precision_of(precision_of(precision));
        options.softness = api::softness_of(softness);
        return ramp(options, job.value_or(api::Job()), progress);
      },
      py::arg("methods") = py::list(), py::kw_only(), py::arg("seed") = defaults.seed,
      py::arg("budget") = defaults.budget, py::arg("largest") = std::uint64_t{1'000'000},
      py::arg("drags") = defaults.drags, py::arg("moves") = defaults.moves, py::arg("precision") = "float",
      py::arg("softness") = api::LinkSoftness(), py::arg("job") = py::none(), py::arg("progress") = py::none(),
      "Finds the largest square grid on which each method runs in real time (Dean 2004, chapter 6).\n\n"
      "Grids grow from 4 x 4 up to `largest` elements. At each size, all methods run the same drags. A method stops "
      "when\n"
      "the 99th percentile of its pass times exceeds the `budget` (s) in two attempts. `methods` are names; default: "
      "the\n"
      "ChainMail family. `progress` is called with the share of the largest grid, 0 to 1.\n\n"
      "Returns a dictionary: `sizes` and `methods`, which are dictionaries of columns for pandas.DataFrame, and "
      "`seconds`.\n"
      "The columns of `sizes` are width, elements, links, method, passes, median_ms, p99_ms, mean_moved, repeated and\n"
      "real_time; those of `methods` are method, largest_width (None: never in real time), lost (False: there was no\n"
      "next size) and growth_exponent of the median. Raises Error for an unknown method or an option out of its "
      "range;\n"
      "and Cancelled.");
}

}  // namespace chainmail::python
