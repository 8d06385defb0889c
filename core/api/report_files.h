#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "api/access.h"
#include "report/page/plot.h"
#include "report/run/compare.h"
#include "report/run/machine.h"
#include "report/run/physics.h"

namespace chainmail::api {

/// Returns where a report comes from. Without a program, it is the library.
report::Origin origin_of(const std::string& command, const std::string& program);
/// Returns what passes the progress of a report on to a job.
report::Progress teller_of(const Job& job);
/// Returns what calibrates contestants. Throws Error if the library was built without NLopt.
report::Calibrator calibrator_of(inner::RelaxationScheme scheme);

/// Returns a plot as SVG, readable on light and dark backgrounds.
ReportFile plot_file(const std::string& name, const report::Plot& plot);
/// Returns report.html, report.json and report.csv of a report.
template <class Report>
std::vector<ReportFile> report_files(const Report& report) {
  std::vector<ReportFile> files{{"report.html", report.html()}};
#ifdef CHAINMAIL_HAS_JSON
  files.push_back({"report.json", report.json()});
#endif
  files.push_back({"report.csv", report.csv()});
  return files;
}
/// Writes files into a folder, which is created if it is missing: all or none. Throws Error.
void write_report(const std::filesystem::path& folder, const std::vector<ReportFile>& files);

}  // namespace chainmail::api
