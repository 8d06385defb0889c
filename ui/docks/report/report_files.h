#pragma once

#include <filesystem>

#include "report/run/compare.h"

namespace chainmail {

/// Writes report.html, report.json and report.csv into a folder, all of them or none, as `chainmail compare` does.
/// Throws Error where that cannot be.
void saveReport(const std::filesystem::path& folder, const report::Comparison& comparison);

}  // namespace chainmail
