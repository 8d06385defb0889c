#pragma once

#include <filesystem>
#include <ostream>

#include "report/table/results.h"

namespace chainmail {

/// Writes everything that a report measured: `objects` with `drags` with `contestants`, each with its figures or the
/// reason (`refusal`) why there are none. A time is an object with its median and its spread. `figures` describes the
/// keys. See report.schema.json.
void write_json(std::ostream& out, const report::Results& results);

/// Reads a report. Throws Error if the file cannot be read, is no report, or has another version.
report::Results read_results(const std::filesystem::path& path);

}  // namespace chainmail
