// Compares two algorithms on the same drag of a sheet: time per pass, and what they do to the links.
//   compare [FOLDER]      also writes the report into FOLDER
#include <chainmail/chainmail.h>
#include <chainmail/files/results/results_json.h>
#include <chainmail/report/page/report.h>
#include <chainmail/report/run/compare.h>

#include <filesystem>
#include <fstream>
#include <iostream>

namespace cm = chainmail;
namespace figures = chainmail::report::figures;

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
  cm::report::Results results = cm::report::compare({object}, options);

  for (const cm::report::Row& row : results.rows) {
    std::cout << label(row.contestant) << ": " << *row[figures::ms_per_move] << " ms per pass, largest violation "
              << *row[figures::violation_max] << " of rest length, " << 100 * *row[figures::violation_fraction]
              << " % of the links violated\n";
  }
  if (argc > 1) {
    const std::filesystem::path folder = argv[1];
    results.runs = {{{cm::report::this_machine(), "compare", cm::report::now_in_words(), "example"}}};
    std::filesystem::create_directories(folder);
    std::ofstream html(folder / "report.html"), json(folder / "report.json");
    write_html(html, results);
    cm::write_json(json, results);
  }
  return 0;
}
