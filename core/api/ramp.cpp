#include "chainmail/ramp.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>

#include "api/access.h"
#include "mesh/parameters.h"
#include "report/run/ramp.h"

namespace chainmail::api {
namespace {

constexpr std::uint64_t smallest_grid = 16;

void check_range(const char* name, bool is_in_range, const char* problem, const char* remedy) {
  if (!is_in_range) {
    throw Error(name, problem, remedy);
  }
}

void check_options(const RampOptions& options) {
  check_range("budget", options.budget > 0 && std::isfinite(options.budget), "it is not a number above 0",
              "use a number of seconds, such as 1 / 60");
  check_range("largest", options.largest >= smallest_grid && options.largest <= element_limit,
              "no grid has so many elements", "use 16 to 20000000");
  check_range("drags", options.drags >= 1, "it is below 1", "use 1 or more");
  check_range("moves", options.moves >= 1, "it is below 1", "use 1 or more");
}

report::RampOptions options_of(const RampOptions& options) {
  check_options(options);
  report::RampOptions how;
  for (const std::string& name : options.methods) {
    how.algorithms.push_back(algorithm_of(name));
    if (info(how.algorithms.back()).family() != Family::chainmail) {
      throw Error("method '" + name + "'", "it is not of the ChainMail family", "use one that is");
    }
  }
  how.seed = options.seed;
  how.budget = options.budget;
  how.largest = options.largest;
  how.drags = options.drags;
  how.moves = options.moves;
  how.precision = precision_of(options.precision);
  how.softness = softness_of(options.softness);
  check(how.softness);
  return how;
}

std::string name_of(Algorithm algorithm) { return std::string(info(algorithm).offered_name()); }

RampSize size_of(const report::RampRow& row) {
  return {row.width,     row.elements, row.links,      name_of(row.algorithm), row.passes,
          row.median_ms, row.p99_ms,   row.mean_moved, row.repeated,           row.in_real_time};
}

RampMethod method_of(const report::RampVerdict& verdict) {
  return {name_of(verdict.algorithm), verdict.largest_width, verdict.lost,
          verdict.growth ? std::optional(verdict.growth->power) : std::nullopt};
}

}  // namespace

Ramp ramp(const RampOptions& options, const Job& job) {
  return guarded([&] {
    const report::RampOptions how = options_of(options);
    const Progress progress = Access::progress(job);
    const auto tell = [&](const report::RampProgress& at) {
      progress.report(std::min(1.0, double(at.width) * at.width / double(how.largest)));
    };
    const report::Ramp found = report::ramp(how, tell, Access::stop(job));
    if (found.stopped) {
      throw Cancelled();
    }
    Ramp result;
    std::ranges::transform(found.rows, std::back_inserter(result.sizes), size_of);
    std::ranges::transform(found.verdicts, std::back_inserter(result.methods), method_of);
    result.seconds = found.seconds;
    return result;
  });
}

}  // namespace chainmail::api
