// Compares two algorithms on the same drag of a sheet: time per pass, and what they do to the links.
//   compare [FOLDER]      also writes the report into FOLDER
#include <chainmail/chainmail.h>
#include <chainmail/files/results/report_json.h>
#include <chainmail/report/page/html.h>
#include <chainmail/report/run/compare.h>

#include <filesystem>
#include <fstream>
#include <iostream>

namespace cm = chainmail;

int main(int argc, char** argv) {
  const cm::Body sheet(cm::generate({cm::MeshKind::cloth, {24, 24, 1}}), cm::Precision::double_precision);
  std::vector<cm::report::Motion> path;
  for (int step = 1; step <= 20; ++step) {
    path.push_back({cm::Point(-0.3 * step, 0.2 * step, 0)});
  }
  cm::report::Case object = cm::report::case_of(sheet, "sheet");
  object.drags = {cm::report::drag_along("corner", sheet, {0}, path)};

  cm::report::CompareOptions options;
  options.algorithms = {cm::Algorithm::generalized, cm::Algorithm::exact};
  options.sweeps = {0};
  options.repetitions = 5;
  const cm::report::Comparison comparison = cm::report::compare({object}, options);

  for (const cm::report::Entry& entry : comparison.cases[0].drags[0].entries) {
    const cm::Violation& violation = entry.measurement->errors.violation;
    std::cout << label(entry.contestant) << ": " << entry.measurement->ms_per_move.median
              << " ms per pass, largest violation " << violation.max << " of rest length, " << 100 * violation.fraction
              << " % of the links violated\n";
  }
  if (argc > 1) {
    const std::filesystem::path folder = argv[1];
    const cm::report::Origin origin{cm::report::this_machine(), "compare", cm::report::now_in_words(), "example"};
    std::filesystem::create_directories(folder);
    std::ofstream html(folder / "report.html"), json(folder / "report.json");
    write_html(html, comparison, origin);
    cm::write_json(json, comparison, origin);
  }
  return 0;
}
